// SPDX-License-Identifier: Apache-2.0
// Benchmarks of datasets: what `ridgeline bench` does.
#include "eval/bench.h"

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "callback.h"
#include "eval/bench_files.h"
#include "eval/bench_task.h"
#include "localization.h"
#include "long_call.h"
#include "options.h"
#include "world.h"

namespace ridgeline::python {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The runs of a benchmark and what they are about.
struct BenchResult {
  std::string dataset;
  std::string config;
  Protocol protocol;
  std::shared_ptr<const World> world;
  std::vector<RunRecord> records;
  std::vector<BenchRun> runs;
  std::vector<std::string> images;                    // by run
  std::vector<std::vector<Assumption>> assumptions;  // by run
};

BenchProgress ProgressOf(const py::object& progress) {
  if (progress.is_none()) return {};
  return [&progress](const BenchRun&, std::size_t done, std::size_t total) {
    WithPython([&] { progress(done, total); });
  };
}

std::shared_ptr<BenchResult> Run(const BenchRequest& request,
                                 const LocalizerOptions& options,
                                 const BenchOptions& bench,
                                 const BenchProgress& progress) {
  const BenchTask task = ReadBenchTask(request, options);
  auto result = std::make_shared<BenchResult>();
  result->world = std::make_shared<World>(ReadWorldOf(task));
  const Localizer localizer(result->world->model, result->world->dtm, options);
  result->runs = RunBench(task.queries, localizer, bench, progress);
  result->dataset = task.queries.dataset().name;
  result->protocol = task.queries.protocol();
  for (const BenchRun& run : result->runs) {
    const Query& query = task.queries.dataset().queries[run.query];
    result->records.push_back(run.record);
    result->images.push_back(query.image.string());
    result->assumptions.push_back(query.assumptions);
  }
  return result;
}

template <typename Of>
py::array Column(const BenchResult& result, const Of& of) {
  std::vector<double> values;
  for (const RunRecord& record : result.records) values.push_back(of(record));
  return ArrayOf(std::move(values), {static_cast<py::ssize_t>(result.records.size())});
}

template <typename Of>
py::object Texts(const BenchResult& result, const Of& of) {
  py::list values;
  for (const RunRecord& record : result.records) values.append(of(record));
  return py::module_::import("numpy").attr("array")(values, py::arg("dtype") = "U");
}

void AddPoses(const BenchResult& result, py::dict& arrays) {
  const char* centers[] = {"east", "north", "height"};
  for (int i = 0; i < 3; ++i) {
    arrays[centers[i]] = Column(result, [i](const RunRecord& r) {
      return r.pose ? r.pose->center_in_world[i] : kNan;
    });
  }
  const char* quaternion[] = {"qx", "qy", "qz", "qw"};
  for (int i = 0; i < 4; ++i) {
    arrays[quaternion[i]] = Column(result, [i](const RunRecord& r) {
      return r.pose ? r.pose->cam_from_world.coeffs()[i] : kNan;
    });
  }
}

void AddErrors(const BenchResult& result, py::dict& arrays) {
  const auto add = [&](const char* name, const char* candidate, auto part) {
    arrays[name] =
        Column(result, [part](const RunRecord& r) { return r.error ? part(*r.error) : kNan; });
    arrays[candidate] = Column(result, [part](const RunRecord& r) {
      return r.candidate_error ? part(*r.candidate_error) : kNan;
    });
  };
  add("error_m", "candidate_error_m", [](const PoseError& e) { return e.translation_m; });
  add("error_horizontal_m", "candidate_error_horizontal_m", [](const PoseError& e) {
    return e.horizontal_m;
  });
  add("error_deg", "candidate_error_deg", [](const PoseError& e) { return e.rotation_deg; });
}

py::dict Arrays(const BenchResult& result) {
  py::dict arrays;
  arrays["query"] = Texts(result, [](const RunRecord& r) { return r.query; });
  arrays["set"] = Texts(result, [](const RunRecord& r) { return r.set; });
  arrays["status"] = Texts(result, [](const RunRecord& r) { return r.status; });
  arrays["seed"] =
      Column(result, [](const RunRecord& r) { return double(r.seed); }).attr("astype")("i8");
  arrays["energy"] = Column(result, [](const RunRecord& r) { return r.energy; });
  arrays["confidence"] = Column(result, [](const RunRecord& r) { return r.confidence; });
  AddPoses(result, arrays);
  AddErrors(result, arrays);
  arrays["posterior_mass"] = Column(result, [](const RunRecord& r) { return r.posterior_mass; });
  arrays["explained"] = Column(result, [](const RunRecord& r) { return r.explained; });
  arrays["observed_nat"] = Column(result, [](const RunRecord& r) { return r.observed_nat; });
  arrays["information_nat"] = Column(result, [](const RunRecord& r) { return r.information_nat; });
  arrays["above_background_nat"] = Column(
      result, [](const RunRecord& r) { return r.above_background_nat.value_or(kNan); });
  arrays["evaluations"] =
      Column(result, [](const RunRecord& r) { return double(r.evaluations); }).attr("astype")("i8");
  arrays["seconds"] = Column(result, [](const RunRecord& r) { return r.seconds; });
  return arrays;
}

std::string Json(const BenchResult& result) {
  return SummaryJson(result.dataset, result.config, result.protocol, result.records);
}

FoundPose Item(const BenchResult& result, py::ssize_t index) {
  const auto size = static_cast<py::ssize_t>(result.runs.size());
  if (index < 0) index += size;
  if (index < 0 || index >= size) throw py::index_error();
  const auto i = static_cast<std::size_t>(index);
  return {result.world, result.images[i], result.assumptions[i], result.runs[i].localization};
}

std::shared_ptr<BenchResult> Bench(py::handle dataset,
                                   const std::string& protocol,
                                   const std::string& perturb,
                                   py::handle world,
                                   py::handle options,
                                   int seed,
                                   int seeds,
                                   int threads,
                                   const py::object& progress) {
  if (seeds < 1) throw InputError("", "seeds", std::to_string(seeds), ">= 1");
  if (!protocol.empty() && !perturb.empty()) {
    throw InputError("", "perturb", "a protocol beside it", "one of the two");
  }
  BenchRequest request{PathOf(dataset).string(), protocol, "", perturb};
  if (!world.is_none()) request.world = PathOf(world).string();
  const LocalizerOptions settings = OptionsOf(options);
  BenchOptions bench;
  bench.seeds.clear();
  for (int k = 0; k < seeds; ++k) bench.seeds.push_back(seed + k);
  bench.threads = threads;
  const BenchProgress show = ProgressOf(progress);
  const bool is_file = py::isinstance<py::str>(options) || py::hasattr(options, "__fspath__");
  const std::string config = is_file ? PathOf(options).string() : "default";
  const LongCall call;
  auto result = Run(request, settings, bench, show);
  result->config = config;
  return result;
}

}  // namespace

