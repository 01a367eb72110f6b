// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace ridgeline {

// One coordinate of a search, in the caller's own unit.
struct Parameter {
  std::string name;
  double lower = 0.0;
  double upper = 1.0;
  // lower and upper are the same place, e.g. a heading in [0, 360] degrees. A sector of headings
  // (80 to 120 degrees) is not periodic.
  bool periodic = false;

  // A parameter with lower == upper keeps that value and costs the search nothing.
  bool Fixed() const { return lower == upper; }
};

// A box of parameters: the space a sampler searches.
struct SearchBox {
  std::vector<Parameter> parameters;

  std::size_t Size() const { return parameters.size(); }
  // True if there is one finite value per parameter and each is within its closed interval.
  bool Contains(std::span<const double> values) const;
  // Shortest signed way from `from` to `to` in parameter `index`, across the seam if periodic.
  double Difference(std::size_t index, double from, double to) const;
  // The middle of every interval.
  std::vector<double> Center() const;

  // Throws InputError naming the field, e.g. "search.heading_deg", for a box without parameters,
  // empty or repeated names, bounds that are not finite, or lower > upper.
  void Validate() const;
};

// Says whether a point of the box is admissible, without evaluating its energy (for a pose: not in
// a building, on the terrain). Called from Sampler::Ask() only, on the caller's thread. An empty
// function admits the whole box.
using Feasible = std::function<bool(std::span<const double>)>;

// The free parameters of a box as the unit cube. Samplers work there.
class UnitCube {
 public:
  explicit UnitCube(const SearchBox& box);

  std::size_t dimension() const { return free_.size(); }
  // Per coordinate of the cube.
  const std::vector<bool>& periodic() const { return periodic_; }
  const std::vector<std::string>& names() const { return names_; }

  // Point of the box for a point of the cube; the fixed parameters get their value.
  std::vector<double> ToBox(std::span<const double> unit) const;
  std::vector<double> ToUnit(std::span<const double> values) const;

 private:
  SearchBox box_;
  std::vector<std::size_t> free_;
  std::vector<bool> periodic_;
  std::vector<std::string> names_;
};

}  // namespace ridgeline
