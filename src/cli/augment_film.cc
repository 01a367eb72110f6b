// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "augment/impact.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/text_file.h"
#include "camera/local_frame.h"
#include "cli/augment_parts.h"
#include "cli/command.h"
#include "cli/film.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/sequence_input.h"
#include "cli/skyline_output.h"
#include "eval/csv_text.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

// Poses by frame id of a CSV with the columns id, east_m, north_m, height_m, heading_deg, pitch_deg
// and roll_deg (frames.csv of `skyline`); rows with empty fields have no pose.
std::map<std::string, Pose> ReadFramePoses(const std::string& file) {
  static const std::array<const char*, 7> kColumns = {
      "id", "east_m", "north_m", "height_m", "heading_deg", "pitch_deg", "roll_deg"};
  std::istringstream text(ReadText(file));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = Fields(line);
  std::array<std::size_t, 7> at{};
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    const auto it = std::find(header.begin(), header.end(), kColumns[k]);
    if (it == header.end()) {
      throw InputError(file, "header", "no column " + std::string(kColumns[k]), "frames.csv");
    }
    at[k] = static_cast<std::size_t>(it - header.begin());
  }
  std::map<std::string, Pose> poses;
  for (int number = 2; std::getline(text, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    if (fields.size() == 1 && fields.front().empty()) continue;
    const std::string place = "line " + std::to_string(number);
    if (fields.size() != header.size()) {
      throw InputError(file, place, std::to_string(fields.size()) + " fields",
                       std::to_string(header.size()) + " as in the header");
    }
    std::array<double, 6> v{};
    bool complete = true;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::string& field = fields[at[k + 1]];
      char* end = nullptr;
      v[k] = std::strtod(field.c_str(), &end);
      complete = complete && !field.empty();
      if (*end != '\0' || !std::isfinite(v[k])) {
        throw InputError(file, place + ": " + kColumns[k + 1], '"' + field + '"', "a number");
      }
    }
    if (!complete) continue;
    poses[fields[at[0]]] = {CamFromWorld(ViewAngles{v[3], v[4], v[5]}), {v[0], v[1], v[2]}};
  }
  return poses;
}

SequenceArguments SequenceOf(const AugmentArguments& arguments) {
  const QueryArguments& query = arguments.view.query;
  return {query.dataset, arguments.frames, query.model, query.crs,
          query.dtm,     query.camera,     arguments.sensors};
}

// The pose to draw a frame at (world): the file's, the instruments', or the dataset's.
std::optional<Pose> PoseFor(const AugmentArguments& arguments,
                            const std::map<std::string, Pose>& poses,
                            const SequenceFrame& frame) {
  if (!arguments.poses.empty()) {
    const auto it = poses.find(frame.id);
    return it == poses.end() ? std::nullopt : std::optional<Pose>(it->second);
  }
  if (!arguments.sensors.empty() || arguments.view.at == "prior") return frame.start;
  return frame.truth;
}

std::optional<Pose> Local(const std::optional<Pose>& pose, const LocalFrame& frame) {
  return pose ? std::optional<Pose>(frame.FromWorld(*pose)) : std::nullopt;
}

std::string StabilityRow(const char* poses, const InsertionStability& s) {
  return std::string(poses) + ',' + std::to_string(s.frames) + ',' +
         CsvNumber(s.mean_error_px, 3) + ',' + CsvNumber(s.worst_error_px, 3) + ',' +
         std::to_string(s.steps) + ',' + CsvNumber(s.jitter_px, 3) + '\n';
}

}  // namespace