void BindBench(py::module_& module) {
  py::class_<BenchResult, std::shared_ptr<BenchResult>>(module, "BenchResult",
                                                        "The runs of a benchmark, in order.")
      .def("arrays", &Arrays, R"(A dict of arrays with a value for each run.

query, set, status (str); seed, evaluations (int64); energy, confidence, east, north, height [m],
qx, qy, qz, qw, error_m, error_horizontal_m, error_deg (NaN: no pose or no truth), candidate_error_m,
candidate_error_horizontal_m, candidate_error_deg (of the best pose, withheld or not),
posterior_mass, explained, observed_nat, information_nat, above_background_nat, seconds (float64).)")
      .def("json", &Json, "summary.json, which `ridgeline bench --json` prints.")
      .def("summary", [](const BenchResult& r) { return FromJson(Json(r)); }, "The same as a dict.")
      .def("csv", [](const BenchResult& r) { return ResultsCsv(r.records); }, "results.csv.")
      .def("evidence_csv", [](const BenchResult& r) { return EvidenceCsv(r.records); },
           "evidence.csv.")
      .def_readonly("dataset", &BenchResult::dataset)
      .def_property_readonly("protocol", [](const BenchResult& r) { return r.protocol.name; })
      .def("__len__", [](const BenchResult& r) { return r.runs.size(); })
      .def("__getitem__", &Item, py::arg("index"), "The Localization of a run.")
      .def("__repr__", [](const BenchResult& r) {
        return "BenchResult(\"" + r.dataset + "\", " + std::to_string(r.runs.size()) + " runs)";
      });
  module.def("bench", &Bench, py::arg("dataset"), py::kw_only(), py::arg("protocol") = "",
             py::arg("perturb") = "", py::arg("world") = py::none(),
             py::arg("options") = py::none(), py::arg("seed") = 1, py::arg("seeds") = 1,
             py::arg("threads") = 0, py::arg("progress") = py::none(),
             R"(Localizes the queries of a dataset and compares with their truths, as `ridgeline bench`.

Args:
    dataset: path of a dataset.json.
    protocol: what a search is told: paper, known-tilt, phone, photo, outside or elsewhere; "": the
        dataset's own priors.
    perturb: "east,north,height,heading[,pitch,roll]" half-ranges [m, deg], in place of a protocol.
    world: with protocol "elsewhere": dataset.json of the place that is searched.
    options: None, a dict, a path or Options.
    seed, seeds: first seed and number of them.
    threads: 0: all; the results are the same on any number.
    progress: called with (done, total) after each run.
Returns:
    BenchResult.)");
}

}  // namespace ridgeline::python
