// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "input/dataset.h"

namespace ridgeline {

// A picture as ridgeline reads all pictures: 8 or 16 bit, as stored, EXIF orientation does not turn
// it. Of 16 bits, where the largest value shows that 8, 10, 12 or 14 are used, those are brought to
// the whole range. Throws InputError if it does not decode (HEIC and others are named) or ends
// early, which OpenCV fills up with grey.
cv::Mat ReadPicture(const std::filesystem::path& path);

// The picture of a query, turned by the query's orientation. Throws InputError also if its size is
// not the query's camera's.
cv::Mat ReadPicture(const Query& query);

// Reads pictures and keeps the last one, so that whoever needs the picture at hand again does not
// decode it again. For one thread.
class PictureReader {
 public:
  // As ReadPicture. The pixels are shared: not to be written.
  cv::Mat Read(const std::filesystem::path& path);
  cv::Mat Read(const Query& query);

 private:
  std::filesystem::path path_;
  cv::Mat stored_;
};

}  // namespace ridgeline
