// SPDX-License-Identifier: Apache-2.0
// Studies of scores: what `ridgeline study` does.
#include "study/study.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "callback.h"
#include "input/picture_input.h"
#include "localization.h"
#include "long_call.h"
#include "options.h"
#include "study/study_files.h"
#include "study/study_summary.h"
#include "world.h"

namespace ridgeline::python {
namespace {

// Every score on every query, with what they are about.
struct StudyResult {
  Dataset dataset;
  Protocol protocol;
  std::vector<ScoreChoice> scores;
  std::vector<ScoreStudy> studies;
};

struct StudyRequest {
  std::filesystem::path dataset;
  std::vector<std::string> scores;
  std::vector<std::string> queries;
  std::string protocol;
  std::string perturb;
};

Protocol ProtocolOf(const StudyRequest& request) {
  if (!request.perturb.empty()) return PerturbedProtocol(request.perturb);
  const Protocol& protocol =
      FindProtocol(request.protocol.empty() ? "known-tilt" : request.protocol);
  if (protocol.HasRecall()) return protocol;
  throw InputError("--protocol",
                   "",
                   "\"" + protocol.name + "\"",
                   "one whose box holds the truth, since a study compares scores with it");
}

std::shared_ptr<StudyResult> Run(const StudyRequest& request,
                                 const LocalizerOptions& options,
                                 const StudyOptions& study,
                                 const StudyProgressFunction& progress) {
  auto result = std::make_shared<StudyResult>();
  result->scores = ChooseScores(request.scores, options.score);
  const Protocol protocol = ProtocolOf(request);
  Dataset dataset = ReadDataset(request.dataset);
  if (protocol.place != PriorPlace::kPicture) {
    CompleteFromPictures(dataset, false, PictureInputOptions{});  // priors are drawn
  }
  const BenchQueries source(protocol, std::move(dataset), options.search.space);
  result->dataset = source.dataset();
  result->protocol = source.protocol();
  const std::vector<std::size_t> queries = StudyQueries(result->dataset, request.queries);
  WorldRequest world_request = RequestFor(result->dataset, 50.0);
  world_request.needs_terrain = world_request.needs_terrain || source.NeedsTerrain();
  const World world = ReadWorld(world_request);
  const Localizer localizer(world.model, world.dtm, options);
  result->studies = RunStudy(source, queries, localizer, result->scores, study, progress);
  return result;
}

py::object FiguresOf(const ScoreStudy& study) {
  if (!study.figures) return py::none();
  py::dict figures;
  for (const FigureText& figure : kFigureTexts) figures[figure.key] = figure.of(*study.figures);
  return figures;
}

py::dict SampledOf(const ScoreStudy& study) {
  const auto count = static_cast<py::ssize_t>(study.sampled.size());
  std::vector<std::int64_t> evaluations;
  std::vector<double> energies, metres, degrees;
  for (const SampledPose& pose : study.sampled) {
    evaluations.push_back(pose.evaluation);
    energies.push_back(pose.energy);
    metres.push_back(pose.translation_m);
    degrees.push_back(pose.rotation_deg);
  }
  py::dict arrays;
  arrays["evaluation"] = ArrayOf(std::move(evaluations), {count});
  arrays["energy"] = ArrayOf(std::move(energies), {count});
  arrays["error_m"] = ArrayOf(std::move(metres), {count});
  arrays["error_deg"] = ArrayOf(std::move(degrees), {count});
  return arrays;
}

py::dict Item(const StudyResult& result, py::ssize_t index) {
  const auto size = static_cast<py::ssize_t>(result.studies.size());
  if (index < 0) index += size;
  if (index < 0 || index >= size) throw py::index_error();
  const ScoreStudy& study = result.studies[static_cast<std::size_t>(index)];
  py::dict item;
  item["query"] = result.dataset.queries[study.query].id;
  item["score"] = result.scores[study.score].name;
  item["set"] = study.set;
  item["prior"] = study.prior;
  item["truth"] = *result.dataset.queries[study.query].truth;
  item["figures"] = FiguresOf(study);
  item["reason"] = study.reason;
  item["map"] = SharedMap{std::make_shared<EnergyMap>(study.map)};
  item["sampled"] = SampledOf(study);
  item["visible_edges"] = study.visible_edges;
  item["picture_lines"] = study.picture_lines;
  item["seconds"] = study.seconds;
  return item;
}

std::string Json(const StudyResult& result) {
  return StudySummaryJson(result.dataset.name,
                          result.protocol,
                          SummariesOf(result.studies, result.scores, result.dataset.name));
}

std::shared_ptr<StudyResult> Study(py::handle dataset,
                                   const std::vector<std::string>& scores,
                                   const std::vector<std::string>& queries,
                                   const std::string& protocol,
                                   const std::string& perturb,
                                   py::handle options,
                                   std::uint64_t seed,
                                   const std::vector<int>& classes,
                                   int threads,
                                   const py::object& progress) {
  const StudyRequest request{PathOf(dataset), scores, queries, protocol, perturb};
  const LocalizerOptions settings = OptionsOf(options);
  StudyOptions study;
  study.seed = seed;
  study.classes = classes;
  study.threads = threads;
  study.Validate();
  StudyProgressFunction show;
  if (!progress.is_none()) {
    show = [&progress](const StudyProgress& p) {
      WithPython([&] { progress(p.done, p.total); });
    };
  }
  const LongCall call;
  return Run(request, settings, study, show);
}

}  // namespace

void BindStudy(py::module_& module) {
  py::class_<StudyResult, std::shared_ptr<StudyResult>>(
      module, "StudyResult", "A dict for every query and score, by query, then score.")
      .def("__len__", [](const StudyResult& r) { return r.studies.size(); })
      .def("__getitem__", &Item, py::arg("index"), R"(One score on one query, a dict.

query, score, set (str), prior, truth (Pose), figures (a dict, or None and `reason`), map
(EnergyMap), sampled (dict of arrays of a TPE search: evaluation, energy, error_m, error_deg),
visible_edges, picture_lines, seconds.)")
      .def("json", &Json, "The summary that `ridgeline study --json` prints.")
      .def("summary", [](const StudyResult& r) { return FromJson(Json(r)); }, "The same as a dict.");
  module.def("study", &Study, py::arg("dataset"), py::arg("scores") = std::vector<std::string>{},
             py::kw_only(), py::arg("queries") = std::vector<std::string>{},
             py::arg("protocol") = "", py::arg("perturb") = "", py::arg("options") = py::none(),
             py::arg("seed") = 1, py::arg("classes") = std::vector<int>{50, 100, 200},
             py::arg("threads") = 0, py::arg("progress") = py::none(),
             R"(How far scores can be trusted: dense maps around drawn priors, as `ridgeline study`.

Args:
    dataset: path of a dataset.json with truths.
    scores: names of scores or of cues of "evidence", own ones too, or "all".
    queries: ids; empty: all with a truth.
    protocol: paper, known-tilt (default), phone or photo; or perturb: half-ranges in numbers.
    classes: evaluations of a TPE search after which score and error are compared.
    progress: called with (done, total) after each map.
Returns:
    StudyResult.)");
}

}  // namespace ridgeline::python
