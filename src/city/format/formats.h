// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "city/format/input_file.h"
#include "city/source_model.h"

namespace ridgeline {

// A format of city models. Adding one: its reader, one line in the table of formats.cc, its test
// and its paragraph in docs/city_data.md.
struct CityFormat {
  std::string_view name;
  // Files of these names are models; all also with ".gz".
  std::vector<std::string_view> extensions;
  // Many files of these names are something else: they are models if they hold one of the marks.
  std::vector<std::string_view> shared_extensions;
  std::vector<std::string_view> marks;
  SourceModel (*read)(InputFile& file);
};

const std::vector<CityFormat>& CityFormats();

// "*.gml, *.citygml, *.xml, ...": for messages.
std::string ModelFilePatterns();

// The format that a file's name stands for; nullptr: none.
const CityFormat* FormatOfName(const std::filesystem::path& path);

// Whether a file is a model: by its name, or where other files share it by its marks, wherever they
// stand in it. Throws InputError for a file that cannot be read.
bool IsModelFile(const std::filesystem::path& path);

// Reads a model file in its own coordinates. The format is told by its name, else by its marks.
// Throws InputError for a file that is missing, damaged or of no known format, and for one beyond a
// limit: coordinates of 1e8 m, 1000 holes in a polygon, 20 000 corners of a ring.
SourceModel ReadModelFile(const std::filesystem::path& path);

}  // namespace ridgeline
