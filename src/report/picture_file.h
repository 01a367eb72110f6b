// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace ridgeline {

// Writes a picture as its extension says (.png, .jpg), whole or not at all. Throws InputError for
// another extension, or a file that cannot be written.
void WritePicture(const cv::Mat& picture, const std::filesystem::path& path);

// The picture as JPEG in a data: URL, no side longer than `max_side_px`.
std::string JpegDataUrl(const cv::Mat& picture, int max_side_px, int quality);

// The picture as PNG in a data: URL, as it is.
std::string PngDataUrl(const cv::Mat& picture);

// Text for HTML and XML, in elements and in attributes; bytes that are not UTF-8 become '?'.
std::string EscapeMarkup(const std::string& text);

}  // namespace ridgeline
