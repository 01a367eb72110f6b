// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

namespace ridgeline {

// Frames per second of a film of single pictures.
inline constexpr double kPictureRate = 5.0;

// A film that browsers play: H.264 in .mp4, VP9 in .webm, by OpenCV's FFmpeg. Pictures are fitted
// to the size of the first, at most 1280 px wide.
class Film {
 public:
  // The file is written under a temporary name. Throws InputError for another extension, and for a
  // path that cannot be written.
  Film(const std::filesystem::path& path, double frames_per_second);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  // Throws InputError if there is no encoder.
  void Add(const cv::Mat& bgr);
  // Moves the film to its place; without pictures there is none.
  void Close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
