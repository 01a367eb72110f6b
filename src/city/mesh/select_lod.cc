// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/select_lod.h"

#include <array>
#include <string>

namespace ridgeline {
namespace {

using Levels = std::uint8_t;  // a bit per level of detail

std::int8_t BestOf(Levels present, int wanted) {
  for (int lod = wanted; lod <= 4; ++lod) {
    if ((present >> lod) & 1) return static_cast<std::int8_t>(lod);
  }
  for (int lod = wanted - 1; lod >= 1; --lod) {
    if ((present >> lod) & 1) return static_cast<std::int8_t>(lod);
  }
  return -1;
}

}  // namespace

std::vector<std::int8_t> SelectLod(SourceModel& model, int wanted) {
  const std::size_t count = model.buildings.size();
  std::vector<Levels> own(count, 0);
  std::vector<Levels> tree(count, 0);  // with the parts
  for (std::size_t b = 0; b < count; ++b) {
    for (const SourceMember& member : model.buildings[b].members) {
      own[b] |= static_cast<Levels>(1 << member.lod);
    }
    int whole = static_cast<int>(b);
    while (whole >= 0) {
      tree[static_cast<std::size_t>(whole)] |= own[b];
      whole = model.buildings[static_cast<std::size_t>(whole)].parent;
    }
  }
  std::vector<std::int8_t> chosen(count, -1);
  for (std::size_t b = 0; b < count; ++b) {
    const SourceBuilding& building = model.buildings[b];
    const std::int8_t of_tree = BestOf(tree[b], wanted);
    const bool parts_have_it = of_tree >= 0 && !((own[b] >> of_tree) & 1);
    if (!parts_have_it) chosen[b] = BestOf(own[b], wanted);
    if (of_tree < 0) {
      const bool flat = (tree[b] & 1) != 0;
      const bool is_part = building.parent >= 0;
      if (is_part && tree[static_cast<std::size_t>(building.parent)] > 1) {
        model.tally.Add("building parts without geometry dropped", building.id);
      } else if (!is_part) {
        model.tally.Add(flat ? "buildings with an outline (LoD0) only dropped"
                             : "buildings without geometry dropped",
                        building.id);
      }
    } else if (chosen[b] >= 0 && chosen[b] != wanted) {
      model.tally.Add("buildings read at LoD" + std::to_string(chosen[b]) + " for lack of LoD" +
                          std::to_string(wanted),
                      building.id);
    }
  }
  return chosen;
}

}  // namespace ridgeline
