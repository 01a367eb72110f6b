// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_source.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <opencv2/videoio.hpp>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/regular_file.h"
#include "camera/picture_camera.h"
#include "input/read_picture.h"
#include "localize/localizer.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

bool IsPicture(const fs::path& path) {
  static constexpr std::array kExtensions{
      ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp", ".webp"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

class PictureFiles final : public FrameSource {
 public:
  explicit PictureFiles(std::vector<Query> queries) : queries_(std::move(queries)) {}

  std::size_t size() const override { return queries_.size(); }
  std::string id(std::size_t index) const override { return queries_[index].id; }
  cv::Mat Read(std::size_t index) override {
    const Query& query = queries_[index];
    try {
      return BgrOf(TurnedUpright(ReadPicture(query.image), query.orientation));
    } catch (const InputError&) {
      return {};
    }
  }

 private:
  std::vector<Query> queries_;
};

// A playlist or a description of streams would have other files and addresses opened in its stead.
bool IsText(const fs::path& path) {
  std::array<char, 64> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  const auto end = start.begin() + file.gcount();
  return file.gcount() > 0 && std::none_of(start.begin(), end, [](char c) {
    return (c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
  });
}

cv::VideoCapture Opened(const fs::path& path) {
  if (IsText(path)) {
    throw InputError(path.string(), "", "a text file", "a picture, folder or video");
  }
  return cv::VideoCapture(path.string());
}

class Video final : public FrameSource {
 public:
  explicit Video(const fs::path& path) : capture_(Opened(path)) {
    if (!capture_.isOpened()) {
      throw InputError(
          path.string(), "", "nothing that can be played", "a picture, folder or video");
    }
    count_ = static_cast<std::size_t>(std::max(0.0, capture_.get(cv::CAP_PROP_FRAME_COUNT)));
    if (count_ == 0) throw InputError(path.string(), "", "no frames", "a video with frames");
    frames_per_second_ = capture_.get(cv::CAP_PROP_FPS);
  }

  std::size_t size() const override { return count_; }
  std::string id(std::size_t index) const override { return std::to_string(index); }
  std::optional<double> frames_per_second() const override { return frames_per_second_; }
  cv::Mat Read(std::size_t index) override {
    if (index != next_) capture_.set(cv::CAP_PROP_POS_FRAMES, static_cast<double>(index));
    next_ = index + 1;
    cv::Mat frame;
    capture_.read(frame);
    return frame.clone();
  }

 private:
  cv::VideoCapture capture_;
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  double frames_per_second_ = 0.0;
};

}  // namespace

std::unique_ptr<FrameSource> OpenFrames(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw InputError(path.string(), "", "nothing", "a picture, a folder of pictures or a video");
  }
  std::vector<fs::path> files;
  if (fs::is_directory(path, error)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
      if (IsPicture(entry.path())) files.push_back(entry.path());
    }
    if (files.empty())
      throw InputError(path.string(), "", "no pictures", "JPEG, PNG or TIFF files");
    std::sort(files.begin(), files.end());
  } else if (IsPicture(path)) {
    files.push_back(path);
  } else {
    RequireRegularFile(path, "a picture, a folder of pictures or a video");
    return std::make_unique<Video>(path);
  }
  std::vector<Query> queries(files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    queries[i].id = files[i].stem().string();
    queries[i].image = files[i];
  }
  return FramesOfQueries(queries);
}

std::unique_ptr<FrameSource> FramesOfQueries(const std::vector<Query>& queries) {
  return std::make_unique<PictureFiles>(queries);
}

}  // namespace ridgeline
