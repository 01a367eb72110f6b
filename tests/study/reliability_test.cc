// SPDX-License-Identifier: Apache-2.0
#include "study/reliability.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "study/hand_made_map.h"

namespace ridgeline {
namespace {

using ::ridgeline::testing::HandMadeMap;

// Error in units of the neighbourhood. The map's values are floats, the errors doubles: which of them
// are equal differs, and so do the rank correlations a little.
constexpr double kTies = 1e-3;
double Cone(double m, double deg) { return -std::hypot(m / 2.0, deg / 2.0); }

TEST(Reliability, AConeAboutTheTruthIsPerfect) {
  const ScoredMap map = HandMadeMap(3.3, -2.4, 7.3, Cone);
  const auto figures = ReliabilityOf(map);
  ASSERT_TRUE(figures.has_value());
  EXPECT_EQ(figures->poses, 21u * 21u * 41u);
  EXPECT_NEAR(figures->minimum_m, std::hypot(0.3, 0.4), 1e-9);  // the nearest place of the grid
  EXPECT_NEAR(figures->minimum_deg, 0.3, 1e-9);
  EXPECT_EQ(figures->better_share, 0.0);
  EXPECT_NEAR(figures->rank_correlation, 1.0, kTies);
  EXPECT_EQ(figures->margin, 1.0);  // no second minimum
  // The farthest corner is (-10, 10): every pose comes home.
  EXPECT_EQ(figures->basin_m, std::ceil(std::hypot(13.3, 12.4)));
  EXPECT_EQ(figures->basin_deg, 28.0);  // heading -20
}

TEST(Reliability, AnUpturnedConeIsWrongInAllRespects) {
  const ScoredMap map = HandMadeMap(0.0, 0.0, 0.0, [](double m, double d) { return -Cone(m, d); });
  const auto figures = ReliabilityOf(map);
  ASSERT_TRUE(figures.has_value());
  EXPECT_NEAR(figures->minimum_m, std::hypot(10.0, 10.0), 1e-9);
  EXPECT_NEAR(figures->rank_correlation, -1.0, kTies);
  EXPECT_EQ(figures->basin_m, 0.0);
  EXPECT_EQ(figures->basin_deg, 0.0);
}

TEST(Reliability, ShareOfBetterPosesIsCounted) {
  // Random energies: the count by hand.
  Random random(7, 0);
  ScoredMap map =
      HandMadeMap(1.2, 0.7, -3.0, [&](double, double) { return random.Uniform(-5.0, 5.0); });
  for (std::size_t p = 0; p < map.positions(); p += 3) map.admissible[p] = 0;
  for (std::size_t i = 0; i < map.poses(); ++i) {
    if (!map.Admissible(i)) map.volume.log_ratios[i] = -INFINITY;
  }
  float best_near = -INFINITY;
  for (std::size_t i = 0; i < map.poses(); ++i) {
    if (map.TranslationM(i) <= 2.0 && map.RotationDeg(i) <= 2.0) {
      best_near = std::max(best_near, map.volume.log_ratios[i]);
    }
  }
  int better = 0;
  int admissible = 0;
  for (std::size_t i = 0; i < map.poses(); ++i) {
    if (!map.Admissible(i)) continue;
    ++admissible;
    if (map.volume.log_ratios[i] > best_near) ++better;
  }
  const auto figures = ReliabilityOf(map);
  EXPECT_EQ(figures->poses, static_cast<std::uint64_t>(admissible));
  EXPECT_NEAR(figures->better_share, static_cast<double>(better) / admissible, 1e-12);
  EXPECT_GT(better, 0);
}

TEST(Reliability, AScoreThatSaysNothingHasHalfOfThePosesBetter) {
  const ScoredMap map = HandMadeMap(0.0, 0.0, 0.0, [](double, double) { return 1.0; });
  const auto figures = ReliabilityOf(map);
  int near = 0;
  for (std::size_t i = 0; i < map.poses(); ++i) {
    near += map.TranslationM(i) <= 2.0 && map.RotationDeg(i) <= 2.0;
  }
  const double all = 21.0 * 21.0 * 41.0;
  EXPECT_NEAR(figures->better_share, 0.5 * (all - near) / all, 1e-12);
  EXPECT_TRUE(std::isnan(figures->rank_correlation));
  EXPECT_EQ(figures->margin, 0.0);
}

TEST(Reliability, ASecondWellSetsMarginAndBasin) {
  // Wells at the truth (-5, 0) and, not as deep, at (5, 0), heading 0 both.
  ScoredMap map = HandMadeMap(-5.0, 0.0, 0.0, Cone);
  for (std::size_t i = 0; i < map.poses(); ++i) {
    const PoseSpace::Offset o = map.volume.OffsetOf(i, {});
    const double other =
        -0.5 - std::hypot(std::hypot(o.east_m - 5.0, o.north_m) / 2.0, o.heading_deg / 2.0);
    map.volume.log_ratios[i] = std::max(map.volume.log_ratios[i], static_cast<float>(other));
  }
  const auto figures = ReliabilityOf(map);
  EXPECT_EQ(figures->minimum_m, 0.0);
  EXPECT_NEAR(figures->margin_log_ratio, 0.5, 1e-6);
  const double median = MedianOf({map.volume.log_ratios.begin(), map.volume.log_ratios.end()});
  EXPECT_NEAR(figures->margin, 0.5 / -median, 1e-6);
  // The ridge between the wells lies at east 0.5, 5.5 m from the truth.
  const std::vector<char> home = ComesHome(map);
  for (const ErrorBin& bin : ByDistance(map, home)) {
    if (bin.upper <= 5.0) {
      EXPECT_EQ(bin.home_share, 1.0) << bin.lower;
    } else if (bin.lower >= 6.0) {
      EXPECT_LT(bin.home_share, 1.0) << bin.lower;
    }
  }
  EXPECT_GE(figures->basin_m, 5.0);
}

TEST(Reliability, TruthWhereNoPoseIsAdmissible) {
  ScoredMap map = HandMadeMap(0.0, 0.0, 0.0, Cone);
  for (std::size_t p = 0; p < map.positions(); ++p) {
    if (map.translation_m[p] > 2.5) continue;
    map.admissible[p] = 0;
    for (std::size_t i = 0; i < 41; ++i) map.volume.log_ratios[41 * p + i] = -INFINITY;
  }
  const auto figures = ReliabilityOf(map);
  ASSERT_TRUE(figures.has_value());
  EXPECT_TRUE(std::isnan(figures->better_share));
  EXPECT_EQ(figures->basin_m, 0.0);
  EXPECT_GT(figures->minimum_m, 2.5);
}

TEST(Reliability, NothingInViewGivesNoFigures) {
  EXPECT_FALSE(ReliabilityOf(HandMadeMap(0.0, 0.0, 0.0, [](double, double) { return -INFINITY; })));
}

TEST(Reliability, LocalSearchesAreThoseThatWalkStepByStep) {
  Random random(11, 0);
  const ScoredMap map = HandMadeMap(2.0, 1.0, 4.0, [&](double m, double d) {
    return 3.0 * Cone(m, d) + random.Uniform(-4.0, 4.0);
  });
  const std::vector<char> home = ComesHome(map);
  const auto index = [](int n, int e, int h) { return (n * 21 + e) * 41 + h; };
  int checked = 0;
  for (int n = 0; n < 21; n += 2) {
    for (int e = 0; e < 21; ++e) {
      for (int h = 0; h < 41; h += 3) {
        int at[3] = {n, e, h};
        for (bool moved = true; moved;) {
          int best[3] = {at[0], at[1], at[2]};
          for (int dn = -1; dn <= 1; ++dn) {
            for (int de = -1; de <= 1; ++de) {
              for (int dh = -1; dh <= 1; ++dh) {
                const int to[3] = {at[0] + dn, at[1] + de, at[2] + dh};
                if (to[0] < 0 || to[0] > 20 || to[1] < 0 || to[1] > 20 || to[2] < 0 || to[2] > 40)
                  continue;
                if (map.volume.log_ratios[index(to[0], to[1], to[2])] >
                    map.volume.log_ratios[index(best[0], best[1], best[2])]) {
                  std::copy(to, to + 3, best);
                }
              }
            }
          }
          moved = !std::equal(at, at + 3, best);
          std::copy(best, best + 3, at);
        }
        const std::size_t end = index(at[0], at[1], at[2]);
        EXPECT_EQ(home[index(n, e, h)] != 0,
                  map.TranslationM(end) <= 2.0 && map.RotationDeg(end) <= 2.0);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 3000);
}

TEST(Reliability, HeadingsThatGoAllAroundHaveNoEnd) {
  PoseVolume volume;
  volume.east_m = volume.north_m = volume.height_m = {0.0};
  for (int h = -180; h < 180; h += 10) {
    volume.heading_deg.push_back(h);
    volume.log_ratios.push_back(static_cast<float>(-std::abs(h)));
  }
  volume.tilts = {Tilt{}};
  volume.log_ratios.back() = 5.0f;  // 170 degrees
  EXPECT_EQ(BestNeighbour(volume, 0), volume.log_ratios.size() - 1);
}

TEST(Reliability, RankCorrelationWithTies) {
  // Ranks 0, 1.5, 1.5, 3, 4 and 1, 0, 2.5, 2.5, 4: 7.25 / 9.5.
  EXPECT_NEAR(
      RankCorrelation(std::vector<double>{1, 2, 2, 3, 5}, std::vector<double>{2, 1, 4, 4, 7}),
      7.25 / 9.5,
      1e-12);
  EXPECT_TRUE(
      std::isnan(RankCorrelation(std::vector<double>{1, 1, 1}, std::vector<double>{1, 2, 3})));
}

TEST(Reliability, MedianLeavesOutWhatIsNotDefined) {
  EXPECT_EQ(MedianOf({3.0, NAN, 1.0, 2.0}), 2.0);
  EXPECT_EQ(MedianOf({4.0, 1.0}), 2.5);
  EXPECT_EQ(MedianOf({-INFINITY, -INFINITY}), -INFINITY);
  EXPECT_TRUE(std::isnan(MedianOf({NAN})));
}

}  // namespace
}  // namespace ridgeline
