// SPDX-License-Identifier: MIT
// evaluate and weigh.
#include <cstdio>
#include <iostream>
#include <iterator>

#include "cli/commands.h"
#include "cli/recordings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/compare/portrait.h"
#include "libeval/evaluation.h"
#include "libeval/lags.h"
#include "libeval/localisation.h"
#include "libtrack/file.h"
#include "reports/comparison/json.h"
#include "reports/comparison/ranking_text.h"
#include "reports/recording/evaluation_html.h"
#include "reports/recording/recording_text.h"

namespace swarmfit::cli {
namespace {

constexpr double kErrorLimit = 0.5;  // as the default protocol has it

// What a fit to this recording would choose.
std::vector<int> chosen_lags(const Tracks& real, const Arguments& a) {
  const Localisation error = estimate_localisation(real);
  return error.white && a.compare.conditions.velocity != VelocitySource::recorded
             ? choose_lags(real, error.sigma, kErrorLimit, a.common.seed)
             : std::vector<int>{1};
}

}  // namespace

int evaluate(const Arguments& a) {
  ReadOptions simulated = a.read;
  if (!a.simulated_columns.empty()) simulated.columns = a.simulated_columns;
  const Tracks real = load(a.read, a.recordings.front(), a.kind);
  MetricOptions options{a.compare.conditions.velocity, a.compare.lags};
  if (options.lags.empty()) options.lags = chosen_lags(real, a);
  const Tracks other = load(simulated, a.simulated, a.kind);
  const Evaluation result = swarmfit::evaluate(real, other, a.compare.binning, options);
  std::fputs((a.common.json ? to_json(result) : evaluation_text(result, style())).c_str(), stdout);
  if (a.html.empty()) return 0;
  PairPortrait both = portrait(real, other, result);
  both.comparison.recording.observation.velocity = options.velocity == VelocitySource::recorded ? "recorded" : "difference";
  write_file_atomically(a.html, evaluation_html(result, both, a.line, kVersion));
  return 0;
}

int weigh(const Arguments& a) {
  const bool standard_input = a.table == "-";
  const std::string csv = standard_input ? std::string(std::istreambuf_iterator<char>(std::cin), {}) : read_file(a.table);
  const WeighedTable result = swarmfit::weigh(standard_input ? "standard input" : a.table, csv);
  std::fputs((a.common.json ? to_json(result) : weights_text(result, style())).c_str(), stdout);
  return 0;
}

}  // namespace swarmfit::cli
