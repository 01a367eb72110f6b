// SPDX-License-Identifier: Apache-2.0
#include "camera/decode_file.h"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/limits.h"
#include "base/regular_file.h"

namespace ridgeline {
namespace {

std::uint32_t BigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

// PNG packs a million pixels into a kilobyte; the other formats are bounded by OpenCV.
void CheckSize(std::string_view png, const std::string& file, const std::string& expected) {
  constexpr std::size_t kWidthAt = 16;  // in IHDR, which comes first
  if (!png.starts_with("\x89PNG") || png.size() < kWidthAt + 8) return;
  const std::int64_t width = BigEndian(png.substr(kWidthAt, 4));
  const std::int64_t height = BigEndian(png.substr(kWidthAt + 4, 4));
  const std::int64_t most = limits::PicturePixels(png.size());
  if (width <= most && height <= most && width * height <= most) return;
  throw InputError(file,
                   "limit",
                   std::to_string(width) + " x " + std::to_string(height) + " px",
                   expected + " of at most " + std::to_string(most) + " px");
}

}  // namespace

cv::Mat DecodeFile(const std::filesystem::path& path, int flags, const std::string& expected) {
  RequireRegularFile(path, expected);
  std::string bytes = ReadFile(path);
  if (bytes.empty()) return {};
  CheckSize(bytes, path.string(), expected);
  const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8U, bytes.data());
  try {
    return cv::imdecode(view, flags);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace ridgeline
