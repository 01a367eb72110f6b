// SPDX-License-Identifier: Apache-2.0
// A city model and its terrain, read once and kept.
#include "world.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "city/crs.h"
#include "long_call.h"

namespace ridgeline::python {
namespace {

using SharedWorld = std::shared_ptr<World>;

SharedWorld Load(py::handle model,
                 py::handle dtm,
                 const std::string& crs,
                 py::handle around,
                 double reach_m,
                 int threads) {
  WorldRequest request;
  request.model = PathsOf(model);
  if (!dtm.is_none()) request.dtm = PathOf(dtm);
  request.crs = crs;
  request.threads = threads;
  request.whole_model = around.is_none();
  if (!around.is_none()) {
    const auto places = DoublesOf(around, "around", {-1, 2});
    for (py::ssize_t i = 0; i < places.shape(0); ++i) {
      request.places.extend(Eigen::Vector2d(places.at(i, 0), places.at(i, 1)));
    }
    request.places.min().array() -= reach_m;
    request.places.max().array() += reach_m;
  }
  const LongCall call;
  return std::make_shared<World>(ReadWorld(request));
}

SharedWorld LoadDataset(py::handle path, double margin_m) {
  const Dataset dataset = ReadDataset(PathOf(path));
  const LongCall call;
  return std::make_shared<World>(ReadWorld(dataset, margin_m));
}

template <typename Row>
py::array RowsOf(const std::vector<Row>& rows, py::handle owner) {
  static_assert(sizeof(Row) == 3 * sizeof(double));
  return View(reinterpret_cast<const double*>(rows.data()),
              {static_cast<py::ssize_t>(rows.size()), 3},
              {static_cast<py::ssize_t>(sizeof(Row)), static_cast<py::ssize_t>(sizeof(double))},
              owner);
}

py::array Vertices(py::object self) {
  return RowsOf(self.cast<const World&>().model.vertices, self);
}

py::array Triangles(py::object self) {
  const std::vector<Triangle>& triangles = self.cast<const World&>().model.triangles;
  const std::uint32_t* first = triangles.empty() ? nullptr : triangles.front().vertices.data();
  return View(first,
              {static_cast<py::ssize_t>(triangles.size()), 3},
              {static_cast<py::ssize_t>(sizeof(Triangle)),
               static_cast<py::ssize_t>(sizeof(std::uint32_t))},
              self);
}

py::array TriangleSurfaces(py::object self) {
  const std::vector<Triangle>& triangles = self.cast<const World&>().model.triangles;
  const std::uint32_t* first = triangles.empty() ? nullptr : &triangles.front().surface;
  return View(first,
              {static_cast<py::ssize_t>(triangles.size())},
              {static_cast<py::ssize_t>(sizeof(Triangle))},
              self);
}

py::dict Surfaces(py::object self) {
  const std::vector<Surface>& surfaces = self.cast<const World&>().model.surfaces;
  const auto count = static_cast<py::ssize_t>(surfaces.size());
  const auto stride = static_cast<py::ssize_t>(sizeof(Surface));
  const Surface* first = surfaces.data();
  py::dict arrays;
  arrays["class"] = View(first == nullptr ? nullptr
                                          : reinterpret_cast<const std::uint8_t*>(
                                                &first->surface_class),
                         {count},
                         {stride},
                         self);
  arrays["building"] = View(first == nullptr ? nullptr : &first->building, {count}, {stride}, self);
  arrays["normal"] = View(first == nullptr ? nullptr : first->normal.data(),
                          {count, 3},
                          {stride, static_cast<py::ssize_t>(sizeof(float))},
                          self);
  return arrays;
}

py::dict FeatureEdges(py::object self) {
  const std::vector<FeatureEdge>& edges = self.cast<const World&>().model.feature_edges;
  const auto count = static_cast<py::ssize_t>(edges.size());
  const auto stride = static_cast<py::ssize_t>(sizeof(FeatureEdge));
  const auto number = static_cast<py::ssize_t>(sizeof(double));
  const FeatureEdge* first = edges.data();
  const auto at = [&](auto FeatureEdge::* member) {
    return first == nullptr ? nullptr : &(first->*member);
  };
  py::dict arrays;
  const auto ends = [&](Eigen::Vector3d FeatureEdge::* member) {
    const Eigen::Vector3d* place = at(member);
    return View(place == nullptr ? nullptr : place->data(), {count, 3}, {stride, number}, self);
  };
  arrays["a"] = ends(&FeatureEdge::a);
  arrays["b"] = ends(&FeatureEdge::b);
  arrays["surface0"] = View(at(&FeatureEdge::surface0), {count}, {stride}, self);
  arrays["surface1"] = View(at(&FeatureEdge::surface1), {count}, {stride}, self);
  arrays["seam"] = View(at(&FeatureEdge::seam), {count}, {stride}, self);
  return arrays;
}

py::list BuildingIds(const World& world) {
  py::list ids;
  for (const Building& building : world.model.buildings) ids.append(building.id);
  return ids;
}

py::object TerrainArray(py::object self) {
  const World& world = self.cast<const World&>();
  if (!world.dtm) return py::none();
  const auto columns = static_cast<py::ssize_t>(world.dtm->columns);
  const auto number = static_cast<py::ssize_t>(sizeof(float));
  return View(world.dtm->heights.data(),
              {static_cast<py::ssize_t>(world.dtm->rows), columns},
              {columns * number, number},
              self);
}

// World coordinates of a grid line's values.
py::array Axis(double first, double spacing, int count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values[i] = first + spacing * i;
  return ArrayOf(std::move(values), {count});
}

py::object TerrainAxes(const World& world) {
  if (!world.dtm) return py::none();
  const Eigen::Vector2d first = world.dtm->first + world.model.origin_in_world.head<2>();
  return py::make_tuple(Axis(first.x(), world.dtm->spacing_m, world.dtm->columns),
                        Axis(first.y(), world.dtm->spacing_m, world.dtm->rows));
}

py::array HeightsAt(const World& world, py::handle places) {
  const auto xy = DoublesOf(places, "places", {-1, 2});
  std::vector<double> heights;
  for (py::ssize_t i = 0; i < xy.shape(0); ++i) {
    const Eigen::Vector2d local =
        Eigen::Vector2d(xy.at(i, 0), xy.at(i, 1)) - world.model.origin_in_world.head<2>();
    const auto height = world.dtm ? world.dtm->HeightAt(local) : std::nullopt;
    heights.push_back(height ? *height + world.model.origin_in_world.z()
                             : std::numeric_limits<double>::quiet_NaN());
  }
  return ArrayOf(std::move(heights), {xy.shape(0)});
}

}  // namespace

std::filesystem::path PathOf(py::handle value) {
  return std::string(py::str(py::module_::import("os").attr("fspath")(value)));
}

std::vector<std::filesystem::path> PathsOf(py::handle value) {
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) {
    return {PathOf(value)};
  }
  std::vector<std::filesystem::path> paths;
  for (const py::handle& item : value) paths.push_back(PathOf(item));
  return paths;
}

