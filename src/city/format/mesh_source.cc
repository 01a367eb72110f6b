// SPDX-License-Identifier: Apache-2.0
#include "city/format/mesh_source.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/mesh/point_welder.h"

namespace ridgeline {
namespace {

constexpr double kWeld = 0.001;  // [m]: corners of one connected part
constexpr std::int8_t kLod = 2;  // a mesh does not say; it is taken for what is wanted most

std::optional<Eigen::Vector3d> ParseVector(std::string_view text) {
  std::istringstream stream{std::string(text)};
  Eigen::Vector3d v;
  std::string rest;
  if (!(stream >> v.x() >> v.y() >> v.z()) || stream >> rest || !v.allFinite()) return std::nullopt;
  return v;
}

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool StripWord(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word) || text.size() == word.size()) return false;
  const char after = text[word.size()];
  if (after != ' ' && after != '\t' && after != ':' && after != '=') return false;
  text = Trim(text.substr(word.size() + 1));
  return true;
}

}  // namespace

MeshSource::MeshSource(const std::string& file) { model_.file = file; }

void MeshSource::Comment(std::string_view text) {
  text = Trim(text);
  if (StripWord(text, "crs")) {
    model_.srs_names.emplace_back(text);
  } else if (StripWord(text, "offset")) {
    offset_ = ParseVector(text);
    if (!offset_) {
      throw InputError(model_.file,
                       "offset",
                       "\"" + std::string(text) + "\"",
                       "three numbers: east, north, height");
    }
  }
}

void MeshSource::BeginObject(std::string_view name) {
  const std::string key(Trim(name));
  const auto [it, is_new] = object_index_.try_emplace(key, static_cast<int>(objects_.size()));
  if (is_new) objects_.push_back(key);
  object_ = it->second;
}

void MeshSource::SetClassFromName(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  struct Word {
    const char* text;
    SurfaceClass surface_class;
  };
  static constexpr std::array kWords = {
      Word{"roof", SurfaceClass::kRoof},
      Word{"dach", SurfaceClass::kRoof},
      Word{"wall", SurfaceClass::kWall},
      Word{"wand", SurfaceClass::kWall},
      Word{"facade", SurfaceClass::kWall},
      Word{"ground", SurfaceClass::kGround},
      Word{"grund", SurfaceClass::kGround},
      Word{"closure", SurfaceClass::kClosure},
  };
  has_class_ = false;
  for (const Word& word : kWords) {
    if (lower.find(word.text) == std::string::npos) continue;
    surface_class_ = word.surface_class;
    has_class_ = true;
    return;
  }
}

void MeshSource::AddFace(std::span<const std::uint32_t> corners) {
  PolygonCount& count = model_.polygons_of_lod[kLod];
  ++count.met;
  if (corners.size() < 3) {
    ++count.named;
    model_.tally.Add("faces with fewer than 3 points dropped", std::size_t{1});
    return;
  }
  ++count.read;
  MeshFace face{static_cast<std::uint32_t>(corners_.size()),
                static_cast<std::uint32_t>(corners.size()),
                object_,
                surface_class_,
                has_class_};
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  faces_.push_back(face);
}

void MeshSource::ReadSidecar() {
  const std::filesystem::path sidecar = model_.file + ".offset";
  std::error_code error;
  if (!std::filesystem::exists(sidecar, error)) return;
  std::istringstream lines(ReadFile(sidecar));
  for (std::string line; std::getline(lines, line);) {
    std::string_view text = Trim(line);
    if (!text.empty() && text.front() == '#') text = Trim(text.substr(1));
    if (text.empty()) continue;
    if (const std::optional<Eigen::Vector3d> bare = ParseVector(text)) {
      offset_ = bare;
    } else {
      Comment(text);
    }
  }
}

std::vector<int> MeshSource::BuildingOfFaces(std::vector<std::string>& names) const {
  std::vector<int> building(faces_.size());
  if (!objects_.empty()) {
    names = objects_;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].object < 0 && names.size() == objects_.size()) names.emplace_back();
      building[f] = faces_[f].object < 0 ? static_cast<int>(objects_.size()) : faces_[f].object;
    }
    return building;
  }
  PointWelder welder(kWeld);
  std::vector<std::uint32_t> welded(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) welded[v] = welder.Add(vertices_[v]);
  std::vector<std::uint32_t> parent(welder.points().size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const MeshFace& face : faces_) {
    const std::uint32_t first = root(welded[corners_[face.first]]);
    for (std::uint32_t i = 1; i < face.count; ++i) {
      parent[root(welded[corners_[face.first + i]])] = first;
    }
  }
  std::unordered_map<std::uint32_t, int> index;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::uint32_t part = root(welded[corners_[faces_[f].first]]);
    const auto [it, is_new] = index.try_emplace(part, static_cast<int>(names.size()));
    if (is_new) names.emplace_back();
    building[f] = it->second;
  }
  return building;
}

SourceModel MeshSource::Finish() {
  ReadSidecar();
  std::vector<std::string> names;
  const std::vector<int> building = BuildingOfFaces(names);
  for (const std::string& name : names) model_.buildings.push_back({name, -1, {}});
  const Eigen::Vector3d offset = offset_.value_or(Eigen::Vector3d::Zero());
  model_.points.reserve(corners_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const MeshFace& face = faces_[f];
    SourceMember member;
    member.polygon = static_cast<std::uint32_t>(model_.polygons.size());
    member.lod = kLod;
    member.surface_class = face.surface_class;
    member.has_class = face.has_class;
    model_.polygons.push_back({static_cast<std::uint32_t>(model_.rings.size()), 1, ""});
    model_.rings.push_back({static_cast<std::uint32_t>(model_.points.size()), face.count});
    for (std::uint32_t i = 0; i < face.count; ++i) {
      model_.points.push_back(vertices_[corners_[face.first + i]] + offset);
    }
    model_.buildings[static_cast<std::size_t>(building[f])].members.push_back(member);
  }
  return std::move(model_);
}

}  // namespace ridgeline
