// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <initializer_list>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/random.h"
#include "camera/picture_facts.h"
#include "support/exif_writer.h"
#include "support/xmp_writer.h"

namespace ridgeline {
namespace {

using testing::ExifWriter;
using testing::XmpPacket;
using Directory = testing::ExifWriter::Directory;
using ::testing::HasSubstr;

ExifWriter Camera(bool big_endian = false) {
  ExifWriter exif(big_endian);
  exif.Text(Directory::kImage, 0x0110, "iPhone 12")
      .Short(Directory::kPhoto, 0xa405, 26)
      .Ratios(Directory::kGps, 2, {{48, 1}, {8, 1}, {553123, 10000}})
      .Ratios(Directory::kGps, 4, {{11, 1}, {34, 1}, {44076, 10000}});
  return exif;
}

std::string Xmp() {
  return XmpPacket(
      "xmlns:d=\"http://www.dji.com/drone-dji/1.0/\" d:GimbalYawDegree=\"+10.00\" "
      "d:GimbalPitchDegree=\"-20.00\" d:GimbalRollDegree=\"+0.00\"");
}

std::string Chunk(const std::string& type, const std::string& body) {
  std::string size(4, '\0');
  for (std::size_t i = 0; i < 4; ++i) size[3 - i] = static_cast<char>(body.size() >> (8 * i));
  return size + type + body + "crc_";
}

std::string Png(const std::string& chunks) {
  return "\x89PNG\r\n\x1a\n" + chunks + Chunk("IEND", "");
}

std::string Deflated(const std::string& text) {
  std::string bytes(compressBound(text.size()), '\0');
  uLongf size = bytes.size();
  compress(reinterpret_cast<Bytef*>(bytes.data()),
           &size,
           reinterpret_cast<const Bytef*>(text.data()),
           text.size());
  bytes.resize(size);
  return bytes;
}

// As ImageMagick and exiftool write blocks into PNG texts.
std::string RawProfile(const std::string& kind, const std::string& bytes) {
  std::string text = "\n" + kind + "\n" + std::to_string(bytes.size()) + "\n";
  constexpr const char* kDigits = "0123456789abcdef";
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
    if (i % 36 == 35) text += '\n';
  }
  return text;
}

std::string Webp(const std::string& exif, const std::string& xmp) {
  const auto chunk = [](const std::string& type, const std::string& body) {
    std::string size(4, '\0');
    for (std::size_t i = 0; i < 4; ++i) size[i] = static_cast<char>(body.size() >> (8 * i));
    return type + size + body + (body.size() % 2 == 1 ? std::string(1, '\0') : std::string());
  };
  return "RIFF____WEBP" + chunk("EXIF", exif) + chunk("XMP ", xmp);
}

class PictureFile : public ::testing::Test {
 protected:
  ~PictureFile() override { std::filesystem::remove(path_); }
  PictureFacts Read(const std::string& bytes) {
    WriteFileAtomically(path_, bytes);
    return ReadPictureFacts(path_);
  }
  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) /
                                ("ridgeline_picture_blocks_" + std::to_string(::getpid()));
};

TEST_F(PictureFile, JpegSegments) {
  const std::string scan = "\xff\xda rest";
  const std::string exif = Camera().Block();
  const PictureFacts facts = Read(testing::JpegWith("\xff\xd8" + scan, exif, Xmp()));
  EXPECT_EQ(facts.camera, "iPhone 12");
  EXPECT_NEAR(facts.direction->heading_deg, 10, 1e-9);
  EXPECT_EQ(Read(testing::JpegWith("\xff\xd8" + scan, "", "")).camera, "");
}

// DJI's pictures as orthority's test data has them: a text in front of the packet.
TEST_F(PictureFile, XmpWithTextBeforeIt) {
  for (const char* before : {"DJI meta data ", "\n\n", "<junk>", "\xEF\xBB\xBF"}) {
    const std::string file = testing::JpegWith("\xff\xd8\xff\xda", "", before + Xmp());
    EXPECT_NEAR(Read(file).direction.value().heading_deg, 10, 1e-9) << before;
  }
}

TEST_F(PictureFile, PngChunks) {
  const std::string exif = Camera().Block();
  const std::string head("Exif\0\0", 6);
  const std::string name("XML:com.adobe.xmp\0", 18);
  for (const std::string& chunks :
       {Chunk("eXIf", exif),
        Chunk("eXIf", head + exif),
        Chunk("tEXt", std::string("Raw profile type exif\0", 22) + RawProfile("exif", head + exif)),
        Chunk("zTXt",
              std::string("Raw profile type APP1\0\0", 23) +
                  Deflated(RawProfile("APP1", head + exif)))}) {
    EXPECT_EQ(Read(Png(chunks)).camera, "iPhone 12");
  }
  for (const std::string& chunk :
       {Chunk("iTXt", name + std::string("\0\0\0\0", 4) + Xmp()),
        Chunk("iTXt", name + std::string("\1\0en\0\0", 6) + Deflated(Xmp()))}) {
    EXPECT_NEAR(Read(Png(chunk)).direction.value().heading_deg, 10, 1e-9);
  }
}

