// SPDX-License-Identifier: Apache-2.0
#include "camera/magnetic_declination.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/angle.h"

namespace ridgeline {
namespace {

// Gauss coefficients [nT] at 2025.0 and their yearly changes.
struct Gauss {
  double g;
  double h;
  double g_rate;
  double h_rate;
};

constexpr int kDegree = 12;
constexpr double kEpoch = 2025.0;

// WMM2025.COF, NOAA NCEI, 2024-11-13: degree 1 order 0, 1 1, 2 0, ..., 12 12.
// clang-format off
constexpr std::array<Gauss, 90> kGauss = {{
    {-29351.8, 0.0, 12.0, 0.0}, {-1410.8, 4545.4, 9.7, -21.5}, {-2556.6, 0.0, -11.6, 0.0},
    {2951.1, -3133.6, -5.2, -27.7}, {1649.3, -815.1, -8.0, -12.1}, {1361.0, 0.0, -1.3, 0.0},
    {-2404.1, -56.6, -4.2, 4.0}, {1243.8, 237.5, 0.4, -0.3}, {453.6, -549.5, -15.6, -4.1},
    {895.0, 0.0, -1.6, 0.0}, {799.5, 278.6, -2.4, -1.1}, {55.7, -133.9, -6.0, 4.1},
    {-281.1, 212.0, 5.6, 1.6}, {12.1, -375.6, -7.0, -4.4}, {-233.2, 0.0, 0.6, 0.0},
    {368.9, 45.4, 1.4, -0.5}, {187.2, 220.2, 0.0, 2.2}, {-138.7, -122.9, 0.6, 0.4},
    {-142.0, 43.0, 2.2, 1.7}, {20.9, 106.1, 0.9, 1.9}, {64.4, 0.0, -0.2, 0.0},
    {63.8, -18.4, -0.4, 0.3}, {76.9, 16.8, 0.9, -1.6}, {-115.7, 48.8, 1.2, -0.4},
    {-40.9, -59.8, -0.9, 0.9}, {14.9, 10.9, 0.3, 0.7}, {-60.7, 72.7, 0.9, 0.9},
    {79.5, 0.0, 0.0, 0.0}, {-77.0, -48.9, -0.1, 0.6}, {-8.8, -14.4, -0.1, 0.5},
    {59.3, -1.0, 0.5, -0.8}, {15.8, 23.4, -0.1, 0.0}, {2.5, -7.4, -0.8, -1.0},
    {-11.1, -25.1, -0.8, 0.6}, {14.2, -2.3, 0.8, -0.2}, {23.2, 0.0, -0.1, 0.0},
    {10.8, 7.1, 0.2, -0.2}, {-17.5, -12.6, 0.0, 0.5}, {2.0, 11.4, 0.5, -0.4},
    {-21.7, -9.7, -0.1, 0.4}, {16.9, 12.7, 0.3, -0.5}, {15.0, 0.7, 0.2, -0.6},
    {-16.8, -5.2, 0.0, 0.3}, {0.9, 3.9, 0.2, 0.2}, {4.6, 0.0, 0.0, 0.0}, {7.8, -24.8, -0.1, -0.3},
    {3.0, 12.2, 0.1, 0.3}, {-0.2, 8.3, 0.3, -0.3}, {-2.5, -3.3, -0.3, 0.3},
    {-13.1, -5.2, 0.0, 0.2}, {2.4, 7.2, 0.3, -0.1}, {8.6, -0.6, -0.1, -0.2},
    {-8.7, 0.8, 0.1, 0.4}, {-12.9, 10.0, -0.1, 0.1}, {-1.3, 0.0, 0.1, 0.0}, {-6.4, 3.3, 0.0, 0.0},
    {0.2, 0.0, 0.1, 0.0}, {2.0, 2.4, 0.1, -0.2}, {-1.0, 5.3, 0.0, 0.1}, {-0.6, -9.1, -0.3, -0.1},
    {-0.9, 0.4, 0.0, 0.1}, {1.5, -4.2, -0.1, 0.0}, {0.9, -3.8, -0.1, -0.1}, {-2.7, 0.9, 0.0, 0.2},
    {-3.9, -9.1, 0.0, 0.0}, {2.9, 0.0, 0.0, 0.0}, {-1.5, 0.0, 0.0, 0.0}, {-2.5, 2.9, 0.0, 0.1},
    {2.4, -0.6, 0.0, 0.0}, {-0.6, 0.2, 0.0, 0.1}, {-0.1, 0.5, -0.1, 0.0}, {-0.6, -0.3, 0.0, 0.0},
    {-0.1, -1.2, 0.0, 0.1}, {1.1, -1.7, -0.1, 0.0}, {-1.0, -2.9, -0.1, 0.0},
    {-0.2, -1.8, -0.1, 0.0}, {2.6, -2.3, -0.1, 0.0}, {-2.0, 0.0, 0.0, 0.0},
    {-0.2, -1.3, 0.0, 0.0}, {0.3, 0.7, 0.0, 0.0}, {1.2, 1.0, 0.0, -0.1}, {-1.3, -1.4, 0.0, 0.1},
    {0.6, 0.0, 0.0, 0.0}, {0.6, 0.6, 0.1, 0.0}, {0.5, -0.1, 0.0, 0.0}, {-0.1, 0.8, 0.0, 0.0},
    {-0.4, 0.1, 0.0, 0.0}, {-0.2, -1.0, -0.1, 0.0}, {-1.3, 0.1, 0.0, 0.0},
    {-0.7, 0.2, -0.1, -0.1}
}};
// clang-format on

// Schmidt semi-normalized associated Legendre functions of cos(theta), and their derivatives by
// theta.
struct Legendre {
  std::array<std::array<double, kDegree + 1>, kDegree + 1> p{};
  std::array<std::array<double, kDegree + 1>, kDegree + 1> dp{};
};

// Recursions of Winch et al. 2005 (Geophys. J. Int. 160, 487-504), by degree.
Legendre LegendreAt(double theta) {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  Legendre l;
  l.p[0][0] = 1.0;
  for (int n = 1; n <= kDegree; ++n) {
    for (int m = 0; m < n; ++m) {
      const double a = (2.0 * n - 1.0) / std::sqrt(static_cast<double>(n * n - m * m));
      const double b = n - 1 > m ? std::sqrt(static_cast<double>((n - 1) * (n - 1) - m * m)) /
                                       std::sqrt(static_cast<double>(n * n - m * m))
                                 : 0.0;
      const double before = n >= 2 ? l.p[n - 2][m] : 0.0;
      const double before_d = n >= 2 ? l.dp[n - 2][m] : 0.0;
      l.p[n][m] = a * c * l.p[n - 1][m] - b * before;
      l.dp[n][m] = a * (c * l.dp[n - 1][m] - s * l.p[n - 1][m]) - b * before_d;
    }
    const double k = n == 1 ? 1.0 : std::sqrt((2.0 * n - 1.0) / (2.0 * n));
    l.p[n][n] = k * s * l.p[n - 1][n - 1];
    l.dp[n][n] = k * (c * l.p[n - 1][n - 1] + s * l.dp[n - 1][n - 1]);
  }
  return l;
}

}  // namespace

// Equations (4) to (17) of the WMM technical report (Chulliat et al. 2020), at height 0.
double MagneticDeclinationDeg(double latitude_deg, double longitude_deg, double year) {
  constexpr double kSemiMajorKm = 6378.137;  // WGS 84
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
  constexpr double kReferenceKm = 6371.2;
  const double latitude = latitude_deg * kRadPerDeg;
  const double longitude = longitude_deg * kRadPerDeg;
  const double vertical =
      kSemiMajorKm / std::sqrt(1.0 - kEccentricity2 * std::sin(latitude) * std::sin(latitude));
  const double from_axis = vertical * std::cos(latitude);
  const double above_equator = vertical * (1.0 - kEccentricity2) * std::sin(latitude);
  const double radius = std::hypot(from_axis, above_equator);
  const double geocentric = std::atan2(above_equator, from_axis);
  const Legendre l = LegendreAt(std::numbers::pi / 2.0 - geocentric);

  double north = 0.0;
  double east = 0.0;
  double down = 0.0;
  std::size_t index = 0;
  for (int n = 1; n <= kDegree; ++n) {
    const double reach = std::pow(kReferenceKm / radius, n + 2);
    for (int m = 0; m <= n; ++m) {
      const Gauss& gauss = kGauss[index++];
      const double g = gauss.g + (year - kEpoch) * gauss.g_rate;
      const double h = gauss.h + (year - kEpoch) * gauss.h_rate;
      const double along = g * std::cos(m * longitude) + h * std::sin(m * longitude);
      const double across = g * std::sin(m * longitude) - h * std::cos(m * longitude);
      north += reach * along * l.dp[n][m];
      east += reach * m * across * l.p[n][m] / std::cos(geocentric);
      down -= reach * (n + 1) * along * l.p[n][m];
    }
  }
  const double tilt = geocentric - latitude;
  return std::atan2(east, north * std::cos(tilt) - down * std::sin(tilt)) / kRadPerDeg;
}

}  // namespace ridgeline
