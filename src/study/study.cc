// SPDX-License-Identifier: Apache-2.0
#include "study/study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "camera/local_frame.h"
#include "eval/bench.h"
#include "localize/pose_scorer.h"
#include "localize/sampled_search.h"
#include "localize/search_poses.h"
#include "score/picture_evidence.h"
#include "score/score_table.h"
#include "study/study_json.h"

namespace ridgeline {
namespace {

// A query ready to be compared: picture, prior and the box around it.
class QueryStudy {
 public:
  QueryStudy(const Query& query,
             const LocalizationInput& input,
             const PoseSpaceOptions& ranges,
             const Localizer& localizer,
             const StudyOptions& options)
      : localizer_(localizer),
        options_(options),
        truth_(LocalFrame{localizer.scene().model().origin_in_world}.FromWorld(*query.truth)),
        prior_(input.prior),
        evidence_(UndistortImage(BgrOf(input.picture), input.camera),
                  input.camera.Pinhole(),
                  localizer.options().lines,
                  localizer.options().score.evidence,
                  options.threads,
                  input.lines),
        space_(input.prior, ranges, localizer.scene(), localizer.dtm(), localizer.footprints()) {}

  // The map and its figures.
  ScoreStudy Map(const ScoreChoice& choice) const {
    const auto start = std::chrono::steady_clock::now();
    const MapOptions& map = localizer_.options().search.map;
    const std::unique_ptr<Score> score = Make(choice);
    const ScoredMap scored =
        WithErrors(MapPoses(ScorerOf(*score), evidence_, map, options_.threads), space_, truth_);
    ScoreStudy study;
    study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    study.prior = prior_;
    study.ranges = space_.ranges();
    study.picture_lines = static_cast<int>(evidence_.segments().size());
    study.visible_edges = VisibleEdgesAtTruth();
    study.figures = ReliabilityOf(scored);
    if (!study.figures) {
      study.reason = score->unusable();
      if (study.reason.empty()) study.reason = "no admissible pose of the map sees the model";
    } else {
      const auto best =
          space_.PoseAt(scored.volume.OffsetOf(study.figures->minimum, space_.center_angles()));
      study.minimum = {best->cam_from_world,
                       best->center_in_world + localizer_.scene().model().origin_in_world};
    }
    const std::vector<char> home = ComesHome(scored);
    study.by_distance = ByDistance(scored, home);
    study.by_angle = ByAngle(scored, home);
    study.map = MapOf(scored.volume, space_, localizer_.scene().model());
    for (std::size_t p = 0; p < scored.positions(); ++p) {
      float& energy = study.map.energies[p % study.map.energies.size()];
      if (scored.admissible[p] && std::isnan(energy)) energy = 1.0f;  // nothing in view
    }
    AddHeadings(scored.volume, study);
    return study;
  }

  void AddSampled(const ScoreChoice& choice, ScoreStudy& study) const {
    SearchOptions search = localizer_.options().search;
    search.sampler.name = "tpe";
    search.evaluations = options_.classes.back();
    const std::unique_ptr<Score> score = Make(choice);
    const SampledSearch sampled =
        SampleSearch(ScorerOf(*score), search, options_.seed, options_.threads);
    for (const Trial& trial : sampled.trace.trials) {
      if (trial.state != TrialState::kComplete) continue;
      const std::vector<double>& v = trial.values;
      const auto pose = space_.PoseAt({v[0], v[1], v[2], v[3], v[4], v[5]});
      if (!pose) continue;
      const PoseError error = ErrorOf(*pose, truth_);
      SampledPose point;
      point.evaluation = static_cast<int>(trial.index) + 1;
      point.after =
          *std::lower_bound(options_.classes.begin(), options_.classes.end() - 1, point.evaluation);
      point.energy = trial.energy;
      point.translation_m = error.translation_m;
      point.horizontal_m = error.horizontal_m;
      point.rotation_deg = error.rotation_deg;
      study.sampled.push_back(point);
    }
  }

  void AddExplored(const ScoreChoice& choice, ScoreStudy& study) const {
    ExploreOptions explore;
    explore.heading_step_deg = localizer_.options().search.map.heading_step_deg;
    const std::unique_ptr<Score> score = Make(choice);
    study.explored = Explore(ScorerOf(*score), explore, options_.threads);
  }

 private:
  std::unique_ptr<Score> Make(const ScoreChoice& choice) const {
    return MakeScore({evidence_, localizer_.scene(), choice.options});
  }

  PoseScorer ScorerOf(const Score& score) const {
    return {score,
            localizer_.scene(),
            space_,
            evidence_.camera(),
            localizer_.options().score.evidence.surface_step_deg};
  }

