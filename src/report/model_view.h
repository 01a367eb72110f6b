// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "city/city_model.h"
#include "projection/view_buffers.h"

namespace ridgeline {

// Pictures of a rendered view (Scene::Render).

// Depth along the optical axis in whole centimetres, CV_16U; 0: sky, 65535: farther than 655 m.
cv::Mat DepthPicture(const ViewBuffers& view);

// Surface index + 1 as red * 65536 + green * 256 + blue, CV_8UC3 (BGR in memory); 0: sky, 0xFFFFFF:
// terrain.
cv::Mat IdPicture(const ViewBuffers& view);

// A shaded view for people: roofs red, walls grey, ground green, sky blue; needs normals.
cv::Mat ShadedPicture(const ViewBuffers& view, const CityModel& model);

}  // namespace ridgeline
