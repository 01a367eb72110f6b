// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "augment/sun.h"
#include "augment/textured_mesh.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public ::testing::Test {
 protected:
  MeshFiles() { fs::create_directories(folder_); }
  ~MeshFiles() override { fs::remove_all(folder_); }
  void Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("ridgeline_mesh_" + std::to_string(::getpid()));
};

constexpr char kQuad[] =
    "mtllib wall.mtl\nv 0 0 0\nv 4 0 0\nv 4 0 3\nv 0 0 3\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl brick\nf 1/1 2/2 3/3\nusemtl glass\nf 1/1 3/3 4/4\n";
constexpr char kMtl[] = "newmtl brick\nKd 1 1 1\nmap_Kd wall.png\nnewmtl glass\nKd 0.2 0.4 0.6\nd 0.25\n";

// Upper half blue, lower half red.
void WriteTexture(const fs::path& path) {
  cv::Mat texture(8, 8, CV_8UC3, cv::Scalar(0, 0, 255));
  texture.rowRange(0, 4).setTo(cv::Scalar(255, 0, 0));
  cv::imwrite(path.string(), texture);
}

const TexturedMesh::Face& FaceOf(const TexturedMesh& mesh, const std::string& material) {
  for (const TexturedMesh::Face& face : mesh.faces) {
    if (mesh.materials[face.material].name == material) return face;
  }
  throw std::runtime_error("no face of " + material);
}

TEST_F(MeshFiles, ObjWithMaterialsAndTexture) {
  Write("quad.obj", kQuad);
  Write("wall.mtl", kMtl);
  WriteTexture(folder_ / "wall.png");
  const TexturedMesh mesh = ReadTexturedMesh(folder_ / "quad.obj", false);
  ASSERT_EQ(mesh.faces.size(), 2u);
  EXPECT_TRUE(mesh.warnings.empty());
  const auto index = [&](const TexturedMesh::Face& f) {
    return static_cast<std::uint32_t>(&f - mesh.faces.data());
  };
  const std::uint32_t brick = index(FaceOf(mesh, "brick"));
  // Near the corner 2 (bottom right), and near 3 (top right).
  const cv::Vec4f low = ColourAt(mesh, brick, {0.1f, 0.8f, 0.1f});
  EXPECT_GT(low[2], 200.0f);
  EXPECT_LT(low[0], 50.0f);
  const cv::Vec4f high = ColourAt(mesh, brick, {0.1f, 0.1f, 0.8f});
  EXPECT_GT(high[0], 200.0f);
  EXPECT_LT(high[2], 50.0f);
  const cv::Vec4f glass = ColourAt(mesh, index(FaceOf(mesh, "glass")), {0.3f, 0.3f, 0.4f});
  EXPECT_NEAR(glass[0], 0.6f * 255.0f, 1.0f);
  EXPECT_NEAR(glass[2], 0.2f * 255.0f, 1.0f);
  EXPECT_NEAR(glass[3], 0.25f, 0.01f);
  // East, north, height as they are; or turned upright.
  Eigen::AlignedBox3d box, upright;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  EXPECT_NEAR(box.max().z(), 3.0, 1e-6);
  for (const Eigen::Vector3d& v : ReadTexturedMesh(folder_ / "quad.obj", true).vertices) {
    upright.extend(v);
  }
  EXPECT_NEAR(upright.min().y(), -3.0, 1e-6);
  EXPECT_NEAR(upright.max().z(), 0.0, 1e-6);
}

TEST_F(MeshFiles, GltfIsTurnedUpright) {
  // One triangle: (0,0,0), (2,0,0), (0,3,0) with y upward, as base64 of nine floats.
  Write("one.gltf",
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[0,0,-5]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"name":"red","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,0,0,0.5]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,3,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAQEAAAAAA"}]})");
  const TexturedMesh mesh = ReadTexturedMesh(folder_ / "one.gltf", false);
  ASSERT_EQ(mesh.faces.size(), 1u);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  EXPECT_NEAR((box.min() - Eigen::Vector3d(0.0, 5.0, 0.0)).norm(), 0.0, 1e-5);
  EXPECT_NEAR((box.max() - Eigen::Vector3d(2.0, 5.0, 3.0)).norm(), 0.0, 1e-5);
  const cv::Vec4f colour = ColourAt(mesh, 0, {0.3f, 0.3f, 0.4f});
  EXPECT_NEAR(colour[2], 255.0f, 1.0f);
  EXPECT_NEAR(colour[0], 0.0f, 1.0f);
  EXPECT_NEAR(colour[3], 0.5f, 0.01f);
}

