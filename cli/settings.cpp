// SPDX-License-Identifier: MIT
#include "cli/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>

#include "cli/cluster.h"
#include "fit/experiment/plant.h"
#include "libeval/lags.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "libtrack/read/read.h"
#include "libtrack/write/write.h"

namespace swarmfit::cli {
namespace {

constexpr int kMostSteps = 1000;    // per frame
constexpr int kRen2016Passes = 10;  // of the calibration loop; the paper iterates until the weights settle and names no limit

double number(std::string_view flag, std::string_view text, std::string_view whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(fmt::format("{} {}: '{}' is not a number", flag, whole, text));
  return value;
}

// "name=rest" into its two parts.
std::pair<std::string, std::string> assignment(std::string_view flag, const std::string& text, std::string_view expected) {
  // The name may hold settings of a model in brackets, which have an equals sign of their own.
  const auto bracket = text.rfind(']');
  const auto equals = text.find('=', bracket == std::string::npos ? 0 : bracket);
  if (equals == std::string::npos || equals == 0) throw InputError(fmt::format("{} {}: expected {}", flag, text, expected));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

char delimiter(const std::string& text) {
  if (text == "\\t" || text == "tab") return '\t';
  if (text == "space") return ' ';
  if (text.size() != 1) throw InputError(fmt::format("--delimiter {}: expected one character, tab or space", text));
  return text[0];
}

ReadOptions read_options(const DataArguments& a) {
  ReadOptions o;
  o.columns = a.columns;
  if (!a.delimiter.empty()) o.delimiter = delimiter(a.delimiter);
  if (a.fps > 0) o.fps = a.fps;
  o.unit = a.unit;
  o.time_unit = a.time_unit;
  o.dates = a.dates;
  o.decimal = a.decimal;
  o.wide = a.wide;
  o.join = a.join;
  if (!a.missing.empty()) o.missing = number("--missing", a.missing, a.missing);
  o.variable = a.variable;
  o.format = a.format;
  o.node = a.node;
  if (!(a.min_confidence < 0)) o.min_confidence = a.min_confidence;
  if (!a.frames.empty()) o.frames = parse_interval("--frames", a.frames);
  if (!a.times.empty()) o.times = parse_interval("--times", a.times);
  o.fill_gaps = a.fill_gaps;
  return o;
}

std::vector<std::string> split_outside_brackets(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

namespace {

int parse_steps(const std::string& text) {
  if (text == "auto") return 0;
  if (text == "fewest") return kFewestSteps;
  const double steps = number("--steps", text, text);
  if (!(steps >= 1 && steps <= kMostSteps && steps == std::floor(steps)))
    throw InputError(fmt::format("--steps {}: expected auto, fewest or a whole number from 1 to {}", text, kMostSteps));
  return static_cast<int>(steps);
}

}  // namespace

ConditionOptions condition_options(const FitArguments& a) {
  ConditionOptions o;
  o.presence = a.presence == "constant" ? ConditionOptions::Presence::constant : ConditionOptions::Presence::recorded;
  o.arena = a.arena;
  o.population = a.population;
  o.smoothing = a.smoothing;
  o.velocity = a.velocity == "recorded" ? VelocitySource::recorded : VelocitySource::difference;
  if (a.observation_error != "estimate") {
    o.sigma = number("--obs-noise", a.observation_error, a.observation_error);
    if (o.sigma < 0) throw InputError(fmt::format("--obs-noise {}: expected estimate or a length of at least 0", a.observation_error));
    o.error = o.sigma > 0 ? ConditionOptions::Error::given : ConditionOptions::Error::none;
  }
  o.rounding = a.protocol != "ren2016";
  o.steps = parse_steps(a.steps);
  return o;
}

}  // namespace

// What needs an escape is written as a literal string if it can be: CLI11 reads escapes back as they stand.
std::string quoted(const std::string& text) {
  if (text.find_first_of("\"\\") != std::string::npos && text.find('\'') == std::string::npos) return "'" + text + "'";
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string quoted(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const auto& text : texts) parts.push_back(quoted(text));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

Tracks load(const DataArguments& data, const std::string& path) {
  const ReadOptions options = read_options(data);
  if (data.join && (path == "demo" || path == "-"))
    throw InputError("--join " + path + ": that is one recording; expected a folder or a pattern");
  // The built-in recording goes through the reader like any other, so that --frames, --fill-gaps and the rest hold for it too.
  if (path == "-" && cluster().size() > 1)
    throw InputError("-: standard input reaches only one of several processes; expected a file that all can read");
  Tracks tracks = path == "demo" ? read_tracks_bytes("demo", to_csv(demo_recording()), options)
                  : path != "-"  ? read_tracks(path, options)
                                 : read_tracks_bytes("standard input", {std::istreambuf_iterator<char>(std::cin), {}}, options);
  return data.kind.empty() ? tracks : of_kind(tracks, kind_named(tracks, data.kind));
}

std::vector<ModelChoice> parse_models(const std::vector<std::string>& texts) {
  std::vector<ModelChoice> choices;
  for (const auto& text : texts) {
    for (const auto& part : split_outside_brackets(text)) {
      choices.push_back(parse_model(part));
      for (std::size_t k = 0; k + 1 < choices.size(); ++k)
        if (choices[k].name == choices.back().name)
          throw InputError(fmt::format("--model {}: {} is named twice; expected different models", text, choices.back().name));
    }
  }
  return choices;
}

std::vector<ModelChoice> preset_models(const std::string& preset) {
  const std::vector<std::string> noise = {"bswarm", "bswarm[noise=perlin]", "bswarm[noise=gaussian]", "bswarm[noise=white]"},
                                 ablation = {"bswarm", "bswarm[noise=none]", "bswarm[interaction=off]"},
                                 published = {"bswarm", "noise_aware", "boids", "rvo", "brownian", "langevin"};
  if (preset == "noise") return parse_models(noise);
  if (preset == "ablation") return parse_models(ablation);
  if (preset == "models") return parse_models(published);
  std::vector<std::string> all = noise;
  all.insert(all.end(), ablation.begin() + 1, ablation.end());
  all.insert(all.end(), published.begin() + 1, published.end());
  for (const auto& spec : models())
    if (std::find(all.begin(), all.end(), spec.name) == all.end()) all.emplace_back(spec.name);
  return parse_models(all);
}

std::map<std::string, double> parse_assignments(const std::vector<std::string>& texts) {
  std::map<std::string, double> out;
  for (const auto& text : texts) {
    const auto [name, value] = assignment("--set", text, "parameter=value");
    out[name] = number("--set", value, text);
  }
  return out;
}

Binning binning(const std::string& normalisation, int bins, const std::string& scoring) {
  Binning b = Binning::standard(normalisation == "separate" ? Normalisation::separate
                                : normalisation == "none"   ? Normalisation::none
                                                            : Normalisation::reference);
  if (bins > 0) b.bins = bins;
  if (scoring == "proper" && b.normalisation == Normalisation::separate)
    throw InputError("--scoring proper --normalisation separate: runs have no common axes to be scored on; expected pooled");
  if (!scoring.empty()) b.pooled = scoring == "pooled";
  return b;
}

FitArguments with_protocol(FitArguments a) {
  const bool literal = a.protocol == "ren2016";
  if (a.normalisation.empty()) a.normalisation = literal ? "separate" : "reference";
  if (a.observation_error.empty()) a.observation_error = literal ? "0" : "estimate";
  if (a.lags.empty()) a.lags = literal ? "1" : "auto";
  if (a.error_limit < 0) a.error_limit = literal ? 1 : 0.5;
  if (a.resolution.empty()) a.resolution = literal ? "none" : "recording";
  if (a.scoring.empty()) a.scoring = a.normalisation == "separate" ? "pooled" : "proper";
  if (a.calibration.empty()) a.calibration = literal ? "last" : "mean";
  if (a.steps.empty()) a.steps = literal ? "fewest" : "auto";
  return a;
}

CompareOptions compare_options(const FitArguments& a) {
  CompareOptions o;
  if (!a.preset.empty() && !a.models.empty()) throw InputError("--preset and --model: expected one of them, not both");
  o.models = a.preset.empty() ? parse_models(a.models) : preset_models(a.preset);
  o.requests.set = parse_assignments(a.set);
  for (const auto& name : a.fix) o.requests.fix[name] = true;
  for (const auto& text : a.bounds) {
    const auto [name, range] = assignment("--bounds", text, "parameter=lower:upper");
    const auto colon = range.find(':');
    if (colon == std::string::npos) throw InputError(fmt::format("--bounds {}: expected parameter=lower:upper", text));
    o.requests.bounds[name] = {number("--bounds", std::string_view(range).substr(0, colon), text),
                               number("--bounds", std::string_view(range).substr(colon + 1), text)};
  }
  o.conditions = condition_options(a);
  o.binning = binning(a.normalisation, a.bins, a.scoring);
  o.budget = budget_named(a.budget);
  if (a.replicates > 0) o.budget.search.replicates = a.replicates;
  if (a.protocol == "ren2016") o.budget.passes = kRen2016Passes;
  o.protocol = a.protocol;
  o.seed = a.common.seed;
  o.max_evaluations = a.max_evaluations;
  o.lags = parse_lags(a.lags);
  o.error_limit = a.error_limit;
  o.resolution = a.resolution == "recording";
  o.mean_weights = a.calibration == "mean";
  o.posterior = a.posterior;
  o.hold_out = a.hold_out;
  return o;
}

std::vector<std::pair<std::string, std::string>> resolved(const FitArguments& a, const std::vector<ModelChoice>& models) {
  std::vector<std::string> names;
  for (const auto& model : models) names.push_back(model.name);
  std::vector<std::pair<std::string, std::string>> out{{"DATA", quoted(a.recordings)}, {"model", quoted(names)}};
  const auto text = [&](const char* flag, const std::string& value) {
    if (!value.empty()) out.emplace_back(flag, quoted(value));
  };
  const auto list = [&](const char* flag, const std::vector<std::string>& values) {
    if (!values.empty()) out.emplace_back(flag, quoted(values));
  };
  const auto positive = [&](const char* flag, auto value) {
    if (value > 0) out.emplace_back(flag, fmt::format("{}", value));
  };
  text("columns", a.data.columns);
  text("delimiter", a.data.delimiter);
  positive("fps", a.data.fps);
  text("unit", a.data.unit);
  text("time-unit", a.data.time_unit);
  text("dates", a.data.dates);
  text("decimal", a.data.decimal);
  text("missing", a.data.missing);
  if (a.data.join) out.emplace_back("join", "true");
  if (a.data.wide) out.emplace_back("wide", "true");
  text("var", a.data.variable);
  text("format", a.data.format);
  text("node", a.data.node);
  if (a.data.min_confidence >= 0) out.emplace_back("min-confidence", fmt::format("{}", a.data.min_confidence));
  text("frames", a.data.frames);
  text("times", a.data.times);
  text("kind", a.data.kind);
  positive("fill-gaps", a.data.fill_gaps);
  out.emplace_back("seed", std::to_string(a.common.seed));
  text("protocol", a.protocol);
  text("budget", a.budget);
  positive("max-evaluations", a.max_evaluations);
  positive("replicates", a.replicates);
  list("set", a.set);
  list("fix", a.fix);
  list("bounds", a.bounds);
  text("presence", a.presence);
  text("arena", a.arena);
  positive("population", a.population);
  if (a.common_dynamics) out.emplace_back("common", "true");
  if (a.hold_out) out.emplace_back("holdout", "true");
  if (a.posterior) out.emplace_back("posterior", "true");
  text("obs-noise", a.observation_error);
  out.emplace_back("error-limit", fmt::format("{}", a.error_limit));
  text("resolution", a.resolution);
  text("scoring", a.scoring);
  text("calibration", a.calibration);
  text("lags", a.lags);
  text("steps", a.steps);
  positive("smooth", a.smoothing);
  text("velocity", a.velocity);
  text("normalisation", a.normalisation);
  positive("bins", a.bins);
  return out;
}

void use_threads(const Common& common) {
  const int threads = common.threads > 0 ? common.threads : cluster().threads();
  if (threads > 0) omp_set_num_threads(threads);
}

}  // namespace swarmfit::cli