void BindWorld(py::module_& module) {
  py::class_<World, SharedWorld>(module, "World", R"(A city model and its terrain, in memory.

Positions are easting, northing, height [m] in the model's system (`crs`). The mesh is in a local
frame: world minus `origin`.)")
      .def_static("load", &Load, py::arg("model"), py::arg("dtm") = py::none(), py::kw_only(),
                  py::arg("crs") = "", py::arg("around") = py::none(), py::arg("reach_m") = 50.0,
                  py::arg("threads") = 0, R"(Reads model and terrain.

Args:
    model: path or paths: CityGML, CityJSON, OBJ, GeoPackage stores, folders of them.
    dtm: terrain, any GDAL raster; None: none.
    crs: projected system, e.g. "EPSG:25832"; "": the model's own.
    around: (n, 2) float64 east, north of places to be looked from: what cannot be seen from within
        `reach_m` of them is not read. None: everything.
Raises:
    InputError: what the program says of unreadable or unfit files.)")
      .def_static("of_dataset", &LoadDataset, py::arg("path"), py::arg("margin_m") = 50.0,
                  "The world of a dataset.json, as far as it is seen from within `margin_m` of its "
                  "places.")
      .def_property_readonly("crs", [](const World& w) { return CrsName(w.model.crs); },
                             "\"EPSG:25832\", \"EPSG:25832+7837\" or \"no CRS\".")
      .def_property_readonly(
          "origin", [](const World& w) { return w.model.origin_in_world; },
          "(3,) float64 [m]: local = world - origin.")
      .def_property_readonly("warnings", [](const World& w) { return w.warnings; },
                             "What was dropped, repaired or assumed, in words.")
      .def_property_readonly("building_ids", &BuildingIds)
      .def_property_readonly("vertices", &Vertices, "(n, 3) float64, local [m]; a view.")
      .def_property_readonly("triangles", &Triangles,
                             "(n, 3) uint32 indices of vertices, counter-clockwise seen from "
                             "outside; a view.")
      .def_property_readonly("triangle_surfaces", &TriangleSurfaces, "(n,) uint32; a view.")
      .def_property_readonly("surfaces", &Surfaces,
                             "dict of views: class (n,) uint8 (0 wall, 1 roof, 2 ground, 3 closure, "
                             "4 other, 5 terrain), building (n,) uint32, normal (n, 3) float32.")
      .def_property_readonly("feature_edges", &FeatureEdges,
                             "dict of views: a and b (n, 3) float64, the ends, local [m]; surface0 "
                             "and surface1 (n,) uint32 (4294967295: none); seam (n,) bool.")
      .def_property_readonly("terrain", &TerrainArray,
                             "(rows, columns) float32, heights less origin[2] [m], rows from south "
                             "to north, NaN where unknown; a view. None without terrain.")
      .def_property_readonly("terrain_axes", &TerrainAxes,
                             "(east (columns,), north (rows,)) of `terrain`, float64, world [m].")
      .def("height_at", &HeightsAt, py::arg("places"),
           "Terrain heights (n,) float64, world [m], at places (n, 2) float64; NaN where unknown.")
      .def("__repr__", [](const World& w) {
        return "World(" + CrsName(w.model.crs) + ", " + std::to_string(w.model.buildings.size()) +
               " buildings, " + (w.dtm ? "with" : "without") + " terrain)";
      });
}

}  // namespace ridgeline::python
