// SPDX-License-Identifier: Apache-2.0
#include "lines/segments_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/limits.h"

namespace ridgeline {
namespace {

std::filesystem::path Write(const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) /
                                     ("ridgeline_segments_" + std::to_string(::getpid()) + ".txt");
  WriteFileAtomically(path, text);
  return path;
}

const CameraIntrinsics kPinhole{"PINHOLE", 100, 80, {90.0, 90.0, 50.0, 40.0}};

TEST(ReadSegments, ReadsCommentsScoresAndBlankLines) {
  const auto segments =
      ReadSegments(Write("# x0 y0 x1 y1\n1 2 30 4 0.5\n\n5 6 7 8 # a comment\n"), kPinhole);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_TRUE(segments[0].b.isApprox(Eigen::Vector2f(30, 4), 1e-5f));
  EXPECT_FLOAT_EQ(segments[0].strength, 0.5f);
  EXPECT_FLOAT_EQ(segments[1].strength, 1.0f);
  EXPECT_EQ(ReadSegments(Write("\xEF\xBB\xBF"
                               "1 2 30 4\r\n"),
                         kPinhole)
                .size(),
            1u);
}

TEST(ReadSegments, UndistortsTheEnds) {
  const CameraIntrinsics radial{"SIMPLE_RADIAL", 100, 80, {90.0, 50.0, 40.0, -0.1}};
  const Eigen::Vector2d ray(0.4, 0.2);
  const Eigen::Vector2d px = radial.Distort(ray);
  const auto segments = ReadSegments(
      Write(std::to_string(px.x()) + " " + std::to_string(px.y()) + " 50 40\n"), radial);
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_NEAR(segments[0].a.x(), 90.0 * 0.4 + 50.0, 1e-3);  // six decimals in the file
  EXPECT_NEAR(segments[0].a.y(), 90.0 * 0.2 + 40.0, 1e-3);
}

TEST(ReadSegments, BadLinesAreNamedByNumber) {
  for (const char* bad : {"1 2 3 4\n1 2 x 4\n",
                          "1 2 3 4\n1 2 3\n",
                          "1 2 3 4\n1 2 3 nan\n",
                          "1 2 3 4\n1 2 3 9 -1\n",
                          "1 2 3 4\n1 2 3 1e300\n"}) {
    try {
      ReadSegments(Write(bad), kPinhole);
      FAIL() << "nothing thrown for " << bad;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("line 2"), std::string::npos) << e.what();
    }
  }
}

TEST(ReadSegments, MoreThanAPictureHasAreRefused) {
  std::string text;
  for (std::size_t i = 0; i <= limits::kSegments; ++i) text += "1 2 3 4\n";
  EXPECT_THROW(ReadSegments(Write(text), kPinhole), InputError);
}

}  // namespace
}  // namespace ridgeline
