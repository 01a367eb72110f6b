// SPDX-License-Identifier: Apache-2.0
#include "track/track_files.h"

#include <cmath>
#include <cstdio>

#include "base/decimals.h"

namespace ridgeline {
namespace {

// Fields of a CSV row; what there is not is an empty field.
class Row {
 public:
  Row& Text(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return Put(text);
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return Put(quoted + '"');
  }
  Row& Add(const std::optional<double>& value, int digits) {
    if (!value || !std::isfinite(*value)) return Put("");
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, *value);
    return Put(text);
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

void AddPose(const std::optional<Pose>& pose, bool with_quaternion, Row& row) {
  if (!pose) {
    for (int i = 0; i < (with_quaternion ? 10 : 6); ++i) row.Add(std::nullopt, 0);
    return;
  }
  const ViewAngles angles = ViewAnglesOf(pose->cam_from_world);
  for (int i = 0; i < 3; ++i) row.Add(pose->center_in_world[i], 3);
  row.Add(angles.heading_deg, 4).Add(angles.pitch_deg, 4).Add(angles.roll_deg, 4);
  if (!with_quaternion) return;
  const Eigen::Quaterniond& q = pose->cam_from_world;
  row.Add(q.w(), 9).Add(q.x(), 9).Add(q.y(), 9).Add(q.z(), 9);
}

void AddDeviations(bool known, const PoseCovariance& covariance, Row& row) {
  for (int i = 0; i < 6; ++i) {
    row.Add(known ? std::optional<double>(std::sqrt(covariance(i, i))) : std::nullopt, 3);
  }
}

void AddErrors(const std::optional<Pose>& pose, const std::optional<Pose>& truth, Row& row) {
  if (!pose || !truth) {
    row.Add(std::nullopt, 0).Add(std::nullopt, 0).Add(std::nullopt, 0);
    return;
  }
  const Eigen::Vector3d d = pose->center_in_world - truth->center_in_world;
  row.Add(d.norm(), 3).Add(d.head<2>().norm(), 3);
  row.Add(RotationDistanceDeg(pose->cam_from_world, truth->cam_from_world), 3);
}

}  // namespace

std::string TrackCsv(std::span<const TrackRow> rows) {
  std::string text =
      "id,time_s,state,reason,look,east,north,height,heading_deg,pitch_deg,roll_deg,qw,qx,qy,qz,"
      "sigma_east_m,sigma_north_m,sigma_height_m,sigma_heading_deg,sigma_pitch_deg,sigma_roll_deg,"
      "protection_m,protection_heading_deg,confidence,explained,evidence_nat,effective_samples,"
      "milliseconds,smoothed_east,smoothed_north,smoothed_height,smoothed_heading_deg,"
      "smoothed_pitch_deg,smoothed_roll_deg,smoothed_sigma_east_m,smoothed_sigma_north_m,"
      "smoothed_sigma_height_m,smoothed_sigma_heading_deg,smoothed_sigma_pitch_deg,"
      "smoothed_sigma_roll_deg,error_m,error_horizontal_m,error_deg,smoothed_error_m,"
      "smoothed_error_horizontal_m,smoothed_error_deg,gnss_lies,gnss_since_s\n";
  for (const TrackRow& r : rows) {
    const TrackFrame& f = r.frame;
    Row row;
    row.Text(f.id).Add(f.time_s, 3).Text(NameOf(f.state)).Text(f.reason).Text(NameOf(f.look));
    AddPose(f.pose, true, row);
    AddDeviations(f.pose.has_value(), f.covariance, row);
    row.Add(f.protection ? std::optional(f.protection->position_m) : std::nullopt, 3);
    row.Add(f.protection ? std::optional(f.protection->heading_deg) : std::nullopt, 3);
    row.Add(f.confidence, 4).Add(f.explained, 3).Add(f.evidence_nat, 1);
    row.Add(f.effective_samples, 1).Add(f.milliseconds, 1);
    const std::optional<Pose> smoothed = r.smoothed ? std::optional(r.smoothed->pose) : std::nullopt;
    AddPose(smoothed, false, row);
    AddDeviations(smoothed.has_value(), r.smoothed ? r.smoothed->covariance : f.covariance, row);
    AddErrors(f.pose, r.truth, row);
    AddErrors(smoothed, r.truth, row);
    row.Text(!f.gnss ? "" : f.gnss->lies ? "yes" : "no");
    row.Add(f.gnss && f.gnss->lies ? std::optional(f.gnss->since_s) : std::nullopt, 3);
    text += row.Line();
  }
  return text;
}

std::vector<std::optional<Pose>> PosesOf(std::span<const TrackRow> rows, bool smoothed) {
  std::vector<std::optional<Pose>> poses;
  for (const TrackRow& row : rows) {
    poses.push_back(!smoothed      ? row.frame.pose
                    : row.smoothed ? std::optional(row.smoothed->pose)
                                   : std::nullopt);
  }
  return poses;
}

std::string TrackTum(std::span<const TrackRow> rows, bool smoothed) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  const std::vector<std::optional<Pose>> poses = PosesOf(rows, smoothed);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!poses[i]) continue;
    const Eigen::Vector3d& p = poses[i]->center_in_world;
    const Eigen::Quaterniond q = poses[i]->cam_from_world.conjugate();
    text += ShortestText(rows[i].frame.time_s.value_or(static_cast<double>(i)));
    for (const double number : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += ' ' + ShortestText(number == 0.0 ? 0.0 : number);
    }
    text += '\n';
  }
  return text;
}

}  // namespace ridgeline
