// SPDX-License-Identifier: Apache-2.0
#include "cli/replay.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "base/error.h"
#include "camera/local_frame.h"
#include "city/read_city.h"
#include "cli/command.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/sequence_input.h"
#include "cli/unsigned_option.h"
#include "cli/version.h"
#include "eval/bench.h"
#include "input/picture_input.h"
#include "input/world.h"
#include "replay/ayadi_pages.h"
#include "replay/loeper_pages.h"
#include "score/picture_evidence.h"
#include "study/study.h"

namespace ridgeline {
namespace {

struct LoeperArguments {
  std::string dataset;
  std::string out;
  std::string query;                 // of Fig. 2 and 3; empty: the first
  std::vector<std::string> queries;  // empty: all
  std::vector<std::string> methods;
  int pictures = 10;  // of Fig. 5
  LoeperReplayOptions replay;
};

struct AyadiArguments {
  SequenceArguments sequence;
  std::string out;
  std::string frame;  // empty: the middle one
  bool known_position = false;
  bool rendered = false;
  std::string building;
  double domain_m = 5.0;
  SensorOptions sensors;
  std::vector<std::string> set;
};

std::vector<LoeperMethod> ChosenMethods(const std::vector<std::string>& names) {
  std::vector<LoeperMethod> chosen;
  for (LoeperMethod& method : LoeperMethods()) {
    if (names.empty() || std::find(names.begin(), names.end(), method.name) != names.end()) {
      chosen.push_back(std::move(method));
    }
  }
  return chosen;
}

void AddChosenPicture(const Query& query,
                      const Localizer& localizer,
                      ReplayPage& page) {
  const LocalizerOptions& options = localizer.options();
  PictureReader pictures;
  const LocalizationInput input = InputOf(query, options, pictures);
  const PictureEvidence evidence(UndistortImage(BgrOf(input.picture), input.camera),
                                 input.camera.Pinhole(),
                                 options.lines,
                                 options.score.evidence,
                                 1,
                                 input.lines);
  const Pose truth =
      LocalFrame{localizer.scene().model().origin_in_world}.FromWorld(*query.truth);
  AddLoeperFigures(DrawLoeperFigures(evidence.bgr(),
                                     evidence.segments(),
                                     localizer.scene().model(),
                                     evidence.camera(),
                                     truth,
                                     options.score.groups.Get<LineEnergyOptions>(),
                                     options.score.groups.Get<ZbufferHoughOptions>()),
                   query.id + " at its true pose",
                   page);
}

int RunLoeper(const LoeperArguments& arguments, const Context& context) {
  LoeperReplayOptions options = arguments.replay;
  options.threads = context.threads;
  options.Validate();
  Dataset dataset = ReadDataset(arguments.dataset);
  CompleteFromPictures(dataset, false, PictureInputOptions{});
  const std::vector<std::size_t> queries = StudyQueries(dataset, arguments.queries);
  const std::size_t shown =
      arguments.query.empty() ? queries.front() : FindQuery(dataset, arguments.query, "--query");
  if (!dataset.queries[shown].truth) {
    throw InputError("--query", "", arguments.query + ", which has no truth", "one with a truth");
  }
  const OutFolder out_folder("--out", arguments.out);
  WorldRequest request = RequestFor(dataset, 100.0);
  request.needs_terrain = true;
  const World world = ReadWorld(request);
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const std::vector<LoeperMethod> methods = ChosenMethods(arguments.methods);
  std::vector<std::unique_ptr<Localizer>> localizers;
  for (const LoeperMethod& method : methods) {
    localizers.push_back(std::make_unique<Localizer>(world.model, world.dtm, method.options));
  }
  ReplayPage page("Loeper et al., replayed on " + dataset.name,
                  {{"dataset", arguments.dataset},
                   {"seed", std::to_string(options.seed)},
                   {"version", VersionText()}});
  std::vector<LoeperRun> runs;
  {
    std::unique_ptr<Progress> progress;
    runs = ReplayLoeper(dataset,
                        queries,
                        methods,
                        localizers,
                        options,
                        [&](std::size_t done, std::size_t total) {
                          if (!progress) {
                            progress =
                                std::make_unique<Progress>(context, "Searching", total, "boxes");
                          }
                          progress->Set(done);
                        });
  }
  AddChosenPicture(dataset.queries[shown], *localizers.front(), page);
  AddLoeperResults(
      dataset, methods, runs, options, static_cast<std::size_t>(arguments.pictures), page);
  page.WriteTo(arguments.out);
  context.Print("written to " + arguments.out + "/index.html");
  return kExitOk;
}

// A frame of the sequence, if picture, camera and instruments are there.
std::optional<AyadiFrame> FrameOf(SequenceInput& input, std::size_t index, bool known_position) {
  const SequenceFrame& known = input.frames[index];
  if (!known.camera || !known.start) return std::nullopt;
  const cv::Mat picture = input.source->Read(index);
  if (picture.empty()) return std::nullopt;
  const LocalFrame local{input.model->origin_in_world};
  AyadiFrame frame;
  frame.id = known.id;
  frame.picture = UndistortImage(picture, *known.camera);
  frame.camera = known.camera->Pinhole();
  frame.instruments = local.FromWorld(*known.start);
  if (known.truth) {
    frame.truth = local.FromWorld(*known.truth);
    if (known_position) frame.instruments.center_in_world = frame.truth->center_in_world;
  } else if (known_position) {
    throw InputError("--known-position", "", known.id + " without a truth", "true positions");
  }
  return frame;
}

// The new building of Fig. 13: a file's, with coordinates of its own, or a tower.
TexturedMesh NewBuilding(const AyadiArguments& arguments,
                      const SequenceInput& input,
                      const AyadiFrame& frame) {
  if (arguments.building.empty()) {
    constexpr double kDistanceM = 60.0;
    const auto ground =
        input.dtm ? input.dtm->HeightAt(frame.instruments.center_in_world.head<2>()) : std::nullopt;
    return TexturedFrom(TowerBefore(frame.truth.value_or(frame.instruments),
                       kDistanceM,
                       ground.value_or(frame.instruments.center_in_world.z() - 1.6)));
  }
  CityOptions options;
  if (input.model->crs.horizontal_epsg != 0) {
    options.project_to = "EPSG:" + std::to_string(input.model->crs.horizontal_epsg);
  }
  const CityModel model = ReadCity({arguments.building}, options);
  TexturedMesh mesh = TexturedFrom(model);
  for (Eigen::Vector3d& v : mesh.vertices) v += model.origin_in_world - input.model->origin_in_world;
  return mesh;
}

// Poses from the last frame's, as `ridgeline skyline` has them by default.
AyadiTemporal TemporalPoses(const Scene& scene, const std::vector<AyadiFrame>& frames) {
  SkylineTracker tracker(scene, SkylineTrackOptions{});
  AyadiTemporal temporal;
  for (const AyadiFrame& frame : frames) {
    temporal.poses.push_back(
        tracker.Track(frame.picture, frame.camera, frame.instruments).match.pose);
  }
  return temporal;
}

std::size_t ChosenFrame(const std::vector<AyadiFrame>& frames, const std::string& id) {
  if (id.empty()) return frames.size() / 2;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].id == id) return i;
  }
  throw InputError("--frame", "", '"' + id + '"', "a frame, e.g. \"" + frames.front().id + '"');
}

