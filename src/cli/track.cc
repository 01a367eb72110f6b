// SPDX-License-Identifier: Apache-2.0
#include "cli/track.h"

#include <memory>

#include "cli/command.h"
#include "cli/track_run.h"
#include "cli/unsigned_option.h"

namespace ridgeline {

void AddTrackCommand(CLI::App& app, Context& context) {
  auto request = std::make_shared<TrackRequest>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"track",
       "Follows a camera through the model: a film, a drive or a flight.",
       "ridgeline track drive/dataset.json --odometry drive/odometry.csv --out track\n"
       "ridgeline track film.mp4 --model city.gml --dtm dtm.tif --camera cam.json \\\n"
       "    --prior start.json --out track --report track.html --film track.mp4\n"
       "camera | ridgeline track - --model city.gml --camera cam.json --prior start.json --nmea -"},
      [request](Context& c) { return RunTrack(*request, c); });
  TrackArguments& input = request->input;
  command->add_option("input", input.input, "dataset.json, folder of pictures, film, or -: lines")
      ->required()
      ->type_name("INPUT");
  command->add_option("--odometry", input.odometry, "Motion: CSV, TUM or KITTI; else by pictures");
  command->add_option("--sensors", input.sensors, "Sensor readings per frame (CSV)");
  command->add_option("--prior", input.prior, "Where the search begins (JSON)");
  command->add_option("--model", input.model, "City model files or folders")->type_name("PATH");
  command->add_option("--dtm", input.dtm, "Terrain raster");
  command->add_option("--crs", input.crs, "Projected system of the positions");
  command->add_option("--camera", input.camera, "Camera file (JSON)");
  command->add_option("--out", request->out, "Folder for frames.csv, summary.json and the rest")
      ->type_name("DIR");
  command->add_option("--report", request->report, "HTML report that opens offline")
      ->type_name("FILE");
  command->add_option("--film", request->film, "Film with the model drawn in (.mp4 or .webm)")
      ->type_name("FILE");
  command->add_option("--nmea", request->nmea, "NMEA 0183 sentences as they come; -: stdout")
      ->type_name("FILE");
  command->add_option("--json-lines", request->jsonl, "A line of JSON per frame; -: stdout")
      ->type_name("FILE");
  command->add_flag("--follow", input.follow, "Take pictures as they appear in the folder");
  command->add_option("--idle", input.idle_s, "With --follow: end after so long without one [s]")
      ->check(CLI::PositiveNumber)
      ->needs("--follow");
  command->add_option("--seed", request->seed, "Seed of the particles (default 1)")
      ->check(Unsigned());
  AddConfigOptions(*command, request->config);
}

}  // namespace ridgeline
