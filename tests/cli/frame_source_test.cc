// SPDX-License-Identifier: Apache-2.0
// Films and what is none, as frames of a sequence.
#include "cli/frame_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Frames : public ::testing::Test {
 protected:
  Frames() { fs::create_directories(folder_); }
  ~Frames() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  // Three frames of one brightness each: 40, 120, 200.
  fs::path Film() const {
    const fs::path path = folder_ / "film.avi";
    cv::VideoWriter film(
        path.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0, cv::Size(64, 48));
    for (const int brightness : {40, 120, 200}) {
      film.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(brightness)));
    }
    return path;
  }

  fs::path folder_ =
      fs::temp_directory_path() / ("ridgeline_frames_" + std::to_string(::getpid()));
};

TEST_F(Frames, OfAFilmInAnyOrder) {
  const auto frames = OpenFrames(Film());
  ASSERT_EQ(frames->size(), 3u);
  EXPECT_DOUBLE_EQ(frames->frames_per_second().value(), 10.0);
  for (const int index : {2, 0, 1}) {
    const cv::Mat frame = frames->Read(static_cast<std::size_t>(index));
    EXPECT_NEAR(cv::mean(frame)[1], 40.0 + 80.0 * index, 4.0) << index;
  }
}

// What would have another file opened in its stead, whatever its name says.
TEST_F(Frames, PlaylistsAreNoFilms) {
  const std::string film = Film().string();
  const std::string playlists[] = {
      "ffconcat version 1.0\nfile '" + film + "'\n",
      "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n" + film + "\n#EXT-X-ENDLIST\n",
      "<?xml version=\"1.0\"?>\n<MPD></MPD>\n",
  };
  for (const std::string& playlist : playlists) {
    const fs::path path = Write("film.mp4", playlist);
    try {
      OpenFrames(path);
      ADD_FAILURE() << playlist;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("a text file"));
    }
  }
}

}  // namespace
}  // namespace ridgeline
