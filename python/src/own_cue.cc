// SPDX-License-Identifier: Apache-2.0
// Cues of "evidence" written in Python: plug-ins like those of cue_table.h.
#include <list>
#include <vector>

#include "base/error.h"
#include "batch.h"
#include "bindings.h"
#include "callback.h"
#include "own_parts.h"
#include "score/cue_table.h"

namespace ridgeline::python {
namespace {

// What register_cue() was given.
struct CueParts {
  py::object fn;
  py::object prepare;
};

struct OwnCuePlugin : CuePlugin {
  std::string name;
  CueName entry{};
};

class OwnCue final : public Cue {
 public:
  explicit OwnCue(const CueContext& context)
      : picture_(context.picture), scene_(context.scene) {
    const std::string& name = static_cast<const OwnCuePlugin*>(context.plugin)->name;
    name_ = "cue \"" + name + "\"";
    parts_ = OwnPartsOf<CueParts>().Get(name);
    prepared_ = WithPython(
        [&] { return Hold(CallPrepare(parts_->prepare, {&context.picture, &context.scene})); });
  }

  bool TakesMany() const override { return true; }

  void LogRatiosOfMany(const PositionView& view,
                       std::span<const Pose> poses,
                       std::span<float> log_ratios) const override {
    std::vector<double> values(poses.size());
    WithPython([&] {
      CallWithBatch(parts_->fn, {&picture_, &scene_, &view, poses, *prepared_}, name_, values);
    });
    for (std::size_t i = 0; i < values.size(); ++i) log_ratios[i] = static_cast<float>(values[i]);
  }

  // Never asked for one: it takes many.
  void LogRatios(const CuePose& /*pose*/, Workspace*, std::span<float> log_ratios) const override {
    log_ratios[0] = 0.0f;
  }

 private:
  std::string name_;
  const PictureEvidence& picture_;
  const Scene& scene_;
  std::shared_ptr<const CueParts> parts_;
  Held prepared_;
};

std::string Register(py::object fn,
                     const std::string& given_name,
                     double weight,
                     py::object prepare) {
  const std::string name = NameOf(fn, given_name);
  RequireName("cue", name);
  RequireCallable("cue", fn);
  if (!prepare.is_none()) RequireCallable("prepare", prepare);
  if (!(weight >= 0.0)) {
    throw InputError("", "score.weights." + name, std::to_string(weight), "a number >= 0");
  }
  static auto* plugins = new std::list<OwnCuePlugin>;
  auto& parts = OwnPartsOf<CueParts>();
  if (!parts.Has(name)) {
    OwnCuePlugin& added = plugins->emplace_back();
    added.name = name;
    added.entry = {added.name.c_str(), weight};
    added.names = {&added.entry, 1};
    added.parts = {.edges_and_skyline = true, .surfaces = false};
    added.declare = [](OptionGroups&) {};
    added.make = [](const CueContext& context) -> std::shared_ptr<const Cue> {
      return std::make_shared<OwnCue>(context);
    };
    try {
      AddCue(added);
    } catch (...) {
      plugins->pop_back();
      throw;
    }
  }
  for (OwnCuePlugin& plugin : *plugins) {
    if (plugin.name == name) plugin.entry.weight = weight;
  }
  parts.Set(name, CueParts{std::move(fn), std::move(prepare)});
  return name;
}

}  // namespace

void BindOwnCues(py::module_& module) {
  module.def("register_cue", &Register, py::arg("fn"), py::kw_only(), py::arg("name") = "",
             py::arg("weight") = 1.0, py::arg("prepare") = py::none(),
             R"(Makes a function a cue of the score "evidence", like those of cues().

Options made from then on weigh it ("score.weights.NAME"). It is called with batches: the poses of
one place. Calls come from several threads, one at a time.

Args:
    fn: fn(batch) -> (len(batch),) float64 log likelihood ratios against chance, 0 says nothing.
    name: None: the function's own.
    weight: the default, >= 0.
    prepare: prepare(picture) -> anything, called once for each picture; batch.prepared.
Returns:
    The name. A name registered again stands for the new function.
Raises:
    InputError: the name of a built-in cue, no function.)");
}

}  // namespace ridgeline::python
