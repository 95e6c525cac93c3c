// SPDX-License-Identifier: MIT
#include "reports/comparison/picture_tables.h"

#include <fmt/format.h>

#include <functional>

#include "reports/write/number.h"

namespace swarmfit {
namespace {

// Where value k of a picture lies: one or two numbers.
using Place = std::function<std::string(std::size_t)>;

Place on_map(std::size_t side, double x, double y, double half) {
  const auto centre = [=](std::size_t k) { return half * ((2 * static_cast<double>(k) + 1) / static_cast<double>(side) - 1); };
  return [=](std::size_t k) { return exact(x + centre(k % side)) + ',' + exact(y + centre(k / side)); };
}

Place along(double first, double step) {
  return [=](std::size_t k) { return exact(first + step * static_cast<double>(k)) + ','; };
}

Place at_lags(const std::vector<Index>& lags, double dt) {
  return [=](std::size_t k) { return (k < lags.size() ? exact(static_cast<double>(lags[k]) * dt) : std::string()) + ','; };
}

void add(std::string& out, const std::string& picture, const std::string& who, const std::vector<double>& mean,
         const std::vector<double>& sd, const Place& place) {
  for (std::size_t k = 0; k < mean.size(); ++k)
    out += fmt::format("{},{},{},{},{}\n", picture, who, place(k), exact(mean[k]), k < sd.size() ? exact(sd[k]) : "");
}

}  // namespace

std::string pictures_csv(const Comparison& c) {
  const PictureGrid& g = c.recording.pictures.grid;
  const Place map = on_map(kMapSide, 0, 0, g.reach), distance = along(0.5 * g.width, g.width),
              time = along(0.5 * static_cast<double>(g.stride) * g.dt, static_cast<double>(g.stride) * g.dt);
  using Member = std::vector<double> Pictures::*;
  const std::vector<std::tuple<std::string, Member, Place>> all{{"neighbour_density", &Pictures::density, map},
                                                                {"turning", &Pictures::turning, map},
                                                                {"acceleration", &Pictures::acceleration, map},
                                                                {"g_r", &Pictures::pairs, distance},
                                                                {"heading_correlation", &Pictures::headings, distance},
                                                                {"vacf", &Pictures::vacf, at_lags(g.plan.vacf_lags, g.dt)},
                                                                {"msd", &Pictures::msd, at_lags(g.plan.msd_lags, g.dt)},
                                                                {"polarisation", &Pictures::polarisation, time},
                                                                {"milling", &Pictures::milling, time},
                                                                {"spread", &Pictures::spread, time},
                                                                {"space_use", &Pictures::space, on_map(kSpaceSide, g.x, g.y, g.half)}};
  std::string out = "picture,model,x,y,value,sd\n";
  for (const auto& [name, member, place] : all) {
    add(out, name, "recording", c.recording.pictures.recording.*member, {}, place);
    for (const ModelFit& r : c.models) {
      const PictureSpread& s = r.likeness.pictures;
      add(out, name, csv_field(r.model), s.mean.*member, s.sd.*member, place);
    }
  }
  return out;
}

}  // namespace swarmfit