int RunAugmentFilm(const AugmentArguments& arguments, const Context& context) {
  using Clock = std::chrono::steady_clock;
  if (fs::path(arguments.film).extension() != ".mp4") {
    throw InputError("--film", "", '"' + arguments.film + '"', "a name ending in .mp4");
  }
  CheckFileToWrite("--film", arguments.film);
  CheckFileToWrite("--stability", arguments.stability);
  SensorOptions sensors;
  ApplyConfig({"", arguments.set}, [&](OptionVisitor& v) {
    v.Group("sensors", [&](OptionVisitor& g) { sensors.Visit(g); });
  });
  CheckOptions(sensors, "sensors");
  const std::unique_ptr<SequenceInput> input =
      ReadSequence(SequenceOf(arguments), sensors, context.threads);
  for (const std::string& warning : input->warnings) context.Warn(warning);
  if (!input->scene) throw InputError("--model", "", "nothing", "a city model, or --dataset");
  std::map<std::string, Pose> poses;
  if (!arguments.poses.empty()) poses = ReadFramePoses(arguments.poses);
  const TexturedMesh mesh = ReadInsertedBuilding(
      arguments, *input->model, input->dtm ? &*input->dtm : nullptr, context);
  InsertionOptions options = arguments.insert;
  options.threads = context.threads;
  options.towards_sun = LightOf(arguments, *input->model, mesh, context);
  const Inserter inserter(*input->scene, mesh);
  const LocalFrame local{input->model->origin_in_world};
  const fs::path temporary = TemporaryBeside(arguments.film);
  std::vector<InsertedFrame> drawn, by_instruments;
  std::size_t with_pose = 0, frames = 0;
  double draw_s = 0.0;
  {
    OverlayVideo film(temporary, input->source->frames_per_second().value_or(kPictureRate));
    Progress progress(context, "Drawing", input->frames.size(), "frames");
    for (std::size_t i = 0; i < input->frames.size(); ++i, progress.Advance()) {
      const SequenceFrame& known = input->frames[i];
      cv::Mat picture = input->source->Read(i);
      if (picture.empty() || !known.camera) continue;
      if (picture.cols != known.camera->width || picture.rows != known.camera->height) {
        throw InputError(known.id,
                         "",
                         std::to_string(picture.cols) + " x " + std::to_string(picture.rows) + " px",
                         "the camera's " + std::to_string(known.camera->width) + " x " +
                             std::to_string(known.camera->height) + " px");
      }
      ++frames;
      picture = UndistortImage(picture, *known.camera);
      const PinholeCamera camera = known.camera->Pinhole();
      const std::optional<Pose> pose = Local(PoseFor(arguments, poses, known), local);
      drawn.push_back({camera, pose, Local(known.truth, local)});
      by_instruments.push_back({camera, Local(known.start, local), Local(known.truth, local)});
      if (!pose) {
        film.Add(picture);  // as it is: a guess would be worse
        continue;
      }
      ++with_pose;
      const cv::Mat foreground =
          ForegroundOf(arguments, known.id, picture, *input->scene, camera, *pose);
      const Clock::time_point start = Clock::now();
      const Insertion insertion = inserter.Insert(picture, camera, *pose, options, foreground);
      draw_s += std::chrono::duration<double>(Clock::now() - start).count();
      film.Add(insertion.picture);
    }
  }
  if (with_pose == 0) {
    throw InputError(arguments.poses.empty() ? "--poses" : arguments.poses,
                     "",
                     "no pose of any frame",
                     "frames.csv of `ridgeline skyline`, --sensors, or truths");
  }
  CommitFile(temporary, arguments.film);
  const InsertionStability stability = StabilityOf(drawn, mesh);
  const InsertionStability instruments = StabilityOf(by_instruments, mesh);
  if (!arguments.stability.empty()) {
    WriteFileAtomically(arguments.stability,
                        "poses,frames,mean_error_px,worst_error_px,steps,jitter_px\n" +
                            StabilityRow("drawn", stability) +
                            StabilityRow("instruments", instruments));
  }
  const double rate = static_cast<double>(with_pose) / std::max(1e-9, draw_s);
  if (context.json) {
    const auto json = [](const InsertionStability& s) {
      return nlohmann::ordered_json{{"frames", s.frames},
                                    {"mean_error_px", s.mean_error_px},
                                    {"worst_error_px", s.worst_error_px},
                                    {"jitter_px", s.jitter_px}};
    };
    context.Print(nlohmann::ordered_json{{"film", arguments.film},
                                         {"frames", frames},
                                         {"with_pose", with_pose},
                                         {"drawn_per_second", rate},
                                         {"drawn", json(stability)},
                                         {"instruments", json(instruments)}}
                      .dump(2));
    return kExitOk;
  }
  char line[200];
  std::snprintf(line,
                sizeof line,
                ": %zu frames, %zu with the building, %.1f drawn per second",
                frames,
                with_pose,
                rate);
  context.Print(arguments.film + line);
  for (const auto& [name, s] : {std::pair<const char*, const InsertionStability&>{"drawn", stability},
                                {"by the instruments", instruments}}) {
    if (s.frames == 0) continue;
    std::snprintf(line,
                  sizeof line,
                  "%s: error %.1f px in the mean, %.1f px at worst, jitter %.1f px (%d frames with "
                  "a truth)",
                  name,
                  s.mean_error_px,
                  s.worst_error_px,
                  s.jitter_px,
                  s.frames);
    context.Print(line);
  }
  return kExitOk;
}

}  // namespace ridgeline