TEST_F(MeshFiles, NothingAboveTheFolderIsReadAndWhatIsMissingIsNamed) {
  Write("quad.obj", kQuad);
  Write("wall.mtl", "newmtl brick\nKd 1 1 1\nmap_Kd ../../secret.png\nnewmtl glass\nmap_Kd none.png\n");
  const TexturedMesh mesh = ReadTexturedMesh(folder_ / "quad.obj", false);
  ASSERT_EQ(mesh.warnings.size(), 2u);
  for (const MeshMaterial& material : mesh.materials) EXPECT_TRUE(material.texture.empty());
  EXPECT_THROW(ReadTexturedMesh(folder_ / "none.obj", false), InputError);
  Write("empty.obj", "v 0 0 0\n");
  EXPECT_THROW(ReadTexturedMesh(folder_ / "empty.obj", false), InputError);
}

TEST(PlacedMesh, StandsOnItsBaseTurnedAndScaled) {
  TexturedMesh mesh =
      TexturedFrom(testing::MakeCity({{{0.0, 50.0}, 8.0, 10.0, 0.0, 0.0, 8.0, 8.0}}));
  mesh = PlacedMesh(std::move(mesh), {100.0, 200.0, 7.0}, 90.0, 2.0);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  EXPECT_NEAR((box.min() - Eigen::Vector3d(92.0, 190.0, 7.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((box.max() - Eigen::Vector3d(108.0, 210.0, 23.0)).norm(), 0.0, 1e-6);
}

// Elevations at solar noon are 90 - latitude + declination; the azimuth is south.
TEST(SunAt, SolsticeEquinoxAndTheOtherHemisphere) {
  // Munich's local noon is 12:00 UTC - 11.6 / 15 h, but for the equation of time (-1.8 min in June).
  const double noon = 12.0 - 11.58 / 15.0 + 1.8 / 60.0;
  const SunDirection june = SunAt({2026, 6, 21, noon}, 48.14, 11.58);
  EXPECT_NEAR(june.elevation_deg, 90.0 - 48.14 + 23.44, 0.05);
  EXPECT_NEAR(june.azimuth_deg, 180.0, 0.5);
  const SunDirection december = SunAt({2026, 12, 21, 12.0 - 11.58 / 15.0 - 1.9 / 60.0}, 48.14, 11.58);
  EXPECT_NEAR(december.elevation_deg, 90.0 - 48.14 - 23.44, 0.1);
  // Cape Town: the sun is in the north.
  const SunDirection cape = SunAt({2026, 12, 21, 12.0 - 18.42 / 15.0 - 1.9 / 60.0}, -33.93, 18.42);
  EXPECT_NEAR(std::remainder(cape.azimuth_deg, 360.0), 0.0, 2.0);
  EXPECT_NEAR(cape.elevation_deg, 90.0 - 33.93 + 23.44, 0.1);
  // At the equinox it rises in the east and is in the west in the evening.
  EXPECT_NEAR(SunAt({2026, 3, 20, 6.0 + 7.5 / 60.0}, 0.0, 0.0).azimuth_deg, 90.0, 0.5);
  EXPECT_NEAR(SunAt({2026, 3, 20, 17.5}, 0.0, 0.0).azimuth_deg, 270.0, 1.0);
  EXPECT_LT(SunAt({2026, 3, 20, 23.0}, 0.0, 0.0).elevation_deg, -60.0);
}

TEST(ParseTime, ZonesAndBadTimes) {
  EXPECT_NEAR(ParseTime("2026-06-21T14:30+02:00", "--sun").hours, 12.5, 1e-9);
  EXPECT_NEAR(ParseTime("2026-06-21 14:30:36Z", "--sun").hours, 14.51, 1e-9);
  EXPECT_NEAR(ParseTime("2026-06-21T01:00+02:00", "--sun").hours, -1.0, 1e-9);
  // 24 hours are a day.
  const SunDirection a = SunAt(ParseTime("2026-06-21T01:00+02:00", "--sun"), 48.0, 11.0);
  const SunDirection b = SunAt({2026, 6, 20, 23.0}, 48.0, 11.0);
  EXPECT_NEAR(a.azimuth_deg, b.azimuth_deg, 1e-6);
  for (const char* bad : {"noon", "2026-13-01T10:00", "2026-02-29T10:00", "2026-06-21T25:00",
                          "2026-06-21T10:00+99:00", "2026-06-21T10:00 please"}) {
    EXPECT_THROW(ParseTime(bad, "--sun"), InputError) << bad;
  }
}

}  // namespace
}  // namespace ridgeline
