// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text_file.h"
#include "track/sensors.h"

namespace ridgeline {
namespace {

// A number of a reading: its column, where it goes, and its range.
struct NumberColumn {
  const char* name;
  std::optional<double> SensorReading::*field;
  double lower, upper;
};

constexpr double kAny = 1e12;
// Phones' gyroscopes end at 2000 deg/s; degrees taken for radians show soon.
constexpr double kFastestRadS = 40.0;
constexpr NumberColumn kNumbers[] = {
    {"time_s", &SensorReading::time_s, -kAny, kAny},
    {"lat_deg", &SensorReading::latitude_deg, -90.0, 90.0},
    {"lon_deg", &SensorReading::longitude_deg, -180.0, 180.0},
    {"alt_m", &SensorReading::altitude_m, -1000.0, 20000.0},
    {"compass_heading_deg", &SensorReading::compass_deg, -360.0, 360.0},
    {"pitch_deg", &SensorReading::pitch_deg, -90.0, 90.0},
    {"roll_deg", &SensorReading::roll_deg, -180.0, 180.0},
    {"pressure_hpa", &SensorReading::pressure_hpa, 100.0, 1200.0},
    {"speed_m_s", &SensorReading::speed_m_s, -100.0, 500.0},
};
constexpr const char* kAxes[] = {"acc_x", "acc_y", "acc_z"};
constexpr const char* kRates[] = {"gyro_x", "gyro_y", "gyro_z"};

// Without blanks and quotes around it.
std::string Bare(std::string_view field) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = field.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  field = field.substr(first, field.find_last_not_of(kBlanks) - first + 1);
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return std::string(quoted ? field.substr(1, field.size() - 2) : field);
}

std::vector<std::string> Fields(std::string_view line) {
  std::vector<std::string> fields;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos;) {
    fields.push_back(Bare(line.substr(0, comma)));
    line.remove_prefix(comma + 1);
  }
  fields.push_back(Bare(line));
  return fields;
}

std::vector<std::string> KnownColumns() {
  std::vector<std::string> names{"id"};
  for (const NumberColumn& c : kNumbers) names.emplace_back(c.name);
  names.insert(names.end(), std::begin(kAxes), std::end(kAxes));
  names.insert(names.end(), std::begin(kRates), std::end(kRates));
  return names;
}

class SensorReader {
 public:
  explicit SensorReader(std::string file) : file_(std::move(file)) {}

  void ReadHeader(const std::vector<std::string>& names) {
    const std::vector<std::string> known = KnownColumns();
    for (const std::string& name : names) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        const std::string nearest = NearestName(name, known);
        throw InputError(file_, "header", '"' + name + '"', "a known column, such as " + nearest);
      }
      if (std::count(names.begin(), names.end(), name) > 1) {
        throw InputError(file_, "header", '"' + name + "\" twice", "each column once");
      }
    }
    if (std::find(names.begin(), names.end(), "id") == names.end()) {
      throw InputError(file_, "header", "no column id", "a column id, the name of the frame");
    }
    names_ = names;
  }
  bool has_header() const { return !names_.empty(); }

  SensorReading ReadRow(const std::vector<std::string>& fields, int line) {
    const std::string place = "line " + std::to_string(line);
    if (fields.size() != names_.size()) {
      throw InputError(file_,
                       place,
                       std::to_string(fields.size()) + " fields",
                       std::to_string(names_.size()) + " as in the header");
    }
    SensorReading reading;
    Eigen::Vector3d acceleration, rotation;
    int axes = 0, rates = 0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string field = place + ": " + names_[i];
      if (names_[i] == "id") {
        reading.id = fields[i];
        if (reading.id.empty()) throw InputError(file_, field, "nothing", "the frame's name");
        if (!ids_.insert(reading.id).second) {
          throw InputError(file_, field, '"' + reading.id + "\" again", "each frame once");
        }
      }
      if (fields[i].empty()) continue;
      for (const NumberColumn& c : kNumbers) {
        if (names_[i] == c.name) reading.*c.field = Number(fields[i], field, c.lower, c.upper);
      }
      for (int axis = 0; axis < 3; ++axis) {
        if (names_[i] == kAxes[axis]) {
          acceleration[axis] = Number(fields[i], field, -kAny, kAny);
          ++axes;
        } else if (names_[i] == kRates[axis]) {
          rotation[axis] = Number(fields[i], field, -kFastestRadS, kFastestRadS);
          ++rates;
        }
      }
    }
    if (rates == 3) reading.rotation_rad_s = rotation;
    if (axes == 3 && acceleration.norm() > 0.0) reading.acceleration = acceleration;
    return reading;
  }

 private:
  double Number(const std::string& text,
                const std::string& field,
                double lower,
                double upper) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end != '\0') throw InputError(file_, field, '"' + text + '"', "a number");
    if (!(value >= lower && value <= upper)) {
      std::ostringstream range;
      range << '[' << lower << ", " << upper << ']';
      throw InputError(file_, field, text, range.str());
    }
    return value;
  }

  std::string file_;
  std::vector<std::string> names_;
  std::set<std::string> ids_;
};

}  // namespace

std::vector<SensorReading> ReadSensors(const std::filesystem::path& path) {
  SensorReader reader(path.string());
  std::vector<SensorReading> readings;
  std::istringstream text(ReadText(path));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    if (fields.front().starts_with('#') || (fields.size() == 1 && fields.front().empty())) continue;
    if (!reader.has_header()) {
      reader.ReadHeader(fields);
    } else {
      readings.push_back(reader.ReadRow(fields, number));
    }
  }
  if (readings.empty())
    throw InputError(path.string(), "", "no rows", "a header and a row per frame");
  return readings;
}

}  // namespace ridgeline
