// SPDX-License-Identifier: Apache-2.0
// Scores written in Python: plug-ins like those of score_table.h.
#include <pybind11/stl.h>

#include <list>
#include <memory>

#include "base/error.h"
#include "batch.h"
#include "bindings.h"
#include "callback.h"
#include "own_parts.h"
#include "score/score_table.h"

namespace ridgeline::python {
namespace {

// What register_score() was given.
struct ScoreParts {
  py::object fn;
  py::object prepare;
  bool is_energy = false;
};

class OwnScore final : public Score {
 public:
  explicit OwnScore(const ScoreContext& context)
      : name_("score \"" + context.options.name + "\""),
        picture_(context.picture),
        scene_(context.scene),
        parts_(OwnPartsOf<ScoreParts>().Get(context.options.name)),
        prepared_(WithPython([&] {
          return Hold(CallPrepare(parts_->prepare, {&context.picture, &context.scene}));
        })) {}

  ViewParts parts() const override {
    return {.edges_and_skyline = true, .surfaces = false};
  }

  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override {
    double log_ratio = 0.0;
    LogRatios(view, {&cam_from_local, 1}, workspace, {&log_ratio, 1});
    return log_ratio;
  }

  void LogRatios(const PositionView& view,
                 std::span<const Pose> poses,
                 Workspace& /*workspace*/,
                 std::span<double> log_ratios) const override {
    if (poses.empty()) return;
    WithPython([&] {
      CallWithBatch(
          parts_->fn, {&picture_, &scene_, &view, poses, *prepared_}, name_, log_ratios);
      if (!parts_->is_energy) return;
      for (double& value : log_ratios) {
        if (!(value >= 0.0 && value <= 1.0)) {
          throw InputError("", name_, std::to_string(value), "energies in [0, 1]");
        }
        value = LogRatioOf(value);
      }
    });
  }

 private:
  std::string name_;
  const PictureEvidence& picture_;
  const Scene& scene_;
  std::shared_ptr<const ScoreParts> parts_;
  Held prepared_;
};

// A plug-in of the table and its name.
struct OwnScorePlugin {
  std::string name;
  ScorePlugin plugin{};
};

std::string Register(py::object fn,
                     const std::string& given_name,
                     py::object prepare,
                     const std::string& returns) {
  const std::string name = NameOf(fn, given_name);
  RequireName("score", name);
  RequireCallable("score", fn);
  if (!prepare.is_none()) RequireCallable("prepare", prepare);
  if (returns != "log_ratio" && returns != "energy") {
    throw InputError("", "returns", "\"" + returns + "\"", "\"log_ratio\" or \"energy\"");
  }
  auto& parts = OwnPartsOf<ScoreParts>();
  if (!parts.Has(name)) {
    static auto* plugins = new std::list<OwnScorePlugin>;
    OwnScorePlugin& added = plugins->emplace_back();
    added.name = name;
    added.plugin = {.name = added.name.c_str(),
                    .declare = [](OptionGroups&) {},
                    .make = [](const ScoreContext& context) -> std::unique_ptr<Score> {
                      return std::make_unique<OwnScore>(context);
                    }};
    try {
      AddScore(added.plugin);
    } catch (...) {
      plugins->pop_back();
      throw;
    }
  }
  parts.Set(name, ScoreParts{std::move(fn), std::move(prepare), returns == "energy"});
  return name;
}

}  // namespace

void BindOwnScores(py::module_& module) {
  BindBatch(module);
  module.def("register_score", &Register, py::arg("fn"), py::kw_only(), py::arg("name") = "",
             py::arg("prepare") = py::none(), py::arg("returns") = "log_ratio", R"(Makes a function a score, like those of scores().

localize, bench, study and Picture.score use it under its name ("score.name"). It is called with
batches: the poses of one place. Calls come from several threads, one at a time.

Args:
    fn: fn(batch) -> (len(batch),) float64; batch is a Batch.
    name: None: the function's own.
    prepare: prepare(picture) -> anything, called once for each picture with a PictureView; what it
        returns is batch.prepared.
    returns: "log_ratio" (higher is better; -inf: nothing of the model in view) or "energy" ([0, 1],
        0 best).
Returns:
    The name. A name registered again stands for the new function.
Raises:
    InputError: a built-in score's name, no function.)");
}

}  // namespace ridgeline::python
