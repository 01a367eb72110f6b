// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "augment/insertion.h"
#include "augment/textured_mesh.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "cli/context.h"
#include "cli/view_input.h"
#include "track/sensors.h"

namespace ridgeline {

struct AugmentArguments {
  ViewArguments view;
  std::vector<std::string> building;
  std::string place;
  double heading_deg = 0.0;
  double scale = 1.0;
  bool y_up = false;
  double light_azimuth_deg = 220.0;
  double light_elevation_deg = 40.0;
  std::string sun;         // time; empty: the light's direction
  std::string foreground;  // picture, folder of pictures by frame id, or "auto"
  std::string impact;      // CSV
  InsertionOptions insert;
  std::string out;
  // Of a film.
  std::string frames;
  std::string poses;
  std::string sensors;
  std::string film;
  std::string stability;  // CSV
  std::vector<std::string> set;
};

// The building in the local frame of a model.
TexturedMesh ReadInsertedBuilding(const AugmentArguments& arguments,
                                  const CityModel& model,
                                  const HeightGrid* dtm,
                                  const Context& context);

// Direction of the light: the sun's at --sun over the building, or as said.
Eigen::Vector3d LightOf(const AugmentArguments& arguments,
                        const CityModel& model,
                        const TexturedMesh& mesh,
                        const Context& context);

// The foreground mask of a photo; empty: none is wanted. @param id  of the frame.
cv::Mat ForegroundOf(const AugmentArguments& arguments,
                     const std::string& id,
                     const cv::Mat& photo,
                     const Scene& city,
                     const PinholeCamera& camera,
                     const Pose& cam_from_local);

// Draws the building into a sequence with poses; an exit code.
int RunAugmentFilm(const AugmentArguments& arguments, const Context& context);

}  // namespace ridgeline
