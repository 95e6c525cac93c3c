// SPDX-License-Identifier: MIT
#include "fit/compare/refute.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libtrack/distributions.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kLevel = 0.005;  // of all facts together
constexpr double kVisible = 0.1;  // of the recording's value; of a correlation where the other is gone
constexpr double kVisiblePolarisation = 0.05;

bool is_fact(const PanelItem& item) {
  return item.key == "speed" || item.key == "polarisation" || item.key == "nearest" || item.key == "vacf_zero" ||
         item.key.starts_with("sd_");
}

// Of single runs.
struct Scatter {
  double mean = kNaN, sd = kNaN, runs = 0;
};

Scatter scatter(const std::vector<Panel>& runs, std::vector<double> Panel::*part, std::size_t k) {
  Moments m;
  for (const Panel& p : runs) m.add((p.*part)[k]);
  const auto n = static_cast<double>(m.count);
  return {m.count > 0 ? m.mean : kNaN, m.count > 1 ? std::sqrt(m.m2 / (n - 1)) : kNaN, n};
}

// Do they differ by more than chance, and visibly?
bool differ(const Estimate& recording, const Scatter& model, double visible, double level) {
  const double difference = std::abs(recording.value - model.mean);
  if (!(model.runs > 1) || !(difference > visible)) return false;  // undefined numbers differ in nothing
  const double t = student_t_above(level / 2, model.runs - 1);
  return difference > t * std::hypot(model.sd * std::sqrt(1 + 1 / model.runs), recording.se);
}

// The first lag at which a curve is not above 0; the number of lags if there is none.
std::size_t first_zero(const std::vector<double>& curve) {
  return static_cast<std::size_t>(std::find_if(curve.begin(), curve.end(), [](double c) { return !(c > 0); }) - curve.begin());
}

bool memories_differ(const PanelEstimate& recording, const std::vector<Panel>& runs, double level) {
  std::vector<double> mean;
  for (std::size_t k = 0; k < recording.value.vacf.size(); ++k) mean.push_back(scatter(runs, &Panel::vacf, k).mean);
  const std::size_t lag = std::min(first_zero(recording.value.vacf), first_zero(mean));
  if (lag >= mean.size() || !(std::max(recording.value.vacf[lag], mean[lag]) > kVisible)) return false;
  return differ({recording.value.vacf[lag], recording.se.vacf[lag]}, scatter(runs, &Panel::vacf, lag), 0, level);
}

// Three digits, and never with an exponent where there are more before the point.
std::string digits(double x) { return std::abs(x) >= 1000 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x); }

std::string plus_minus(double value, double error, const std::string& unit) {
  return digits(value) +
         (std::isfinite(error) ? " ± " + (error >= 100 ? fmt::format("{:.0f}", error) : fmt::format("{:.2g}", error)) : "") +
         (unit.empty() ? "" : ' ' + unit);
}

std::string unit_of(const PanelItem& item, const std::string& length) {
  std::string out = item.length > 0 ? length : "";
  if (item.time < 0) out += "/s";
  if (item.time > 0) out += "s";
  return out;
}

std::string duration(double value, double error, double longest) {
  return std::isfinite(value) ? "for " + plus_minus(value, error, "s") : fmt::format("for longer than {:.2g} s", longest);
}

std::string sentence(const Refutation& f, const Comparison& r) {
  if (f.item.key == "vacf_zero") {
    const double longest = r.recording.panel.lags.empty() ? kNaN : r.recording.panel.lags.back();
    return fmt::format("velocities keep their direction {} (first zero of the autocorrelation), in the recording {}",
                       duration(f.model, f.sd, longest), duration(f.recording.value, f.recording.se, longest));
  }
  const std::string unit = unit_of(f.item, r.recording.data.unit);
  return fmt::format("the {} is {}, in the recording {}", f.item.name, plus_minus(f.model, f.sd, unit),
                     plus_minus(f.recording.value, f.recording.se, unit));
}

}  // namespace

std::vector<Refutation> refutations(const PanelPlan& plan, const PanelEstimate& recording, const std::vector<Panel>& runs) {
  const auto items = plan.items();
  const double level = kLevel / static_cast<double>(std::count_if(items.begin(), items.end(), is_fact));
  std::vector<Refutation> out;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (!is_fact(items[k])) continue;
    const Estimate real{recording.value.values[k], recording.se.values[k]};
    const Scatter model = scatter(runs, &Panel::values, k);
    const double visible = items[k].key == "polarisation" ? kVisiblePolarisation : kVisible * std::abs(real.value);
    if (items[k].key == "vacf_zero" ? memories_differ(recording, runs, level) : differ(real, model, visible, level))
      out.push_back({items[k], real, model.mean, model.sd});
  }
  return out;
}

std::vector<Warning> warnings_of_facts(const Comparison& r) {
  std::vector<Warning> out;
  for (const ModelFit& m : r.models) {
    if ((m.standing.rank != 1 && m.standing.certainty.group != 1) || m.likeness.refuted_by.empty()) continue;
    std::vector<std::string> facts;
    for (const Refutation& f : m.likeness.refuted_by) facts.push_back(sentence(f, r));
    out.emplace_back(
        Gravity::claim,
        fmt::format("Simple observables contradict {} as fitted: {} (± scatter of single simulations; ± standard error of the recording).",
                    m.model, fmt::join(facts, "; ")));
  }
  return out;
}

}  // namespace swarmfit
