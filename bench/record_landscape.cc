// SPDX-License-Identifier: Apache-2.0
// Records the energy of a score around the true poses of a dataset as landscapes (landscape.h): one
// CSV per query over east, north and heading, for optim_landscape.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/bench.h"
#include "input/world.h"
#include "localize/pose_scorer.h"
#include "localize/pose_volume.h"
#include "score/picture_evidence.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

struct Settings {
  std::string dataset;
  std::string folder = ".";
  std::string perturb = "10,10,0,20";
  int every = 1;
  int seed = 1;
  int threads = 1;
  LocalizerOptions options;
};

std::string CsvOf(const PoseVolume& volume) {
  std::ostringstream csv;
  csv << "east_m,north_m,heading_deg,energy\n";
  std::size_t index = 0;
  for (const double north : volume.north_m) {
    for (const double east : volume.east_m) {
      for (const double heading : volume.heading_deg) {
        const float log_ratio = volume.log_ratios[index++];
        csv << east << ',' << north << ',' << heading << ',';
        std::isfinite(log_ratio) ? csv << Score::EnergyOf(log_ratio) : csv << "nan";
        csv << '\n';
      }
    }
  }
  return csv.str();
}

void Record(const Query& query, const Localizer& localizer, const Settings& settings) {
  const Perturbation half = ParsePerturbation(settings.perturb);
  PictureReader pictures;
  LocalizationInput input = InputOf(query, localizer.options(), pictures);
  input.prior = DrawPrior(*query.truth, half, settings.seed, query.id);
  PoseSpaceOptions ranges = localizer.options().search.space;
  ranges.east_m = half.east_m;
  ranges.north_m = half.north_m;
  ranges.heading_deg = half.heading_deg;
  ranges.height_m = ranges.pitch_deg = ranges.roll_deg = 0.0;

  const LocalizerOptions& options = localizer.options();
  const PictureEvidence picture(UndistortImage(BgrOf(input.picture), input.camera),
                                input.camera.Pinhole(),
                                options.lines,
                                options.score.evidence,
                                settings.threads,
                                input.lines);
  const auto score = MakeScore({picture, localizer.scene(), options.score});
  const PoseSpace space(
      input.prior, ranges, localizer.scene(), localizer.dtm(), localizer.footprints());
  const ViewAngles& center = space.center_angles();
  const std::vector<Tilt> level = {{center.pitch_deg, center.roll_deg, 0.0}};
  const PoseScorer scorer(
      *score, localizer.scene(), space, picture.camera(), options.score.evidence.surface_step_deg);
  const PoseVolume volume = ComputeVolume(scorer, level, options.search.map, settings.threads);
  const auto path = std::filesystem::path(settings.folder) / (query.id + ".csv");
  WriteFileAtomically(path, CsvOf(volume));
  std::printf("%s: %zu poses\n", path.c_str(), volume.log_ratios.size());
}

void RecordAll(const Settings& settings) {
  const Dataset dataset = ReadDataset(settings.dataset);
  constexpr double kMarginM = 100.0;
  const World world = ReadWorld(dataset, kMarginM);
  const Localizer localizer(world.model, world.dtm, settings.options);
  int number = 0;
  for (const Query& query : dataset.queries) {
    if (query.truth && number++ % settings.every == 0) Record(query, localizer, settings);
  }
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  ridgeline::Settings settings;
  settings.options.search.map.spacing_m = 0.5;
  settings.options.search.map.max_positions = 100000;
  std::vector<std::string> assignments;
  CLI::App app("Records energies around the true poses of a dataset");
  app.add_option("dataset", settings.dataset, "dataset.json")->required();
  app.add_option("--folder", settings.folder, "where the CSV files go");
  app.add_option("--perturb", settings.perturb, "half-ranges: east, north, height, heading");
  app.add_option("--every", settings.every, "one query in so many")->check(CLI::PositiveNumber);
  app.add_option("--seed", settings.seed, "of the drawn priors");
  app.add_option("--threads", settings.threads);
  app.add_option("--set", assignments, "options, e.g. search.map.spacing_m=1");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& assignment : assignments) {
      ridgeline::SetOption(assignment,
                           [&](ridgeline::OptionVisitor& v) { settings.options.Visit(v); });
    }
    ridgeline::RecordAll(settings);
  } catch (const ridgeline::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