int RunAyadi(AyadiArguments& arguments, const Context& context) {
  ApplyConfig({"", arguments.set}, [&](OptionVisitor& v) {
    v.Group("sensors", [&](OptionVisitor& g) { arguments.sensors.Visit(g); });
  });
  CheckOptions(arguments.sensors, "sensors");
  const OutFolder out_folder("--out", arguments.out);
  const std::unique_ptr<SequenceInput> input =
      ReadSequence(arguments.sequence, arguments.sensors, context.threads);
  if (!input->scene) throw InputError("--model", "", "nothing", "a city model, or --dataset");
  for (const std::string& note : input->notes) context.Note(note);
  for (const std::string& warning : input->warnings) context.Warn(warning);
  std::vector<AyadiFrame> frames;
  for (std::size_t i = 0; i < input->frames.size(); ++i) {
    if (auto frame = FrameOf(*input, i, arguments.known_position)) {
      frames.push_back(std::move(*frame));
    } else {
      context.Note(input->frames[i].id + ": left out (" + input->frames[i].missing + ")");
    }
  }
  if (frames.empty()) {
    throw InputError("--sensors", "", "no frame with picture and instruments", "at least one");
  }
  const std::size_t chosen = ChosenFrame(frames, arguments.frame);
  const TexturedMesh tower = NewBuilding(arguments, *input, frames[chosen]);
  ReplayPage page("Ayadi et al., replayed on " +
                      (arguments.sequence.dataset.empty() ? arguments.sequence.frames
                                                          : arguments.sequence.dataset),
                  {{"frames", std::to_string(frames.size())},
                   {"position",
                    arguments.known_position ? "known, as shown on a map" : "by the instruments"},
                   {"version", VersionText()}});
  std::vector<AyadiRun> runs;
  for (AyadiVariant& variant : AyadiVariants()) {
    variant.rendered = arguments.rendered && variant.name == "printed";
    Progress progress(context, "Matching, " + variant.name, frames.size(), "frames");
    AyadiRun run{variant, {}};
    for (const AyadiFrame& frame : frames) {
      run.frames.push_back(ReplayFrame(*input->scene, variant, frame));
      progress.Advance();
    }
    runs.push_back(std::move(run));
  }
  AddAyadiResults(runs, page);
  AddAyadiSizes(runs, page);
  AddAyadiStability(runs, frames, TemporalPoses(*input->scene, frames), tower, page);
  for (const AyadiRun& run : runs) {
    AddAyadiFrame(
        *input->scene, run.variant, frames[chosen], run.frames[chosen], &tower, page);
  }
  const AyadiRun& last = runs.back();
  AddAyadiDomain(ExploreDomain(*input->scene,
                               last.variant,
                               frames[chosen],
                               last.frames[chosen].skyline,
                               arguments.domain_m,
                               0.5,
                               context.threads),
                 frames[chosen],
                 last.variant.name,
                 page);
  page.WriteTo(arguments.out);
  context.Print("written to " + arguments.out + "/index.html");
  return kExitOk;
}

