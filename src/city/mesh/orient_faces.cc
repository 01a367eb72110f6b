// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/orient_faces.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

namespace ridgeline {
namespace {

// A directed edge of a face, keyed by its undirected ends.
struct HalfEdge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t face = 0;
  bool forward = false;  // runs from low to high
};

struct Neighbour {
  std::uint32_t face = 0;
  bool agrees = false;
};

class ShellOrienter {
 public:
  ShellOrienter(FaceSet& set, std::uint32_t begin, std::uint32_t end)
      : set_(set), begin_(begin), neighbours_(end - begin), component_(end - begin, -1) {
    CollectNeighbours(begin, end);
    for (std::uint32_t f = begin; f < end; ++f) total_area_ += set.faces[f].area;
  }

  // Number of faces turned.
  std::size_t Run() {
    std::size_t turned = 0;
    for (std::uint32_t seed = 0; seed < component_.size(); ++seed) {
      if (component_[seed] < 0) turned += OrientComponent(seed);
    }
    return turned;
  }

 private:
  void CollectNeighbours(std::uint32_t begin, std::uint32_t end) {
    std::vector<HalfEdge> edges;
    for (std::uint32_t f = begin; f < end; ++f) {
      const Face& face = set_.faces[f];
      for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
        const std::span<const std::uint32_t> ring = set_.Ring(r);
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const std::uint32_t a = ring[i];
          const std::uint32_t b = ring[(i + 1) % ring.size()];
          edges.push_back({std::min(a, b), std::max(a, b), f - begin, a < b});
        }
      }
    }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t j = i + 1;
      while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high)
        ++j;
      // More than two faces at an edge do not say who neighbours whom.
      if (j - i == 2 && edges[i].face != edges[i + 1].face) {
        const bool agrees = edges[i].forward != edges[i + 1].forward;
        neighbours_[edges[i].face].push_back({edges[i + 1].face, agrees});
        neighbours_[edges[i + 1].face].push_back({edges[i].face, agrees});
      }
      i = j;
    }
  }

  std::size_t OrientComponent(std::uint32_t seed) {
    std::vector<std::pair<std::uint32_t, bool>> members;  // face, turned against the seed
    members.emplace_back(seed, false);
    component_[seed] = static_cast<int>(seed);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto [face, turned] = members[i];
      for (const Neighbour& neighbour : neighbours_[face]) {
        if (component_[neighbour.face] >= 0) continue;
        component_[neighbour.face] = static_cast<int>(seed);
        members.emplace_back(neighbour.face, turned == neighbour.agrees);
      }
    }
    const bool turn_all = PointsInwards(members);
    std::size_t count = 0;
    for (const auto& [face, turned] : members) {
      if (turned == turn_all) continue;
      set_.Flip(set_.faces[begin_ + face]);
      ++count;
    }
    return count;
  }

  // Whether the component, with its members turned as told, is inside out: by its volume where it
  // is the body of the building; by the area that would have to be turned where it is only a sheet
  // of it (the walls of a courtyard rightly point inwards).
  bool PointsInwards(const std::vector<std::pair<std::uint32_t, bool>>& members) const {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double area = 0.0;
    double turned_area = 0.0;
    for (const auto& [f, turned] : members) {
      const Face& face = set_.faces[begin_ + f];
      center += face.area * face.centroid;
      area += face.area;
      if (turned) turned_area += face.area;
    }
    if (area <= 0.0) return false;
    center /= area;
    double volume = 0.0;
    double bulk = 0.0;
    for (const auto& [f, turned] : members) {
      const Face& face = set_.faces[begin_ + f];
      const double part = face.area * face.normal.dot(face.centroid - center);
      volume += turned ? -part : part;
      bulk += std::abs(part);
    }
    constexpr double kBody = 0.6;   // share of the building's area
    constexpr double kClear = 0.3;  // of a convex body, |volume| = bulk
    const bool is_body = members.size() >= 4 && area > kBody * total_area_;
    if (is_body && std::abs(volume) > kClear * bulk) return volume < 0.0;
    return turned_area > 0.5 * area;
  }

  FaceSet& set_;
  std::uint32_t begin_;
  double total_area_ = 0.0;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<int> component_;
};

}  // namespace

void OrientFaces(FaceSet& set, const std::vector<std::string>& building_ids, Tally& tally) {
  const auto count = static_cast<std::uint32_t>(set.faces.size());
  for (std::uint32_t begin = 0; begin < count;) {
    const std::uint32_t building = set.faces[begin].building;
    std::uint32_t end = begin + 1;
    while (end < count && set.faces[end].building == building) ++end;
    const std::size_t turned = ShellOrienter(set, begin, end).Run();
    if (turned > 0) tally.Add("buildings with surfaces turned outwards", building_ids[building]);
    begin = end;
  }
}

}  // namespace ridgeline
