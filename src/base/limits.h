// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Every limit on what is read from outside, in one place (docs/reliability.md explains them).
// Beyond them a file is damaged or made to hurt: an InputError whose field is "limit" names the
// limit and what to do. They keep any input of 1 MB within ten seconds and 1 GB.
namespace ridgeline::limits {

// Of any file that is read as a whole [bytes].
inline constexpr std::uint64_t kFileBytes = 2'000'000'000;
// Lists and objects within each other in JSON; city models have about ten.
inline constexpr std::size_t kJsonDepth = 100;
// Elements within each other in XML; city models have about 25.
inline constexpr std::size_t kXmlDepth = 200;
// A packed file may grow so many times [1], and to so much in any case [bytes].
inline constexpr std::uint64_t kExpansion = 64;
inline constexpr std::uint64_t kExpandedBytes = std::uint64_t{64} << 20;

// Coordinates of a model [m, or what the file has].
inline constexpr double kCoordinate = 1e8;
// Heights of cameras [m].
inline constexpr double kHeight = 1e5;
inline constexpr std::uint32_t kHoles = 1000;     // of a polygon
inline constexpr std::uint32_t kCorners = 20000;  // of a ring
// Parts within parts of a building.
inline constexpr int kGenerations = 64;
// Links to links, and prototypes in prototypes.
inline constexpr int kLinkDepth = 8;
// What links and implicit geometry stand for: so many polygons for each that is written, or so many
// in any case, and so many points of copies.
inline constexpr std::size_t kPolygonsPerUse = 16;
inline constexpr std::size_t kLinkedPolygons = 100'000;
inline constexpr std::size_t kCopiedPoints = 10'000'000;

// Corners of other polygons that all edges of a model run along: so many in any case, and so many
// for each edge. Cities have some tens for each.
inline constexpr std::size_t kContacts = 100'000'000;
inline constexpr std::size_t kContactsPerEdge = 2000;

// Cells of the part of a raster that is read.
inline constexpr std::int64_t kRasterCells = 100'000'000;

// Of a picture: all pixels; all pixels for each byte of the file, or so many in any case (photos
// have 1 to 20, a white page thousands); and the shorter side: what is smaller shows no building.
inline constexpr std::int64_t kPicturePixels = 200'000'000;
inline constexpr std::int64_t kPixelsPerByte = 50;
inline constexpr std::int64_t kPackedPixels = 25'000'000;
inline constexpr int kLeastPictureSide = 24;
// Pixels that a picture in a file of so many bytes may have.
constexpr std::int64_t PicturePixels(std::size_t bytes) {
  return std::min(kPicturePixels,
                  std::max(kPackedPixels, kPixelsPerByte * static_cast<std::int64_t>(bytes)));
}

// Segments of a file of lines; a detector finds thousands.
inline constexpr std::size_t kSegments = 30'000;

}  // namespace ridgeline::limits
