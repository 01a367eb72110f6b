// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "city/city_model.h"

namespace ridgeline {

// How a surface looks.
struct MeshMaterial {
  std::string name;
  cv::Vec3f bgr = {200.0f, 205.0f, 210.0f};  // [0, 255], times the texture's
  float opacity = 1.0f;
  cv::Mat texture;  // CV_8UC3 or CV_8UC4 (BGR, BGRA); empty: none
};

// A building to be drawn: triangles with materials and texture coordinates.
struct TexturedMesh {
  struct Face {
    std::array<std::uint32_t, 3> vertices{};
    std::uint32_t material = 0;
    // Of the corners; v upward, repeated beyond [0, 1].
    std::array<Eigen::Vector2f, 3> uv = {
        Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()};
  };
  std::vector<Eigen::Vector3d> vertices;  // east, north, height [m], in a frame of its own
  std::vector<Face> faces;
  std::vector<MeshMaterial> materials;
  std::vector<std::string> warnings;
};

// Whether a file's ending is one that ReadTexturedMesh() reads with its materials: glTF, GLB, OBJ,
// DAE, FBX, 3DS, PLY, STL.
bool IsTexturedFormat(const std::filesystem::path& path);

// Reads a model by assimp, with materials and textures (embedded, or files beside it). glTF has y
// upward and metres by its standard; the others are taken as they are, east, north, height.
//
// @param y_up  Turns a model with y upward (x right, z towards the viewer) upright; glTF always is.
// Throws InputError for a file that cannot be read or holds no triangles. Textures that are missing
// are named in `warnings`.
TexturedMesh ReadTexturedMesh(const std::filesystem::path& path, bool y_up);

// A city model's building: roofs, walls and the rest in plain colours.
TexturedMesh TexturedFrom(const CityModel& model);

// The mesh turned clockwise, scaled and moved so that the middle of its base comes to `base`.
TexturedMesh PlacedMesh(TexturedMesh mesh,
                        const Eigen::Vector3d& base,
                        double heading_deg,
                        double scale);

// Its triangles as a model that can be looked at by rays: surface i is face i.
CityModel RayModelOf(const TexturedMesh& mesh);

// Colour (BGR, [0, 255]) and opacity of a face at a point (barycentric weights of its corners).
cv::Vec4f ColourAt(const TexturedMesh& mesh,
                   std::uint32_t face,
                   const Eigen::Vector3f& barycentric);

}  // namespace ridgeline
