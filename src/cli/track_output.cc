// SPDX-License-Identifier: Apache-2.0
#include "cli/track_output.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "city/crs.h"
#include "convert/colmap_model.h"
#include "convert/globe_files.h"
#include "track/nmea.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kConfident = 0.9;
constexpr double kWrongM = 5.0;
constexpr double kChiSquare95 = 5.991;  // two degrees of freedom

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto i = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  return values[i];
}

Json JsonOf(const TrackErrors& e) {
  if (e.posed == 0) return {{"frames_with_truth", e.frames}, {"with_pose", 0}};
  return {{"frames_with_truth", e.frames},
          {"with_pose", e.posed},
          {"ate_rmse_m", e.ate_rmse_m},
          {"ate_median_m", e.ate_median_m},
          {"ate_max_m", e.ate_max_m},
          {"rotation_median_deg", e.rotation_median_deg},
          {"rotation_max_deg", e.rotation_max_deg},
          {"rpe_rmse_m", e.rpe_rmse_m},
          {"rpe_rmse_deg", e.rpe_rmse_deg},
          {"within_1m", e.within_1m},
          {"within_3m", e.within_3m},
          {"within_5m", e.within_5m},
          {"within_1m_1deg", e.within_1m_1deg},
          {"within_5deg", e.within_5deg}};
}

Json JsonOf(const GnssMonitor::Verdict& v) {
  Json json{{"lies", v.lies}, {"log_likelihood_ratio", v.ratio}};
  if (v.lies) {
    json["since_s"] = v.since_s;
    json["kind"] = v.is_drag ? "drag" : "jump";
    json[v.is_drag ? "east_m_s" : "east_m"] = v.size.x();
    json[v.is_drag ? "north_m_s" : "north_m"] = v.size.y();
  }
  return json;
}

// A dataset whose truths are the poses found, for the writers of other programs' formats.
Dataset DatasetOf(std::span<const TrackRow> rows,
                  std::span<const std::optional<CameraIntrinsics>> cameras,
                  const CityModel& model) {
  Dataset dataset;
  dataset.name = "track";
  dataset.crs = CrsName(model.crs);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Query query;
    query.id = rows[i].frame.id;
    query.set = NameOf(rows[i].frame.state);
    query.image = rows[i].frame.id;
    query.camera = cameras[i];
    query.truth = rows[i].smoothed ? std::optional(rows[i].smoothed->pose) : rows[i].frame.pose;
    if (query.truth && query.camera) dataset.queries.push_back(std::move(query));
  }
  return dataset;
}

}  // namespace

TrackSummary SummaryOf(std::span<const TrackRow> rows) {
  TrackSummary s;
  std::vector<std::optional<Pose>> truths;
  std::vector<double> all_ms;
  double tracking_ms = 0.0;
  std::size_t in_ellipse = 0, in_protection = 0;
  for (const TrackRow& row : rows) {
    const TrackFrame& f = row.frame;
    ++s.frames;
    truths.push_back(row.truth);
    all_ms.push_back(f.milliseconds);
    s.tracking += f.state == TrackState::kTracking ? 1 : 0;
    s.relocalizing += f.state == TrackState::kRelocalizing ? 1 : 0;
    s.lost += f.state == TrackState::kLost ? 1 : 0;
    if (f.state == TrackState::kTracking) tracking_ms += f.milliseconds;
    if (f.gnss) s.gnss = f.gnss;
    if (f.gnss && f.gnss->first) s.gnss_noticed_at = f.id;
    if (!row.truth || !f.pose) continue;
    const Eigen::Vector3d d = f.pose->center_in_world - row.truth->center_in_world;
    if (f.confidence >= kConfident) {
      ++s.confident;
      s.confident_wrong += d.norm() > kWrongM ? 1 : 0;
    }
    if (!f.protection) continue;
    ++s.protectable;
    in_protection += d.head<2>().norm() <= f.protection->position_m ? 1 : 0;
    const Eigen::Matrix2d plane = f.covariance.topLeftCorner<2, 2>();
    in_ellipse += d.head<2>().dot(plane.inverse() * d.head<2>()) <= kChiSquare95 ? 1 : 0;
  }
  if (s.protectable > 0) {
    s.protected_share = static_cast<double>(in_protection) / static_cast<double>(s.protectable);
    s.ellipse_share = static_cast<double>(in_ellipse) / static_cast<double>(s.protectable);
  }
  s.causal = ErrorsOf(PosesOf(rows, false), truths);
  s.smoothed = ErrorsOf(PosesOf(rows, true), truths);
  s.median_ms = Quantile(all_ms, 0.5);
  s.p95_ms = Quantile(all_ms, 0.95);
  if (s.tracking > 0) s.tracking_mean_ms = tracking_ms / static_cast<double>(s.tracking);
  return s;
}

