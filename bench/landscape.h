// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "optim/search_box.h"

namespace ridgeline {

// An energy recorded on a regular grid over some parameters, to try samplers on the real thing
// without computing it again.
//
// File: CSV with one line per grid point, in any order. The header names the parameters, with
// " periodic" behind the name of one whose grid goes round (the period is points times spacing),
// and last "energy". Every combination of the values must be there; values must be equally spaced.
// An energy of nan or inf marks a place that is not admissible:
//   east_m,north_m,heading_deg,energy
//   -10,-10,80,0.91
class Landscape {
 public:
  // Throws InputError with file and line.
  explicit Landscape(const std::filesystem::path& path);

  const SearchBox& box() const { return box_; }
  // Energy at the admissible grid points around, linear in each parameter between them.
  double Energy(std::span<const double> values) const;
  // True if the nearest grid point is.
  bool Feasible(std::span<const double> values) const;
  // The grid point of least energy.
  const std::vector<double>& minimum() const { return minimum_; }
  double least_energy() const { return least_energy_; }

 private:
  struct Axis {
    double first = 0.0;
    double spacing = 1.0;
    std::size_t count = 1;
    bool periodic = false;
    std::size_t stride = 1;
  };

  void MakeAxes(const std::vector<std::vector<double>>& rows, const std::string& file);
  std::size_t NodeAt(std::size_t axis, double value, double* beyond) const;

  SearchBox box_;
  std::vector<Axis> axes_;
  std::vector<double> energies_;
  std::vector<double> minimum_;
  double least_energy_ = 0.0;
};

}  // namespace ridgeline
