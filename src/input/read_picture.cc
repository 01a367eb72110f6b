// SPDX-License-Identifier: Apache-2.0
#include "input/read_picture.h"

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "camera/picture_camera.h"

namespace ridgeline {
namespace {

// Whether a JPEG file has no end-of-image marker after its first scan. Segments before the scan may
// hold whole JPEG files (thumbnails); in a scan 0xff is never followed by 0xd9 but at the end.
bool IsCutOff(std::string_view jpeg) {
  std::size_t at = 2;
  while (at + 4 <= jpeg.size() && jpeg[at] == '\xff' && jpeg[at + 1] != '\xda') {
    if (jpeg[at + 1] == '\xff') {
      ++at;
      continue;
    }
    at += 2 + static_cast<unsigned char>(jpeg[at + 2]) * std::size_t{256} +
          static_cast<unsigned char>(jpeg[at + 3]);
  }
  return at >= jpeg.size() || jpeg.find("\xff\xd9", at) == std::string_view::npos;
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

}  // namespace

cv::Mat ReadPicture(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(path.string(), "", "no such file", "a picture");
  }
  const std::string bytes = ReadFile(path);
  if (bytes.starts_with("\xff\xd8") && IsCutOff(bytes)) {
    throw InputError(
        path.string(), "", "a JPEG file that ends early", "a whole one (was the copy cut off?)");
  }
  cv::Mat picture;
  if (!bytes.empty()) {
    const cv::Mat view(1,
                       static_cast<int>(bytes.size()),
                       CV_8U,
                       const_cast<char*>(bytes.data()));  // NOLINT: read only
    picture = cv::imdecode(view, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
  }
  if (picture.empty()) {
    throw InputError(
        path.string(), "", "a file that does not decode", "a picture (JPEG, PNG, TIFF)");
  }
  if (picture.depth() != CV_8U && picture.depth() != CV_16U) {
    throw InputError(path.string(), "", "pixels of another type", "8 or 16 bit integers");
  }
  return picture;
}

namespace {

// The query's picture from the one that is stored.
cv::Mat PictureOf(const Query& query, const cv::Mat& stored) {
  cv::Mat picture = TurnedUpright(stored, query.orientation);
  const bool fits = !query.camera ||
                    (picture.cols == query.camera->width && picture.rows == query.camera->height);
  if (fits) return picture;
  const bool turned = picture.cols == query.camera->height && picture.rows == query.camera->width;
  throw InputError(
      query.image.string(),
      "size",
      SizeText(picture.cols, picture.rows),
      "the camera's " + SizeText(query.camera->width, query.camera->height) +
          (turned ? " (pictures are taken as they are stored, not as EXIF turns them)" : ""));
}

}  // namespace

cv::Mat ReadPicture(const Query& query) { return PictureOf(query, ReadPicture(query.image)); }

cv::Mat PictureReader::Read(const std::filesystem::path& path) {
  if (stored_.empty() || path != path_) {
    stored_ = ReadPicture(path);
    path_ = path;
  }
  return stored_;
}

cv::Mat PictureReader::Read(const Query& query) { return PictureOf(query, Read(query.image)); }

}  // namespace ridgeline
