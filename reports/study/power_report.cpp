// SPDX-License-Identifier: MIT
#include "reports/study/power_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"
#include "reports/comparison/tables.h"
#include "reports/comparison/words.h"
#include "reports/study/power_html.h"
#include "reports/write/json_parts.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

using json_parts::finite;
using json_parts::Json;

const std::string& planted(const Power& p, const PowerPair& pair) { return p.recovery.planted[pair.planted]; }
const std::string& rival(const Power& p, const PowerPair& pair) { return p.recovery.compared[pair.rival]; }

bool mostly_told_apart(const PowerPair& pair) { return pair.recordings > 0 && 2 * pair.told_apart > pair.recordings; }

// Would this recording do, as its factor is printed?
bool suffices(double factor) { return factor < 1.05; }

// How many times as long, in words.
std::string needed(double factor) {
  if (std::isnan(factor)) return kUndefined;
  if (std::isinf(factor)) return "never";
  return suffices(factor) ? "as much" : fmt::format("{} ×", brief(factor, 2));
}

// The pairs in both directions: telling them apart takes both.
const PowerPair& turned(const Power& p, const PowerPair& pair) {
  return *std::find_if(p.pairs.begin(), p.pairs.end(),
                       [&](const PowerPair& other) { return planted(p, other) == rival(p, pair) && rival(p, other) == planted(p, pair); });
}

}  // namespace

// The order may be right although the rival shares the best group: then no single recording can be sure of it.
std::string power_sentence(const Power& p) {
  std::vector<std::string> unclear, unsure;
  for (const PowerPair& pair : p.pairs) {
    const PowerPair& back = turned(p, pair);
    if (&pair > &back || (mostly_told_apart(pair) && mostly_told_apart(back))) continue;
    const double factor = std::max(pair.factor, back.factor);
    if (suffices(factor)) {
      unsure.push_back(fmt::format("{} and {}", planted(p, pair), rival(p, pair)));
      continue;
    }
    const std::string how = std::isfinite(factor) ? fmt::format("the right order needs about {} times as much data", brief(factor, 2))
                                                  : std::string("more data may not help");
    unclear.push_back(fmt::format("{} and {} ({})", planted(p, pair), rival(p, pair), how));
  }
  const std::string order =
      unsure.empty() ? std::string()
                     : fmt::format(" It ranks {} in the right order, but does not distinguish them with certainty.", enumerate(unsure));
  if (unclear.empty() && unsure.empty()) return "A recording like this one distinguishes all these models.";
  if (unclear.empty())
    return fmt::format("A recording like this one ranks all these models correctly, but does not distinguish {} with certainty.",
                       enumerate(unsure));
  return fmt::format("A recording like this one does not distinguish {}.", enumerate(unclear)) + order;
}

PaperTable pairs_table(const Power& p, const std::string& caption) {
  PaperTable t{"pairs", caption, {"true model", "rival", "ranked before", "distinguished", "lead", "sd", "data for the right order"}, {}};
  for (const PowerPair& pair : p.pairs)
    t.rows.push_back({planted(p, pair), rival(p, pair), fmt::format("{} of {}", pair.first, pair.recordings),
                      fmt::format("{} of {}", pair.told_apart, pair.recordings), fixed(pair.lead, 2), fixed(pair.lead_sd, 2),
                      needed(pair.factor)});
  return t;
}

std::string power_text(const Power& p, TextStyle style) {
  const std::string text = paint(wrapped(power_sentence(p), kTextWidth), Paint::bold, style) + "\n\n" + recovery_text(p.recovery, style) +
                           '\n' + table_text(pairs_table(p, ""), style);
  return style.unicode ? text : ascii(text);
}

std::string pairs_csv(const Power& p) {
  std::string out = "true_model,rival,recordings,ranked_before,distinguished,lead,lead_sd,factor\n";
  for (const PowerPair& pair : p.pairs)
    out += fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(planted(p, pair)), csv_field(rival(p, pair)), pair.recordings, pair.first,
                       pair.told_apart, exact(pair.lead), exact(pair.lead_sd), exact(pair.factor));
  return out;
}

std::string to_json(const Power& p, const Settings& settings) {
  Json pairs = Json::array();
  for (const PowerPair& pair : p.pairs)
    pairs.push_back({{"true_model", planted(p, pair)},
                     {"rival", rival(p, pair)},
                     {"recordings", pair.recordings},
                     {"ranked_before", pair.first},
                     {"distinguished", pair.told_apart},
                     {"lead", finite(pair.lead)},
                     {"lead_sd", finite(pair.lead_sd)},
                     {"factor", finite(pair.factor)}});
  Json recovery = Json::parse(to_json(p.recovery, settings));
  Json all = {{"schema", "swarmfit-power/2"}, {"answer", power_sentence(p)}, {"pairs", std::move(pairs)}};
  for (const char* key : {"conditions", "compared", "true_models", "cases"}) all[key] = recovery[key];
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_power(const std::string& dir, const Power& p, const Settings& settings) {
  begin_study(dir, "power", settings);
  const std::string tables = dir + "/tables";
  write_matrices(tables, p.recovery, settings);
  write_table(
      tables,
      pairs_table(p,
                  "True models and their rivals: in how many recordings the true model ranked before the rival, in how many of these the "
                  "rival was not in the best group, the lead in score, and how many times as long a recording must be for a lead in "
                  "95 %."));
  write_file_atomically(tables + "/pairs.csv", pairs_csv(p));
  write_file_atomically(tables + "/cases.csv", recovery_csv(p.recovery));
  write_file_atomically(dir + "/report.html", power_html(p, settings));
  write_file_atomically(dir + "/power.json", to_json(p, settings));
}

}  // namespace swarmfit
