// SPDX-License-Identifier: Apache-2.0
#include "cli/skyline_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "camera/local_frame.h"
#include "cli/command.h"
#include "cli/film.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/sequence_input.h"
#include "cli/shell_command.h"
#include "cli/skyline_output.h"
#include "cli/skyline_report.h"
#include "cli/version.h"
#include "report/html_report.h"
#include "report/overlay.h"
#include "report/overlay_layers.h"
#include "report/overlay_scale.h"
#include "report/picture_file.h"
#include "skyline/skyline_file.h"
#include "track/skyline_tracker.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct SkylineArguments {
  SequenceArguments sequence;
  ConfigArguments config;
  std::string out;
  std::string skylines;
  std::string video;
  std::string report;
  bool overlays = false;
  bool columns = false;
  SkylineTrackOptions track;
  SensorOptions sensors;

  void Visit(OptionVisitor& v) {
    track.Visit(v);
    v.Group("sensors", [&](OptionVisitor& g) { sensors.Visit(g); });
  }
};

// Writes what is asked for, frame by frame, into the folder.
class Writer {
 public:
  // `report` may be null.
  Writer(const SkylineArguments& arguments,
         const fs::path& folder,
         const SequenceInput& input,
         SkylineReport* report)
      : arguments_(arguments), folder_(folder), input_(input), report_(report) {
    if (!arguments.video.empty()) {
      video_ = std::make_unique<OverlayVideo>(
          folder / arguments.video, input.source->frames_per_second().value_or(kPictureRate));
    }
  }

  void Add(std::size_t index,
           const SkylineFrameResult& result,
           const cv::Mat& picture,
           const SkylineFrame& frame,
           const PinholeCamera& camera) {
    if (arguments_.columns) {
      WriteFileAtomically(folder_ / (result.id + "_skyline.csv"), SkylineColumnsCsv(frame.skyline));
    }
    const bool reports = report_ != nullptr && report_->Shows(index);
    if (!video_ && !arguments_.overlays && !reports) return;
    const std::vector<OverlayLayer> before = LayersBefore(result, frame, camera);
    const std::vector<OverlayLayer> after = LayersAfter(frame, camera);
    if (reports) report_->AddPicture(index, result.id, picture, before, after);
    if (!video_ && !arguments_.overlays) return;
    Overlay overlay;
    overlay.layers = before;
    overlay.layers.insert(overlay.layers.end(), after.begin(), after.end());
    overlay.caption = result.id + ": " + result.status;
    const cv::Mat drawn = DrawOverlay(picture, overlay, OverlayDrawOptions{});
    if (video_) video_->Add(FilmFrame(drawn, picture.rows));
    if (arguments_.overlays) WritePicture(drawn, folder_ / (result.id + "_overlay.jpg"));
  }

 private:
  // All of one size, whatever a frame's legend takes: the photo and two rows of names.
  static cv::Mat FilmFrame(const cv::Mat& drawn, int photo_rows) {
    const cv::Size photo(drawn.cols, photo_rows);
    const int rows = photo_rows + static_cast<int>(std::lround(50.0 * OverlayScale(photo)));
    cv::Mat frame(rows, drawn.cols, CV_8UC3, cv::Scalar::all(32));
    const int shared = std::min(rows, drawn.rows);
    drawn.rowRange(0, shared).copyTo(frame.rowRange(0, shared));
    return frame;
  }

  std::vector<OverlayLayer> LayersBefore(const SkylineFrameResult& result,
                                         const SkylineFrame& frame,
                                         const PinholeCamera& camera) const {
    if (!input_.scene || !result.start) return {};
    OverlayLayer before = ModelSkylineLayer(*input_.scene, camera, frame.start);
    before.name = "model skyline by the sensors";
    before.color = {150, 150, 150};
    return {std::move(before)};
  }

  std::vector<OverlayLayer> LayersAfter(const SkylineFrame& frame,
                                        const PinholeCamera& camera) const {
    std::vector<OverlayLayer> layers = {SkylineLayer(frame.skyline)};
    if (input_.scene && frame.match.pose) {
      layers.push_back(ModelSkylineLayer(*input_.scene, camera, *frame.match.pose));
      layers.back().name = "model skyline after the match";
    }
    return layers;
  }

