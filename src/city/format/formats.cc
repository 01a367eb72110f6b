// SPDX-License-Identifier: Apache-2.0
#include "city/format/formats.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/error.h"
#include "base/limits.h"
#include "city/format/read_citygml.h"
#include "city/format/read_cityjson.h"
#include "city/format/read_obj.h"

namespace ridgeline {
namespace fs = std::filesystem;
namespace {

// ".gml" of "tile.GML.gz".
std::string ModelExtension(const fs::path& path) {
  const fs::path name = path.extension() == ".gz" ? path.stem() : path;
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

bool Contains(const std::vector<std::string_view>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

// Whether a file holds one of the format's marks. What is first in a document of XML is fixed, but
// in one of JSON nothing is: the whole file is looked through.
bool HasMark(const fs::path& path, const CityFormat& format) {
  if (format.marks.empty()) return false;
  std::size_t longest = 0;
  for (const std::string_view mark : format.marks) longest = std::max(longest, mark.size());
  InputFile file(path);
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::string text;
  for (;;) {
    const std::size_t kept = std::min(text.size(), longest);
    text.erase(0, text.size() - kept);
    text.resize(kept + kChunk);
    const std::size_t count = file.Read(text.data() + kept, kChunk);
    text.resize(kept + count);
    if (count == 0) return false;
    for (const std::string_view mark : format.marks) {
      if (text.find(mark) != std::string::npos) return true;
    }
  }
}

const CityFormat& FormatOf(const fs::path& path) {
  if (const CityFormat* const format = FormatOfName(path)) return *format;
  for (const CityFormat& format : CityFormats()) {
    if (HasMark(path, format)) return format;
  }
  throw InputError(
      path.string(), "", "a file of no known format", "a city model (" + ModelFilePatterns() + ")");
}

[[noreturn]] void FailLimit(const SourceModel& model,
                            const SourcePolygon& polygon,
                            const std::string& found,
                            const std::string& expected) {
  const std::string name = polygon.id.empty() ? "" : " of polygon " + polygon.id;
  throw InputError(model.file, "limit", found + name, expected);
}

void CheckLimits(const SourceModel& model) {
  for (const SourcePolygon& polygon : model.polygons) {
    if (polygon.ring_count > limits::kHoles + 1) {
      FailLimit(model,
                polygon,
                std::to_string(polygon.ring_count - 1) + " holes",
                "at most " + std::to_string(limits::kHoles) + " in a polygon");
    }
    for (std::uint32_t r = polygon.first_ring; r < polygon.first_ring + polygon.ring_count; ++r) {
      const SourceRing& ring = model.rings[r];
      if (ring.point_count > limits::kCorners) {
        FailLimit(model,
                  polygon,
                  "a ring of " + std::to_string(ring.point_count) + " corners",
                  "at most " + std::to_string(limits::kCorners));
      }
      for (std::uint32_t p = ring.first_point; p < ring.first_point + ring.point_count; ++p) {
        const double largest = model.points[p].cwiseAbs().maxCoeff();
        if (largest <= limits::kCoordinate) continue;  // false for NaN
        std::ostringstream number;
        number << "the coordinate " << largest;
        FailLimit(model, polygon, number.str(), "coordinates of at most 1e8");
      }
    }
  }
}

}  // namespace

const std::vector<CityFormat>& CityFormats() {
  static const std::vector<CityFormat> formats = {
      {"CityGML", {".gml", ".citygml"}, {".xml"}, {"CityModel"}, ReadCityGml},
      {"CityJSON",
       {".cityjson", ".cityjsonl", ".jsonl"},
       {".json"},
       {"\"CityObjects\"", "\"CityJSON\""},
       ReadCityJson},
      {"OBJ", {".obj"}, {}, {}, ReadObj},
      {"PLY", {".ply"}, {}, {}, ReadPly},
  };
  return formats;
}

std::string ModelFilePatterns() {
  std::string text;
  for (const CityFormat& format : CityFormats()) {
    for (const auto* list : {&format.extensions, &format.shared_extensions}) {
      for (const std::string_view extension : *list) {
        text += (text.empty() ? "*" : ", *") + std::string(extension);
      }
    }
  }
  return text;
}

const CityFormat* FormatOfName(const fs::path& path) {
  const std::string extension = ModelExtension(path);
  for (const CityFormat& format : CityFormats()) {
    if (Contains(format.extensions, extension) || Contains(format.shared_extensions, extension)) {
      return &format;
    }
  }
  return nullptr;
}

bool IsModelFile(const fs::path& path) {
  const CityFormat* const format = FormatOfName(path);
  if (format == nullptr) return false;
  return Contains(format->extensions, ModelExtension(path)) || HasMark(path, *format);
}

SourceModel ReadModelFile(const fs::path& path) {
  InputFile file(path);
  SourceModel model = FormatOf(path).read(file);
  CheckLimits(model);
  return model;
}

}  // namespace ridgeline
