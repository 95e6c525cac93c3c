// SPDX-License-Identifier: MIT
#include "reports/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "reports/number.h"

namespace swarmfit {

namespace {

constexpr double kNoise = 2;  // standard errors below which two scores cannot be told apart

// How far the winner leads another model.
struct Lead {
  double difference, se;
  double in_se() const { return se > 0 ? difference / se : INFINITY; }
  bool known() const { return std::isfinite(se); }
};

Lead lead(const FitResult& first, const FitResult& other) {
  return {first.score - other.score, std::hypot(first.score_se, other.score_se)};
}

std::string standard_errors(const Lead& l) {
  return std::isfinite(l.in_se()) ? fmt::format("{:.1f} standard errors", l.in_se()) : "no spread between replicates";
}

// The winner's largest raw energy among the metrics that count.
std::string main_misfit(const Comparison& c, const FitResult& winner) {
  const std::size_t none = c.columns.size();
  std::size_t worst = none;
  for (std::size_t m = 0; m < none; ++m) {
    if (!counts(c, m) || !std::isfinite(winner.raw_energies[m])) continue;
    if (worst == none || winner.raw_energies[m] > winner.raw_energies[worst]) worst = m;
  }
  if (worst == none) return {};
  return fmt::format("Its largest misfit is in the {} (energy {} of at most {}).", c.columns[worst].name(),
                     fixed(winner.raw_energies[worst], 2), brief(worst_energy(c.binning)));
}

Headline single(const Comparison& c, const FitResult& only) {
  return {Verdict::single, fmt::format("{} is the only model here, so there is nothing to rank.", only.model),
          "A score compares models with each other; alone, judge the fit by its raw energies and distributions. " + main_misfit(c, only)};
}

Headline tie(const Comparison& c, const std::vector<const FitResult*>& together, const Lead& l) {
  std::vector<std::string> names;
  for (const FitResult* r : together) names.push_back(r->model);
  Headline h;
  h.verdict = Verdict::tie;
  h.sentence = fmt::format("{} cannot be told apart with this recording and budget.", enumerate(names));
  h.detail = fmt::format("{} has the highest score, but leads {} by only {} ({}). {}", names[0], names[1], fixed(l.difference, 3),
                         standard_errors(l), main_misfit(c, *together[0]));
  return h;
}

Headline ranked(const Comparison& c, const FitResult& first, const FitResult& second, const Lead& l) {
  Headline h;
  h.verdict = l.known() ? Verdict::clear : Verdict::open;
  h.sentence = fmt::format("{} moves most like the recording.", first.model);
  h.detail = fmt::format("It leads {} by {} in score ({}). {}", second.model, fixed(l.difference, 3),
                         l.known() ? standard_errors(l) : "standard error unknown", main_misfit(c, first));
  return h;
}

// "lag 8 (0.08 s)"
std::string lag_name(const Comparison& c, const LagFacts& l) { return fmt::format("lag {} ({} s)", l.lag, brief(l.lag * c.data.dt)); }

std::string power(const std::string& base, int exponent) {
  if (exponent == 1) return base;
  if (exponent == 2) return base + "²";
  if (exponent == 3) return base + "³";
  return base + '^' + std::to_string(exponent);
}

}  // namespace

Headline headline(const Comparison& c) {
  std::vector<const FitResult*> scored;
  for (const FitResult& r : c.models)
    if (std::isfinite(r.score)) scored.push_back(&r);
  if (scored.empty()) return {Verdict::none, "No model could be scored.", "See the warnings and the failed simulations below."};
  if (scored.size() == 1 && c.models.size() == 1) return single(c, *scored[0]);
  if (scored.size() == 1)
    return {Verdict::open, fmt::format("{} is the only model that could be scored.", scored[0]->model), main_misfit(c, *scored[0])};

  std::vector<const FitResult*> together = {scored[0]};
  for (std::size_t k = 1; k < scored.size(); ++k) {
    const Lead l = lead(*scored[0], *scored[k]);
    if (l.difference == 0 || (l.known() && l.in_se() < kNoise)) together.push_back(scored[k]);
  }
  return together.size() > 1 ? tie(c, together, lead(*together[0], *together[1]))
                             : ranked(c, *scored[0], *scored[1], lead(*scored[0], *scored[1]));
}

bool counts(const Comparison& c, std::size_t column) { return c.defined[column] && c.observation.used[column]; }

std::string why_left_out(const Comparison& c, std::size_t column) {
  if (counts(c, column)) return {};
  if (!c.observation.why_not[column].empty()) return c.observation.why_not[column];
  return c.defined[column] ? "left out by request" : "undefined in the recording";
}

std::string marked(const Comparison& c, std::size_t column, const std::string& symbol) {
  if (!counts(c, column)) return '(' + symbol + ')';
  return c.observation.drowned[column] ? symbol + '~' : symbol;
}

std::string what_drowned_means(const Comparison& c) {
  for (std::size_t m = 0; m < c.columns.size(); ++m)
    if (counts(c, m) && c.observation.drowned[m])
      return "~ mostly localisation error: models are told apart only as far as they differ by more than as much error again would make.";
  return {};
}

std::string lags_measured(const Comparison& c) {
  std::vector<std::string> frames, shares;
  for (const LagFacts& l : c.lags) {
    if (l.lag == 0) continue;
    frames.push_back(lag_name(c, l));
    if (std::isfinite(l.error_share))
      shares.push_back(fmt::format("{}{} at lag {}", percent(l.error_share), shares.empty() ? " of a metric's variance" : "", l.lag));
  }
  if (frames.empty()) return {};
  std::string out = fmt::format("Motion is measured at {}.", enumerate(frames));
  if ((c.observation.sigma > 0).any() && !shares.empty()) out += fmt::format(" Localisation error makes up at most {}.", enumerate(shares));
  return out;
}

std::string lag_weights(const Comparison& c) {
  std::vector<LagFacts> lags = c.lags;
  std::stable_sort(lags.begin(), lags.end(), [](const LagFacts& a, const LagFacts& b) { return a.weight > b.weight; });
  std::vector<std::string> parts;
  for (const LagFacts& l : lags)
    parts.push_back(fmt::format("{}{} {}{}", l.lag > 0 ? lag_name(c, l) : "what has no lag (d, η)", parts.empty() ? " carried" : "",
                                percent(l.weight), parts.empty() ? " of the weight" : ""));
  // One lag and those without: nothing to share out.
  if (lags.size() < 3 || !(lags.front().weight > 0)) return {};
  parts.front().front() = static_cast<char>(std::toupper(static_cast<unsigned char>(parts.front().front())));
  return enumerate(parts) + ". ";
}

double worst_energy(const Binning& b) { return 2 * b.bins / (b.upper - b.lower); }

std::string metric_unit(std::size_t metric, const std::string& length_unit) {
  const MetricInfo& info = kMetricInfo[metric];
  const bool angle = metric == kAngularVelocity || metric == kAngularAcceleration;
  std::string above = angle ? "rad" : "1";
  if (info.length != 0) above = power(length_unit.empty() ? "unit" : length_unit, info.length);
  return info.time == 0 ? above : above + '/' + power("s", -info.time);
}

std::string density_unit(std::size_t metric, const std::string& length_unit) {
  const std::string unit = metric_unit(metric, length_unit);
  if (unit.substr(0, 2) == "1/") return unit.substr(2);
  return unit.find('/') == std::string::npos ? "1/" + unit : "1/(" + unit + ')';
}

std::string panel_unit(const PanelItem& item, const std::string& length_unit) {
  std::string above;
  if (item.length != 0) above = power(length_unit.empty() ? "unit" : length_unit, item.length);
  if (item.time > 0) above += fmt::format("{}{}", above.empty() ? "" : " ", power("s", item.time));
  return item.time < 0 ? (above.empty() ? "1" : above) + '/' + power("s", -item.time) : above;
}

std::vector<std::string> at_bounds(const FitResult& r) {
  std::vector<std::string> names;
  for (const ParameterResult& p : r.parameters)
    if (p.at_bound) names.push_back(p.name);
  return names;
}

std::string enumerate(const std::vector<std::string>& items) {
  std::string out;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) out += k + 1 == items.size() ? " and " : ", ";
    out += items[k];
  }
  return out;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    // C1 controls are U+0080 .. U+009F: in UTF-8 the byte C2 and one of 80 .. 9F.
    const bool c1 = byte == 0xC2 && k + 1 < text.size() && static_cast<unsigned char>(text[k + 1]) < 0xA0;
    if (byte < 0x20 || byte == 0x7F || c1) {
      out += '?';
      if (c1) ++k;
    } else {
      out += text[k];
    }
  }
  return out;
}

}  // namespace swarmfit
