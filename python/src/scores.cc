// SPDX-License-Identifier: Apache-2.0
// Scores of arrays of poses in one picture.
#include "scores.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "cameras.h"
#include "datasets.h"
#include "localization.h"
#include "localize/search_poses.h"
#include "long_call.h"
#include "options.h"
#include "poses.h"
#include "score/evidence_score.h"
#include "score/score_table.h"
#include "score_poses.h"

namespace ridgeline::python {
namespace {

// A score of one picture, with all that it refers to.
struct OwnedScore {
  std::shared_ptr<const OwnedPicture> picture;
  ScoreOptions options;
  std::unique_ptr<Score> score;

  const OwnedLocalizer& owner() const { return *picture->owner; }
  const Scene& scene() const { return owner().localizer.scene(); }
  double step_deg() const { return owner().localizer.options().score.evidence.surface_step_deg; }
};
using SharedScore = std::shared_ptr<OwnedScore>;

SharedPicture MadePicture(const SharedLocalizer& localizer,
                          py::handle image,
                          py::handle camera,
                          py::handle lines,
                          int threads) {
  const cv::Mat picture = PictureOf(image);
  const CameraIntrinsics intrinsics = CameraOf(camera);
  if (picture.cols != intrinsics.width || picture.rows != intrinsics.height) {
    throw InputError("",
                     "image",
                     std::to_string(picture.cols) + " x " + std::to_string(picture.rows),
                     "the camera's " + std::to_string(intrinsics.width) + " x " +
                         std::to_string(intrinsics.height));
  }
  std::optional<std::vector<LineSegment>> given;
  if (!lines.is_none()) given = SegmentsOf(lines);
  const LocalizerOptions& options = localizer.localizer().options();
  const LongCall call;
  // The pixels belong to the caller, whatever becomes of them.
  const cv::Mat bgr = UndistortImage(BgrOf(picture), intrinsics);
  return {std::shared_ptr<OwnedPicture>(
      new OwnedPicture{localizer.owned,
                       {bgr.data == picture.data ? bgr.clone() : bgr,
                        intrinsics.Pinhole(),
                        options.lines,
                        options.score.evidence,
                        threads,
                        given}})};
}

SharedScore MadeScore(const SharedPicture& picture, const std::string& name, py::handle weights) {
  auto made = std::make_shared<OwnedScore>();
  made->picture = picture.owned;
  made->options = picture.owned->owner->localizer.options().score;
  if (!name.empty()) made->options.name = name;
  for (const std::string& cue : CueNames()) made->options.weights.try_emplace(cue, 0.0);
  if (!weights.is_none()) {
    made->options.weights = weights.cast<std::map<std::string, double>>();
  }
  CheckOptions(made->options, "score");
  const LongCall call;
  made->score = MakeScore({made->picture->evidence, made->scene(), made->options});
  return made;
}

// values(i) of each pose into a new array, `columns` each.
template <typename Value, typename Judge>
py::array_t<Value> Judged(const OwnedScore& of,
                          const PoseList& poses,
                          std::size_t columns,
                          int threads,
                          const Judge& judge) {
  std::vector<Value> values(poses.size() * columns);
  {
    const LongCall call;
    const PoseGroups groups = GroupsOf(Shifted(poses, of.scene().model().origin_in_world));
    ForEachPlace(*of.score,
                 of.scene(),
                 of.picture->evidence.camera(),
                 of.step_deg(),
                 groups,
                 threads,
                 [&](const PositionView& view,
                     std::span<const Pose> of_place,
                     std::span<const std::size_t> indices,
                     Score::Workspace& workspace) {
                   judge(view, of_place, indices, workspace, values);
                 });
  }
  const auto count = static_cast<py::ssize_t>(poses.size());
  if (columns == 1) return ArrayOf(std::move(values), {count});
  return ArrayOf(std::move(values), {count, static_cast<py::ssize_t>(columns)});
}

py::array_t<double> LogRatios(const OwnedScore& of, py::handle poses, int threads) {
  return Judged<double>(of,
                        *PosesOf(poses),
                        1,
                        threads,
                        [&](const PositionView& view,
                            std::span<const Pose> of_place,
                            std::span<const std::size_t> indices,
                            Score::Workspace& workspace,
                            std::vector<double>& values) {
                          std::vector<double> log_ratios(of_place.size());
                          of.score->LogRatios(view, of_place, workspace, log_ratios);
                          for (std::size_t k = 0; k < indices.size(); ++k) {
                            values[indices[k]] = log_ratios[k];
                          }
                        });
}

py::array_t<double> Energies(const OwnedScore& of, py::handle poses, int threads) {
  py::array_t<double> energies = LogRatios(of, poses, threads);
  double* values = energies.mutable_data();
  for (py::ssize_t i = 0; i < energies.size(); ++i) values[i] = Score::EnergyOf(values[i]);
  return energies;
}

const EvidenceScore& EvidenceOf(const OwnedScore& of) {
  const auto* evidence = dynamic_cast<const EvidenceScore*>(of.score.get());
  if (evidence == nullptr) {
    throw InputError("", "score.name", "\"" + of.options.name + "\"", "\"evidence\", which has cues");
  }
  return *evidence;
}

py::array_t<float> Cues(const OwnedScore& of, py::handle poses, int threads) {
  const EvidenceScore& evidence = EvidenceOf(of);
  const std::size_t columns = evidence.cue_names().size();
  py::array_t<float> cues =
      Judged<float>(of,
                    *PosesOf(poses),
                    columns,
                    threads,
                    [&](const PositionView& view,
                        std::span<const Pose> of_place,
                        std::span<const std::size_t> indices,
                        Score::Workspace& workspace,
                        std::vector<float>& values) {
                      std::vector<float> rows(of_place.size() * columns);
                      evidence.CuesOfMany(view, of_place, workspace, rows);
                      for (std::size_t k = 0; k < indices.size(); ++k) {
                        std::copy_n(rows.begin() + k * columns,
                                    columns,
                                    values.begin() + indices[k] * columns);
                      }
                    });
  return columns == 1 ? py::array_t<float>(cues.reshape({-1, 1})) : cues;
}

SharedMap MapAround(const OwnedScore& of, py::handle prior, py::handle ranges, int threads) {
  const Localizer& localizer = of.owner().localizer;
  const PoseSpaceOptions box = RangesOf(ranges, localizer.options().search.space);
  const PosePrior around = PriorOf(prior);
  const LongCall call;
  const PoseSpace space(around, box, localizer.scene(), localizer.dtm(), localizer.footprints());
  const PoseScorer scorer(
      *of.score, localizer.scene(), space, of.picture->evidence.camera(), of.step_deg());
  const PoseVolume volume =
      MapPoses(scorer, of.picture->evidence, localizer.options().search.map, threads);
  return {std::make_shared<EnergyMap>(MapOf(volume, space, of.owner().world->model))};
}

// The matrix counts its holders.
py::array MatView(const cv::Mat& mat) {
  py::array array = ArrayOf(mat);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

CameraIntrinsics WorkCamera(const SharedPicture& picture) {
  const PinholeCamera& p = picture.owned->evidence.camera();
  return {"PINHOLE", p.width, p.height, {p.fx, p.fy, p.cx, p.cy}};
}

void BindPicture(py::module_& module) {
  py::class_<SharedPicture>(module, "Picture", R"(A picture prepared to be compared with a world.

Made once, so that a pose costs microseconds. All it shows is in the pixels of the reduced,
undistorted picture (`camera`).

Args:
    localizer: Localizer, which is kept; its options say how.
    image: path, or (height, width[, 3 or 4]) uint8 or uint16, blue, green, red; as taken.
    camera: Camera, with the picture's size.
    lines: segments of the undistorted picture in place of the detector's, (n, 4) or (n, 5) [px].)")
      .def(py::init(&MadePicture), py::arg("localizer"), py::arg("image"), py::arg("camera"),
           py::kw_only(), py::arg("lines") = py::none(), py::arg("threads") = 0)
      .def_property_readonly(
          "bgr", [](const SharedPicture& p) { return MatView(p.owned->evidence.bgr()); },
          "(height, width, 3) uint8, a view.")
      .def_property_readonly(
          "foliage", [](const SharedPicture& p) { return MatView(p.owned->evidence.foliage()); },
          "(height, width) uint8, 255 where leaves hide what is behind; a view.")
      .def_property_readonly("camera", &WorkCamera)
      .def_property_readonly(
          "lines", [](const SharedPicture& p) { return ArrayOf(p.owned->evidence.segments()); },
          "(n, 5) float32: x0, y0, x1, y1 [px], strength.")
      .def("score", &MadeScore, py::arg("name") = "", py::kw_only(),
           py::arg("weights") = py::none(), R"(A score of this picture.

Args:
    name: one of scores(), own ones too; "": that of the localizer's options.
    weights: of the cues of "evidence" by name, in place of the options'; absent ones are 0.
Returns:
    Score.)");
}

}  // namespace

void BindScores(py::module_& module) {
  BindPicture(module);
  py::class_<OwnedScore, SharedScore>(module, "Score", R"(Judges poses in one picture; thread-safe.

Poses of equal centres share one look from there, so that orientations are cheap; order does not
matter. Ray resolution depends on the range of orientations of a place, as in a search.)")
      .def_property_readonly("name", [](const OwnedScore& s) { return s.options.name; })
      .def("log_ratios", &LogRatios, py::arg("poses"), py::kw_only(), py::arg("threads") = 0,
           "(n,) float64: log likelihood ratios against chance, higher is better; -inf: nothing of "
           "the model in view. poses: Poses, a Pose or a list of them.")
      .def("energies", &Energies, py::arg("poses"), py::kw_only(), py::arg("threads") = 0,
           "(n,) float64 in [0, 1], 0 best: 1 / (1 + exp(log_ratio / 10)).")
      .def_property_readonly("cue_names",
                             [](const OwnedScore& s) { return EvidenceOf(s).cue_names(); })
      .def("cues", &Cues, py::arg("poses"), py::kw_only(), py::arg("threads") = 0,
           "(n, cues) float32: the cues of \"evidence\" by cue_names, without their weights.")
      .def("map", &MapAround, py::arg("prior"), py::arg("ranges") = py::none(), py::kw_only(),
           py::arg("threads") = 0,
           "EnergyMap of the dense search around a prior; ranges {\"east_m\": 10, ...}.");
  module.def("scores", &ScoreNames, "Names of the scores, own ones last.");
  module.def("cues", &CueNames, "Names of the cues of \"evidence\", own ones last.");
}

}  // namespace ridgeline::python
