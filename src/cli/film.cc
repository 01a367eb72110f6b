// SPDX-License-Identifier: Apache-2.0
#include "cli/film.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

constexpr int kMaxWidthPx = 1280;

}  // namespace

struct Film::Impl {
  std::filesystem::path path;
  std::filesystem::path temporary;
  double frames_per_second = 10.0;
  cv::Size size;
  cv::VideoWriter writer;
};

Film::Film(const std::filesystem::path& path, double frames_per_second)
    : impl_(std::make_unique<Impl>()) {
  const std::string extension = path.extension().string();
  if (extension != ".mp4" && extension != ".webm") {
    throw InputError(path.string(), "", "a film of another kind", "a name ending in .mp4 or .webm");
  }
  impl_->path = path;
  impl_->temporary = TemporaryBeside(path);
  impl_->frames_per_second = frames_per_second;
}

Film::~Film() = default;

void Film::Add(const cv::Mat& bgr) {
  if (!impl_->writer.isOpened()) {
    const double scale = std::min(1.0, static_cast<double>(kMaxWidthPx) / bgr.cols);
    // Encoders want even sizes.
    impl_->size = {static_cast<int>(bgr.cols * scale) / 2 * 2,
                   static_cast<int>(bgr.rows * scale) / 2 * 2};
    const bool mp4 = impl_->path.extension() == ".mp4";
    const int codec = mp4 ? cv::VideoWriter::fourcc('a', 'v', 'c', '1')
                          : cv::VideoWriter::fourcc('V', 'P', '9', '0');
    impl_->writer.open(impl_->temporary.string(),
                       cv::CAP_FFMPEG,
                       codec,
                       impl_->frames_per_second,
                       impl_->size);
    if (!impl_->writer.isOpened()) {
      throw InputError(impl_->path.string(),
                       "",
                       mp4 ? "no encoder for H.264" : "no encoder for VP9",
                       std::string("OpenCV with FFmpeg, or a name ending in ") +
                           (mp4 ? ".webm" : ".mp4"));
    }
  }
  cv::Mat fitted = bgr;
  if (bgr.size() != impl_->size) cv::resize(bgr, fitted, impl_->size, 0, 0, cv::INTER_AREA);
  impl_->writer.write(fitted);
}

void Film::Close() {
  if (!impl_->writer.isOpened()) return;
  impl_->writer.release();
  CommitFile(impl_->temporary, impl_->path);
}

}  // namespace ridgeline
