// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "input/dataset.h"
#include "localize/localizer.h"
#include "support/synthetic_city.h"

namespace ridgeline::testing {

// A short street and a dataset of one flat-shaded picture of it, in a folder of this process.
class StreetStudy {
 public:
  StreetStudy() : model_(Street()), localizer_(model_, std::nullopt, Options()) {
    std::filesystem::create_directories(folder_);
    Pose truth;
    truth.cam_from_world = CamFromWorld(ViewAngles{4.0, 3.0, 0.0});
    truth.center_in_world = {0.5, -6.0, 1.7};
    Query query;
    query.id = "street, 1";
    query.image = folder_ / "photo.png";
    query.camera = CameraIntrinsics{"PINHOLE", 320, 240, {250.0, 250.0, 160.0, 120.0}};
    cv::imwrite(query.image.string(), Photo(truth, query.camera->Pinhole()));
    truth.center_in_world += model_.origin_in_world;
    query.truth = truth;
    dataset_.name = "street";
    dataset_.file = "street.json";
    dataset_.queries = {query};
    query.id = "unknown";
    query.truth.reset();
    dataset_.queries.push_back(query);
  }
  ~StreetStudy() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  const Dataset& dataset() const { return dataset_; }
  const Localizer& localizer() const { return localizer_; }

 private:
  static CityModel Street() {
    std::vector<House> houses;
    const double eaves[] = {6.0, 9.0, 5.0, 8.0, 11.0, 7.0};
    for (int i = 0; i < 6; ++i) {
      House house;
      house.center = {i % 2 == 0 ? -11.0 : 12.0, 8.0 + 9.0 * i};
      house.length_m = 9.0 + i % 3;
      house.width_m = 8.0;
      house.eaves_m = eaves[i];
      house.ridge_m = eaves[i] + (i % 3 == 0 ? 0.0 : 3.0);
      houses.push_back(house);
    }
    CityModel model = MakeCity(houses);
    model.crs.horizontal_epsg = 25832;
    model.origin_in_world = {690000.0, 5335000.0, 500.0};
    return model;
  }

  static LocalizerOptions Options() {
    LocalizerOptions options;
    options.search.map.heading_step_deg = 2.0;
    return options;
  }

  cv::Mat Photo(const Pose& cam_from_local, const PinholeCamera& camera) const {
    const ViewBuffers buffers = localizer_.scene().Render(camera, cam_from_local);
    cv::Mat picture(camera.height, camera.width, CV_8UC3, cv::Scalar(245, 240, 235));
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        const std::uint32_t surface =
            buffers.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
        if (surface == kNoSurface) {
          const Eigen::Vector3d ray =
              cam_from_local.cam_from_world.conjugate() * camera.RayFromImage({x + 0.5, y + 0.5});
          if (ray.z() < 0.0) picture.at<cv::Vec3b>(y, x) = {70, 70, 70};
          continue;
        }
        const Surface& s = localizer_.scene().model().surfaces[surface];
        const auto shade = static_cast<unsigned char>(110.0 + 50.0 * s.normal.x() +
                                                      25.0 * s.normal.y() + 6.0 * (s.building % 5));
        picture.at<cv::Vec3b>(y, x) = s.surface_class == SurfaceClass::kRoof
                                          ? cv::Vec3b(60, 80, shade)
                                          : cv::Vec3b(shade, shade, shade);
      }
    }
    return picture;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ridgeline_study_" + std::to_string(::getpid()));
  CityModel model_;
  Localizer localizer_;
  Dataset dataset_;
};

}  // namespace ridgeline::testing