  const SkylineArguments& arguments_;
  const fs::path folder_;
  const SequenceInput& input_;
  SkylineReport* const report_;
  std::unique_ptr<OverlayVideo> video_;
};

// The skyline that another program found in a frame; nullopt: none is asked for. Throws InputError if
// the folder has none.
std::optional<Skyline> GivenSkyline(const SkylineArguments& arguments,
                                    const SequenceFrame& known,
                                    const cv::Mat& picture) {
  if (arguments.track.extractor != "file") return std::nullopt;
  const std::optional<fs::path> file = SkylineFileOf(arguments.skylines, known.id);
  if (!file) {
    throw InputError(arguments.skylines,
                     known.id,
                     "no skyline of this frame",
                     known.id + ".png (sky mask) or " + known.id + ".csv");
  }
  CameraIntrinsics camera{"SIMPLE_PINHOLE", picture.cols, picture.rows, {}};
  camera.params = {1.0 * picture.cols, 0.5 * picture.cols, 0.5 * picture.rows};
  return ReadSkylineFile(*file, known.camera.value_or(camera));
}

// Extraction alone, for frames without a model or a start.
SkylineFrame ExtractOnly(const cv::Mat& picture,
                         const SkylineTrackOptions& options,
                         const std::optional<Skyline>& given) {
  SkylineFrame frame;
  if (given) {
    frame.skyline = *given;
    return frame;
  }
  frame.skyline = options.extractor == "canny" ? ExtractCannySkyline(picture, options.canny)
                                               : ExtractSkyline(picture, options.skyline);
  return frame;
}

// The frame's picture as its camera sees it without distortion. Empty: missing.
cv::Mat ReadPicture(SequenceInput& input, std::size_t index) {
  const cv::Mat picture = input.source->Read(index);
  const SequenceFrame& frame = input.frames[index];
  if (picture.empty() || !frame.camera) return picture;
  if (picture.cols != frame.camera->width || picture.rows != frame.camera->height) {
    throw InputError(frame.id,
                     "",
                     std::to_string(picture.cols) + " x " + std::to_string(picture.rows) + " px",
                     "the camera's " + std::to_string(frame.camera->width) + " x " +
                         std::to_string(frame.camera->height) + " px");
  }
  return UndistortImage(picture, *frame.camera);
}

SkylineFrameResult ResultOf(const SkylineFrame& frame,
                            const SequenceFrame& known,
                            const LocalFrame& local) {
  SkylineFrameResult result;
  result.status = NameOf(frame.match.status);
  result.reason = frame.match.reason;
  result.method = NameOf(frame.method);
  result.by_sensors = frame.by_sensors;
  result.at_best = frame.at_best;
  if (frame.match.evaluations > 0) result.heading_sigma_deg = frame.match.heading_sigma_deg;
  result.start = known.start;
  if (frame.match.pose) result.pose = local.ToWorld(*frame.match.pose);
  result.times = frame.times;
  return result;
}

std::vector<SkylineFrameResult> Track(SequenceInput& input,
                                      const SkylineArguments& arguments,
                                      const fs::path& folder,
                                      SkylineReport* report,
                                      const Context& context) {
  std::optional<SkylineTracker> tracker;
  if (input.scene) tracker.emplace(*input.scene, arguments.track);
  Writer writer(arguments, folder, input, report);
  Progress progress(context, "Matching", input.frames.size(), "frames");
  std::vector<SkylineFrameResult> results;
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    const SequenceFrame& known = input.frames[i];
    const cv::Mat picture = ReadPicture(input, i);
    SkylineFrameResult result;
    if (picture.empty()) {
      result.status = "missing_picture";
      result.reason = "the picture is missing or cannot be read";
    } else {
      SkylineFrame frame;
      PinholeCamera camera;
      const std::optional<Skyline> given = GivenSkyline(arguments, known, picture);
      if (tracker && known.camera && known.start) {
        camera = known.camera->Pinhole();
        const LocalFrame local{input.model->origin_in_world};
        const Pose start = local.FromWorld(*known.start);
        frame = tracker->Track(picture, camera, start, given ? &*given : nullptr);
        result = ResultOf(frame, known, local);
        if (known.truth) {
          const Pose truth = local.FromWorld(*known.truth);
          result.at_truth = tracker->DistancesAt(frame.skyline, camera, truth);
        }
      } else {
        frame = ExtractOnly(picture, arguments.track, given);
        result.status = tracker ? "missing_sensors" : "extracted";
        result.reason = !tracker ? "" : known.camera ? known.missing : "no camera";
      }
      result.id = known.id;
      writer.Add(i, result, picture, frame, camera);
    }
    result.id = known.id;
    result.truth = known.truth;
    results.push_back(std::move(result));
    progress.Advance();
  }
  return results;
}

