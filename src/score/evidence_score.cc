// SPDX-License-Identifier: Apache-2.0
#include "score/evidence_score.h"

#include <algorithm>
#include <limits>

#include "score/edge_fit.h"
#include "score/score_plugin.h"

namespace ridgeline {

struct EvidenceScore::Memory final : Score::Workspace {
  std::vector<std::unique_ptr<Cue::Workspace>> cues;  // by part
  std::vector<float> values;
  // Of the cues that take many poses at once: by part, the values of the poses asked for.
  std::vector<std::vector<float>> many;
  std::size_t pose = 0;  // whose values in `many` are meant
};

EvidenceScore::EvidenceScore(const CueContext& context,
                             const std::map<std::string, double>& weights)
    : picture_(context.picture),
      scene_(context.scene),
      lines_(context.options.Get<LineLikelihoodOptions>()) {
  for (const char* name : kEdgeKindNames) {
    const auto it = weights.find(name);
    edge_weights_.push_back(it == weights.end() ? 0.0 : it->second);
  }
  for (const CuePlugin* plugin : CueTable()) {
    std::vector<double> of_plugin;
    for (const CueName& cue : plugin->names) {
      const auto it = weights.find(cue.name);
      of_plugin.push_back(it == weights.end() ? 0.0 : it->second);
    }
    const auto counts = [](double weight) { return weight > 0.0; };
    if (std::none_of(of_plugin.begin(), of_plugin.end(), counts)) continue;
    CueContext of_cue = context;
    of_cue.plugin = plugin;
    parts_.push_back({plugin, plugin->make(of_cue), weights_.size()});
    weights_.insert(weights_.end(), of_plugin.begin(), of_plugin.end());
  }
}

ViewParts EvidenceScore::parts() const {
  // Whether anything of the model is in view is told by the edges.
  ViewParts parts{.edges_and_skyline = true, .surfaces = false};
  for (const Part& part : parts_) parts.surfaces = parts.surfaces || part.plugin->parts.surfaces;
  return parts;
}

const char* EvidenceScore::unusable() const {
  return picture_.is_blank() ? "the picture has no lines and one colour" : "";
}

std::unique_ptr<Score::Workspace> EvidenceScore::NewWorkspace() const {
  auto memory = std::make_unique<Memory>();
  for (const Part& part : parts_) memory->cues.push_back(part.cue->NewWorkspace());
  memory->values.resize(weights_.size());
  memory->many.resize(parts_.size());
  return memory;
}

std::unique_ptr<Score> EvidenceScore::With(
    const std::function<std::shared_ptr<const Cue>(const Cue&)>& change) const {
  std::unique_ptr<EvidenceScore> other(new EvidenceScore(*this));
  for (Part& part : other->parts_) {
    if (std::shared_ptr<const Cue> cue = change(*part.cue)) part.cue = std::move(cue);
  }
  return other;
}

std::unique_ptr<Score> EvidenceScore::Tolerant(double factor) const {
  return With([&](const Cue& cue) { return cue.Tolerant(factor); });
}

std::unique_ptr<Score> EvidenceScore::ForTilts(
    std::span<const Eigen::Matrix3f> cam_from_level) const {
  return With([&](const Cue& cue) { return cue.ForTilts(cam_from_level); });
}

std::vector<std::string> EvidenceScore::cue_names() const {
  std::vector<std::string> names;
  for (const Part& part : parts_) {
    for (const CueName& cue : part.plugin->names) names.emplace_back(cue.name);
  }
  return names;
}

std::span<const float> EvidenceScore::Cues(const PositionView& view,
                                           const Pose& cam_from_local,
                                           Score::Workspace& workspace) const {
  auto& memory = static_cast<Memory&>(workspace);
  AskForMany(view, {&cam_from_local, 1}, memory);
  ProjectPieces(view.visible, picture_.camera(), cam_from_local, memory.segments);
  ReadPose(cam_from_local, view, memory);
  return memory.values;
}

void EvidenceScore::CuesOfMany(const PositionView& view,
                               std::span<const Pose> poses,
                               Score::Workspace& workspace,
                               std::span<float> rows) const {
  auto& memory = static_cast<Memory&>(workspace);
  AskForMany(view, poses, memory);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    memory.pose = i;
    ProjectPieces(view.visible, picture_.camera(), poses[i], memory.segments);
    ReadPose(poses[i], view, memory);
    std::copy(memory.values.begin(), memory.values.end(), rows.begin() + i * weights_.size());
  }
}

void EvidenceScore::AskForMany(const PositionView& view,
                               std::span<const Pose> poses,
                               Memory& memory) const {
  memory.pose = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!parts_[i].cue->TakesMany()) continue;
    memory.many[i].resize(poses.size() * parts_[i].plugin->names.size());
    parts_[i].cue->LogRatiosOfMany(view, poses, memory.many[i]);
  }
}

void EvidenceScore::ReadPose(const Pose& cam_from_local,
                             const PositionView& view,
                             Memory& memory) const {
  const CuePose pose{
      view, cam_from_local.cam_from_world.toRotationMatrix().cast<float>(), memory.segments};
  const std::span<float> values(memory.values);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    const std::size_t count = part.plugin->names.size();
    const std::span<float> of_part = values.subspan(part.first, count);
    if (part.cue->TakesMany()) {
      std::copy_n(memory.many[i].begin() + memory.pose * count, count, of_part.begin());
    } else {
      part.cue->LogRatios(pose, memory.cues[i].get(), of_part);
    }
  }
}

double EvidenceScore::LogRatio(const PositionView& view,
                               const Pose& cam_from_local,
                               Score::Workspace& workspace) const {
  double log_ratio = 0.0;
  LogRatios(view, {&cam_from_local, 1}, workspace, {&log_ratio, 1});
  return log_ratio;
}

void EvidenceScore::LogRatios(const PositionView& view,
                              std::span<const Pose> poses,
                              Score::Workspace& workspace,
                              std::span<double> log_ratios) const {
  auto& memory = static_cast<Memory&>(workspace);
  if (!picture_.is_blank()) AskForMany(view, poses, memory);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    memory.pose = i;
    log_ratios[i] = LogRatioOfOne(view, poses[i], memory);
  }
}

double EvidenceScore::LogRatioOfOne(const PositionView& view,
                                    const Pose& cam_from_local,
                                    Memory& memory) const {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  if (picture_.is_blank()) return kNothing;
  ProjectPieces(view.visible, picture_.camera(), cam_from_local, memory.segments);
  if (memory.segments.empty()) return kNothing;
  ReadPose(cam_from_local, view, memory);
  double sum = 0.0;
  for (std::size_t k = 0; k < weights_.size(); ++k) sum += weights_[k] * memory.values[k];
  return sum;
}

std::vector<BuildingFit> EvidenceScore::BuildingFits(const PositionView& view,
                                                     const Pose& cam_from_local,
                                                     Score::Workspace& workspace) const {
  ProjectPieces(view.visible, picture_.camera(), cam_from_local, workspace.segments);
  return EdgeFit(picture_.field(), picture_.camera(), lines_)
      .Of(workspace.segments, view.visible, view.kinds, edge_weights_, scene_, cam_from_local);
}

extern const ScorePlugin kEvidenceScore;
constinit const ScorePlugin kEvidenceScore = {
    .name = "evidence",
    .declare = [](OptionGroups&) {},  // those of the cues
    .make = [](const ScoreContext& c) -> std::unique_ptr<Score> {
      const CueContext context{c.picture, c.scene, c.options.evidence.cues};
      return std::make_unique<EvidenceScore>(context, c.options.weights);
    }};

}  // namespace ridgeline
