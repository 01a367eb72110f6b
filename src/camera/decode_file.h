// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace ridgeline {

// A mask, a class image or a texture as cv::imread(path, flags) gives it, from a regular file and
// within the limits of pictures; photos come by ReadPicture. Empty if it does not decode.
//
// @param expected  What the file should be, for messages. Throws InputError.
cv::Mat DecodeFile(const std::filesystem::path& path, int flags, const std::string& expected);

}  // namespace ridgeline