void Report(const SkylineSummary& s, const std::string& out, bool matched, const Context& context) {
  if (context.json) {
    nlohmann::ordered_json json{{"frames", s.frames},
                                {"matched", s.matched},
                                {"l1_before_px", s.by_sensors.used_px},
                                {"l1_after_px", s.at_best.used_px},
                                {"plain_l1_before_px", s.by_sensors.plain_px},
                                {"plain_l1_after_px", s.at_best.plain_px},
                                {"extract_ms", s.times.extract_ms},
                                {"clean_ms", s.times.clean_ms},
                                {"match_ms", s.times.match_ms}};
    if (s.with_truth > 0) {
      json["start_heading_error_deg"] = s.start_heading_deg;
      json["heading_error_deg"] = s.heading_deg;
      json["tilt_error_deg"] = s.tilt_deg;
      json["l1_truth_px"] = s.at_truth.used_px;
      json["plain_l1_truth_px"] = s.at_truth.plain_px;
    }
    context.Print(json.dump(2));
    return;
  }
  char line[256];
  if (matched) {
    std::snprintf(line, sizeof line, "%zu of %zu frames matched", s.matched, s.frames);
  } else {
    std::snprintf(
        line, sizeof line, "Skylines of %zu frames extracted; no model to match", s.frames);
  }
  context.Print(line + (", results in " + out));
  if (s.matched == 0) return;
  std::snprintf(line,
                sizeof line,
                "L1 %.1f px -> %.1f px (at 640 px; all columns: %.1f -> %.1f); extraction %.1f ms, "
                "clean-up %.1f ms, match %.1f ms",
                s.by_sensors.used_px,
                s.at_best.used_px,
                s.by_sensors.plain_px,
                s.at_best.plain_px,
                s.times.extract_ms,
                s.times.clean_ms,
                s.times.match_ms);
  context.Print(line);
  if (s.with_truth == 0) return;
  std::snprintf(
      line,
      sizeof line,
      "heading error %.2f deg -> %.2f deg, tilt error %.2f deg; L1 at the true poses %.1f "
      "px (all columns: %.1f)",
      s.start_heading_deg,
      s.heading_deg,
      s.tilt_deg,
      s.at_truth.used_px,
      s.at_truth.plain_px);
  context.Print(line);
}

// A dataset by its folder, pictures and videos by their own name.
std::string NameOf(const SequenceArguments& sequence) {
  if (sequence.dataset.empty()) return fs::path(sequence.frames).filename().string();
  return fs::absolute(sequence.dataset).parent_path().filename().string();
}

std::string CommandOf(const SkylineArguments& arguments) {
  const SequenceArguments& sequence = arguments.sequence;
  return ShellCommand("ridgeline skyline")
      .Option("--dataset", sequence.dataset)
      .Option("--frames", sequence.frames)
      .Option("--model", sequence.model)
      .Option("--crs", sequence.crs)
      .Option("--dtm", sequence.dtm)
      .Option("--camera", sequence.camera)
      .Option("--sensors", sequence.sensors)
      .Option("--config", arguments.config.config)
      .Option("--set", arguments.config.set)
      .Option("--out", arguments.out)
      .text();
}

// Of a file that is to be written; empty for none.
fs::path FolderOf(const fs::path& file) {
  return file.empty() ? fs::path() : fs::absolute(file).lexically_normal().parent_path();
}

