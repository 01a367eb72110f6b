// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

class GDALDataset;
class GDALRasterBand;

namespace ridgeline {

// The values of a raster's first band, with what is missing made NaN, whichever way the file tells
// it: a nodata value, NaN, a mask, an alpha band, or a fill value that it does not declare (-9999,
// the ends of an integer type, anything that is no height on Earth). The only way from a raster's
// cells to heights: nothing is resampled before.
class RasterValues {
 public:
  // @param metres_per_unit  Of the band, after its scale and offset.
  RasterValues(GDALDataset& dataset, const std::string& file, double metres_per_unit);

  // Heights [m] of the cells (column, row), (column + 1, row), ...; NaN: missing. Throws InputError
  // for cells that cannot be read.
  void ReadRow(int column, int row, std::span<double> heights);

  // A line for undeclared fill values that were met, and one for zeros far below all others.
  std::vector<std::string> Warnings() const;

 private:
  bool IsUndeclaredFill(double raw, double height) const;

  std::string file_;
  GDALRasterBand& band_;
  GDALRasterBand* mask_ = nullptr;
  bool has_nodata_ = false;
  double nodata_ = 0.0;
  double scale_ = 1.0;
  double offset_ = 0.0;
  double metres_per_unit_ = 1.0;
  // Ends of the band's integer type; NaN: none.
  double lowest_integer_ = std::numeric_limits<double>::quiet_NaN();
  double highest_integer_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<unsigned char> mask_row_;
  std::map<double, std::size_t> fills_;
  std::size_t zeros_ = 0;
  double lowest_other_ = std::numeric_limits<double>::infinity();  // height that is not 0
};

// Throws InputError for a raster that is no terrain model, saying what it is: a picture (colour
// bands, a palette, 8 bits), complex numbers, several bands.
void CheckIsTerrain(GDALDataset& dataset, const std::string& file);

}  // namespace ridgeline
