// SPDX-License-Identifier: Apache-2.0
#include "city/raster_values.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "base/error.h"

namespace ridgeline {
namespace {

// Heights of solid ground on Earth [m], with a margin: the shore of the Dead Sea, Mount Everest.
constexpr double kLowestHeight = -500.0;
constexpr double kHighestHeight = 9000.0;
// Fill values in use that small units would make heights.
constexpr std::array kFills = {-9999.0, -99999.0, -32768.0, -32767.0};

std::string Number(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

int BandsOfValues(GDALDataset& dataset) {
  int count = 0;
  for (int b = 1; b <= dataset.GetRasterCount(); ++b) {
    if (dataset.GetRasterBand(b)->GetColorInterpretation() != GCI_AlphaBand) ++count;
  }
  return count;
}

bool IsColour(GDALColorInterp meaning) {
  return meaning >= GCI_RedBand && meaning <= GCI_YCbCr_CrBand && meaning != GCI_AlphaBand;
}

// GDAL makes a mask of alpha bands of bytes and 16 bits only; beside heights it is often a float.
GDALRasterBand* AlphaBandOf(GDALDataset& dataset) {
  for (int b = 2; b <= dataset.GetRasterCount(); ++b) {
    GDALRasterBand* const band = dataset.GetRasterBand(b);
    if (band->GetColorInterpretation() == GCI_AlphaBand) return band;
  }
  return nullptr;
}

}  // namespace

RasterValues::RasterValues(GDALDataset& dataset, const std::string& file, double metres_per_unit)
    : file_(file), band_(*dataset.GetRasterBand(1)), metres_per_unit_(metres_per_unit) {
  int has_nodata = 0;
  nodata_ = band_.GetNoDataValue(&has_nodata);
  has_nodata_ = has_nodata != 0;
  scale_ = band_.GetScale();
  offset_ = band_.GetOffset();
  if (scale_ == 0.0 || !std::isfinite(scale_) || !std::isfinite(offset_)) {
    throw InputError(file_,
                     "scale",
                     "heights of " + Number(scale_) + " * cell + " + Number(offset_),
                     "a scale that keeps them apart (gdal_edit.py -unsetstats -scale 1 -offset 0)");
  }
  if ((band_.GetMaskFlags() & GMF_ALL_VALID) == 0) {
    mask_ = band_.GetMaskBand();
  } else {
    mask_ = AlphaBandOf(dataset);
  }
  switch (band_.GetRasterDataType()) {
    case GDT_Int16:
      lowest_integer_ = std::numeric_limits<std::int16_t>::min();
      highest_integer_ = std::numeric_limits<std::int16_t>::max();
      break;
    case GDT_UInt16:
      highest_integer_ = std::numeric_limits<std::uint16_t>::max();
      break;
    case GDT_Int32:
      lowest_integer_ = std::numeric_limits<std::int32_t>::min();
      highest_integer_ = std::numeric_limits<std::int32_t>::max();
      break;
    case GDT_UInt32:
      highest_integer_ = std::numeric_limits<std::uint32_t>::max();
      break;
    default:
      break;
  }
}

bool RasterValues::IsUndeclaredFill(double raw, double height) const {
  if (height < kLowestHeight || height > kHighestHeight) return true;
  if (raw == lowest_integer_ || raw == highest_integer_) return true;
  for (const double fill : kFills) {
    if (raw == fill) return true;
  }
  return false;
}

void RasterValues::ReadRow(int column, int row, std::span<double> heights) {
  const int count = static_cast<int>(heights.size());
  CPLErr error = band_.RasterIO(
      GF_Read, column, row, count, 1, heights.data(), count, 1, GDT_Float64, 0, 0, nullptr);
  if (mask_ != nullptr && error == CE_None) {
    mask_row_.resize(heights.size());
    error = mask_->RasterIO(
        GF_Read, column, row, count, 1, mask_row_.data(), count, 1, GDT_Byte, 0, 0, nullptr);
  }
  if (error != CE_None) {
    throw InputError(file_,
                     "row " + std::to_string(row),
                     "cells that cannot be read",
                     "a whole raster (was the download cut off?)");
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double raw = heights[i];
    const bool declared = !std::isfinite(raw) || (has_nodata_ && raw == nodata_) ||
                          (mask_ != nullptr && mask_row_[i] == 0);
    heights[i] = (raw * scale_ + offset_) * metres_per_unit_;
    if (declared) {
      heights[i] = std::numeric_limits<double>::quiet_NaN();
    } else if (IsUndeclaredFill(raw, heights[i])) {
      heights[i] = std::numeric_limits<double>::quiet_NaN();
      // A raster of noise has a million of them.
      constexpr std::size_t kMostFills = 1000;
      if (fills_.size() < kMostFills || fills_.contains(raw)) ++fills_[raw];
    } else if (heights[i] == 0.0) {
      ++zeros_;
    } else {
      lowest_other_ = std::min(lowest_other_, heights[i]);
    }
  }
}

std::vector<std::string> RasterValues::Warnings() const {
  std::vector<std::string> warnings;
  // Land goes down to the sea step by step; a hole that somebody filled with zeros does not.
  constexpr double kCliff = 20.0;
  if (zeros_ > 0 && std::isfinite(lowest_other_) && lowest_other_ > kCliff) {
    warnings.push_back(file_ + ": " + std::to_string(zeros_) +
                       " cells are at 0 m, all others above " + Number(lowest_other_) +
                       " m; taken as they are (gdal_edit.py -a_nodata 0 declares them missing)");
  }
  if (fills_.empty()) return warnings;
  std::size_t cells = 0;
  auto most = fills_.begin();
  for (auto it = fills_.begin(); it != fills_.end(); ++it) {
    cells += it->second;
    if (it->second > most->second) most = it;
  }
  warnings.push_back(file_ + ": " + std::to_string(cells) + " cells hold " + Number(most->first) +
                     (fills_.size() > 1 ? " and other values that are" : ", which is") +
                     " no height; taken as missing (gdal_edit.py -a_nodata " + Number(most->first) +
                     " declares it)");
  return warnings;
}

void CheckIsTerrain(GDALDataset& dataset, const std::string& file) {
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  const auto fail = [&](const std::string& found) {
    throw InputError(file, "", found, "a terrain model: one band of heights");
  };
  const GDALDataType type = band.GetRasterDataType();
  const GDALColorInterp meaning = band.GetColorInterpretation();
  if (GDALDataTypeIsComplex(type)) {
    fail(std::string("a raster of complex numbers (") + GDALGetDataTypeName(type) + ")");
  }
  if (meaning == GCI_PaletteIndex || band.GetColorTable() != nullptr) {
    fail("a picture: its cells are colours of a palette");
  }
  if (IsColour(meaning)) {
    fail(std::string("a colour picture (band 1 is ") + GDALGetColorInterpretationName(meaning) +
         ")");
  }
  const int bands = BandsOfValues(dataset);
  if (bands > 1) {
    fail("a raster of " + std::to_string(bands) +
         " bands (gdal_translate -b N takes one that holds heights)");
  }
  if (type == GDT_Byte) {
    fail(
        "a picture of 8 bits, e.g. shaded relief (gdal_translate -ot Float32 if its cells are "
        "heights in metres)");
  }
}

}  // namespace ridgeline
