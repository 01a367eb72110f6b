// SPDX-License-Identifier: Apache-2.0
#include "cli/sensor_priors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "city/crs.h"
#include "city/read_city.h"
#include "city/terrain.h"
#include "cli/command.h"
#include "input/world.h"
#include "track/gyroscope.h"

namespace ridgeline {
namespace {

constexpr char kPrefix[] = "sensors.";

Crs CrsOf(const Dataset& dataset) {
  if (const std::optional<Crs> crs = ParseCrs(dataset.crs)) return *crs;
  return ReadCityCrs(dataset.model, CityOptions{});
}

// Heights of the terrain around the readings, for the barometer's start.
class Ground {
 public:
  Ground(const Dataset& dataset, const Crs& crs, const Eigen::AlignedBox2d& places) {
    if (!dataset.dtm) {
      throw InputError(
          "--set", "sensors.height_source", "barometer without a terrain", "--dtm FILE");
    }
    constexpr double kMarginM = 20.0;
    CityModel frame;
    frame.crs = crs;
    frame.origin_in_world << places.min().array().floor().matrix(), 0.0;
    origin_ = frame.origin_in_world;
    std::vector<std::string> warnings;  // come again when the world is read
    const Eigen::Vector2d origin = origin_.head<2>();
    dtm_ = ReadDtm(*dataset.dtm,
                   frame,
                   places.min() - origin,
                   places.max() - origin,
                   kMarginM,
                   warnings);
  }
  std::optional<double> At(const Eigen::Vector2d& world) const {
    const auto height = dtm_->HeightAt(world - origin_.head<2>());
    return height ? std::optional<double>(*height + origin_.z()) : std::nullopt;
  }

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::optional<HeightGrid> dtm_;
};

// Those whose id is a query's, and the first that the barometer can start from: each is projected,
// and a film has many readings without a picture.
void KeepReadingsOf(const std::vector<Query>& queries, std::vector<SensorReading>& readings) {
  std::set<std::string> ids;
  for (const Query& query : queries) ids.insert(query.id);
  const auto start =
      std::find_if(readings.begin(), readings.end(), [](const SensorReading& reading) {
        return reading.pressure_hpa && reading.latitude_deg && reading.longitude_deg &&
               reading.compass_deg;
      });
  if (start != readings.end()) ids.insert(start->id);
  std::erase_if(readings, [&](const SensorReading& reading) { return !ids.contains(reading.id); });
}

}  // namespace

SensorOptions TakeSensorOptions(const std::string& sensors, std::vector<std::string>& set) {
  SensorOptions options;
  std::vector<std::string> rest;
  for (const std::string& assignment : set) {
    if (!assignment.starts_with(kPrefix)) {
      rest.push_back(assignment);
      continue;
    }
    if (sensors.empty()) {
      throw InputError("--set", assignment, "an option of sensors without any", "--sensors FILE");
    }
    ApplyConfig({"", {assignment}}, [&](OptionVisitor& v) {
      v.Group("sensors", [&](OptionVisitor& g) { options.Visit(g); });
    });
  }
  CheckOptions(options, "sensors");
  set = std::move(rest);
  return options;
}

void PriorsFromSensors(const std::string& sensors,
                       const SensorOptions& options,
                       const Context& context,
                       Dataset& dataset) {
  std::vector<SensorReading> readings = ReadSensors(sensors);
  if (options.attitude == "gyroscope") {
    readings = IntegrateGyroscope(std::move(readings), options, sensors);
  }
  const bool only = dataset.queries.size() == 1 && readings.size() == 1;
  if (!only) KeepReadingsOf(dataset.queries, readings);
  const Crs crs = CrsOf(dataset);
  // Once for the places, without heights; then with them.
  const auto priors_with = [&](const auto& height) {
    SensorPriors priors(crs, options);
    std::vector<std::optional<PosePrior>> result;
    for (const SensorReading& reading : readings) {
      std::string missing;
      result.push_back(priors.PriorOf(reading, height, missing));
    }
    return result;
  };
  const auto level = [](const Eigen::Vector2d&) { return std::optional<double>(0.0); };
  std::vector<std::optional<PosePrior>> priors = priors_with(level);
  if (options.height_source == "barometer") {
    Eigen::AlignedBox2d places;
    for (const auto& prior : priors) {
      if (prior) places.extend(prior->position_in_world);
    }
    if (!places.isEmpty()) {
      const Ground ground(dataset, crs, places);
      priors = priors_with([&](const Eigen::Vector2d& place) { return ground.At(place); });
    }
  }
  std::map<std::string, std::optional<PosePrior>> by_id;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (priors[i] && options.height_source == "dtm") priors[i]->height_in_world.reset();
    by_id[readings[i].id] = priors[i];
  }
  std::size_t used = 0;
  for (Query& query : dataset.queries) {
    const auto it = by_id.find(only ? readings.front().id : query.id);
    query.prior = it == by_id.end() ? std::nullopt : it->second;
    if (query.prior) {
      ++used;
      query.assumptions.push_back({"prior", "by instruments", sensors});
    } else {
      context.Note(query.id + ": no usable row in " + sensors);
    }
  }
  if (used > 0) return;
  throw InputError(sensors,
                   "id",
                   "no usable row for any query",
                   "position and compass of ids such as \"" + dataset.queries.front().id + "\"");
}

}  // namespace ridgeline
