// SPDX-License-Identifier: Apache-2.0
#include "report/picture_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

std::string Base64(const std::vector<uchar>& bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = static_cast<std::uint32_t>(bytes[i]) << 16;
    if (count > 1) bits |= static_cast<std::uint32_t>(bytes[i + 1]) << 8;
    if (count > 2) bits |= bytes[i + 2];
    text += kLetters[bits >> 18];
    text += kLetters[(bits >> 12) & 63];
    text += count > 1 ? kLetters[(bits >> 6) & 63] : '=';
    text += count > 2 ? kLetters[bits & 63] : '=';
  }
  return text;
}

// Length of the UTF-8 sequence at the start of `text`; 0 if there is no valid one.
std::size_t Utf8Length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

void WritePicture(const cv::Mat& picture, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  constexpr std::array<std::string_view, 3> kKnown = {".png", ".jpg", ".jpeg"};
  if (std::find(kKnown.begin(), kKnown.end(), extension) == kKnown.end()) {
    throw InputError(
        path.string(), "", "\"" + extension + "\"", "a name that ends in .png or .jpg");
  }
  std::vector<uchar> bytes;
  cv::imencode(extension, picture, bytes);
  WriteFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string JpegDataUrl(const cv::Mat& picture, int max_side_px, int quality) {
  const double scale =
      std::min(1.0, static_cast<double>(max_side_px) / std::max(picture.cols, picture.rows));
  cv::Mat small = picture;
  if (scale < 1.0) cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
  std::vector<uchar> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return "data:image/jpeg;base64," + Base64(bytes);
}

std::string PngDataUrl(const cv::Mat& picture) {
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  return "data:image/png;base64," + Base64(bytes);
}

std::string EscapeMarkup(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = Utf8Length(std::string_view(text).substr(i));
    const char c = length == 0 ? '?' : text[i];
    if (length > 1) {
      escaped += text.substr(i, length);
    } else if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\'') {
      escaped += "&#39;";
    } else if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') {
      escaped += '?';
    } else {
      escaped += c;
    }
    i += std::max<std::size_t>(1, length);
  }
  return escaped;
}

}  // namespace ridgeline
