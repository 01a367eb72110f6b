// SPDX-License-Identifier: Apache-2.0
#include "base/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace ridgeline {
namespace {

struct Inner {
  int count = 3;
  std::vector<double> weights = {1.0, 2.0};
  void Visit(OptionVisitor& v) {
    v.Field("count", count, AtLeast(1));
    v.Field("weights", weights, Open(0.0, 10.0));
    v.Rule("weights", !weights.empty(), "no weights", "at least one");
  }
};

struct Outer {
  double length_px = 25.0;
  bool merge = false;
  std::string detector = "lsd";
  Inner inner;
  void Visit(OptionVisitor& v) {
    v.Field("length_px", length_px, Positive());
    v.Field("merge", merge);
    v.Field("detector", detector, OneOf{{"lsd", "fld", "edlines"}});
    v.Group("inner", [this](OptionVisitor& g) { inner.Visit(g); });
  }
};

VisitOptions Visitor(Outer& options) {
  return [&options](OptionVisitor& v) { options.Visit(v); };
}

std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Options, JsonRoundTripKeepsEveryField) {
  Outer written;
  written.length_px = 0.1;
  written.merge = true;
  written.detector = "fld";
  written.inner = {7, {0.25}};
  const std::string json = OptionsToJson(Visitor(written));
  Outer read;
  OptionsFromJson(json, "a.json", Visitor(read));
  EXPECT_EQ(OptionsToJson(Visitor(read)), json);
}

TEST(Options, AbsentKeysKeepTheirValues) {
  Outer options;
  OptionsFromJson(R"({"inner": {"count": 9}})", "a.json", Visitor(options));
  EXPECT_EQ(options.inner.count, 9);
  EXPECT_EQ(options.inner.weights.size(), 2u);
  EXPECT_EQ(options.length_px, 25.0);
}

TEST(Options, UnknownKeyNamesTheNearest) {
  Outer options;
  const std::string message = MessageOf(
      [&] { OptionsFromJson(R"({"inner": {"cuont": 9}})", "a.json", Visitor(options)); });
  EXPECT_EQ(message, "a.json: inner.cuont: got an unknown key, expected e.g. \"inner.count\"");
}

TEST(Options, WrongTypesAreNamed) {
  Outer options;
  EXPECT_EQ(MessageOf([&] { SetOption("length_px=long", Visitor(options)); }),
            "--set: length_px: got \"long\", expected a number");
  EXPECT_EQ(MessageOf([&] { SetOption("inner.count=1.5", Visitor(options)); }),
            "--set: inner.count: got 1.5, expected a whole number");
  EXPECT_EQ(MessageOf([&] { SetOption("inner=4", Visitor(options)); }),
            "--set: inner: got 4, expected an object { \"count\": ..., ... }");
  EXPECT_EQ(MessageOf([&] { SetOption("length_px", Visitor(options)); }),
            "--set: got \"length_px\", expected path.to.key=value");
}

TEST(Options, SetReachesNestedFieldsAndBareWords) {
  Outer options;
  SetOption("inner.weights=[4,5,6]", Visitor(options));
  SetOption("detector=edlines", Visitor(options));
  EXPECT_THAT(options.inner.weights, testing::ElementsAre(4.0, 5.0, 6.0));
  EXPECT_EQ(options.detector, "edlines");
}

TEST(Options, ValuesOutOfRangeAreNamedWithTheirPath) {
  const auto message = [](const std::string& assignment) {
    Outer options;
    SetOption(assignment, Visitor(options));
    return MessageOf([&] { CheckOptions(options, "outer"); });
  };
  EXPECT_EQ(message("merge=true"), "no error");
  EXPECT_EQ(message("length_px=0"), "outer.length_px: got 0, expected > 0");
  EXPECT_EQ(message("inner.count=-3"), "outer.inner.count: got -3, expected >= 1");
  EXPECT_EQ(message("inner.weights=[1,10]"), "outer.inner.weights: got 10, expected (0, 10)");
  EXPECT_EQ(message("detector=sobel"),
            "outer.detector: got \"sobel\", expected lsd, fld or edlines");
  EXPECT_EQ(message("inner.weights=[]"),
            "outer.inner.weights: got no weights, expected at least one");
}

TEST(Options, RangesAreListed) {
  Outer options;
  EXPECT_EQ(OptionsWithRanges(Visitor(options)),
            "length_px      25.0       > 0\n"
            "merge          false      true or false\n"
            "detector       \"lsd\"      lsd, fld or edlines\n"
            "inner.count    3          >= 1, whole\n"
            "inner.weights  [1.0,2.0]  each (0, 10)\n");
}

TEST(NumberRange, HoldsWhatItsTextSays) {
  const double nan = std::nan("");
  EXPECT_TRUE(Closed(0.0, 1.0).Holds(0.0) && Closed(0.0, 1.0).Holds(1.0));
  EXPECT_FALSE(Closed(0.0, 1.0).Holds(1.0001) || Closed(0.0, 1.0).Holds(nan));
  EXPECT_FALSE(Open(0.0, 1.0).Holds(0.0) || Open(0.0, 1.0).Holds(1.0));
  EXPECT_TRUE(LeftOpen(0.0, 1.0).Holds(1.0) && RightOpen(0.0, 1.0).Holds(0.0));
  EXPECT_FALSE(LeftOpen(0.0, 1.0).Holds(0.0) || RightOpen(0.0, 1.0).Holds(1.0));
  EXPECT_TRUE(AnyNumber().Holds(-1e300));
  EXPECT_FALSE(AnyNumber().Holds(nan) || AnyNumber().Holds(INFINITY));
  EXPECT_FALSE(Positive().Holds(nan) || Positive().Holds(0.0));
  EXPECT_EQ(LeftOpen(0.0, 90.0).Text(), "(0, 90]");
  EXPECT_EQ(RightOpen(1e-6, 10000000.0).Text(), "[1e-06, 10000000)");
  EXPECT_EQ(MoreThan(3.0, "canny_low").Text(), "> canny_low");
  EXPECT_EQ(AnyNumber().Text(), "any number");
}

TEST(Options, BrokenJsonNamesThePlace) {
  Outer options;
  EXPECT_THAT(MessageOf([&] { OptionsFromJson("{\"merge\": tru", "a.json", Visitor(options)); }),
              testing::StartsWith("a.json: byte "));
}

TEST(NearestName, IsByEditDistance) {
  EXPECT_EQ(NearestName("heding", {"heading", "height", "pitch"}), "heading");
  EXPECT_EQ(NearestName("x", {}), "");
}

}  // namespace
}  // namespace ridgeline