TEST_F(PictureFile, WebpChunks) {
  const std::string exif = Camera().Block();
  EXPECT_EQ(Read(Webp(exif, Xmp())).camera, "iPhone 12");
  EXPECT_EQ(Read(Webp(std::string("Exif\0\0", 6) + exif, Xmp())).camera, "iPhone 12");
  EXPECT_NEAR(Read(Webp(exif, Xmp())).direction.value().heading_deg, 10, 1e-9);
}

TEST_F(PictureFile, TiffAndBigTiffWithPointersOfAnyType) {
  for (const bool big_endian : {false, true}) {
    for (const bool big_tiff : {false, true}) {
      for (const std::uint16_t pointer : std::initializer_list<std::uint16_t>{4, 13, 16, 18}) {
        const std::string file = Camera(big_endian)
                                     .Layout(big_tiff, pointer)
                                     .Undefined(Directory::kImage, 700, Xmp())
                                     .Block();
        const PictureFacts facts = Read(file);
        EXPECT_EQ(facts.camera, "iPhone 12") << big_endian << big_tiff << pointer;
        EXPECT_EQ(facts.focal_35mm, 26.0) << big_endian << big_tiff << pointer;
        EXPECT_TRUE(facts.place.has_value()) << big_endian << big_tiff << pointer;
        EXPECT_NEAR(facts.direction.value().heading_deg, 10, 1e-9);
      }
    }
  }
}

TEST_F(PictureFile, RefusesPanoramas) {
  const std::string xmp = XmpPacket(
      "xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
      "GPano:ProjectionType=\"equirectangular\"");
  try {
    Read(testing::JpegWith("\xff\xd8\xff\xda", "", xmp));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("GPano:ProjectionType: got an equirectangular panorama"));
  }
}

// No byte, cut or number makes the parsers read outside of the file, loop, or take much memory; run
// under AddressSanitizer by the dev preset.
TEST_F(PictureFile, HostileBytesAreNoError) {
  const std::string exif = Camera().Undefined(Directory::kImage, 700, Xmp()).Block();
  const std::string big = Camera().Layout(true, 18).Block();
  const std::vector<std::string> files = {
      exif,
      big,
      testing::JpegWith("\xff\xd8\xff\xda", Camera().Block(), Xmp()),
      Png(Chunk("eXIf", exif) +
          Chunk("zTXt", std::string("Raw profile type exif\0\0", 23) + Deflated(exif))),
      Webp(exif, Xmp())};
  Random random(1, HashText("HostileBytes"));
  for (const std::string& file : files) {
    for (std::size_t size = 0; size < file.size(); size += 23) Read(file.substr(0, size));
    for (int i = 0; i < 100; ++i) {
      std::string damaged = file;
      for (int k = 0; k < 4; ++k) {
        const auto at = static_cast<std::size_t>(
            random.Uniform(0.0, static_cast<double>(damaged.size()) - 0.5));
        damaged[at] = static_cast<char>(random.Uniform(0.0, 255.9));
      }
      try {
        Read(damaged);
      } catch (const InputError&) {  // a panorama by chance
      }
    }
  }
}

// A directory that points to itself, and one that claims 65535 items of a megabyte each.
TEST(ParseExif, LoopsAndBombs) {
  const std::string loop("II*\0\x08\0\0\0\x01\0\x69\x87\x04\0\x01\0\0\0\x08\0\0\0\0\0\0\0", 26);
  EXPECT_EQ(ParseExif(loop).photo.size(), 1u);
  std::string bomb("II*\0\x08\0\0\0\xff\xff", 10);
  for (int i = 0; i < 65535; ++i) {
    bomb += static_cast<char>(i);
    bomb += static_cast<char>(i >> 8);
    bomb += std::string("\x01\0\0\0\x0f\0\0\0\0\0", 10);  // bytes, 983040 of them, at 0
  }
  bomb += std::string(1 << 20, 'x');
  std::size_t values = 0;
  for (const auto& [tag, item] : ParseExif(bomb).image) values += item.numbers.size();
  EXPECT_EQ(values, 0u);
}

TEST(ParseXmp, NamesAreBareAndStructuresKept) {
  const XmpProperties properties = ParseXmp(
      XmpPacket("xmlns:a=\"https://www.Maker.com/A/1.0#\" a:X=\"1\"",
                "<a:List><rdf:Seq><rdf:li>first</rdf:li><rdf:li>second</rdf:li></rdf:Seq></a:List>"
                "<a:S rdf:parseType=\"Resource\"><a:Y>2</a:Y></a:S>"));
  EXPECT_EQ(properties.at("maker.com/a/1.0 X"), "1");
  EXPECT_EQ(properties.at("maker.com/a/1.0 List"), "first");
  EXPECT_EQ(properties.at("maker.com/a/1.0 S/Y"), "2");
}

TEST(ParseXmp, DepthIsBounded) {
  std::string deep;
  for (int i = 0; i < 20000; ++i) deep += "<a:b xmlns:a=\"u:v\">";
  ParseXmp(deep + "x");
}

}  // namespace
}  // namespace ridgeline
