// SPDX-License-Identifier: Apache-2.0
#include "cli/track_run.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "base/atomic_file.h"
#include "base/error.h"
#include "camera/local_frame.h"
#include "city/crs.h"
#include "cli/film.h"
#include "cli/idle_options.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/shell_command.h"
#include "cli/track_output.h"
#include "cli/track_report.h"
#include "cli/version.h"
#include "localize/localizer.h"
#include "report/html_report.h"
#include "report/overlay_layers.h"
#include "report/picture_file.h"
#include "track/tracker.h"
#include "track/visual_odometry.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;


// A file or standard output that lines go to as they come.
class LineSink {
 public:
  explicit LineSink(const std::string& option, const std::string& path) {
    if (path.empty()) return;
    if (path == "-") {
      stream_ = &std::cout;
      return;
    }
    file_.open(path, std::ios::binary | std::ios::trunc);
    if (!file_) throw InputError(option, "", path + ", which cannot be written", "a file or -");
    stream_ = &file_;
  }
  explicit operator bool() const { return stream_ != nullptr; }
  void Put(const std::string& lines) { *stream_ << lines << std::flush; }

 private:
  std::ofstream file_;
  std::ostream* stream_ = nullptr;
};

void CheckRequest(const TrackRequest& request) {
  if (request.nmea == "-" && request.jsonl == "-") {
    throw InputError("--nmea", "", "standard output beside --json-lines -", "one of the two there");
  }
  if (!request.out.empty() || !request.report.empty() || !request.film.empty() ||
      !request.nmea.empty() || !request.jsonl.empty()) {
    return;
  }
  throw InputError("--out", "", "nothing to write", "--out DIR, --report, --film, --nmea or "
                                                    "--json-lines");
}

// The picture as the camera sees it without distortion, with the model at the pose.
std::vector<OverlayLayer> LayersOf(const TrackFrame& frame,
                                   const CameraIntrinsics& camera,
                                   const Localizer& localizer) {
  if (!frame.pose) return {};
  const LocalFrame local{localizer.scene().model().origin_in_world};
  return ModelEdgeLayers(localizer.scene(), camera.Pinhole(), local.FromWorld(*frame.pose));
}

// Of dataset.json its folder's name.
std::string NameOfInput(const fs::path& input) {
  const fs::path whole = fs::absolute(input).lexically_normal();
  const bool is_dataset = whole.filename() == "dataset.json" || !whole.has_filename();
  return (is_dataset ? whole.parent_path() : whole).filename().string();
}

class Session {
 public:
  Session(const TrackRequest& request, TrackWorld& world, const Context& context)
      : request_(request),
        world_(world),
        context_(context),
        localizer_(world.model, world.dtm, request.localizer),
        tracker_(localizer_, request.track, request.seed, context.threads),
        visual_(0.5 * request.track.max_speed_m_s),
        nmea_("--nmea", request.nmea),
        jsonl_("--json-lines", request.jsonl),
        report_(world.frames->size().value_or(0)) {
    if (!request.film.empty()) {
      film_ = std::make_unique<Film>(request.film,
                                     world.frames->frames_per_second().value_or(kPictureRate));
    }
    tracker_.Start(world.start);
  }

  void Run() {
    std::optional<Progress> progress;
    const auto total = world_.frames->size();
    if (total) progress.emplace(context_, "Tracking", *total, "frames");
    TrackFrameFacts facts;
    cv::Mat picture;
    while (world_.frames->Next(facts, picture)) {
      Step(facts, picture);
      if (progress) progress->Advance();
    }
    if (film_) film_->Close();
    if (rows_.empty()) throw InputError(request_.input.input, "", "no frames", "pictures in order");
  }

