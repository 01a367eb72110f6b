// SPDX-License-Identifier: Apache-2.0
#include "input/read_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;

class PictureToRead : public ::testing::Test {
 protected:
  ~PictureToRead() override { std::filesystem::remove(path_); }
  cv::Mat Read(const std::string& bytes) {
    WriteFileAtomically(path_, bytes);
    return ReadPicture(path_);
  }
  cv::Mat ReadPng(const cv::Mat& picture) {
    std::vector<uchar> png;
    cv::imencode(".png", picture, png);
    return Read(std::string(png.begin(), png.end()));
  }
  std::string Message(const std::string& bytes) {
    try {
      Read(bytes);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) /
                                ("ridgeline_read_picture_" + std::to_string(::getpid()));
};

TEST_F(PictureToRead, DeepPicturesFillTheWholeRange) {
  for (const int bits : {10, 12, 14, 16}) {
    const int most = (1 << bits) - 1;
    cv::Mat stored(40, 40, CV_16UC3, cv::Scalar(0, most / 3, most));
    const cv::Mat read = ReadPng(stored);
    ASSERT_EQ(read.depth(), CV_16U);
    const auto pixel = read.at<cv::Vec3w>(1, 1);
    EXPECT_EQ(pixel[0], 0) << bits;
    EXPECT_EQ(pixel[1], 21845) << bits;
    EXPECT_EQ(pixel[2], 65535) << bits;
  }
}

// An alpha channel that fills its range does not tell the depth of the colours.
TEST_F(PictureToRead, AlphaIsNoColour) {
  const cv::Mat read = ReadPng(cv::Mat(40, 40, CV_16UC4, cv::Scalar(0, 0, 4095, 65535)));
  EXPECT_EQ(read.at<cv::Vec4w>(0, 0)[2], 65535);
}

TEST_F(PictureToRead, EightBitsAreAsStored) {
  const cv::Mat read = ReadPng(cv::Mat(40, 40, CV_8UC3, cv::Scalar(1, 2, 3)));
  EXPECT_EQ(read.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
}

TEST_F(PictureToRead, OtherFormatsAreNamed) {
  const auto iso = [](const std::string& brand) {
    return std::string(
               "\0\0\0\x18"
               "ftyp",
               8) +
           brand + std::string(16, '\0');
  };
  EXPECT_THAT(Message(iso("heic")), HasSubstr("got a HEIC picture, expected a picture in JPEG"));
  EXPECT_THAT(Message(iso("mif1")), HasSubstr("got a HEIC picture"));
  EXPECT_THAT(Message(iso("crx ")), HasSubstr("got a CR3 raw picture"));
  EXPECT_THAT(Message(iso("mp42")), HasSubstr("got a video"));
  EXPECT_THAT(Message("\xff\x0a..............."), HasSubstr("got a JPEG XL picture"));
  EXPECT_THAT(Message("hello"), HasSubstr("got a file that does not decode"));
}

TEST_F(PictureToRead, PicturesTooSmallToShowAnything) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 480), cv::Size(480, 23)}) {
    std::vector<uchar> png;
    cv::imencode(".png", cv::Mat::zeros(size, CV_8UC3), png);
    EXPECT_THAT(
        Message(std::string(png.begin(), png.end())),
        HasSubstr("size: got " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                  " px, expected a picture of 24 px and more on each side"));
  }
}

// 30 MP of one colour in a few kB are no photo; nothing is unpacked.
TEST_F(PictureToRead, PicturesThatGrowBeyondMeasure) {
  std::vector<uchar> png;
  cv::imencode(".png", cv::Mat::zeros(5000, 6000, CV_8U), png, {cv::IMWRITE_PNG_COMPRESSION, 9});
  ASSERT_LT(png.size(), 100'000u);
  EXPECT_THAT(Message(std::string(png.begin(), png.end())),
              HasSubstr("limit: got 6000 x 5000 px, expected at most 25000000 px in a file of"));
}

// A header that announces more than the decoder takes.
TEST_F(PictureToRead, HeadersOfEnormousPictures) {
  std::string bytes = "P6 100000 100000 255\n" + std::string(100, '\0');
  EXPECT_THAT(Message(bytes), HasSubstr("got a file that does not decode"));
  bytes = std::string("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0", 18) +
          std::string("\xa0\x86\x01\0\xa0\x86\x01\0\1\0\x18\0", 12) + std::string(120, '\0');
  EXPECT_THAT(Message(bytes), HasSubstr("limit: got 100000 x 100000 px"));
}

}  // namespace
}  // namespace ridgeline
