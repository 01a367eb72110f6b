// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/edge_table.h"

#include <algorithm>
#include <span>
#include <unordered_map>

namespace ridgeline {

EdgeTable BuildEdgeTable(const FaceSet& set) {
  EdgeTable table;
  table.edge_of_corner.resize(set.corners.size());
  std::unordered_map<std::uint64_t, std::uint32_t> index;
  index.reserve(set.corners.size());
  struct Entry {
    std::uint32_t edge;
    EdgeUse use;
  };
  std::vector<Entry> entries;
  entries.reserve(set.corners.size());
  for (std::uint32_t f = 0; f < set.faces.size(); ++f) {
    const Face& face = set.faces[f];
    for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
      const std::span<const std::uint32_t> ring = set.Ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t from = ring[i];
        const std::uint32_t to = ring[(i + 1) % ring.size()];
        const std::uint32_t low = std::min(from, to);
        const std::uint32_t high = std::max(from, to);
        const std::uint64_t key = (std::uint64_t{low} << 32) | high;
        const auto [it, is_new] =
            index.try_emplace(key, static_cast<std::uint32_t>(table.edges.size()));
        if (is_new) table.edges.push_back({low, high, 0, 0});
        ++table.edges[it->second].use_count;
        table.edge_of_corner[set.rings[r].first + i] = it->second;
        entries.push_back({it->second, {f, from == low}});
      }
    }
  }
  std::uint32_t first = 0;
  for (PolygonEdge& edge : table.edges) {
    edge.first_use = first;
    first += edge.use_count;
    edge.use_count = 0;
  }
  table.uses.resize(entries.size());
  for (const Entry& entry : entries) {
    PolygonEdge& edge = table.edges[entry.edge];
    table.uses[edge.first_use + edge.use_count++] = entry.use;
  }
  return table;
}

}  // namespace ridgeline