  int VisibleEdgesAtTruth() const {
    const double step_rad =
        localizer_.options().score.evidence.surface_step_deg * std::numbers::pi / 180.0;
    const PanoramaRange range =
        RangeOf(evidence_.camera(), ViewAnglesOf(truth_.cam_from_world), {}, step_rad);
    const VisibleSet visible = localizer_.scene().VisibleFrom(truth_.center_in_world, range.sector);
    std::vector<ProjectedSegment> segments;
    ProjectPieces(visible, evidence_.camera(), truth_, segments);
    return static_cast<int>(segments.size());
  }

  void AddHeadings(const PoseVolume& volume, ScoreStudy& study) const {
    std::vector<double> best(volume.heading_deg.size(), -INFINITY);
    for (std::size_t i = 0; i < volume.log_ratios.size(); ++i) {
      double& value = best[i % volume.orientations() / volume.tilts.size()];
      value = std::max(value, static_cast<double>(volume.log_ratios[i]));
    }
    for (std::size_t h = 0; h < best.size(); ++h) {
      const PoseSpace::Offset offset{0.0, 0.0, 0.0, volume.heading_deg[h], 0.0, 0.0};
      study.heading_deg.push_back(space_.AnglesAt(offset).heading_deg);
      study.heading_energy.push_back(Score::EnergyOf(best[h]));
    }
  }

  const Localizer& localizer_;
  const StudyOptions& options_;
  Pose truth_;  // local frame
  PosePrior prior_;
  PictureEvidence evidence_;
  PoseSpace space_;
};

LocalizationInput StudyInput(const Query& query,
                             const LocalizerOptions& localizer_options,
                             const SearchStart& start) {
  PictureReader pictures;
  LocalizationInput input = InputOf(query, localizer_options, pictures);
  if (input.picture.cols != input.camera.width || input.picture.rows != input.camera.height) {
    throw InputError(
        query.image.string(),
        "",
        std::to_string(input.picture.cols) + " x " + std::to_string(input.picture.rows) + " px",
        "the camera's " + std::to_string(input.camera.width) + " x " +
            std::to_string(input.camera.height) + " px");
  }
  input.prior = start.prior;
  return input;
}

// The list of maps of a study, one after the other: those of the shard, found where an earlier start
// kept them, else made and kept.
class Pieces {
 public:
  Pieces(std::string kind,
         std::size_t total,
         const StudyOptions& options,
         const StudyProgressFunction& progress)
      : kind_(std::move(kind)), options_(options), progress_(progress) {
    for (std::size_t i = 0; i < total; ++i) total_ += options_.shard.Takes(i) ? 1 : 0;
  }

  // nullopt: another shard's.
  template <typename Make>
  std::optional<ScoreStudy> Next(const std::string& what, const Make& make) {
    const std::size_t index = next_++;
    if (!options_.shard.Takes(index)) return std::nullopt;
    const std::string name = kind_ + "_" + PieceName(index, what);
    std::optional<std::string> kept;
    if (options_.folder != nullptr) kept = options_.folder->Find(name);
    ScoreStudy study = kept ? ReadStudy(*kept, name) : make();
    if (!kept && options_.folder != nullptr) options_.folder->Keep(name, StudyText(study));
    if (progress_) progress_({++done_, total_});
    return study;
  }

