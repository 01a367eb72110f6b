// SPDX-License-Identifier: Apache-2.0
// Where the distance between the skylines at the true pose comes from, on walks that
// `ridgeline synth --walk` made: the model against the town as built (overhang, chimneys, dormers),
// the town against what hides it (trees, lamps, cars), and the extracted skyline against the true
// one. All in pixels of a picture 640 px wide, means over all columns as in the paper.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "city/read_city.h"
#include "input/dataset.h"
#include "score/sky_score.h"
#include "synth/detail_mesh.h"
#include "synth/town.h"
#include "track/skyline_tracker.h"

namespace ridgeline {
namespace {

constexpr double kNearM = 0.1;
// A column is wrong if it is off by more than this [px at 640], and called seen nevertheless.
constexpr double kWrongPx = 10.0;

// Lets the row of every column that the edge crosses be at most the edge's.
void RaiseTo(const Eigen::Vector2d& a, const Eigen::Vector2d& b, std::vector<float>& rows) {
  const double left = std::min(a.x(), b.x()), right = std::max(a.x(), b.x());
  const int first = std::max(0, static_cast<int>(std::ceil(left - 0.5)));
  const int last =
      std::min(static_cast<int>(rows.size()) - 1, static_cast<int>(std::floor(right - 0.5)));
  for (int c = first; c <= last; ++c) {
    const double t = right > left ? (c + 0.5 - a.x()) / (b.x() - a.x()) : 0.0;
    float& row = rows[static_cast<std::size_t>(c)];
    row = std::min(row, static_cast<float>(a.y() + t * (b.y() - a.y())));
  }
}

// The upper outline of a mesh in a picture: its triangles' edges, the highest of each column.
void AddOutline(const DetailMesh& mesh,
                const PinholeCamera& camera,
                const Pose& pose,
                std::vector<float>& rows) {
  for (const DetailTriangle& triangle : mesh.triangles) {
    Eigen::Vector3d corner[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = pose.cam_from_world *
                  (mesh.vertices[triangle.vertices[static_cast<std::size_t>(k)]].cast<double>() -
                   pose.center_in_world);
    }
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d a = corner[k], b = corner[(k + 1) % 3];
      if (a.z() < kNearM && b.z() < kNearM) continue;
      if (a.z() < kNearM) std::swap(a, b);
      if (b.z() < kNearM) b = a + (a.z() - kNearM) / (a.z() - b.z()) * (b - a);
      RaiseTo(camera.ImageFromCamera(a), camera.ImageFromCamera(b), rows);
    }
  }
}

// Mean distance of two skylines within the picture [px at 640].
double MeanDistance(const std::vector<float>& a, const std::vector<float>& b, double height) {
  double sum = 0.0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const auto inside = [&](float y) {
      return std::clamp<double>(std::isnan(y) ? 0 : y, 0, height);
    };
    sum += std::abs(inside(a[c]) - inside(b[c]));
  }
  return sum / static_cast<double>(a.size());
}

struct Sums {
  double total = 0.0, least = 0.0, details = 0.0, hidden = 0.0, extraction = 0.0;
  double seen = 0.0, wrong = 0.0;  // shares of the columns
};

struct Meshes {
  DetailMesh built;  // buildings and ground
  DetailMesh street;
};

// Rows of the skyline as the town's own meshes show it, at 640 px.
std::vector<float> TrueRows(const Meshes& meshes,
                            bool street,
                            const PinholeCamera& camera,
                            const Pose& pose) {
  std::vector<float> rows(static_cast<std::size_t>(camera.width),
                          static_cast<float>(camera.height));
  AddOutline(meshes.built, camera, pose, rows);
  if (street) AddOutline(meshes.street, camera, pose, rows);
  return rows;
}

