// SPDX-License-Identifier: Apache-2.0
#include "augment/textured_mesh.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

enum PlainMaterial : std::uint32_t { kPlainWall, kPlainRoof, kPlainOther };

cv::Vec4f Texel(const cv::Mat& texture, int x, int y) {
  if (texture.channels() == 4) {
    const cv::Vec4b& p = texture.at<cv::Vec4b>(y, x);
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]),
            p[3] / 255.0f};
  }
  const cv::Vec3b& p = texture.at<cv::Vec3b>(y, x);
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 1.0f};
}

int Wrapped(int i, int size) { return ((i % size) + size) % size; }

// Bilinear, repeated; v is upward.
cv::Vec4f Sample(const cv::Mat& texture, const Eigen::Vector2f& uv) {
  const float x = (uv.x() - std::floor(uv.x())) * texture.cols - 0.5f;
  const float y = (1.0f - (uv.y() - std::floor(uv.y()))) * texture.rows - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float fx = x - x0, fy = y - y0;
  const auto at = [&](int dx, int dy) {
    return Texel(texture, Wrapped(x0 + dx, texture.cols), Wrapped(y0 + dy, texture.rows));
  };
  return (at(0, 0) * (1.0f - fx) + at(1, 0) * fx) * (1.0f - fy) +
         (at(0, 1) * (1.0f - fx) + at(1, 1) * fx) * fy;
}

}  // namespace

TexturedMesh TexturedFrom(const CityModel& model) {
  TexturedMesh mesh;
  mesh.vertices = model.vertices;
  mesh.materials = {{"wall", {205.0f, 218.0f, 228.0f}, 1.0f, {}},
                    {"roof", {90.0f, 105.0f, 165.0f}, 1.0f, {}},
                    {"other", {190.0f, 195.0f, 200.0f}, 1.0f, {}}};
  for (const Triangle& triangle : model.triangles) {
    TexturedMesh::Face face;
    face.vertices = triangle.vertices;
    switch (model.surfaces[triangle.surface].surface_class) {
      case SurfaceClass::kWall:
        face.material = kPlainWall;
        break;
      case SurfaceClass::kRoof:
        face.material = kPlainRoof;
        break;
      default:
        face.material = kPlainOther;
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

TexturedMesh PlacedMesh(TexturedMesh mesh,
                        const Eigen::Vector3d& base,
                        double heading_deg,
                        double scale) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  const Eigen::Vector3d middle(box.center().x(), box.center().y(), box.min().z());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(-heading_deg * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  for (Eigen::Vector3d& v : mesh.vertices) v = base + scale * (turn * (v - middle));
  return mesh;
}

CityModel RayModelOf(const TexturedMesh& mesh) {
  CityModel model;
  model.buildings.emplace_back();
  model.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto& v = mesh.faces[i].vertices;
    Surface surface;
    surface.normal = (mesh.vertices[v[1]] - mesh.vertices[v[0]])
                         .cross(mesh.vertices[v[2]] - mesh.vertices[v[0]])
                         .normalized()
                         .cast<float>();
    if (!surface.normal.allFinite()) surface.normal = Eigen::Vector3f::UnitZ();
    model.surfaces.push_back(surface);
    model.triangles.push_back({v, static_cast<std::uint32_t>(i)});
  }
  return model;
}

cv::Vec4f ColourAt(const TexturedMesh& mesh,
                   std::uint32_t face,
                   const Eigen::Vector3f& barycentric) {
  const TexturedMesh::Face& f = mesh.faces[face];
  const MeshMaterial& material = mesh.materials[f.material];
  cv::Vec4f colour(material.bgr[0], material.bgr[1], material.bgr[2], material.opacity);
  if (material.texture.empty()) return colour;
  const Eigen::Vector2f uv =
      barycentric[0] * f.uv[0] + barycentric[1] * f.uv[1] + barycentric[2] * f.uv[2];
  const cv::Vec4f texel = Sample(material.texture, uv);
  for (int c = 0; c < 3; ++c) colour[c] *= texel[c] / 255.0f;
  colour[3] *= texel[3];
  return colour;
}

}  // namespace ridgeline
