// SPDX-License-Identifier: Apache-2.0
// What is seen of a world from a pose: edges, skyline, depth and surfaces.
#include "scene.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>
#include <numbers>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "cameras.h"
#include "long_call.h"
#include "options.h"
#include "poses.h"
#include "score/edge_kind.h"
#include "score/position_view.h"
#include "score/sky_score.h"
#include "world.h"

namespace ridgeline::python {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct OwnedScene {
  std::shared_ptr<World> world;
  Scene scene;
};

SharedScene MadeScene(std::shared_ptr<World> world, py::handle options) {
  const LocalizerOptions settings = OptionsOf(options);
  const LongCall call;
  const World& of = *world;
  const auto owned = std::make_shared<OwnedScene>(OwnedScene{
      std::move(world), Scene(of.model, of.dtm ? &*of.dtm : nullptr, settings.projection)});
  return {std::shared_ptr<const Scene>(owned, &owned->scene)};
}

Pose LocalOf(const Scene& scene, py::handle pose) {
  Pose local = PoseOf(pose);
  local.center_in_world -= scene.model().origin_in_world;
  return local;
}

Sector SectorOf(const PinholeCamera& camera, const Pose& pose) {
  return RangeOf(camera, ViewAnglesOf(pose.cam_from_world), {}, 0.5 * kDegree).sector;
}

// The seen pieces, one row each.
struct Edges {
  std::vector<float> image;
  std::vector<double> world;
  std::vector<float> depth;
  std::vector<std::uint32_t> edge, building;
  std::vector<std::uint8_t> kind, left, right;
};

Edges SeenEdges(const Scene& scene, const PinholeCamera& camera, const Pose& pose) {
  const VisibleSet visible = scene.VisibleFrom(pose.center_in_world, SectorOf(camera, pose));
  std::vector<ProjectedSegment> segments;
  ProjectPieces(visible, camera, pose, segments);
  const CityModel& model = scene.model();
  Edges edges;
  for (const ProjectedSegment& segment : segments) {
    const VisiblePiece& piece = visible.pieces[segment.piece];
    const FeatureEdge& edge = scene.edge(piece.edge);
    edges.image.insert(edges.image.end(),
                       {segment.a.x(), segment.a.y(), segment.b.x(), segment.b.y()});
    for (const Eigen::Vector3f& end : {piece.a, piece.b}) {
      const Eigen::Vector3d in_world = end.cast<double>() + model.origin_in_world;
      edges.world.insert(edges.world.end(), {in_world.x(), in_world.y(), in_world.z()});
    }
    edges.depth.push_back(segment.depth);
    edges.edge.push_back(piece.edge);
    edges.building.push_back(edge.surface0 < model.surfaces.size()
                                 ? model.surfaces[edge.surface0].building
                                 : kNoSurface);
    edges.kind.push_back(static_cast<std::uint8_t>(KindOf(piece, scene)));
    edges.left.push_back(static_cast<std::uint8_t>(piece.left));
    edges.right.push_back(static_cast<std::uint8_t>(piece.right));
  }
  return edges;
}

py::dict VisibleEdges(const SharedScene& shared, py::handle pose, py::handle camera) {
  const Scene& scene = *shared.scene;
  const PinholeCamera pinhole = CameraOf(camera).Pinhole();
  const Pose local = LocalOf(scene, pose);
  Edges edges;
  {
    const LongCall call;
    edges = SeenEdges(scene, pinhole, local);
  }
  const auto count = static_cast<py::ssize_t>(edges.edge.size());
  py::dict arrays;
  arrays["image"] = ArrayOf(std::move(edges.image), {count, 4});
  arrays["world"] = ArrayOf(std::move(edges.world), {count, 2, 3});
  arrays["depth_m"] = ArrayOf(std::move(edges.depth), {count});
  arrays["edge"] = ArrayOf(std::move(edges.edge), {count});
  arrays["building"] = ArrayOf(std::move(edges.building), {count});
  arrays["kind"] = ArrayOf(std::move(edges.kind), {count});
  arrays["left"] = ArrayOf(std::move(edges.left), {count});
  arrays["right"] = ArrayOf(std::move(edges.right), {count});
  return arrays;
}

py::array SkylineAt(const SharedScene& shared, py::handle pose, py::handle camera) {
  const Scene& scene = *shared.scene;
  const PinholeCamera pinhole = CameraOf(camera).Pinhole();
  const Pose local = LocalOf(scene, pose);
  std::vector<float> rows(static_cast<std::size_t>(pinhole.width));
  {
    const LongCall call;
    const PanoramaRange range =
        RangeOf(pinhole, ViewAnglesOf(local.cam_from_world), {}, 0.5 * kDegree);
    const PositionView view = ViewFrom(
        scene, local.center_in_world, range, {.edges_and_skyline = true, .surfaces = false});
    SkylineRows(
        view.skyline, pinhole, local.cam_from_world.toRotationMatrix().cast<float>(), rows);
  }
  return ArrayOf(std::move(rows), {pinhole.width});
}

py::tuple Horizon(const SharedScene& shared, py::handle center) {
  const Scene& scene = *shared.scene;
  const auto place = DoublesOf(center, "center", {3});
  const Eigen::Vector3d local =
      Eigen::Map<const Eigen::Vector3d>(place.data()) - scene.model().origin_in_world;
  VisibleSet seen;
  {
    const LongCall call;
    seen = scene.SkylineFrom(local, Sector{});
  }
  const auto count = static_cast<py::ssize_t>(seen.skyline_elevation.size());
  std::vector<double> azimuths;
  std::vector<double> elevations;
  for (std::size_t i = 0; i < seen.skyline_elevation.size(); ++i) {
    azimuths.push_back((seen.first_azimuth + seen.azimuth_step * static_cast<double>(i)) / kDegree);
    elevations.push_back(seen.skyline_elevation[i] / kDegree);
  }
  return py::make_tuple(ArrayOf(std::move(azimuths), {count}),
                        ArrayOf(std::move(elevations), {count}));
}

py::dict Rendered(const SharedScene& shared, py::handle pose, py::handle camera, bool normals) {
  const Scene& scene = *shared.scene;
  const PinholeCamera pinhole = CameraOf(camera).Pinhole();
  const Pose local = LocalOf(scene, pose);
  ViewBuffers buffers;
  std::vector<std::uint32_t> buildings;
  {
    const LongCall call;
    buffers = scene.Render(pinhole, local, normals);
    const std::vector<Surface>& surfaces = scene.model().surfaces;
    for (const std::uint32_t id : buffers.surfaces) {
      buildings.push_back(id < surfaces.size() ? surfaces[id].building : kNoSurface);
    }
  }
  const std::vector<py::ssize_t> shape{pinhole.height, pinhole.width};
  py::dict arrays;
  arrays["depth_m"] = ArrayOf(buffers.depth);
  arrays["surface"] = ArrayOf(std::move(buffers.surfaces), shape);
  arrays["building"] = ArrayOf(std::move(buildings), shape);
  if (normals) arrays["normal"] = ArrayOf(buffers.normals);
  return arrays;
}

}  // namespace

