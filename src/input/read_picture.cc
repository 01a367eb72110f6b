// SPDX-License-Identifier: Apache-2.0
#include "input/read_picture.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/gdal_handles.h"
#include "base/limits.h"
#include "base/regular_file.h"
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

// What a file that does not decode is, where its beginning tells.
std::string KindOf(std::string_view bytes) {
  if (bytes.starts_with("\xff\x0a") || bytes.starts_with(std::string_view("\0\0\0\x0cJXL ", 8))) {
    return "a JPEG XL picture";
  }
  if (bytes.size() < 12 || bytes.substr(4, 4) != "ftyp") return "a file that does not decode";
  const std::string_view brand = bytes.substr(8, 4);  // ISO/IEC 23008-12, annex B
  for (const char* heic : {"heic", "heix", "heim", "heis", "hevc", "hevx", "mif1", "msf1"}) {
    if (brand == heic) return "a HEIC picture";
  }
  if (brand == "avif" || brand == "avis") return "an AVIF picture";
  if (brand == "crx ") return "a CR3 raw picture";
  return "a video or another file of MP4's kind";
}

// Cameras put 10, 12 or 14 bits into a container of 16: brought to its whole range.
cv::Mat InWholeRange(const cv::Mat& picture) {
  if (picture.depth() != CV_16U) return picture;
  const int colours = picture.channels() == 2 || picture.channels() == 4 ? picture.channels() - 1
                                                                         : picture.channels();
  double most = 0.0;
  for (int channel = 0; channel < colours; ++channel) {
    cv::Mat plane;
    cv::extractChannel(picture, plane, channel);
    double largest = 0.0;
    cv::minMaxLoc(plane, nullptr, &largest);
    most = std::max(most, largest);
  }
  constexpr double kWhole = 65535.0;
  for (const int bits : {8, 10, 12, 14}) {
    const double range = (1 << bits) - 1;
    if (most > range) continue;
    cv::Mat whole;
    picture.convertTo(whole, CV_16U, kWhole / range);
    return whole;
  }
  return picture;
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

// The size that a file's header tells, before anything is unpacked; nullopt for other formats.
std::optional<cv::Size> SizeInHeader(const std::string& file) {
  GDALAllRegister();
  const QuietGdal quiet;
  const char* const drivers[] = {"JPEG", "PNG", "GTiff", "WEBP", "BMP", nullptr};
  const GdalDatasetPtr header(
      GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers));
  if (header == nullptr) return std::nullopt;
  return cv::Size(header->GetRasterXSize(), header->GetRasterYSize());
}

void CheckSize(const std::string& file, const cv::Size& size, std::size_t bytes) {
  if (std::min(size.width, size.height) < limits::kLeastPictureSide) {
    throw InputError(
        file,
        "size",
        SizeText(size.width, size.height),
        "a picture of " + std::to_string(limits::kLeastPictureSide) + " px and more on each side");
  }
  const std::int64_t most = limits::PicturePixels(bytes);
  if (std::int64_t{size.width} * size.height <= most) return;
  throw InputError(file,
                   "limit",
                   SizeText(size.width, size.height),
                   "at most " + std::to_string(most) + " px in a file of " + std::to_string(bytes) +
                       " bytes (a smaller copy)");
}

// Empty if it does not decode.
cv::Mat Decoded(const std::string& bytes) {
  if (bytes.empty()) return {};
  const cv::Mat view(1,
                     static_cast<int>(bytes.size()),
                     CV_8U,
                     const_cast<char*>(bytes.data()));  // NOLINT: read only
  try {
    return cv::imdecode(view, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

cv::Mat ReadPicture(const std::filesystem::path& path) {
  RequireRegularFile(path, "a picture");
  const std::string bytes = ReadFile(path);
  if (bytes.starts_with("\xff\xd8") && IsCutOff(bytes)) {
    throw InputError(
        path.string(), "", "a JPEG file that ends early", "a whole one (was the copy cut off?)");
  }
  if (const auto size = SizeInHeader(path.string())) CheckSize(path.string(), *size, bytes.size());
  const cv::Mat picture = Decoded(bytes);
  if (picture.empty()) {
    throw InputError(path.string(),
                     "",
                     KindOf(bytes),
                     "a picture in JPEG, PNG, TIFF or WebP (a converter that keeps the EXIF makes "
                     "one)");
  }
  CheckSize(path.string(), picture.size(), bytes.size());
  if (picture.depth() != CV_8U && picture.depth() != CV_16U) {
    throw InputError(path.string(), "", "pixels of another type", "8 or 16 bit integers");
  }
  return InWholeRange(picture);
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