std::string SummaryJson(const TrackSummary& s,
                        const std::vector<std::string>& notes,
                        const std::string& start_from) {
  Json json{{"frames", s.frames},
            {"start", start_from},
            {"tracking", s.tracking},
            {"relocalizing", s.relocalizing},
            {"lost", s.lost}};
  if (s.causal.frames > 0) {
    json["causal"] = JsonOf(s.causal);
    json["smoothed"] = JsonOf(s.smoothed);
    json["confident_frames"] = s.confident;
    json["confident_but_off_by_more_than_5m"] = s.confident_wrong;
    json["tracking_frames_with_truth"] = s.protectable;
    json["truth_within_protection_level"] = s.protected_share;
    json["truth_within_95_percent_ellipse"] = s.ellipse_share;
  }
  json["latency_ms"] = {
      {"median", s.median_ms}, {"p95", s.p95_ms}, {"mean_while_tracking", s.tracking_mean_ms}};
  if (s.gnss) {
    json["gnss"] = JsonOf(*s.gnss);
    if (s.gnss_noticed_at) json["gnss"]["noticed_at"] = *s.gnss_noticed_at;
  }
  json["notes"] = notes;
  return json.dump(2) + "\n";
}

void WriteTrackFiles(std::span<const TrackRow> rows,
                     std::span<const std::optional<CameraIntrinsics>> cameras,
                     const CityModel& model,
                     const fs::path& folder) {
  WriteFileAtomically(folder / "frames.csv", TrackCsv(rows));
  WriteFileAtomically(folder / "poses.tum", TrackTum(rows, false));
  WriteFileAtomically(folder / "smoothed.tum", TrackTum(rows, true));
  const Dataset dataset = DatasetOf(rows, cameras, model);
  if (dataset.queries.empty()) return;
  fs::create_directories(folder / "colmap");
  WriteColmapModel(dataset, {}, folder / "colmap");
  if (model.crs.horizontal_epsg == 0) return;
  WriteFileAtomically(folder / "track.geojson", PosesGeoJson(dataset));
  WriteFileAtomically(folder / "track.kml", PosesKml(dataset));
}

std::string TrackJsonLine(const TrackFrame& frame, const Crs& crs) {
  Json json{{"id", frame.id}};
  if (frame.time_s) json["time_s"] = *frame.time_s;
  json["state"] = NameOf(frame.state);
  if (!frame.reason.empty()) json["reason"] = frame.reason;
  json["look"] = NameOf(frame.look);
  json["confidence"] = frame.confidence;
  if (frame.pose) {
    const Eigen::Vector3d& p = frame.pose->center_in_world;
    const Eigen::Quaterniond& q = frame.pose->cam_from_world;
    const ViewAngles angles = ViewAnglesOf(q);
    json["position"] = {p.x(), p.y(), p.z()};
    json["cam_from_world_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
    json["heading_deg"] = angles.heading_deg;
    json["pitch_deg"] = angles.pitch_deg;
    json["roll_deg"] = angles.roll_deg;
    std::vector<double> sigmas;
    for (int i = 0; i < 6; ++i) sigmas.push_back(std::sqrt(frame.covariance(i, i)));
    json["sigmas"] = sigmas;
    if (const auto place = LatitudeLongitude(crs, p.head<2>())) {
      json["latitude"] = place->x();
      json["longitude"] = place->y();
    }
  }
  if (frame.protection) {
    json["protection_m"] = frame.protection->position_m;
    json["protection_heading_deg"] = frame.protection->heading_deg;
  }
  if (frame.gnss) json["gnss"] = JsonOf(*frame.gnss);
  json["milliseconds"] = frame.milliseconds;
  return json.dump() + "\n";
}

std::string TrackNmea(const TrackFrame& frame, const TrackFrame* before, const Crs& crs) {
  if (!frame.pose) return NmeaSentences(std::nullopt);
  const Eigen::Vector2d place = frame.pose->center_in_world.head<2>();
  const auto geographic = LatitudeLongitude(crs, place);
  if (!geographic) return NmeaSentences(std::nullopt);
  const double convergence = MeridianConvergenceDeg(crs, place).value_or(0.0);
  NmeaFix fix;
  fix.time_s = frame.time_s;
  fix.latitude_deg = geographic->x();
  fix.longitude_deg = geographic->y();
  fix.altitude_m = frame.pose->center_in_world.z();
  fix.true_heading_deg =
      WrapHeadingDeg(ViewAnglesOf(frame.pose->cam_from_world).heading_deg + convergence);
  fix.is_tracked = frame.state == TrackState::kTracking;
  if (before != nullptr && before->time_s && frame.time_s && *frame.time_s > *before->time_s) {
    const Eigen::Vector2d step = place - before->pose->center_in_world.head<2>();
    fix.speed_m_s = step.norm() / (*frame.time_s - *before->time_s);
    fix.course_deg = WrapHeadingDeg(
        std::atan2(step.x(), step.y()) * 180.0 / 3.14159265358979323846 + convergence);
  }
  return NmeaSentences(fix);
}

}  // namespace ridgeline
