// SPDX-License-Identifier: Apache-2.0
// Samplers written in Python: plug-ins like those of sampler_table.h.
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <utility>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "callback.h"
#include "optim/sampler_table.h"
#include "own_parts.h"

namespace ridgeline::python {
namespace {

// What register_sampler() was given.
struct SamplerParts {
  py::object make;
};

const char* NameOf(TrialState state) {
  switch (state) {
    case TrialState::kAsked:
      return "asked";
    case TrialState::kComplete:
      return "complete";
    case TrialState::kInfeasible:
      return "infeasible";
    case TrialState::kFailed:
      return "failed";
  }
  return "";
}

py::array ArrayOfPoint(const UnitPoint& point) {
  return ArrayOf(point, {static_cast<py::ssize_t>(point.size())});
}

class OwnStrategy final : public Strategy {
 public:
  OwnStrategy(const std::string& name, const StrategyContext& context)
      : name_("sampler \"" + name + "\""), dimension_(context.dimension) {
    WithPython([&] {
      py::dict given;
      given["names"] = py::cast(context.names);
      given["periodic"] = py::cast(context.periodic);
      given["seed"] = context.seed;
      given["start"] = context.start.empty() ? py::object(py::none())
                                             : py::object(ArrayOfPoint(context.start));
      strategy_ = Hold(OwnPartsOf<SamplerParts>().Get(name)->make(**given));
      for (const char* method : {"propose", "observe"}) {
        if (!py::hasattr(*strategy_, method)) {
          throw InputError("", name_, "an object without " + std::string(method) + "()",
                           "propose(id) and observe(id, point, energy, state)");
        }
      }
    });
  }

  std::optional<UnitPoint> Propose(std::int64_t id) override {
    return WithPython([&]() -> std::optional<UnitPoint> {
      const py::object point = strategy_->attr("propose")(id);
      if (point.is_none()) return std::nullopt;
      const auto array =
          DoublesOf(point, name_ + " point", {static_cast<py::ssize_t>(dimension_)});
      UnitPoint unit(array.data(), array.data() + array.size());
      for (const double u : unit) {
        if (!(u >= 0.0 && u <= 1.0)) {
          throw InputError("", name_ + " point", std::to_string(u), "numbers in [0, 1]");
        }
      }
      return unit;
    });
  }

  void Reject(std::int64_t id) override {
    WithPython([&] {
      if (py::hasattr(*strategy_, "reject")) strategy_->attr("reject")(id);
    });
  }

  void Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) override {
    WithPython([&] { strategy_->attr("observe")(id, ArrayOfPoint(point), energy, NameOf(state)); });
  }

  bool Ended() const override {
    return WithPython([&] {
      return py::hasattr(*strategy_, "ended") && strategy_->attr("ended")().cast<bool>();
    });
  }

 private:
  std::string name_;
  std::size_t dimension_;
  Held strategy_;
};

// A plug-in's functions are told no name: each has its own place among these, whose function it is.
constexpr std::size_t kMostSamplers = 32;

struct OwnSamplerPlugin {
  std::string name;
  SamplerPlugin plugin{};
};

std::array<OwnSamplerPlugin, kMostSamplers>& Places() {
  static auto* places = new std::array<OwnSamplerPlugin, kMostSamplers>;
  return *places;
}

template <std::size_t kPlace>
std::unique_ptr<Strategy> MakeAt(const StrategyContext& context, const OptionGroups& /*options*/) {
  return std::make_unique<OwnStrategy>(Places()[kPlace].name, context);
}

using MakeFunction = std::unique_ptr<Strategy> (*)(const StrategyContext&, const OptionGroups&);

template <std::size_t... kPlaces>
constexpr std::array<MakeFunction, kMostSamplers> MakersOf(std::index_sequence<kPlaces...>) {
  return {&MakeAt<kPlaces>...};
}

std::string Register(py::object make, const std::string& given_name) {
  const std::string name = python::NameOf(make, given_name);
  RequireName("sampler", name);
  RequireCallable("sampler", make);
  auto& parts = OwnPartsOf<SamplerParts>();
  if (!parts.Has(name)) {
    static std::size_t count = 0;
    if (count == kMostSamplers) {
      throw InputError("", "sampler", std::to_string(count + 1) + " own samplers", "at most 32");
    }
    static constexpr auto kMakers = MakersOf(std::make_index_sequence<kMostSamplers>());
    OwnSamplerPlugin& added = Places()[count];
    added.name = name;
    added.plugin = {.name = added.name.c_str(),
                    .declare = [](OptionGroups&) {},
                    .begins_at_start = false,
                    .make = kMakers[count]};
    AddSampler(added.plugin);
    ++count;
  }
  parts.Set(name, SamplerParts{std::move(make)});
  return name;
}

}  // namespace

void BindOwnSamplers(py::module_& module) {
  module.def("register_sampler", &Register, py::arg("make"), py::kw_only(), py::arg("name") = "",
             R"(Makes a class a sampler, like those of samplers().

Sampler and localizations with {"search.method": "sampler", "search.sampler.name": NAME} use it.

Args:
    make: make(names, periodic, seed, start) -> an object with
        propose(id) -> (len(names),) numbers in [0, 1], or None: it waits for results;
        observe(id, point, energy, state): a result; energy is inf for "infeasible" and nan for
        "failed" points, state is "complete" for all others;
        reject(id), optional: the last proposal is not admissible, another one is asked for;
        ended() -> bool, optional: no proposals will come any more.
    name: None: the class's own.
Returns:
    The name. A name registered again stands for the new class.)");
}

}  // namespace ridgeline::python
