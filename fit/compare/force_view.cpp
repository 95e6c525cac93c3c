// SPDX-License-Identifier: MIT
#include "fit/compare/force_view.h"

#include <algorithm>
#include <cmath>

#include "libeval/robust.h"
#include "libeval/value_spread.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::size_t kPoints = 25;  // of a curve

std::vector<double> up_to(double end) {
  std::vector<double> out;
  for (std::size_t k = 0; k < kPoints; ++k) out.push_back(end * static_cast<double>(k) / (kPoints - 1));
  return out;
}

// From the first knot, below which hardly any pairs are, to the last.
ForceGrid grid_of(const ForceBasis& basis) {
  ForceGrid out{up_to(basis.top_speed), up_to(basis.reach), {}};
  if (!basis.knots.empty())
    for (const double part : up_to(1)) out.pairs.push_back(basis.knots.front() + part * (basis.knots.back() - basis.knots.front()));
  return out;
}

double rms(const Eigen::Array3d& a, int dims) { return std::sqrt(a.square().sum() / dims); }

template <class Value>
std::vector<double> along(const std::vector<double>& places, const Value& value) {
  std::vector<double> out;
  for (const double place : places) out.push_back(value(place));
  return out;
}

struct CurvesAndErrors {
  ForceCurves value, se;
  double attraction_p, alignment_p;
};

// What is needed together; kernels one at a time beside it.
CurvesAndErrors curves(const ForceBasis& basis, const ForceGrid& grid, const ForceGroups& needed, ForceRegression& regression) {
  const auto with = [&](ForceGroup group) {
    ForceGroups groups = needed;
    groups[static_cast<std::size_t>(group)] = true;
    return regression.refit(groups);
  };
  const ForceFit alone = regression.fit(needed), pair = with(ForceGroup::pair), alignment = with(ForceGroup::alignment);
  const double known = alone.law.coefficients.allFinite() ? 0 : kNaN;
  CurvesAndErrors out;
  out.value.drag = along(grid.speeds, [&](double v) { return known + alone.law.drag(v); });
  out.se.drag = along(grid.speeds, [&](double v) { return known + alone.drag_se(v); });
  out.value.confinement = along(grid.distances, [&](double r) { return known + alone.law.confinement(r); });
  out.se.confinement = along(grid.distances, [&](double r) { return known + alone.confinement_se(r); });
  out.value.attraction =
      along(grid.pairs, [&](double r) { return known + 0 * pair.kernel_se(ForceGroup::pair, r) + pair.law.kernel(ForceGroup::pair, r); });
  out.se.attraction = along(grid.pairs, [&](double r) { return known + pair.kernel_se(ForceGroup::pair, r); });
  out.value.alignment = along(grid.pairs, [&](double r) {
    return known + 0 * alignment.kernel_se(ForceGroup::alignment, r) + alignment.law.kernel(ForceGroup::alignment, r);
  });
  out.se.alignment = along(grid.pairs, [&](double r) { return known + alignment.kernel_se(ForceGroup::alignment, r); });
  const ForceLaw& law = alone.law;
  out.value.noise = {rms(law.white, basis.dims) + known, rms(law.coloured, basis.dims) + known, law.memory + known};
  out.attraction_p = pair.p[static_cast<std::size_t>(ForceGroup::pair)];
  out.alignment_p = alignment.p[static_cast<std::size_t>(ForceGroup::alignment)];
  return out;
}

}  // namespace

ForceView::ForceView(const Tracks& recording) : basis_(force_basis(recording)) {
  ForceRegression regression(recording, basis_);
  facts_.grid = grid_of(basis_);
  needed_ = regression.needed();
  const CurvesAndErrors seen = curves(basis_, facts_.grid, needed_, regression);
  facts_.recording = seen.value;
  facts_.se = seen.se;
  for (std::size_t g = 0; g < kForceGroups; ++g)
    if (const auto group = static_cast<ForceGroup>(g); needed_[g] && group != ForceGroup::drag && group != ForceGroup::confinement)
      facts_.needed.push_back(to_string(group));
  facts_.attraction_p = seen.attraction_p;
  facts_.alignment_p = seen.alignment_p;
}

ForceCurves ForceView::of(const Tracks& simulated) const {
  ForceRegression regression(simulated, basis_);
  return curves(basis_, facts_.grid, needed_, regression).value;
}

std::vector<GroupCurve> force_curves(const Tracks& recording) {
  const ForceView view(recording);
  const auto& [grid, value, se, needed, attraction_p, alignment_p] = view.facts();
  std::vector<GroupCurve> out;
  const auto add = [&](GroupCurve curve) {
    if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); })) out.push_back(std::move(curve));
  };
  add({"drag", "drag", "speed", 1, -1, 0, -1, grid.speeds, value.drag, se.drag});
  add({"stiffness", "stiffness of the confinement", "distance from the centre", 1, 0, 0, -2, grid.distances, value.confinement,
       se.confinement});
  add({"attraction", "attraction of a pair", "distance", 1, 0, 1, -2, grid.pairs, value.attraction, se.attraction});
  add({"alignment", "alignment of a pair", "distance", 1, 0, 0, -1, grid.pairs, value.alignment, se.alignment});
  return out;
}

ForceSpread force_spread(std::span<const ForceCurves> all) {
  const std::vector<ForceCurves> curves(all.begin(), all.end());
  return {summarised(curves, [](const std::vector<double>& values) { return robust(values).median; }),
          summarised(curves, [](const std::vector<double>& values) { return robust(values).sd; })};
}

}  // namespace swarmfit
