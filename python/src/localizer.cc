// SPDX-License-Identifier: Apache-2.0
// From a photo to its pose.
#include "localizer.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "cameras.h"
#include "datasets.h"
#include "eval/localize_task.h"
#include "input/query_request.h"
#include "localization.h"
#include "localize/sampled_search.h"
#include "long_call.h"
#include "options.h"
#include "scene.h"
#include "world.h"

namespace ridgeline::python {
namespace {

bool IsPath(py::handle value) {
  return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
}

std::string TextOrEmpty(py::handle value) {
  return value.is_none() ? std::string() : PathOf(value).string();
}

SharedLocalizer Made(std::shared_ptr<World> world, py::handle options) {
  const LocalizerOptions settings = OptionsOf(options);
  const LongCall call;
  return {std::make_shared<OwnedLocalizer>(std::move(world), settings)};
}

FoundPose Localize(const SharedLocalizer& self,
                   py::handle image,
                   py::handle camera,
                   py::handle prior,
                   py::handle lines,
                   py::handle ranges,
                   std::uint64_t seed,
                   int threads) {
  const Localizer& localizer = self.localizer();
  LocalizationInput input;
  input.picture = PictureOf(image);
  input.camera = CameraOf(camera);
  input.prior = PriorOf(prior);
  if (!lines.is_none()) input.lines = SegmentsOf(lines);
  const PoseSpaceOptions box = RangesOf(ranges, localizer.options().search.space);
  FoundPose found{self.owned->world,
                  IsPath(image) ? PathOf(image).string() : std::string(),
                  AssumptionsOf(input.prior, box.camera_height_m, "prior"),
                  {}};
  const LongCall call;
  found.result = localizer.Localize(input, box, seed, threads);
  return found;
}

struct PhotoArguments {
  QueryArguments query;
  py::object camera, prior;
  std::string lines;
  std::optional<double> declination_deg;
  py::object options;
};

// Segments of a file stand for a detector's.
void TakeLines(LineDetectionOptions& options) {
  if (options.detector != LineDetectionOptions{}.detector && options.detector != kLinesFromFile) {
    throw InputError("--lines",
                     "",
                     "lines.detector=" + options.detector + " beside it",
                     "segments of a file or a detector's, not both");
  }
  options.detector = kLinesFromFile;
}

// The task of the program's words; objects of Python go before files.
LocalizeTask TaskOf(PhotoArguments arguments) {
  LocalizeTask task;
  task.options = OptionsOf(arguments.options);
  task.declination_deg = arguments.declination_deg;
  task.lines = arguments.lines;
  if (!task.lines.empty()) TakeLines(task.options.lines);
  if (IsPath(arguments.camera)) arguments.query.camera = PathOf(arguments.camera).string();
  task.dataset = ReadQuery(arguments.query);
  Query& query = task.query();
  if (!arguments.camera.is_none() && !IsPath(arguments.camera)) {
    query.camera = CameraOf(arguments.camera);
  }
  if (arguments.prior.is_none()) return task;
  if (IsPath(arguments.prior)) {
    query.prior = ReadPrior(PathOf(arguments.prior));
    task.dataset.file = PathOf(arguments.prior);  // named where the prior leaves something open
  } else {
    query.prior = PriorOf(arguments.prior);
    task.dataset.file = "prior";
  }
  return task;
}

FoundPose LocalizePhoto(LocalizeTask task, std::uint64_t seed, int threads) {
  PictureReader pictures;
  CompleteTask(task, pictures);
  auto world = std::make_shared<World>(ReadWorldOf(task));
  const Localizer localizer(world->model, world->dtm, task.options);
  CheckPlace(task, localizer);
  BenchRun run = RunTask(task, localizer, seed, threads, pictures);
  return {std::move(world),
          task.query().image.string(),
          task.query().assumptions,
          std::move(run.localization)};
}

// A search box for samplers; the space refers to the localizer.
struct OwnedSpace {
  std::shared_ptr<const OwnedLocalizer> owner;
  PoseSpace space;
};

PoseSpace::Offset OffsetOf(const double* v) { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }

std::shared_ptr<OwnedSpace> SpaceOf(const SharedLocalizer& self,
                                    py::handle prior,
                                    py::handle ranges) {
  const Localizer& localizer = self.localizer();
  return std::make_shared<OwnedSpace>(
      OwnedSpace{self.owned,
                 PoseSpace(PriorOf(prior),
                           RangesOf(ranges, localizer.options().search.space),
                           localizer.scene(),
                           localizer.dtm(),
                           localizer.footprints())});
}

py::list BoxOf(const OwnedSpace& space) {
  py::list box;
  for (const Parameter& p : SearchBoxOf(space.space).parameters) {
    box.append(py::make_tuple(p.name, p.lower, p.upper, p.periodic));
  }
  return box;
}

py::object PoseAt(const OwnedSpace& space, py::handle offset) {
  const auto values = DoublesOf(offset, "offset", {6});
  std::optional<Pose> pose = space.space.PoseAt(OffsetOf(values.data()));
  if (!pose) return py::none();
  pose->center_in_world += space.owner->world->model.origin_in_world;
  return py::cast(*pose);
}

py::array Admissible(const OwnedSpace& space, py::handle offsets) {
  const auto values = DoublesOf(offsets, "offsets", {-1, 6});
  py::array_t<bool> admissible(values.shape(0));
  for (py::ssize_t i = 0; i < values.shape(0); ++i) {
    admissible.mutable_at(i) = space.space.PoseAt(OffsetOf(values.data() + 6 * i)).has_value();
  }
  return admissible;
}

void BindSpace(py::module_& module) {
  py::class_<OwnedSpace, std::shared_ptr<OwnedSpace>>(
      module, "PoseSpace", R"(The poses that a prior and the terrain allow, as offsets from the prior.

An offset is east, north, height [m], heading, pitch, roll [deg]; of a prior without height the
terrain and a camera height are its place.)")
      .def_property_readonly("box", &BoxOf,
                             "[(name, lower, upper, periodic)] of the six offsets, for Sampler.")
      .def("pose_at", &PoseAt, py::arg("offset"),
           "Pose in the world frame at an offset (6,); None: no camera can be there.")
      .def("admissible", &Admissible, py::arg("offsets"),
           "(n,) bool: whether a camera can be at offsets (n, 6) float64.");
}

void BindPhoto(py::module_& module) {
  module.def(
      "localize",
      [](py::handle image, py::handle model, py::handle dtm, py::handle dataset,
         const std::string& query, const std::string& crs, py::object camera, py::object prior,
         py::handle lines, std::optional<double> declination_deg, py::object options,
         std::uint64_t seed, int threads) {
        PhotoArguments arguments;
        arguments.query.dataset = TextOrEmpty(dataset);
        arguments.query.query = query;
        if (!model.is_none()) {
          for (const auto& path : PathsOf(model)) arguments.query.model.push_back(path.string());
        }
        arguments.query.dtm = TextOrEmpty(dtm);
        arguments.query.crs = crs;
        arguments.query.image = TextOrEmpty(image);
        if (arguments.query.image.empty() && arguments.query.dataset.empty()) {
          throw InputError("IMAGE", "", "nothing", "a picture, or --dataset with --query");
        }
        arguments.camera = std::move(camera);
        arguments.prior = std::move(prior);
        arguments.lines = TextOrEmpty(lines);
        arguments.declination_deg = declination_deg;
        arguments.options = std::move(options);
        LocalizeTask task = TaskOf(std::move(arguments));
        const LongCall call;
        return LocalizePhoto(std::move(task), seed, threads);
      },
      py::arg("image") = py::none(), py::arg("model") = py::none(), py::kw_only(),
      py::arg("dtm") = py::none(), py::arg("dataset") = py::none(), py::arg("query") = "",
      py::arg("crs") = "", py::arg("camera") = py::none(), py::arg("prior") = py::none(),
      py::arg("lines") = py::none(), py::arg("declination_deg") = py::none(),
      py::arg("options") = py::none(), py::arg("seed") = 1, py::arg("threads") = 0,
      R"(The pose of one photo: what `ridgeline localize` does, to the last bit.

Reads the part of the model that is seen from the prior; to localize many pictures, load a World
once and use a Localizer.

Args:
    image: path of the picture.
    model: path or paths of the city model.
    dtm: path of the terrain; None: the model's ground.
    dataset, query: a dataset.json and an id in it, in place of the above.
    crs: projected system of prior and poses, e.g. "EPSG:25832".
    camera: Camera, path of a camera file, or None: the picture's EXIF.
    prior: Prior, Pose, path of a prior file, or None: the picture's EXIF and XMP.
    lines: path of another detector's segments.
    declination_deg: of a magnetic heading, east positive; None: World Magnetic Model.
    options: None, a dict, a path or Options.
    seed, threads: the result is the same on any number of threads; 0: all.
Returns:
    Localization.
Raises:
    InputError: in the words of the program.
    KeyboardInterrupt: Ctrl-C.)");
}

}  // namespace

void BindLocalizer(py::module_& module) {
  BindSpace(module);
  BindPhoto(module);
  py::class_<SharedLocalizer>(module, "Localizer", R"(Finds poses of pictures in one world; thread-safe.

Args:
    world: World, which is kept.
    options: None, a dict, a path or Options.)")
      .def(py::init(&Made), py::arg("world"), py::arg("options") = py::none())
      .def("localize", &Localize, py::arg("image"), py::arg("camera"), py::arg("prior"),
           py::kw_only(), py::arg("lines") = py::none(), py::arg("ranges") = py::none(),
           py::arg("seed") = 1, py::arg("threads") = 0, R"(The pose of one picture.

Args:
    image: path, or (height, width[, 3 or 4]) uint8 or uint16, blue, green, red; as taken.
    camera: Camera, with the picture's size.
    prior: Prior, or a Pose.
    lines: (n, 4) or (n, 5) float32 or float64 segments of the undistorted picture [px], in place of
        the detector's.
    ranges: half-ranges of the search, {"east_m": 10, "heading_deg": 20, ...}; None: the options'.
Returns:
    Localization.)")
      .def("search_space", &SpaceOf, py::arg("prior"), py::arg("ranges") = py::none(),
           "PoseSpace of a prior and half-ranges {\"east_m\": 10, ...}.")
      .def_property_readonly("world",
                             [](const SharedLocalizer& l) {
                               return std::const_pointer_cast<World>(l.owned->world);
                             })
      .def_property_readonly("scene",
                             [](const SharedLocalizer& l) {
                               return SharedScene{std::shared_ptr<const Scene>(
                                   l.owned, &l.owned->localizer.scene())};
                             })
      .def_property_readonly("options",
                             [](const SharedLocalizer& l) { return l.localizer().options(); },
                             "A copy of the options.");
}

}  // namespace ridgeline::python
