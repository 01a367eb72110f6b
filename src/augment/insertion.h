// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "augment/textured_mesh.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/ray_scene.h"
#include "projection/scene.h"

namespace ridgeline {

struct InsertionOptions {
  // Unit vector towards the sun, local frame; below the horizon there is no sun and no shadow.
  Eigen::Vector3d towards_sun = {-0.49, -0.59, 0.64};
  // Shadows: of the new building on itself, on its neighbours and the terrain, and of the city on it.
  bool shadows = false;
  // Rays per pixel, across and down: smooths the outline and the textures.
  int samples = 2;
  // Of the building as a whole, (0, 1].
  double opacity = 1.0;
  // Opacity of the parts that the city hides, hatched; [0, 1].
  double reveal = 0.0;
  // Share of the light that comes from the whole sky, [0, 1].
  double ambient = 0.55;
  int threads = 0;

  // Throws InputError naming the argument, e.g. "--samples".
  void Validate() const;
};

struct Insertion {
  cv::Mat picture;   // 8-bit BGR
  cv::Mat coverage;  // CV_8U: visible share of the building in each pixel, 255: all of it
  double visible_share = 0.0;  // of the picture
  double hidden_share = 0.0;   // of the building's own outline, behind city, terrain or foreground
};

// Unit vector towards a light by its azimuth (clockwise from grid north) and elevation.
Eigen::Vector3d Towards(double azimuth_deg, double elevation_deg);

// Draws a planned building into photos of its surroundings, hidden where the city or its terrain is
// in front of it (Ayadi et al., section 7.1). Thread-safe.
class Inserter {
 public:
  // Both must outlive it; the mesh is in the scene's local frame.
  Inserter(const Scene& city, const TexturedMesh& mesh);

  // @param photo  8-bit BGR, as large as `camera`.
  // @param foreground  What stands before the building though the city model lacks it: CV_8U, as
  //     large, 255: wholly. Empty: nothing.
  // Transparent materials let the photo through, not what is behind them in the building.
  Insertion Insert(const cv::Mat& photo,
                   const PinholeCamera& camera,
                   const Pose& cam_from_local,
                   const InsertionOptions& options,
                   const cv::Mat& foreground = {}) const;

  const TexturedMesh& mesh() const { return mesh_; }

 private:
  struct Strip;
  void DrawStrip(const Strip& strip, cv::Mat& picture, cv::Mat& coverage, cv::Mat& counts) const;
  void ShadeSurroundings(const Strip& strip, cv::Mat& picture) const;
  bool InShadow(const Eigen::Vector3d& point,
                const Eigen::Vector3d& normal,
                const Eigen::Vector3d& towards_sun) const;

  const Scene& city_;
  const TexturedMesh& mesh_;
  const CityModel ray_model_;
  const RayScene building_;
};

}  // namespace ridgeline