 private:
  std::string kind_;
  const StudyOptions& options_;
  const StudyProgressFunction& progress_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
};

bool ChangesModel(const Variation& variation) {
  return variation.name == "edges" || variation.name == "heights" || variation.name == "footprints";
}

}  // namespace

void StudyOptions::Validate() const {
  const auto is_rising = [&] {
    for (std::size_t i = 1; i < classes.size(); ++i) {
      if (classes[i] <= classes[i - 1]) return false;
    }
    return !classes.empty() && classes.front() > 0;
  };
  if (!is_rising())
    throw InputError("--classes", "", "numbers that do not rise", "e.g. 50,100,200");
}

std::vector<std::size_t> StudyQueries(const Dataset& dataset,
                                      const std::vector<std::string>& ids,
                                      const std::vector<std::string>& sets) {
  std::vector<std::size_t> queries;
  std::vector<std::string> known;
  for (std::size_t q = 0; q < dataset.queries.size(); ++q) {
    known.push_back(dataset.queries[q].id);
    if (ids.empty() && dataset.queries[q].truth) queries.push_back(q);
  }
  for (const std::string& id : ids) {
    const auto it = std::find(known.begin(), known.end(), id);
    if (it == known.end()) {
      throw InputError(
          "--query",
          "",
          "\"" + id + "\"",
          "a query of " + dataset.file.string() + ", e.g. \"" + NearestName(id, known) + "\"");
    }
    const auto q = static_cast<std::size_t>(it - known.begin());
    if (!dataset.queries[q].truth) {
      throw InputError(dataset.file.string(),
                       "queries[" + std::to_string(q) + "].truth",
                       "none",
                       "the truth of \"" + id + "\": a study compares a score with it");
    }
    queries.push_back(q);
  }
  if (!sets.empty()) {
    const std::vector<std::size_t> chosen = ChooseQueries(dataset, {}, sets);
    std::erase_if(queries, [&](std::size_t q) {
      return std::find(chosen.begin(), chosen.end(), q) == chosen.end();
    });
  }
  if (queries.empty()) {
    throw InputError(dataset.file.string(),
                     "queries",
                     "no query with a truth",
                     "truths: a study compares a score with them");
  }
  return queries;
}

std::vector<ScoreStudy> RunStudy(const BenchQueries& source,
                                 std::span<const std::size_t> queries,
                                 const Localizer& localizer,
                                 std::span<const ScoreChoice> scores,
                                 const StudyOptions& options,
                                 const StudyProgressFunction& progress) {
  Pieces pieces("map", queries.size() * scores.size(), options, progress);
  std::vector<ScoreStudy> studies;
  for (const std::size_t q : queries) {
    const Query& query = source.dataset().queries[q];
    std::optional<QueryStudy> of_query;  // only where a map is to be made
    const auto make = [&](std::size_t s) {
      if (!of_query) {
        const SearchStart start = source.Start(q, options.seed, localizer);
        of_query.emplace(
            query, StudyInput(query, localizer.options(), start), start.ranges, localizer, options);
      }
      ScoreStudy study = of_query->Map(scores[s]);
      of_query->AddSampled(scores[s], study);
      if (options.explore) of_query->AddExplored(scores[s], study);
      return study;
    };
    for (std::size_t s = 0; s < scores.size(); ++s) {
      std::optional<ScoreStudy> study =
          pieces.Next(query.id + "_" + scores[s].name, [&] { return make(s); });
      if (!study) continue;
      study->query = q;
      study->score = s;
      study->set = query.set;
      studies.push_back(std::move(*study));
    }
  }
  return studies;
}

namespace {

// The model and the localizer of one level of a variation, made where they are first needed.
class VariedWorld {
 public:
  VariedWorld(const Localizer& localizer,
              const Variation& variation,
              const std::string& level,
              std::uint64_t seed)
      : localizer_(localizer),
        variation_(variation),
        level_(level),
        seed_(seed),
        options_(VariedOptions(localizer.options(), variation, level)) {}

  const LocalizerOptions& options() const { return options_; }

  const Localizer& Get() {
    if (varied_) return *varied_;
    const CityModel& model = localizer_.scene().model();
    if (ChangesModel(variation_)) changed_ = VariedModel(model, variation_, level_, seed_);
    std::optional<HeightGrid> dtm;
    if (localizer_.dtm() != nullptr) dtm = *localizer_.dtm();
    varied_.emplace(changed_ ? *changed_ : model, std::move(dtm), options_);
    return *varied_;
  }

 private:
  const Localizer& localizer_;
  const Variation& variation_;
  const std::string& level_;
  std::uint64_t seed_;
  LocalizerOptions options_;
  std::optional<CityModel> changed_;
  std::optional<Localizer> varied_;
};

}  // namespace

std::vector<VariedStudy> RunVariations(const BenchQueries& source,
                                       std::span<const std::size_t> queries,
                                       const Localizer& localizer,
                                       std::span<const ScoreChoice> scores,
                                       std::span<const Variation> variations,
                                       const StudyOptions& options,
                                       const StudyProgressFunction& progress) {
  std::size_t levels = 0;
  for (const Variation& variation : variations) levels += variation.levels.size();
  Pieces pieces("varied", levels * queries.size() * scores.size(), options, progress);
  std::vector<VariedStudy> studies;
  for (std::size_t v = 0; v < variations.size(); ++v) {
    const Variation& variation = variations[v];
    for (std::size_t l = 0; l < variation.levels.size(); ++l) {
      const std::string& level = variation.levels[l];
      VariedWorld world(localizer, variation, level, options.seed);
      for (const std::size_t q : queries) {
        const Query& query = source.dataset().queries[q];
        std::optional<QueryStudy> of_query;
        const auto make = [&](std::size_t s) {
          if (!of_query) {
            const SearchStart start = source.Start(q, options.seed, localizer);
            LocalizationInput input = StudyInput(query, world.options(), start);
            input.picture = VariedPicture(input.picture, variation, level, options.seed, query.id);
            input.camera = VariedCamera(input.camera, variation, level);
            of_query.emplace(query, input, start.ranges, world.Get(), options);
          }
          ScoreChoice choice = scores[s];
          choice.options.evidence = world.options().score.evidence;
          ScoreStudy study = of_query->Map(choice);
          study.map = {};
          return study;
        };
        for (std::size_t s = 0; s < scores.size(); ++s) {
          std::optional<ScoreStudy> study =
              pieces.Next(variation.name + "_" + level + "_" + query.id + "_" + scores[s].name,
                          [&] { return make(s); });
          if (!study) continue;
          study->query = q;
          study->score = s;
          study->set = query.set;
          studies.push_back({v, l, std::move(*study)});
        }
      }
    }
  }
  return studies;
}

}  // namespace ridgeline