  void WriteResults() {
    std::vector<TrackFrame> frames;
    for (const TrackRow& row : rows_) frames.push_back(row.frame);
    const auto smoothed = Smooth(frames, world_.model.origin_in_world, request_.smoother);
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].smoothed = smoothed[i];
    if (!request_.out.empty()) {
      const fs::path out = request_.out;
      WriteTrackFiles(rows_, cameras_, world_.model, out);
      WriteFileAtomically(out / "summary.json",
                          SummaryJson(SummaryOf(rows_), tracker_.notes(), world_.start_from));
      const cv::Mat map = TrackMap(rows_, localizer_);
      if (!map.empty()) WritePicture(map, out / "map.png");
    }
    if (request_.report.empty()) return;
    ReportData data = report_.Make(rows_, localizer_);
    data.title = "Track of " + NameOfInput(request_.input.input);
    data.command = ShellCommand("ridgeline track").Word(request_.input.input).text();
    data.version = VersionText();
    data.crs = CrsName(world_.model.crs);
    data.options_json = OptionsToJson(
        [&](OptionVisitor& v) { const_cast<TrackRequest&>(request_).Visit(v); });
    data.warnings = tracker_.notes();
    WriteHtmlReport(data, request_.report);
  }

  const std::vector<TrackRow>& rows() const { return rows_; }
  const std::vector<std::string>& notes() const { return tracker_.notes(); }

 private:
  void Step(const TrackFrameFacts& facts, const cv::Mat& picture) {
    TrackInput input;
    input.id = facts.id;
    input.time_s = facts.time_s;
    input.camera = facts.camera;
    input.motion = facts.motion;
    input.motion_missing = facts.motion_missing;
    input.heading_deg = facts.heading_deg;
    input.pitch_deg = facts.pitch_deg;
    input.roll_deg = facts.roll_deg;
    input.fix = facts.fix;
    input.picture = picture;
    std::string trouble;
    if (!picture.empty() && facts.camera &&
        (picture.cols != facts.camera->width || picture.rows != facts.camera->height)) {
      trouble = "the picture is " + std::to_string(picture.cols) + " x " +
                std::to_string(picture.rows) + " px, the camera's " +
                std::to_string(facts.camera->width) + " x " +
                std::to_string(facts.camera->height);
      input.picture = cv::Mat();
    } else if (!picture.empty() && !facts.camera) {
      trouble = "the camera is not known";
      input.picture = cv::Mat();
    }
    if (!world_.has_odometry && !input.picture.empty()) SeeMotion(facts, input);
    const TrackFrame frame = tracker_.Step(input);
    rows_.push_back({frame, std::nullopt, facts.truth});
    if (!trouble.empty()) rows_.back().frame.reason = trouble;
    cameras_.push_back(facts.camera);
    Tell(rows_.back().frame);
    Draw(rows_.back().frame, input);
    last_s_ = facts.time_s ? facts.time_s : last_s_;
  }

  // Without odometry: motion from the pictures.
  void SeeMotion(const TrackFrameFacts& facts, TrackInput& input) {
    const double seconds =
        facts.time_s && last_s_ && *facts.time_s > *last_s_ ? *facts.time_s - *last_s_ : 1.0;
    const VisualOdometry::Result seen = visual_.Next(UndistortImage(input.picture, *facts.camera),
                                                     facts.camera->Pinhole(),
                                                     seconds,
                                                     facts.speed_m_s);
    input.motion = seen.motion;
    input.motion_missing = seen.missing;
    input.is_cut = seen.is_cut;
    if (seen.zoom) {
      char text[120];
      std::snprintf(text,
                    sizeof text,
                    "the picture has grown by a factor of %.2f at once: the focal length has changed",
                    *seen.zoom);
      input.is_cut = true;
      input.cut_reason = text;
    }
  }

  void Tell(const TrackFrame& frame) {
    const Crs& crs = world_.model.crs;
    const TrackFrame* before = posed_ ? &rows_[*posed_].frame : nullptr;
    if (nmea_) nmea_.Put(TrackNmea(frame, before, crs));
    if (jsonl_) jsonl_.Put(TrackJsonLine(frame, crs));
    if (!frame.pose) return;
    if (before != nullptr && frame.state == TrackState::kTracking &&
        before->state == TrackState::kTracking && before->time_s && frame.time_s &&
        *frame.time_s > *before->time_s) {
      visual_.Learn(
          (frame.pose->center_in_world - before->pose->center_in_world).norm() /
          (*frame.time_s - *before->time_s));
    }
    posed_ = rows_.size() - 1;
  }

  void Draw(const TrackFrame& frame, const TrackInput& input) {
    const std::size_t index = rows_.size() - 1;
    const bool reports = !request_.report.empty() && report_.Shows(index);
    if ((!film_ && !reports) || input.picture.empty()) return;
    const cv::Mat photo = UndistortImage(input.picture, *input.camera);
    const std::vector<OverlayLayer> layers = LayersOf(frame, *input.camera, localizer_);
    if (reports) report_.AddPicture(index, frame.id, photo, layers);
    if (!film_) return;
    Overlay overlay;
    overlay.layers = layers;
    char text[160];
    std::snprintf(text,
                  sizeof text,
                  "%s: %s, confidence %.2f%s",
                  frame.id.c_str(),
                  NameOf(frame.state),
                  frame.confidence,
                  frame.gnss && frame.gnss->lies ? ", GNSS lies" : "");
    overlay.caption = text;
    film_->Add(DrawOverlay(photo, overlay, OverlayDrawOptions{}));
  }

  const TrackRequest& request_;
  TrackWorld& world_;
  const Context& context_;
  Localizer localizer_;
  Tracker tracker_;
  VisualOdometry visual_;
  LineSink nmea_, jsonl_;
  std::unique_ptr<Film> film_;
  TrackReport report_;
  std::vector<TrackRow> rows_;
  std::vector<std::optional<CameraIntrinsics>> cameras_;
  std::optional<std::size_t> posed_;  // the last frame with a pose
  std::optional<double> last_s_;
};

