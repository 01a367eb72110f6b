// SPDX-License-Identifier: Apache-2.0
#include "optim/simplex.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

bool Better(const Vertex& a, const Vertex& b) { return a.energy < b.energy; }

// a + factor (b - a)
UnitPoint Along(const UnitPoint& a, const UnitPoint& b, double factor) {
  UnitPoint result(a.size());
  for (std::size_t d = 0; d < a.size(); ++d) result[d] = a[d] + factor * (b[d] - a[d]);
  return result;
}

UnitPoint CentroidOfAllButLast(const std::vector<Vertex>& simplex) {
  UnitPoint centroid(simplex[0].point.size(), 0.0);
  const double share = 1.0 / static_cast<double>(simplex.size() - 1);
  for (std::size_t i = 0; i + 1 < simplex.size(); ++i) {
    for (std::size_t d = 0; d < centroid.size(); ++d) {
      centroid[d] += share * simplex[i].point[d];
    }
  }
  return centroid;
}

// Largest distance along an axis from the best vertex.
double Extent(const std::vector<Vertex>& simplex) {
  double extent = 0.0;
  for (const Vertex& vertex : simplex) {
    for (std::size_t d = 0; d < vertex.point.size(); ++d) {
      extent = std::max(extent, std::abs(vertex.point[d] - simplex[0].point[d]));
    }
  }
  return extent;
}

Batch Single(const UnitPoint& point, const std::vector<bool>& periodic) {
  return {{FoldIntoCube(point, periodic)}, {}, {}};
}

}  // namespace

SearchRoutine Simplex(std::shared_ptr<Vertex> best,
                      std::vector<std::size_t> coordinates,
                      std::vector<bool> periodic,
                      double step,
                      double smallest) {
  std::vector<Vertex> simplex = {*best};
  Batch corners;
  for (const std::size_t d : coordinates) {
    UnitPoint point = best->point;
    const bool turn = !periodic[d] && point[d] + step > 1.0;
    point[d] += turn ? -step : step;
    simplex.push_back({point, 0.0});
    corners.points.push_back(FoldIntoCube(point, periodic));
  }
  co_yield corners;
  for (std::size_t i = 1; i < simplex.size(); ++i) simplex[i].energy = corners.energies[i - 1];

  std::stable_sort(simplex.begin(), simplex.end(), Better);
  while (Extent(simplex) > smallest) {
    Vertex& worst = simplex.back();
    const double second_worst = simplex[simplex.size() - 2].energy;
    const UnitPoint centroid = CentroidOfAllButLast(simplex);

    Vertex reflected{Along(centroid, worst.point, -1.0), 0.0};
    Batch one = Single(reflected.point, periodic);
    co_yield one;
    reflected.energy = one.energies[0];

    if (reflected.energy < simplex[0].energy) {
      Vertex expanded{Along(centroid, worst.point, -2.0), 0.0};
      Batch two = Single(expanded.point, periodic);
      co_yield two;
      expanded.energy = two.energies[0];
      worst = Better(expanded, reflected) ? expanded : reflected;
    } else if (reflected.energy < second_worst) {
      worst = reflected;
    } else {
      const bool outside = reflected.energy < worst.energy;
      Vertex contracted{Along(centroid, worst.point, outside ? -0.5 : 0.5), 0.0};
      Batch two = Single(contracted.point, periodic);
      co_yield two;
      contracted.energy = two.energies[0];
      if (contracted.energy < std::min(reflected.energy, worst.energy)) {
        worst = contracted;
      } else {
        Batch shrunk;
        for (std::size_t i = 1; i < simplex.size(); ++i) {
          simplex[i].point = Along(simplex[0].point, simplex[i].point, 0.5);
          shrunk.points.push_back(FoldIntoCube(simplex[i].point, periodic));
        }
        co_yield shrunk;
        for (std::size_t i = 1; i < simplex.size(); ++i) simplex[i].energy = shrunk.energies[i - 1];
      }
    }
    std::stable_sort(simplex.begin(), simplex.end(), Better);
  }
  *best = {FoldIntoCube(simplex[0].point, periodic), simplex[0].energy};
}

}  // namespace ridgeline
