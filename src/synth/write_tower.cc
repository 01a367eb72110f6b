// SPDX-License-Identifier: Apache-2.0
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "synth/write_tower.h"

namespace ridgeline {
namespace {

constexpr int kFloors = 9;
constexpr double kHalfM = 6.0;
constexpr double kFloorM = 3.2;

// A floor of one bay: a window in light render.
cv::Mat FacadeTexture() {
  cv::Mat texture(64, 64, CV_8UC3, cv::Scalar(205, 222, 232));
  cv::rectangle(texture, cv::Rect(16, 14, 32, 36), cv::Scalar(120, 95, 70), cv::FILLED);
  cv::rectangle(texture, cv::Rect(16, 14, 32, 36), cv::Scalar(245, 248, 250), 2);
  cv::line(texture, {32, 14}, {32, 50}, cv::Scalar(245, 248, 250), 2);
  cv::line(texture, {0, 63}, {63, 63}, cv::Scalar(170, 185, 195), 1);
  return texture;
}

}  // namespace

void WriteDemoTower(const std::filesystem::path& folder) {
  std::vector<uchar> png;
  cv::imencode(".png", FacadeTexture(), png);
  WriteFileAtomically(folder / "tower.png",
                      {reinterpret_cast<const char*>(png.data()), png.size()});
  WriteFileAtomically(folder / "tower.mtl",
                      "newmtl facade\nKd 1 1 1\nmap_Kd tower.png\n"
                      "newmtl roof\nKd 0.45 0.46 0.48\n");
  const std::string x = std::to_string(kHalfM), top = std::to_string(kFloors * kFloorM);
  std::string obj = "# A planned building for `ridgeline augment`: east, north, height [m]\n"
                    "mtllib tower.mtl\n";
  for (const std::string& z : {std::string("0"), top}) {
    obj += "v -" + x + " -" + x + " " + z + "\nv " + x + " -" + x + " " + z + "\nv " + x + " " + x +
           " " + z + "\nv -" + x + " " + x + " " + z + "\n";
  }
  // Four bays a side, one repeat of the texture a floor.
  obj += "vt 0 0\nvt 4 0\nvt 4 " + std::to_string(kFloors) + "\nvt 0 " + std::to_string(kFloors) +
         "\nusemtl facade\n"
         "f 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\nf 4/1 1/2 5/3 8/4\n"
         "usemtl roof\nf 5/1 6/2 7/3 8/4\nf 4/1 3/2 2/3 1/4\n";
  WriteFileAtomically(folder / "tower.obj", obj);
}

}  // namespace ridgeline
