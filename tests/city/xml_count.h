// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ridgeline::testing {

// What a CityGML file says it holds, counted by a plain scan of its tags that shares nothing with
// the reader: no XML library, no links, areas straight from the numbers.
struct XmlCount {
  std::size_t buildings = 0;  // Building and BuildingPart elements
  std::size_t polygons = 0;   // of each whole building's best level of detail: 2, else 3, 4, 1
  double area = 0.0;          // of those polygons, holes taken off
  std::array<double, 4> area_of_class{};  // wall, roof, ground, closure surfaces
};

XmlCount CountXml(const std::filesystem::path& file);

}  // namespace ridgeline::testing
