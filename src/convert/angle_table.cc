// SPDX-License-Identifier: Apache-2.0
#include "convert/angle_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.h"
#include "convert/text_lines.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct Column {
  const char* name;
  std::vector<std::string> spellings;  // in small letters
};

const std::array<Column, 7>& Columns() {
  static const std::array<Column, 7> columns = {{
      {"image",
       {"image", "imagename", "name", "label", "photo", "filename", "file", "query", "id"}},
      {"easting", {"easting", "x/easting", "east", "e", "x", "x0"}},
      {"northing", {"northing", "y/northing", "north", "n", "y", "y0"}},
      {"height", {"height", "z/altitude", "altitude", "h", "z", "z0"}},
      {"omega", {"omega", "omega_deg", "omega[deg]", "omega [deg]"}},
      {"phi", {"phi", "phi_deg", "phi[deg]", "phi [deg]"}},
      {"kappa", {"kappa", "kappa_deg", "kappa[deg]", "kappa [deg]"}},
  }};
  return columns;
}

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

// Of the first line that names omega: programs write remarks above it.
char DelimiterOf(const std::string& line) {
  for (const char delimiter : {';', ',', '\t'}) {
    if (line.find(delimiter) != std::string::npos) return delimiter;
  }
  return ' ';
}

// Places of the columns in a header line; nullopt if it is none.
std::optional<std::array<std::size_t, 7>> HeaderOf(const TextLine& line) {
  if (Lower(line.text()).find("omega") == std::string::npos) return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string name = Lower(line[i]);
    name.erase(0, name.find_first_not_of("# "));
    if (!name.empty()) names.push_back(name);
  }
  std::array<std::size_t, 7> places{};
  for (std::size_t c = 0; c < places.size(); ++c) {
    const Column& column = Columns()[c];
    const auto it = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return std::find(column.spellings.begin(), column.spellings.end(), name) !=
             column.spellings.end();
    });
    if (it == names.end()) {
      line.Fail(std::string("no column ") + column.name,
                "columns image, easting, northing, height, omega, phi, kappa");
    }
    places[c] = static_cast<std::size_t>(it - names.begin());
  }
  return places;
}

}  // namespace

Dataset ReadAngleTable(const fs::path& file, const ConvertOptions& options) {
  char delimiter = ' ';
  for (const TextLine& line : ReadLines(file)) {
    if (Lower(line.text()).find("omega") == std::string::npos) continue;
    delimiter = DelimiterOf(line.text());
    break;
  }
  const Eigen::Vector3d origin = options.origin.value_or(Eigen::Vector3d::Zero());
  Dataset dataset;
  dataset.name = file.stem().string();
  dataset.crs = options.crs;
  std::optional<std::array<std::size_t, 7>> places;
  for (const TextLine& line : ReadLines(file, delimiter)) {
    if (!places) {
      places = HeaderOf(line);
      continue;
    }
    if (!IsData(line)) continue;
    const auto number = [&](std::size_t c) { return line.Number((*places)[c], Columns()[c].name); };
    if ((*places)[0] >= line.size() || line[(*places)[0]].empty()) {
      line.Fail("\"" + line.text() + "\"", "the name of a picture");
    }
    constexpr double kMostDeg = 720.0;
    for (const std::size_t c : {4, 5, 6}) {
      if (std::abs(number(c)) <= kMostDeg) continue;
      line.Fail("\"" + line[(*places)[c]] + "\"", std::string("an angle in degrees for ") + Columns()[c].name);
    }
    Query query;
    query.image = line[(*places)[0]];
    query.camera = options.camera;
    query.truth = Pose{CamFromWorld(OmegaPhiKappa{number(4), number(5), number(6)}),
                       origin + Eigen::Vector3d(number(1), number(2), number(3))};
    dataset.queries.push_back(std::move(query));
  }
  if (!places) {
    throw InputError(file.string(),
                     "line 1",
                     "no names of columns",
                     "a line such as \"image,easting,northing,height,omega,phi,kappa\"");
  }
  if (dataset.queries.empty()) {
    throw InputError(file.string(), "", "no picture", "a line per picture");
  }
  return dataset;
}

}  // namespace ridgeline
