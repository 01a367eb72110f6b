// SPDX-License-Identifier: Apache-2.0
#include "track/odometry_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/text_file.h"

namespace ridgeline {
namespace {

// Deviations of a step where the file has none: a share of its length, and what remains of none.
constexpr double kShare = 0.02;
constexpr double kLeastM = 0.02;
constexpr double kStepDeg = 0.2;
// A frame this far outside of the rows' times has no pose.
constexpr double kTimeReachS = 0.05;
const std::vector<std::string> kColumns = {
    "id", "time_s", "dx_m", "dy_m", "dz_m", "qw", "qx", "qy", "qz", "sigma_m", "sigma_deg"};

std::vector<std::string> Split(const std::string& line, bool commas) {
  std::vector<std::string> words;
  if (commas) {
    words.emplace_back();
    for (const char c : line) {
      if (c == ',') {
        words.emplace_back();
      } else if (c != ' ' && c != '\t' && c != '\r') {
        words.back() += c;
      }
    }
    return words;
  }
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

class OdometryReader {
 public:
  explicit OdometryReader(const std::filesystem::path& path) { odometry_.file = path.string(); }

  void Line(const std::string& line, int number) {
    place_ = "line " + std::to_string(number);
    const std::vector<std::string> comma_words = Split(line, true);
    if (comma_words.size() == 1 && comma_words.front().empty()) return;
    if (comma_words.front().starts_with('#')) return;
    if (odometry_.format.empty()) {
      if (comma_words.size() > 1) {
        odometry_.format = "CSV";
        return ReadHeader(comma_words);
      }
      const std::size_t words = Split(line, false).size();
      odometry_.format = words == 12 ? "KITTI" : "TUM";
    }
    if (odometry_.format == "CSV") return ReadCsv(comma_words);
    const std::vector<std::string> words = Split(line, false);
    const std::size_t expected = odometry_.format == "KITTI" ? 12 : 8;
    if (words.size() != expected) {
      Fail("", std::to_string(words.size()) + " words",
           expected == 12 ? "12 numbers (KITTI)"
                          : "8 numbers (TUM: timestamp tx ty tz qx qy qz qw), 12 (KITTI), or a CSV "
                            "with a header");
    }
    expected == 12 ? ReadKitti(words) : ReadTum(words);
  }

  Odometry Done() {
    if (odometry_.rows.empty()) throw InputError(odometry_.file, "", "no rows", "poses");
    return std::move(odometry_);
  }

 private:
  [[noreturn]] void Fail(const std::string& field,
                         const std::string& found,
                         const std::string& expected) const {
    throw InputError(
        odometry_.file, field.empty() ? place_ : place_ + ": " + field, found, expected);
  }

  double Number(const std::string& text, const std::string& field) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value)) {
      Fail(field, '"' + text + '"', "a number");
    }
    // Seconds since 1970 are numbers, too.
    constexpr double kMost = 1e12;
    if (std::abs(value) > kMost) Fail(field, text, "a number of at most 1e12");
    return value;
  }

  Eigen::Quaterniond Rotation(double w, double x, double y, double z) const {
    const Eigen::Quaterniond q(w, x, y, z);
    if (std::abs(q.norm() - 1.0) > 0.01) {
      Fail("rotation", "a quaternion of length " + std::to_string(q.norm()), "a unit quaternion");
    }
    return q.normalized();
  }

  void ReadHeader(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (std::find(kColumns.begin(), kColumns.end(), name) == kColumns.end()) {
        Fail("header", '"' + name + '"', "a known column, such as " + NearestName(name, kColumns));
      }
      if (std::count(names.begin(), names.end(), name) > 1) {
        Fail("header", '"' + name + "\" twice", "each column once");
      }
    }
    const auto has = [&](const char* name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const char* name : {"dx_m", "dy_m", "dz_m", "qw", "qx", "qy", "qz"}) {
      if (!has(name)) Fail("header", std::string("no column ") + name, "all of the pose's columns");
    }
    if (!has("id") && !has("time_s")) Fail("header", "neither id nor time_s", "one of the two");
    names_ = names;
  }

  void ReadCsv(const std::vector<std::string>& fields) {
    if (fields.size() != names_.size()) {
      Fail("", std::to_string(fields.size()) + " fields",
           std::to_string(names_.size()) + " as in the header");
    }
    std::map<std::string, double> numbers;
    Odometry::Row row;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == "id") {
        row.id = fields[i];
      } else {
        numbers[names_[i]] = Number(fields[i], names_[i]);
      }
    }
    if (numbers.count("time_s") > 0) row.time_s = numbers["time_s"];
    Motion motion;
    motion.step_in_before = {numbers["dx_m"], numbers["dy_m"], numbers["dz_m"]};
    motion.now_from_before =
        Rotation(numbers["qw"], numbers["qx"], numbers["qy"], numbers["qz"]).conjugate();
    AddDeviations(motion);
    if (numbers.count("sigma_m") > 0) motion.sigma_m = Positive(numbers["sigma_m"], "sigma_m");
    if (numbers.count("sigma_deg") > 0) {
      motion.sigma_deg = Positive(numbers["sigma_deg"], "sigma_deg");
    }
    const Pose before = odometry_.rows.empty() ? Pose{} : odometry_.rows.back().pose;
    row.pose = Moved(before, motion);
    row.since_row = motion;
    AddRow(std::move(row));
  }

  double Positive(double value, const char* field) const {
    if (value <= 0.0) Fail(field, std::to_string(value), "more than 0");
    return value;
  }

  void ReadTum(const std::vector<std::string>& words) {
    std::vector<double> n;
    for (const std::string& word : words) n.push_back(Number(word, ""));
    Odometry::Row row;
    row.time_s = n[0];
    row.pose = {Rotation(n[7], n[4], n[5], n[6]).conjugate(), {n[1], n[2], n[3]}};
    AddPose(std::move(row));
  }

  void ReadKitti(const std::vector<std::string>& words) {
    Eigen::Matrix<double, 3, 4> m;
    for (int i = 0; i < 12; ++i) m(i / 4, i % 4) = Number(words[static_cast<std::size_t>(i)], "");
    const Eigen::Matrix3d r = m.leftCols<3>();
    if ((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() > 0.02 || r.determinant() < 0.0) {
      Fail("rotation", "a matrix that is no rotation", "the upper rows of world_from_camera");
    }
    Odometry::Row row;
    row.pose = {Eigen::Quaterniond(r.transpose()).normalized(), m.col(3)};
    AddPose(std::move(row));
  }

  void AddPose(Odometry::Row row) {
    if (!odometry_.rows.empty()) {
      row.since_row = MotionBetween(odometry_.rows.back().pose, row.pose);
      AddDeviations(row.since_row);
    }
    AddRow(std::move(row));
  }

  static void AddDeviations(Motion& motion) {
    motion.sigma_m = std::max(kLeastM, kShare * motion.step_in_before.norm());
    motion.sigma_deg = kStepDeg;
  }

  void AddRow(Odometry::Row row) {
    if (!odometry_.rows.empty() && row.time_s && odometry_.rows.back().time_s &&
        *row.time_s <= *odometry_.rows.back().time_s) {
      Fail("time", std::to_string(*row.time_s), "times that rise");
    }
    odometry_.rows.push_back(std::move(row));
  }

  Odometry odometry_;
  std::vector<std::string> names_;
  std::string place_;
};

