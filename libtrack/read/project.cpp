// SPDX-License-Identifier: MIT
#include "libtrack/read/project.h"

#include <fmt/format.h>
#include <geodesic.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libtrack/error.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr double kEquator = 6378137, kFlattening = 1 / 298.257223563;  // WGS 84

void check_on_earth(const RawTable& table) {
  const auto& longitude = table[FileColumn::x];
  const auto& latitude = table[FileColumn::y];
  for (std::size_t i = 0; i < longitude.size(); ++i)
    if (std::abs(latitude[i]) > 90 || std::abs(longitude[i]) > 360)
      throw InputError(
          fmt::format("{}: longitude {:.9g}, latitude {:.9g} is not a place on Earth; expected degrees, latitudes from -90 to 90",
                      table.place(i), longitude[i], latitude[i]));
}

}  // namespace

void project_degrees(RawTable& table) {
  check_on_earth(table);
  auto& x = table[FileColumn::x];
  auto& y = table[FileColumn::y];
  std::vector<double> longitude, latitude;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    // Against the first one, so that the date line parts nobody.
    longitude.push_back(longitude.empty() ? x[i] : longitude[0] + std::remainder(x[i] - longitude[0], 360));
    latitude.push_back(y[i]);
  }
  table.unit = "m";
  table.degrees = false;
  if (longitude.empty()) return;
  const double east = std::remainder(median(std::move(longitude)), 360), north = median(std::move(latitude));
  geod_geodesic earth;
  geod_init(&earth, kEquator, kFlattening);
  double farthest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    double distance = 0, azimuth = 0, unused = 0;
    geod_inverse(&earth, north, east, y[i], x[i], &distance, &azimuth, &unused);
    farthest = std::max(farthest, distance);
    x[i] = distance * std::sin(azimuth * std::numbers::pi / 180);
    y[i] = distance * std::cos(azimuth * std::numbers::pi / 180);
  }
  const double angle = farthest / kEquator;
  const double stretched = angle > 0 ? angle / std::sin(std::min(angle, 0.99 * std::numbers::pi)) - 1 : 0;
  table.notes.push_back(
      fmt::format("degrees were projected to metres east (x) and north (y) of longitude {:.6f}, latitude {:.6f} (azimuthal "
                  "equidistant, WGS 84); the farthest position is {:.4g} km away, where lengths across are {:.2g} % too long",
                  east, north, farthest / 1000, 100 * stretched));
}

}  // namespace swarmfit