void AddFrame(const Query& query,
              const Scene& scene,
              const Eigen::Vector3d& origin,
              const Meshes& meshes,
              const Eigen::Vector3d& town_origin,
              const SkylineTrackOptions& options,
              Sums& sums) {
  const cv::Mat picture = cv::imread(query.image.string(), cv::IMREAD_COLOR);
  if (picture.empty()) throw InputError(query.image.string(), "", "nothing", "a picture");
  const PinholeCamera camera =
      query.camera->Pinhole().Scaled(kSkylineReferenceWidthPx / query.camera->width);
  Pose in_town = *query.truth;
  in_town.center_in_world -= town_origin;
  Pose in_model = *query.truth;
  in_model.center_in_world -= origin;
  const double height = camera.height;

  const std::vector<float> built = TrueRows(meshes, false, camera, in_town);
  const std::vector<float> all = TrueRows(meshes, true, camera, in_town);
  std::vector<float> model(all.size());
  SkylineRows(SkylineDirections(scene.SkylineFrom(in_model.center_in_world, Sector{})),
              camera,
              in_model.cam_from_world.toRotationMatrix().cast<float>(),
              model);
  const Skyline found = ExtractSkyline(picture, options.skyline);
  std::vector<float> real;
  int seen = 0, wrong = 0;
  const double scale = kSkylineReferenceWidthPx / picture.cols;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::size_t k = std::min(
        found.size() - 1,
        static_cast<std::size_t>((static_cast<double>(c) + 0.5) / scale / found.column_step_px));
    real.push_back(static_cast<float>(found.y_px[k] * scale));
    if (found.columns[k] == SkylineColumn::kUnknown) continue;
    ++seen;
    const double off = std::abs(real.back() - std::clamp<double>(all[c], 0, height));
    wrong += off > kWrongPx;
  }
  Sums s;
  s.total = MeanDistance(real, model, height);
  s.least = MeanDistance(all, model, height);
  s.details = MeanDistance(built, model, height);
  s.hidden = MeanDistance(all, built, height);
  s.extraction = MeanDistance(real, all, height);
  s.seen = seen / static_cast<double>(all.size());
  s.wrong = wrong / static_cast<double>(all.size());
  sums.total += s.total;
  sums.least += s.least;
  sums.details += s.details;
  sums.hidden += s.hidden;
  sums.extraction += s.extraction;
  sums.seen += s.seen;
  sums.wrong += s.wrong;
}

int Main(int argc, char** argv) {
  CLI::App app("Where the skylines' distance at the true pose comes from, on synthetic walks.");
  std::vector<std::string> walks;
  std::vector<int> seeds;
  int every = 1;
  app.add_option("--walk", walks, "Folders that ridgeline synth --walk made")->required();
  app.add_option("--seed", seeds, "Their seeds")->required();
  app.add_option("--every", every, "Take every n-th frame");
  CLI11_PARSE(app, argc, argv);
  SkylineTrackOptions options;
  std::printf(
      "| walk | plain L1 at the truth | true skyline to model | overhang, chimneys | trees, lamps "
      "| "
      "extraction | known columns | wrong and known |\n|---|---|---|---|---|---|---|---|\n");
  for (std::size_t w = 0; w < walks.size(); ++w) {
    const Dataset dataset = ReadDataset(walks[w] + "/dataset.json");
    TownOptions town_options;
    town_options.seed = seeds.at(w);
    const Town town = MakeTown(town_options);
    Meshes meshes;
    AddBuildings(town, 0.3, meshes.built);
    AddGround(town, meshes.built);
    AddStreetLife(town, meshes.street);
    const CityModel model = ReadCity(dataset.model, CityOptions{});
    std::vector<std::string> warnings;
    std::optional<HeightGrid> dtm;
    if (dataset.dtm) {
      Eigen::Vector2d lower = model.vertices.front().head<2>(), upper = lower;
      for (const Eigen::Vector3d& v : model.vertices) {
        lower = lower.cwiseMin(v.head<2>());
        upper = upper.cwiseMax(v.head<2>());
      }
      dtm = ReadDtm(*dataset.dtm, model, lower, upper, 200.0, warnings);
    }
    const Scene scene(model, dtm ? &*dtm : nullptr, ProjectionOptions{});
    Sums s;
    int frames = 0;
    for (std::size_t i = 0; i < dataset.queries.size(); i += static_cast<std::size_t>(every)) {
      AddFrame(dataset.queries[i],
               scene,
               model.origin_in_world,
               meshes,
               town.origin_in_world,
               options,
               s);
      ++frames;
    }
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.0f %% | %.1f %% |\n",
                walks[w].c_str(),
                s.total / frames,
                s.least / frames,
                s.details / frames,
                s.hidden / frames,
                s.extraction / frames,
                100 * s.seen / frames,
                100 * s.wrong / frames);
  }
  return 0;
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  try {
    return ridgeline::Main(argc, argv);
  } catch (const ridgeline::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