void Print(const TrackRequest& request, const Session& session, const Context& context) {
  if (request.nmea == "-" || request.jsonl == "-") return;  // standard output is taken
  const TrackSummary s = SummaryOf(session.rows());
  if (context.json) {
    context.Print(SummaryJson(s, session.notes(), ""));
    return;
  }
  char line[240];
  std::snprintf(line,
                sizeof line,
                "%zu of %zu frames tracked, %zu lost; %.0f ms a frame",
                s.tracking,
                s.frames,
                s.lost,
                s.median_ms);
  context.Print(line);
  const auto errors = [&](const char* name, const TrackErrors& e) {
    if (e.posed == 0) {
      context.Print(std::string(name) + ": no pose");
      return;
    }
    std::snprintf(line,
                  sizeof line,
                  "%-11s ATE %.2f m, RPE %.2f m %.2f deg; within 1 / 3 / 5 m %.0f / %.0f / %.0f %% "
                  "of %zu frames",
                  name,
                  e.ate_rmse_m,
                  e.rpe_rmse_m,
                  e.rpe_rmse_deg,
                  100.0 * e.within_1m,
                  100.0 * e.within_3m,
                  100.0 * e.within_5m,
                  e.frames);
    context.Print(line);
  };
  if (s.causal.frames > 0) {
    errors("as it came", s.causal);
    errors("smoothed", s.smoothed);
  }
  if (s.gnss && s.gnss->lies) {
    std::snprintf(line,
                  sizeof line,
                  "the receiver lies since %.1f s (a %s), noticed at %s",
                  s.gnss->since_s,
                  s.gnss->is_drag ? "drag" : "jump",
                  s.gnss_noticed_at.value_or("?").c_str());
    context.Print(line);
  }
  for (const std::string& note : session.notes()) context.Print("note        " + note);
}

}  // namespace

void TrackRequest::Visit(OptionVisitor& v) {
  localizer.Visit(v);
  v.Group("track", [this](OptionVisitor& g) { track.Visit(g); });
  v.Group("smoother", [this](OptionVisitor& g) { smoother.Visit(g); });
  v.Group("sensors", [this](OptionVisitor& g) { sensors.Visit(g); });
}

int RunTrack(TrackRequest& request, const Context& context) {
  CheckRequest(request);
  ApplyConfig(request.config, [&](OptionVisitor& v) { request.Visit(v); });
  CheckVisited([&](OptionVisitor& v) { request.Visit(v); }, "");
  RefuseIdleOptions(request.config.set, request.localizer);
  const OutFolder out_folder("--out", request.out);
  CheckFileToWrite("--report", request.report);
  CheckFileToWrite("--film", request.film);
  const std::unique_ptr<TrackWorld> world =
      ReadTrack(request.input, request.sensors, context.threads);
  for (const std::string& warning : world->warnings) context.Warn(warning);
  context.Note("start: " + world->start_from);
  if (!world->has_odometry) {
    context.Note("no odometry: motion is taken from the pictures, approximately");
  }
  Session session(request, *world, context);
  session.Run();
  session.WriteResults();
  Print(request, session, context);
  for (const TrackRow& row : session.rows()) {
    if (row.frame.state == TrackState::kTracking) return kExitOk;
  }
  return kExitAbstained;
}

}  // namespace ridgeline
