// SPDX-License-Identifier: Apache-2.0
// Models on a web server that behaves, and that does not.
#include "city/format/web_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/city_text.h"
#include "city/read_city.h"
#include "support/web_server.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

class WebFiles : public ::testing::Test {
 protected:
  WebFiles() {
    options_.cache = folder_.path() / "cache";
    options_.patience_s = 1;
    options_.retries = 0;
    ::setenv("RIDGELINE_CACHE", options_.cache.c_str(), 1);
  }
  ~WebFiles() override { ::unsetenv("RIDGELINE_CACHE"); }

  std::string ErrorOf(const std::string& address) const {
    try {
      FetchWebFile(address, options_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  // Files in the cache that are taken for whole ones.
  std::size_t Kept() const {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(options_.cache, error)) {
      if (entry.path().extension() != ".date") ++count;
    }
    return count;
  }

  TestFolder folder_;
  WebOptions options_;
};

TEST_F(WebFiles, AreFetchedOnceAndAskedForAgain) {
  const std::string text(100000, 'x');
  WebServer server(Files{{"a.txt", text}});
  const auto first = FetchWebFile(server.address() + "/whole/a.txt", options_);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(ReadFile(first->path), text);
  EXPECT_EQ(first->path.extension(), ".txt");
  const auto again = FetchWebFile(server.address() + "/whole/a.txt", options_);
  EXPECT_EQ(again->path, first->path);
  EXPECT_EQ(again->warning, "");
  EXPECT_EQ(server.bodies_sent(), 1);
}

TEST_F(WebFiles, OfAServerThatIsGoneAreTakenFromTheCache) {
  WebServer server(Files{{"a.txt", "content"}});
  const std::string address = server.address() + "/whole/a.txt";
  const auto first = FetchWebFile(address, options_);
  server.Stop();
  const auto again = FetchWebFile(address, options_);
  EXPECT_EQ(again->path, first->path);
  EXPECT_THAT(again->warning, HasSubstr("the copy of an earlier run is used"));
  EXPECT_THAT(ErrorOf(server.address() + "/whole/b.txt"),
              AllOf(HasSubstr("/whole/b.txt: got "), HasSubstr("expected a server that sends")));
}

TEST_F(WebFiles, AreNulloptWhereTheServerHasNone) {
  WebServer server(Files{});
  EXPECT_FALSE(FetchWebFile(server.address() + "/whole/a.txt", options_).has_value());
}

TEST_F(WebFiles, SentByHalfAreNeverKept) {
  WebServer server(Files{{"a.txt", std::string(100000, 'x')}});
  EXPECT_THAT(ErrorOf(server.address() + "/half/a.txt"), HasSubstr("/half/a.txt: got "));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, OfASilentServerAreGivenUp) {
  WebServer server(Files{{"a.txt", std::string(100000, 'x')}});
  EXPECT_THAT(ErrorOf(server.address() + "/mute/a.txt"), HasSubstr("/mute/a.txt: got "));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, OfAServerThatDripsAreGivenUp) {
  WebServer server(Files{{"a.txt", "x"}});
  EXPECT_THAT(ErrorOf(server.address() + "/drip/a.txt"), HasSubstr("/drip/a.txt: got "));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, OfAServerThatSendsJustFastEnoughAreGivenUpInTheEnd) {
  options_.most_s = 2;
  WebServer server(Files{{"a.txt", "x"}});
  EXPECT_THAT(ErrorOf(server.address() + "/trickle/a.txt"), HasSubstr("/trickle/a.txt: got "));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, ThatAreMovedInACircleAreGivenUp) {
  WebServer server(Files{{"a.txt", "x"}});
  EXPECT_THAT(ErrorOf(server.address() + "/circle/a.txt"), HasSubstr("/circle/a.txt: got "));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, ThatAreMovedToThisMachineAreNotTaken) {
  WebServer server(Files{{"a.txt", "x"}});
  EXPECT_THAT(ErrorOf(server.address() + "/moved/a.txt"), HasSubstr("/moved/a.txt: got "));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, WithoutEndAreCutAtTheLimit) {
  options_.most_bytes = 1'000'000;
  WebServer server(Files{{"a.txt", "x"}});
  EXPECT_THAT(ErrorOf(server.address() + "/endless/a.txt"),
              HasSubstr("/endless/a.txt: got more than 1000000 bytes (limit)"));
  EXPECT_EQ(Kept(), 0u);
}

// A server packs 100 MB into 100 kB. Whether the client unpacks them or not, what is kept is small.
TEST_F(WebFiles, PackedOnTheWayAreCountedUnpacked) {
  options_.most_bytes = 1'000'000;
  WebServer server(Files{{"a.txt", "x"}});
  const std::string error = ErrorOf(server.address() + "/gzip/a.txt");
  if (error.empty()) {
    const auto file = FetchWebFile(server.address() + "/gzip/a.txt", options_);
    EXPECT_LE(fs::file_size(file->path), options_.most_bytes);
  } else {
    EXPECT_THAT(error, HasSubstr("got more than 1000000 bytes (limit)"));
    EXPECT_EQ(Kept(), 0u);
  }
}

TEST_F(WebFiles, OfABusyServerAreAnError) {
  WebServer server(Files{{"a.txt", "x"}});
  EXPECT_THAT(ErrorOf(server.address() + "/busy/a.txt"), HasSubstr("500"));
  EXPECT_EQ(Kept(), 0u);
}

TEST_F(WebFiles, AnEarlierWholeCopyOutlivesAHalfOne) {
  WebServer server(Files{{"a.txt", "content"}});
  const std::string address = server.address() + "/whole/a.txt";
  FetchWebFile(address, options_);
  server.SendHalves();
  const auto again = FetchWebFile(address, options_);
  EXPECT_EQ(server.bodies_sent(), 2);
  EXPECT_EQ(ReadFile(again->path), "content");
  EXPECT_THAT(again->warning, HasSubstr("the copy of an earlier run is used"));
  EXPECT_EQ(Kept(), 1u);
}

TEST_F(WebFiles, WithoutLengthAndDateAreFetchedEachTime) {
  WebServer server(Files{{"a.txt", "content"}});
  for (int run = 1; run <= 2; ++run) {
    EXPECT_EQ(ReadFile(FetchWebFile(server.address() + "/undated/a.txt", options_)->path),
              "content");
    EXPECT_EQ(server.bodies_sent(), run);
  }
}

TEST_F(WebFiles, ModelsAreReadFromTheServer) {
  const std::string model = GmlDocument(GmlBox("a", kCorner, kCorner + Eigen::Vector3d(10, 8, 6)));
  WebServer server(Files{{"town.gml", model}});
  EXPECT_EQ(ReadCity({server.address() + "/whole/town.gml"}, {}).buildings.size(), 1u);
  // Without a length no one can tell that half is missing; the reader does.
  WebServer cut(Files{{"town.gml", model.substr(0, model.size() / 2)}});
  try {
    ReadCity({cut.address() + "/undated/town.gml"}, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("a file that ends early"));
  }
}

TEST_F(WebFiles, TilesAreThoseAroundThePlace) {
  const double east = std::floor(kCorner.x() / 2000.0) * 2.0;
  const double north = std::floor(kCorner.y() / 2000.0) * 2.0;
  const std::string name = "LoD2_" + std::to_string(static_cast<int>(east)) + "_" +
                           std::to_string(static_cast<int>(north)) + ".gml";
  WebServer server(
      Files{{name, GmlDocument(GmlBox("a", kCorner, kCorner + Eigen::Vector3d(10, 8, 6)))}});
  CityOptions options;
  options.region.emplace();
  options.region->positions.extend(Eigen::Vector2d(kCorner.head<2>()));
  const std::string address = server.address() + "/whole/LoD2_{east/2}_{north/2}.gml";
  const CityModel model = ReadCity({address}, options);
  EXPECT_EQ(model.buildings.size(), 1u);
  options.region->positions = Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.0));
  try {
    ReadCity({address}, options);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("tiles on the server"));
  }
}

TEST(TileAddresses, NameEveryTileThatTheBoxTouches) {
  Eigen::AlignedBox2d box(Eigen::Vector2d(690500, 5335900), Eigen::Vector2d(691500, 5336100));
  EXPECT_THAT(TileAddresses("http://h/{east}_{north}.gml", box),
              ::testing::ElementsAre("http://h/690_5335.gml",
                                     "http://h/690_5336.gml",
                                     "http://h/691_5335.gml",
                                     "http://h/691_5336.gml"));
  EXPECT_THAT(TileAddresses("http://h/{east/2}_{north/2}.gml", box),
              ::testing::ElementsAre("http://h/690_5334.gml", "http://h/690_5336.gml"));
  EXPECT_THROW(TileAddresses("http://h/{easting}_{north}.gml", box), InputError);
  EXPECT_THROW(TileAddresses("http://h/{east/0}_{north}.gml", box), InputError);
}

}  // namespace
}  // namespace ridgeline::testing
