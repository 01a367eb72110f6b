// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "input/dataset.h"

namespace ridgeline {

// The pictures of a sequence, in order.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::size_t size() const = 0;
  // Name of a frame: of a file without its extension; of a video frame its number.
  virtual std::string id(std::size_t index) const = 0;
  // Frames per second; nullopt: single pictures.
  virtual std::optional<double> frames_per_second() const { return std::nullopt; }
  // 8-bit BGR; empty: the frame is missing or cannot be read. Fastest with rising indices.
  virtual cv::Mat Read(std::size_t index) = 0;
};

// A picture, a folder of pictures (ordered by name) or a video. Throws InputError if there is
// nothing to read.
std::unique_ptr<FrameSource> OpenFrames(const std::filesystem::path& path);

// The pictures of a dataset's queries, whether they exist or not.
std::unique_ptr<FrameSource> FramesOfQueries(const std::vector<Query>& queries);

}  // namespace ridgeline
