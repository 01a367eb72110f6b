// SPDX-License-Identifier: Apache-2.0
#include "cli/skyline_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "base/error.h"

namespace ridgeline {
namespace {

// Widest picture of a video [px].
constexpr int kMaxVideoWidthPx = 1280;

std::string Number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

// Fields of a CSV row; missing numbers are empty fields.
class Row {
 public:
  Row& Text(const std::string& text) {
    const bool quote = text.find_first_of(",\"\n") != std::string::npos;
    return Put(quote ? '"' + text + '"' : text);
  }
  Row& Add(std::optional<double> value, int digits) {
    return Put(value ? Number(*value, digits) : std::string());
  }
  std::string Line() const { return line_ + '\n'; }

 private:
  Row& Put(const std::string& field) {
    if (!first_) line_ += ',';
    first_ = false;
    line_ += field;
    return *this;
  }

  std::string line_;
  bool first_ = true;
};

void AddPose(const std::optional<Pose>& pose, Row& row) {
  if (!pose) {
    for (int i = 0; i < 6; ++i) row.Add(std::nullopt, 0);
    return;
  }
  const ViewAngles angles = ViewAnglesOf(pose->cam_from_world);
  for (int i = 0; i < 3; ++i) row.Add(pose->center_in_world[i], 3);
  row.Add(angles.heading_deg, 4).Add(angles.pitch_deg, 4).Add(angles.roll_deg, 4);
}

// Heading, pitch and roll of `pose` minus those of `truth`.
ViewAngles AngleErrors(const Pose& pose, const Pose& truth) {
  const ViewAngles a = ViewAnglesOf(pose.cam_from_world);
  const ViewAngles b = ViewAnglesOf(truth.cam_from_world);
  return {HeadingDifferenceDeg(a.heading_deg, b.heading_deg),
          a.pitch_deg - b.pitch_deg,
          HeadingDifferenceDeg(a.roll_deg, b.roll_deg)};
}

std::optional<double> Used(const std::optional<SkylineDistances>& d) {
  return d ? std::optional<double>(d->used_px) : std::nullopt;
}

std::optional<double> Plain(const std::optional<SkylineDistances>& d) {
  return d ? std::optional<double>(d->plain_px) : std::nullopt;
}

void AddTo(SkylineDistances& sum, const std::optional<SkylineDistances>& d) {
  sum.used_px += Used(d).value_or(0.0);
  sum.plain_px += Plain(d).value_or(0.0);
}

const char* NameOf(SkylineColumn column) {
  switch (column) {
    case SkylineColumn::kSeen:
      return "seen";
    case SkylineColumn::kAboveImage:
      return "above";
    case SkylineColumn::kBelowImage:
      return "below";
    case SkylineColumn::kUnknown:
      return "unknown";
  }
  return "";
}

}  // namespace

std::string SkylineFramesCsv(const std::vector<SkylineFrameResult>& frames) {
  std::string csv =
      "id,status,l1_before_px,l1_after_px,east_m,north_m,height_m,heading_deg,pitch_deg,roll_deg,"
      "start_east_m,start_north_m,start_height_m,start_heading_deg,start_pitch_deg,start_roll_deg,"
      "heading_error_deg,pitch_error_deg,roll_error_deg,position_error_m,extract_ms,clean_ms,"
      "match_ms,plain_l1_before_px,plain_l1_after_px,l1_truth_px,plain_l1_truth_px,"
      "heading_sigma_deg,method,reason\n";
  for (const SkylineFrameResult& f : frames) {
    Row row;
    row.Text(f.id).Text(f.status).Add(Used(f.by_sensors), 2).Add(Used(f.at_best), 2);
    AddPose(f.pose, row);
    AddPose(f.start, row);
    if (f.pose && f.truth) {
      const ViewAngles error = AngleErrors(*f.pose, *f.truth);
      row.Add(error.heading_deg, 4).Add(error.pitch_deg, 4).Add(error.roll_deg, 4);
      row.Add((f.pose->center_in_world - f.truth->center_in_world).norm(), 3);
    } else {
      for (int i = 0; i < 4; ++i) row.Add(std::nullopt, 0);
    }
    row.Add(f.times.extract_ms, 3).Add(f.times.clean_ms, 3).Add(f.times.match_ms, 3);
    row.Add(Plain(f.by_sensors), 2).Add(Plain(f.at_best), 2);
    row.Add(Used(f.at_truth), 2).Add(Plain(f.at_truth), 2);
    row.Add(f.heading_sigma_deg, 3);
    csv += row.Text(f.method).Text(f.reason).Line();
  }
  return csv;
}

SkylineSummary Summarize(const std::vector<SkylineFrameResult>& frames) {
  SkylineSummary s;
  s.frames = frames.size();
  std::size_t timed = 0;
  for (const SkylineFrameResult& f : frames) {
    if (f.times.Total() > 0.0) {
      ++timed;
      s.times.extract_ms += f.times.extract_ms;
      s.times.clean_ms += f.times.clean_ms;
      s.times.match_ms += f.times.match_ms;
    }
    if (!f.pose) continue;
    ++s.matched;
    AddTo(s.by_sensors, f.by_sensors);
    AddTo(s.at_best, f.at_best);
    if (!f.truth || !f.start) continue;
    ++s.with_truth;
    AddTo(s.at_truth, f.at_truth);
    const ViewAngles start = AngleErrors(*f.start, *f.truth);
    const ViewAngles end = AngleErrors(*f.pose, *f.truth);
    s.start_heading_deg += std::abs(start.heading_deg);
    s.heading_deg += std::abs(end.heading_deg);
    s.tilt_deg += std::max(std::abs(end.pitch_deg), std::abs(end.roll_deg));
  }
  const auto mean = [](double& sum, std::size_t count) {
    if (count > 0) sum /= static_cast<double>(count);
  };
  for (double* sum : {&s.times.extract_ms, &s.times.clean_ms, &s.times.match_ms}) mean(*sum, timed);
  for (SkylineDistances* sum : {&s.by_sensors, &s.at_best}) {
    mean(sum->used_px, s.matched);
    mean(sum->plain_px, s.matched);
  }
  mean(s.at_truth.used_px, s.with_truth);
  mean(s.at_truth.plain_px, s.with_truth);
  for (double* sum : {&s.start_heading_deg, &s.heading_deg, &s.tilt_deg}) mean(*sum, s.with_truth);
  return s;
}

std::string SkylineColumnsCsv(const Skyline& skyline) {
  std::string csv = "x_px,y_px,state,confidence\n";
  for (std::size_t c = 0; c < skyline.size(); ++c) {
    csv += Row()
               .Add(skyline.XOf(c), 3)
               .Add(skyline.y_px[c], 3)
               .Text(NameOf(skyline.columns[c]))
               .Add(skyline.confidence[c], 3)
               .Line();
  }
  return csv;
}

struct OverlayVideo::Impl {
  std::filesystem::path path;
  double frames_per_second = 25.0;
  cv::Size size;
  cv::VideoWriter writer;
};

OverlayVideo::OverlayVideo(std::filesystem::path path, double frames_per_second)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = std::move(path);
  impl_->frames_per_second = frames_per_second;
}

OverlayVideo::~OverlayVideo() = default;

void OverlayVideo::Add(const cv::Mat& bgr) {
  if (!impl_->writer.isOpened()) {
    const double scale = std::min(1.0, static_cast<double>(kMaxVideoWidthPx) / bgr.cols);
    // Encoders want even sizes.
    impl_->size = {static_cast<int>(bgr.cols * scale) / 2 * 2,
                   static_cast<int>(bgr.rows * scale) / 2 * 2};
    // H.264 is what browsers play; without its encoder MPEG-4 part 2, which players do.
    for (const int codec : {cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                            cv::VideoWriter::fourcc('m', 'p', '4', 'v')}) {
      if (impl_->writer.isOpened()) break;
      impl_->writer.open(impl_->path.string(), codec, impl_->frames_per_second, impl_->size);
    }
    if (!impl_->writer.isOpened()) {
      throw InputError(
          impl_->path.string(), "", "no encoder for H.264 or MPEG-4", "OpenCV with FFmpeg");
    }
  }
  cv::Mat fitted = bgr;
  if (bgr.size() != impl_->size) cv::resize(bgr, fitted, impl_->size, 0, 0, cv::INTER_AREA);
  impl_->writer.write(fitted);
}

}  // namespace ridgeline
