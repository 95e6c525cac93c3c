// SPDX-License-Identifier: MIT
#include "libswarm/force_regression.h"

#include <cmath>
#include <optional>
#include <vector>

#include "libswarm/force_design.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kAlpha = 0.05;
constexpr ForceGroups kSimplest{true, false, true};      // drag and confinement
constexpr double kNeeded = kAlpha / (kForceGroups - 2);  // of those that are tested

}  // namespace

// What is measured once, and fitted again and again.
struct ForceRegression::Measured {
  Measured(const Tracks& tracks, const ForceBasis& of) : basis(of), dt(tracks.dt()), regression(force_design(tracks, of)) {
    for (std::size_t g = 0; g < kForceGroups; ++g) there[g] = basis.count(static_cast<ForceGroup>(g)) > 0;
  }

  // Coefficients of these groups.
  std::vector<Index> columns(const ForceGroups& groups) const {
    std::vector<Index> out;
    for (std::size_t g = 0; g < kForceGroups; ++g)
      for (std::size_t k = 0; groups[g] && k < basis.count(static_cast<ForceGroup>(g)); ++k)
        out.push_back(static_cast<Index>(basis.first(static_cast<ForceGroup>(g)) + k));
    return out;
  }

  double p_of(std::size_t group) const {
    const auto of = static_cast<ForceGroup>(group);
    return regression.p_of(static_cast<Index>(basis.first(of)), static_cast<Index>(basis.count(of)));
  }

  // To drag and confinement the group that is needed most comes in and those that are not needed any more go out, as long as one does.
  // The memory of the noise stays as it is.
  ForceGroups needed() {
    ForceGroups kept = kSimplest;
    for (std::size_t round = 0; round < kForceGroups; ++round) {
      std::optional<std::size_t> next;
      double least = kNeeded;
      for (std::size_t g = 0; g < kForceGroups; ++g) {
        if (kept[g] || !there[g]) continue;
        ForceGroups with = kept;
        with[g] = true;
        regression.refit(columns(with));
        if (const double p = p_of(g); p < least) least = p, next = g;
      }
      if (next) kept[*next] = true;
      regression.refit(columns(kept));
      bool gone = false;
      for (std::size_t g = 0; g < kForceGroups; ++g)
        if (kept[g] && !kSimplest[g] && !(p_of(g) < kNeeded)) kept[g] = false, gone = true;
      if (!next && !gone) break;
    }
    return kept;
  }

  const ForceBasis basis;
  const double dt;
  InstrumentalRegression regression;
  ForceGroups there{};  // those that have any terms
};

ForceRegression::ForceRegression(const Tracks& tracks, const ForceBasis& basis) : measured_(std::make_unique<Measured>(tracks, basis)) {}
ForceRegression::~ForceRegression() = default;

Index ForceRegression::rows() const { return measured_->regression.rows(); }
Index ForceRegression::enough() const { return 4 * static_cast<Index>(measured_->basis.size()); }

ForceGroups ForceRegression::needed() {
  if (rows() < enough()) return {};
  measured_->regression.fit(measured_->columns(measured_->there));
  return measured_->needed();
}

ForceFit ForceRegression::fit(const ForceGroups& groups) {
  if (rows() >= enough()) measured_->regression.fit(measured_->columns(there(groups)));
  return result(groups);
}

ForceFit ForceRegression::refit(const ForceGroups& groups) {
  if (rows() >= enough()) measured_->regression.refit(measured_->columns(there(groups)));
  return result(groups);
}

ForceGroups ForceRegression::there(ForceGroups groups) const {
  for (std::size_t g = 0; g < kForceGroups; ++g) groups[g] = groups[g] && measured_->there[g];
  return groups;
}

ForceFit ForceRegression::result(const ForceGroups& groups) const {
  const InstrumentalRegression& r = measured_->regression;
  const auto size = static_cast<Index>(measured_->basis.size());
  ForceFit out;
  out.law.basis = measured_->basis;
  out.rows = r.rows();
  out.p.fill(kNaN);
  if (rows() < enough()) {
    out.law.coefficients = Eigen::VectorXd::Constant(size, kNaN);
    out.covariance = Eigen::MatrixXd::Constant(size, size, kNaN);
    return out;
  }
  out.groups = there(groups);
  for (std::size_t g = 0; g < kForceGroups; ++g)
    if (out.groups[g]) out.p[g] = measured_->p_of(g);
  out.law.coefficients = r.coefficients();
  out.law.white = r.white();
  if (const NoiseMemory& memory = r.memory(); memory.rho > 0) {
    out.law.coloured = memory.variance.sqrt();
    out.law.memory = -measured_->dt / std::log(memory.rho);
  }
  out.covariance = r.covariance();
  return out;
}

ForceFit fit_forces(const Tracks& tracks, const ForceBasis& basis) {
  ForceRegression regression(tracks, basis);
  return regression.fit(regression.needed());
}

}  // namespace swarmfit