// A place among the rows: the last row before it, and how far on to the next.
struct Place {
  std::size_t row = 0;
  double share = 0.0;
};

std::optional<Place> PlaceOf(const std::vector<Odometry::Row>& rows, double time_s) {
  if (!rows.front().time_s || time_s < *rows.front().time_s - kTimeReachS ||
      time_s > *rows.back().time_s + kTimeReachS) {
    return std::nullopt;
  }
  std::size_t i = 0;
  while (i + 1 < rows.size() && *rows[i + 1].time_s <= time_s) ++i;
  if (i + 1 == rows.size()) return Place{i, 0.0};
  const double share = (time_s - *rows[i].time_s) / (*rows[i + 1].time_s - *rows[i].time_s);
  return Place{i, std::max(0.0, share)};
}

Pose PoseAt(const std::vector<Odometry::Row>& rows, const Place& place) {
  const Pose& a = rows[place.row].pose;
  if (place.share == 0.0) return a;
  const Pose& b = rows[place.row + 1].pose;
  return {a.cam_from_world.slerp(place.share, b.cam_from_world),
          a.center_in_world + place.share * (b.center_in_world - a.center_in_world)};
}

// The motion from one place to a later one, with the deviations of the rows between.
Motion MotionOver(const std::vector<Odometry::Row>& rows, const Place& from, const Place& to) {
  Motion motion = MotionBetween(PoseAt(rows, from), PoseAt(rows, to));
  double m = 0.0, deg = 0.0;
  for (std::size_t i = from.row + 1; i <= to.row + (to.share > 0.0 ? 1 : 0); ++i) {
    m = std::hypot(m, rows[i].since_row.sigma_m);
    deg = std::hypot(deg, rows[i].since_row.sigma_deg);
  }
  motion.sigma_m = m;
  motion.sigma_deg = deg;
  return motion;
}

std::vector<std::optional<Place>> PlacesOf(const Odometry& odometry,
                                           std::span<const FrameKey> frames) {
  const std::vector<Odometry::Row>& rows = odometry.rows;
  std::vector<std::optional<Place>> places(frames.size());
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].id.empty()) by_id[rows[i].id] = i;
  }
  bool any = false;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto it = by_id.find(frames[f].id);
    if (it != by_id.end()) {
      places[f] = Place{it->second, 0.0};
    } else if (by_id.empty() && frames[f].time_s) {
      places[f] = PlaceOf(rows, *frames[f].time_s);
    }
    any = any || places[f];
  }
  if (any) return places;
  // In order; relative poses lack that of the first frame.
  const std::size_t missing = frames.size() - std::min(frames.size(), rows.size());
  if (rows.size() > frames.size() || missing > 1) return places;
  for (std::size_t f = missing; f < frames.size(); ++f) places[f] = Place{f - missing, 0.0};
  return places;
}

}  // namespace

Odometry ReadOdometry(const std::filesystem::path& path) {
  OdometryReader reader(path);
  std::istringstream text(ReadText(path));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) reader.Line(line, number);
  return reader.Done();
}

std::vector<FrameMotion> MotionsOf(const Odometry& odometry, std::span<const FrameKey> frames) {
  const std::vector<std::optional<Place>> places = PlacesOf(odometry, frames);
  std::vector<FrameMotion> motions(frames.size());
  for (std::size_t f = 1; f < frames.size(); ++f) {
    const std::optional<Place>& now = places[f];
    std::optional<Place> before = places[f - 1];
    if (!now) {
      motions[f].missing = "the odometry has no pose of this frame";
      continue;
    }
    // The first row of relative poses is the way from the first frame.
    if (!before && f == 1 && odometry.format == "CSV" && now->row == 0) {
      motions[f].motion = odometry.rows.front().since_row;
      continue;
    }
    if (!before) {
      motions[f].missing = "the odometry has no pose of the frame before";
    } else if (now->row < before->row) {
      motions[f].missing = "the odometry has the frames in another order";
    } else {
      motions[f].motion = MotionOver(odometry.rows, *before, *now);
    }
  }
  return motions;
}

}  // namespace ridgeline