void AddLoeper(CLI::App& replay, Context& context) {
  auto arguments = std::make_shared<LoeperArguments>();
  CLI::App* command =
      AddCommand(replay,
                 context,
                 {"loeper",
                  "Loeper et al.: line segments against CityGML; Fig. 2, 3, 5 and Table 1.",
                  "ridgeline replay loeper town/dataset.json --out loeper"},
                 [arguments](Context& c) { return RunLoeper(*arguments, c); });
  command->add_option("dataset", arguments->dataset, "dataset.json, with truths")->required();
  command->add_option("--out", arguments->out, "Folder for index.html, CSV and PNG files")
      ->required()
      ->type_name("DIR");
  command->add_option("--query", arguments->query, "Picture of Fig. 2 and 3 [the first]")
      ->type_name("ID");
  command
      ->add_option("--queries", arguments->queries, "These pictures only (default: all with a truth)")
      ->type_name("ID")
      ->delimiter(',');
  command->add_option("--methods", arguments->methods, "printed, corrected, evidence [all]")
      ->delimiter(',')
      ->check(CLI::IsMember({"printed", "corrected", "evidence"}));
  command->add_option("--side", arguments->replay.sides_m, "Sides of the box [m]")
      ->delimiter(',')
      ->default_str("40,20");
  command->add_option("--heading", arguments->replay.headings_deg, "Half-ranges of kappa [deg]")
      ->delimiter(',')
      ->default_str("10,20");
  command->add_option("--iterations", arguments->replay.iterations, "Poses looked at, rising")
      ->delimiter(',')
      ->default_str("50,100,200");
  command->add_option("--pictures", arguments->pictures, "Pictures of Fig. 5")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", arguments->replay.seed, "Seed of priors and samplers")
      ->capture_default_str()
      ->check(Unsigned());
}

void AddAyadi(CLI::App& replay, Context& context) {
  auto arguments = std::make_shared<AyadiArguments>();
  CLI::App* command = AddCommand(
      replay,
      context,
      {"ayadi",
       "Ayadi et al.: skylines for augmented reality; Fig. 8 to 13, Tables 1 and 2.",
       "ridgeline replay ayadi --dataset walk/dataset.json --sensors walk/sensors.csv \\\n"
       "    --set sensors.declination_deg=4 --set sensors.held=landscape --out ayadi"},
      [arguments](Context& c) { return RunAyadi(*arguments, c); });
  AddSequenceOptions(*command, arguments->sequence);
  command->add_option("--out", arguments->out, "Folder for index.html, CSV and PNG files")
      ->required()
      ->type_name("DIR");
  command->add_option("--frame", arguments->frame, "Frame of Fig. 8 to 13 [the middle one]")
      ->type_name("ID");
  command->add_flag("--known-position",
                    arguments->known_position,
                    "The true position, as if shown on a map, in place of the instruments'");
  command->add_flag("--rendered",
                    arguments->rendered,
                    "As printed: virtual skylines extracted from rendered images (slow)");
  command
      ->add_option("--building", arguments->building, "Building of Fig. 13, placed by its coordinates")
      ->type_name("PATH");
  command->add_option("--domain", arguments->domain_m, "Half side of Fig. 9 [m]")
      ->capture_default_str()
      ->check(CLI::Range(0.5, 50.0));
  command->add_option("--set", arguments->set, "Options of the sensors, e.g. sensors.declination_deg=4")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void AddReplayCommand(CLI::App& app, Context& context) {
  CLI::App* replay = app.add_subcommand(
      "replay", "Redoes a paper's experiments on one's own data: its figures and tables.");
  replay->footer("Example:\n  ridgeline replay loeper town/dataset.json --out loeper");
  replay->fallthrough();
  replay->require_subcommand(1);
  AddLoeper(*replay, context);
  AddAyadi(*replay, context);
}

}  // namespace ridgeline
