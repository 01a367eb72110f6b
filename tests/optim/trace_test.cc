// SPDX-License-Identifier: Apache-2.0
#include "optim/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "base/atomic_file.h"
#include "base/error.h"
#include "optim/functions.h"
#include "optim/minimize.h"
#include "optim/modes.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

class TraceFile : public testing::Test {
 protected:
  TraceFile()
      : path_(fs::temp_directory_path() /
              ("ridgeline_trace_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
               ".jsonl")) {}
  ~TraceFile() override { fs::remove(path_); }

  std::string ErrorOf(const std::string& content) const {
    WriteFileAtomically(path_, content);
    try {
      ReadTrace(path_, box_);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path_.string().size());
    }
    return "";
  }

  fs::path path_;
  SearchBox box_ = PoseLikeBox();
};

SamplerOptions Tpe() {
  SamplerOptions options;
  options.name = "tpe";
  return options;
}

Energy Moody() {
  return [](std::span<const double> v) {
    if (v[0] > 10.0) throw std::runtime_error("bad \"place\" \xff");
    if (v[0] < -10.0) return std::numeric_limits<double>::infinity();
    return PoseLikeEnergy(v);
  };
}

TEST_F(TraceFile, ReadsBackWhatWasWrittenBitForBit) {
  MinimizeOptions options;
  options.budget = 60;
  const Trace written = Minimize(*MakeSampler(Tpe(), {box_, {}, {}}, 1), Moody(), options);
  WriteTrace(path_, box_, written);
  const Trace read = ReadTrace(path_, box_);
  ASSERT_EQ(read.trials.size(), written.trials.size());
  for (std::size_t i = 0; i < read.trials.size(); ++i) {
    EXPECT_EQ(read.trials[i].index, written.trials[i].index);
    EXPECT_EQ(read.trials[i].values, written.trials[i].values);
    EXPECT_EQ(read.trials[i].state, written.trials[i].state);
    if (read.trials[i].state == TrialState::kComplete) {
      EXPECT_EQ(read.trials[i].energy, written.trials[i].energy);
    }
  }
}

TEST_F(TraceFile, SearchContinuesFromAFile) {
  MinimizeOptions options;
  options.budget = 80;
  options.batch = 4;
  const Trace whole = Minimize(*MakeSampler(Tpe(), {box_, {}, {}}, 1), Moody(), options);
  options.budget = 30;
  WriteTrace(path_, box_, Minimize(*MakeSampler(Tpe(), {box_, {}, {}}, 1), Moody(), options));
  options.budget = 80;
  const Trace continued =
      Minimize(*MakeSampler(Tpe(), {box_, {}, {}}, 1), Moody(), options, ReadTrace(path_, box_));
  ASSERT_EQ(continued.trials.size(), whole.trials.size());
  for (std::size_t i = 0; i < whole.trials.size(); ++i) {
    EXPECT_EQ(continued.trials[i].values, whole.trials[i].values);
  }
}

TEST_F(TraceFile, MalformedFilesNameTheLine) {
  WriteTrace(path_, box_, {});
  const std::string header = ReadFile(path_);
  EXPECT_EQ(ErrorOf(header), "");
  EXPECT_NE(ErrorOf("").find("line 1"), std::string::npos);
  EXPECT_NE(ErrorOf("{}\n").find(": line 1: got no trace header"), std::string::npos);
  EXPECT_NE(ErrorOf("{\"ridgeline_trace\":2}\n").find("ridgeline_trace: got 2"), std::string::npos);
  EXPECT_NE(ErrorOf("{\"ridgeline_trace\":1,\"parameters\":[]}\n").find("line 1: parameters"),
            std::string::npos);
  EXPECT_NE(ErrorOf(header + "{\"index\":0,\n").find(": line 2"), std::string::npos);
  const std::string good = R"({"index":0,"values":[0,0,1.7,0,0],"energy":0.5,"state":"complete"})"
                           "\n";
  EXPECT_EQ(ErrorOf(header + good), "");
  EXPECT_NE(ErrorOf(header + good + good).find(": line 3: index: got 0, expected 1"),
            std::string::npos);
  const std::string outside =
      R"({"index":0,"values":[99,0,1.7,0,0],"energy":0.5,"state":"complete"})"
      "\n";
  EXPECT_NE(ErrorOf(header + outside).find(": line 2: values"), std::string::npos);
  const std::string unknown = R"({"index":0,"values":[0,0,1.7,0,0],"state":"odd"})"
                              "\n";
  EXPECT_NE(ErrorOf(header + unknown).find("the state \"odd\""), std::string::npos);
  const std::string without = R"({"index":0,"values":[0,0,1.7,0,0],"state":"complete"})"
                              "\n";
  EXPECT_NE(ErrorOf(header + without).find(": line 2"), std::string::npos);
}

TEST(SearchBox, BadBoxesAreErrors) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto message = [](std::vector<Parameter> parameters) {
    try {
      MakeSampler(Tpe(), {{std::move(parameters)}, {}, {}}, 1);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({}), "search: got no parameters, expected at least one");
  EXPECT_EQ(message({{"east_m", 3.0, 2.0}}), "search.east_m: got [3, 2], expected lower <= upper");
  EXPECT_EQ(message({{"east_m", std::nan(""), 2.0}}),
            "search.east_m: got [nan, 2], expected finite bounds");
  EXPECT_EQ(message({{"east_m", 0.0, kInfinity}}),
            "search.east_m: got [0, inf], expected finite bounds");
  EXPECT_EQ(message({{"east_m", -1e308, 1e308}}).substr(0, 14), "search.east_m:");
  EXPECT_EQ(message({{"a", 0.0, 1.0}, {"a", 0.0, 1.0}}),
            "search.a: got the name twice, expected different names");
  EXPECT_EQ(message({{"", 0.0, 1.0}}), "search: got a parameter without name, expected a name");
}

