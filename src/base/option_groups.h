// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"

namespace ridgeline {

// Options of plug-ins, a group of a type each, in the order in which they were added. Whoever holds
// them need not know the types. Copied by value.
class OptionGroups {
 public:
  // Adds a group with the defaults of its type, which has Visit(). Plug-ins may share a group:
  // where the type is there already, nothing changes.
  template <typename Options>
  void Add(const char* name) {
    if (Find<Options>() != nullptr) return;
    groups_.push_back({name, Options{}, [](std::any& o, OptionVisitor& v) {
                         std::any_cast<Options&>(o).Visit(v);
                       }});
  }

  // The group of a type; it must have been added.
  template <typename Options>
  const Options& Get() const {
    const Options* options = Find<Options>();
    assert(options != nullptr);
    return *options;
  }
  template <typename Options>
  Options& Get() {
    return const_cast<Options&>(std::as_const(*this).Get<Options>());
  }

  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const Group& group : groups_) names.push_back(group.name);
    return names;
  }

  void Visit(OptionVisitor& v) {
    for (Group& group : groups_) {
      v.Group(group.name, [&](OptionVisitor& g) { group.visit(group.options, g); });
    }
  }

 private:
  struct Group {
    std::string name;
    std::any options;
    void (*visit)(std::any&, OptionVisitor&);
  };

  template <typename Options>
  const Options* Find() const {
    for (const Group& group : groups_) {
      if (const Options* options = std::any_cast<Options>(&group.options)) return options;
    }
    return nullptr;
  }

  std::vector<Group> groups_;
};

}  // namespace ridgeline