int RunSkyline(SkylineArguments& arguments, const Context& context) {
  ApplyConfig(arguments.config, [&](OptionVisitor& v) { arguments.Visit(v); });
  CheckVisited([&](OptionVisitor& v) { arguments.Visit(v); }, "");
  if ((arguments.track.extractor == "file") == arguments.skylines.empty()) {
    throw InputError("--skylines",
                     "",
                     arguments.skylines.empty() ? "nothing" : arguments.skylines,
                     arguments.skylines.empty() ? "a folder, for extractor=file"
                                                : "--set extractor=file with it");
  }
  if (!arguments.video.empty() && fs::path(arguments.video).extension() != ".mp4") {
    throw InputError("--video", "", '"' + arguments.video + '"', "a name ending in .mp4");
  }
  const fs::path out = fs::absolute(arguments.out).lexically_normal();
  std::error_code error;
  if (fs::exists(out, error)) {
    throw InputError("--out", "", out.string() + ", which exists", "a new folder");
  }
  const std::unique_ptr<SequenceInput> input =
      ReadSequence(arguments.sequence, arguments.sensors, context.threads);
  for (const std::string& note : input->notes) context.Note(note);
  for (const std::string& warning : input->warnings) context.Warn(warning);

  // Fails before the work; the folder of the frames comes to its place after it.
  const fs::path report_folder = FolderOf(arguments.report);
  const bool beside_frames = report_folder == FolderOf(out / "frames.csv");
  const OutFolder made("--report", beside_frames ? fs::path() : report_folder);
  const fs::path temporary = TemporaryBeside(out);
  fs::create_directory(temporary);
  std::optional<SkylineReport> report;
  if (!arguments.report.empty()) report.emplace(input->frames.size());
  const std::vector<SkylineFrameResult> results =
      Track(*input, arguments, temporary, report ? &*report : nullptr, context);
  WriteFileAtomically(temporary / "frames.csv", SkylineFramesCsv(results));
  CommitFile(temporary, out);

  if (report) {
    ReportData data = report->Make(results);
    data.title = "Skylines of " + NameOf(arguments.sequence);
    data.command = CommandOf(arguments);
    data.version = VersionText();
    const int epsg = input->model ? input->model->crs.horizontal_epsg : 0;
    if (epsg != 0) data.crs = "EPSG:" + std::to_string(epsg);
    data.options_json = OptionsToJson([&](OptionVisitor& v) { arguments.Visit(v); });
    data.warnings = input->warnings;
    WriteHtmlReport(data, arguments.report);
    context.Note("report: " + arguments.report);
  }
  const SkylineSummary summary = Summarize(results);
  Report(summary, arguments.out, input->scene != nullptr, context);
  return input->scene && summary.matched == 0 ? kExitAbstained : kExitOk;
}

}  // namespace

void AddSkylineCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<SkylineArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"skyline",
       "Corrects the poses of frames by matching the skyline; without a model, extracts it.",
       "ridgeline skyline --dataset walk/dataset.json --sensors walk/sensors.csv --out poses\n"
       "ridgeline skyline --dataset walk/dataset.json --sensors walk/sensors.csv \\\n"
       "    --set match.method=2x2d --out poses_2x2d --video overlay.mp4 --report poses.html"},
      [arguments](Context& c) { return RunSkyline(*arguments, c); });
  AddSequenceOptions(*command, arguments->sequence);
  command->add_option("--out", arguments->out, "Folder for frames.csv and the rest")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--skylines",
                   arguments->skylines,
                   "Folder of skylines by another program (ID.png masks or ID.csv), for "
                   "extractor=file")
      ->type_name("DIR");
  command->add_option("--video", arguments->video, "Name of an overlay video in it (.mp4)");
  command->add_option("--report", arguments->report, "HTML report that opens offline")
      ->type_name("FILE");
  command->add_flag("--overlays", arguments->overlays, "An overlay picture per frame too");
  command->add_flag("--columns", arguments->columns, "The skyline of each frame too, as CSV");
  AddConfigOptions(*command, arguments->config);
}

}  // namespace ridgeline