TEST(SearchBox, StartOutsideIsAnError) {
  EXPECT_THROW(MakeSampler(Tpe(), {PoseLikeBox(), {}, {99.0, 0.0, 1.7, 0.0, 0.0}}, 1), InputError);
  EXPECT_THROW(MakeSampler(Tpe(), {PoseLikeBox(), {}, {0.0}}, 1), InputError);
}

TEST(SearchBox, DifferenceTakesTheShortWay) {
  const SearchBox box = PoseLikeBox();
  EXPECT_NEAR(box.Difference(3, 350.0, 10.0), 20.0, 1e-12);
  EXPECT_NEAR(box.Difference(3, 10.0, 350.0), -20.0, 1e-12);
  EXPECT_NEAR(box.Difference(0, -19.0, 19.0), 38.0, 1e-12);
}

TEST(Minimize, BadBudgetsAreErrors) {
  MinimizeOptions options;
  options.budget = 0;
  EXPECT_THROW(Minimize(*MakeSampler(Tpe(), {PoseLikeBox(), {}, {}}, 1), PoseLikeEnergy, options),
               InputError);
  options.budget = 10;
  options.batch = -1;
  EXPECT_THROW(Minimize(*MakeSampler(Tpe(), {PoseLikeBox(), {}, {}}, 1), PoseLikeEnergy, options),
               InputError);
}

TEST(Minimize, ReportsTrialsInOrder) {
  MinimizeOptions options;
  options.budget = 33;
  options.batch = 8;
  options.threads = 4;
  std::int64_t next = 0;
  options.on_trial = [&](const Trial& trial) { EXPECT_EQ(trial.index, next++); };
  Minimize(*MakeSampler(Tpe(), {PoseLikeBox(), {}, {}}, 1), PoseLikeEnergy, options);
  EXPECT_EQ(next, 33);
}

Trial At(std::int64_t index, double east, double heading, double energy) {
  Trial trial;
  trial.index = index;
  trial.values = {east, 0.0, 1.7, heading, 0.0};
  trial.SetEnergy(energy);
  return trial;
}

TEST(DistinctModes, KeepsLocalMinimaOnly) {
  Trace trace;
  trace.trials = {At(0, 0.0, 1.0, 0.1),    // the best
                  At(1, 1.5, 1.0, 0.2),    // its slope
                  At(2, 3.0, 1.0, 0.3),    // slope of the slope: no neighbour of the best
                  At(3, 0.5, 359.5, 0.4),  // neighbour of the best across the seam
                  At(4, 10.0, 1.0, 0.5),   // another mode
                  At(5, 10.0, 90.0, 0.5),  // another one, by heading
                  At(6, -9.0, 1.0, std::nan("")),
                  At(7, -9.0, 1.0, std::numeric_limits<double>::infinity())};
  DistinctModesOptions options;
  options.separation = {2.0, 2.0, 0.0, 2.0, 2.0};
  std::vector<Mode> modes = DistinctModes(trace, PoseLikeBox(), options);
  ASSERT_EQ(modes.size(), 3u);
  EXPECT_EQ(modes[0].trial, 0);
  EXPECT_EQ(modes[1].trial, 4);
  EXPECT_EQ(modes[2].trial, 5);
  options.max_modes = 2;
  EXPECT_EQ(DistinctModes(trace, PoseLikeBox(), options).size(), 2u);
  options.separation[3] = std::numeric_limits<double>::infinity();
  options.max_modes = 9;
  EXPECT_EQ(DistinctModes(trace, PoseLikeBox(), options).size(), 2u);
  EXPECT_TRUE(DistinctModes({}, PoseLikeBox(), options).empty());
}

TEST(DistinctModes, BadSeparationsAreErrors) {
  DistinctModesOptions options;
  options.separation = {1.0};
  EXPECT_THROW(DistinctModes({}, PoseLikeBox(), options), InputError);
  options.separation = {1.0, 1.0, 0.0, std::nan(""), 1.0};
  EXPECT_THROW(DistinctModes({}, PoseLikeBox(), options), InputError);
}

// Two valleys of a known function are the two modes of a search over it.
TEST(DistinctModes, FindsBothValleysOfASearch) {
  SearchProblem problem;
  problem.box = CubeBox(2, -2.0, 2.0);
  const auto valleys = [](std::span<const double> x) {
    const double a = (x[0] - 1.0) * (x[0] - 1.0) + x[1] * x[1];
    const double b = (x[0] + 1.0) * (x[0] + 1.0) + x[1] * x[1] + 0.05;
    return std::min(a, b);
  };
  MinimizeOptions run;
  run.budget = 400;
  SamplerOptions options;
  options.name = "sobol";
  DistinctModesOptions modes;
  modes.separation = {0.5, 0.5};
  const std::vector<Mode> found =
      DistinctModes(Minimize(*MakeSampler(options, problem, 3), valleys, run), problem.box, modes);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].values[0], 1.0, 0.2);
  EXPECT_NEAR(found[1].values[0], -1.0, 0.2);
}

}  // namespace
}  // namespace ridgeline