void BindScene(py::module_& module) {
  module.attr("NO_SURFACE") = kNoSurface;
  module.attr("TERRAIN_SURFACE") = kTerrainSurface;
  py::list kinds;
  for (const char* name : kEdgeKindNames) kinds.append(name);
  module.attr("EDGE_KINDS") = py::tuple(kinds);
  py::class_<SharedScene>(module, "Scene", R"(A world prepared to be looked at; thread-safe.

Pictures are those of camera.pinhole(): without distortion, pixels with COLMAP's origin.

Args:
    world: World, which is kept.
    options: of "projection"; None, a dict, a path or Options.)")
      .def(py::init(&MadeScene), py::arg("world"), py::arg("options") = py::none())
      .def("visible_edges", &VisibleEdges, py::arg("pose"), py::arg("camera"),
           R"(Visible pieces of the model's edges.

Returns:
    dict of arrays with a row for each piece: image (n, 4) float32 x0, y0, x1, y1 [px]; world
    (n, 2, 3) float64, the ends of the whole piece [m]; depth_m (n,) float32, of its middle along
    the optical axis; edge and building (n,) uint32; kind (n,) uint8, an index into EDGE_KINDS;
    left and right (n,) uint8, what is seen beside it (0 sky, 1 own wall, 2 own roof, 3 another
    building, 4 ground).)")
      .def("skyline", &SkylineAt, py::arg("pose"), py::arg("camera"),
           "(width,) float32: row of the skyline in each column [px]; NaN where it is not reached.")
      .def("horizon", &Horizon, py::arg("center"),
           "(azimuths (n,), elevations (n,)) float64 [deg] of the skyline all around a place (3,) "
           "in world coordinates; azimuths clockwise from grid north.")
      .def("render", &Rendered, py::arg("pose"), py::arg("camera"), py::arg("normals") = false,
           R"(Depth and surfaces, a ray per pixel centre.

Returns:
    dict of depth_m (height, width) float32 along the optical axis (inf: sky), surface (height,
    width) uint32 (NO_SURFACE: sky, TERRAIN_SURFACE: terrain), building (height, width) uint32
    (NO_SURFACE: none) and, if asked for, normal (height, width, 3) float32, unit, towards the
    camera (0: sky).)");
}

}  // namespace ridgeline::python
