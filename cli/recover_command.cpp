// SPDX-License-Identifier: MIT
// recover: plant models, film them, compare, and count who wins on whose recording.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cli/checkpoints.h"
#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/parts.h"
#include "cli/progress.h"
#include "cli/settings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/study/recovery.h"
#include "libtrack/error.h"
#include "reports/study/parameter_recovery_report.h"
#include "reports/study/recovery_report.h"

namespace swarmfit::cli {
namespace {

RecoveryOptions recovery_options(const RecoverArguments& a) {
  FitArguments fit;
  fit.common = a.common;
  fit.models = a.models;
  fit.preset = a.preset;
  fit.budget = a.budget;
  fit.protocol = a.protocol;
  fit.max_evaluations = a.max_evaluations;
  fit.observation_error = a.observation_error;
  fit.lags = a.lags;
  fit.resolution = a.resolution;
  fit.scoring = a.scoring;
  fit.calibration = a.calibration;
  fit.steps = a.steps;
  RecoveryOptions o;
  o.compare = compare_options(with_protocol(fit));
  o.planted = a.planted.empty() ? o.compare.models : parse_models(a.planted);
  if (a.parameters && o.compare.models.size() != 1) throw InputError("recover --parameters: expected exactly one model, as in -m brownian");
  if (!a.parameters && o.compare.models.size() < 2)
    throw InputError("recover: fewer than two models; expected -m A,B,... or --preset noise|ablation|models|all");
  o.film.dims = a.dims;
  o.film.agents = a.agents;
  o.film.frames = a.frames;
  o.film.dt = 1 / a.fps;
  o.film.sigma = a.noise;
  o.film.dropout = a.dropout;
  o.film.unit = a.unit;
  o.scales = {a.extent, a.spacing, a.speed};
  o.seeds = a.seeds;
  o.spread = a.spread;
  for (const auto& [name, value] : parse_assignments(a.set)) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) throw InputError(fmt::format("--set {}: expected model.parameter=value", name));
    o.set[parse_model(name.substr(0, dot)).name][name.substr(dot + 1)] = value;
  }
  return o;
}

Settings resolved(const RecoverArguments& a, const RecoveryOptions& o) {
  std::vector<std::string> compared, planted;
  for (const auto& m : o.compare.models) compared.push_back(m.name);
  for (const auto& m : o.planted) planted.push_back(m.name);
  Settings s{{"model", quoted(compared)},
             {"plant", quoted(planted)},
             {"seed", std::to_string(a.common.seed)},
             {"seeds", std::to_string(a.seeds)},
             {"agents", std::to_string(a.agents)},
             {"frames", std::to_string(a.frames)},
             {"fps", fmt::format("{}", a.fps)},
             {"dims", std::to_string(a.dims)},
             {"film-noise", fmt::format("{}", a.noise)},
             {"dropout", fmt::format("{}", a.dropout)},
             {"spread", fmt::format("{}", a.spread)},
             {"extent", fmt::format("{}", a.extent)},
             {"spacing", fmt::format("{}", a.spacing)},
             {"speed", fmt::format("{}", a.speed)},
             {"unit", quoted(a.unit)},
             {"protocol", quoted(a.protocol)},
             {"budget", quoted(a.budget)}};
  if (a.parameters) s.emplace_back("parameters", "true");
  if (a.max_evaluations > 0) s.emplace_back("max-evaluations", std::to_string(a.max_evaluations));
  if (!a.observation_error.empty()) s.emplace_back("obs-noise", quoted(a.observation_error));
  if (!a.lags.empty()) s.emplace_back("lags", quoted(a.lags));
  if (!a.resolution.empty()) s.emplace_back("resolution", quoted(a.resolution));
  if (!a.scoring.empty()) s.emplace_back("scoring", quoted(a.scoring));
  if (!a.calibration.empty()) s.emplace_back("calibration", quoted(a.calibration));
  if (!a.steps.empty()) s.emplace_back("steps", quoted(a.steps));
  if (!a.set.empty()) s.emplace_back("set", quoted(a.set));
  return s;
}

int recover_models_of(const RecoverArguments& a, const RecoveryOptions& options, const std::string& dir, Checkpoint& checkpoint) {
  const auto total = options.planted.size() * static_cast<std::size_t>(options.seeds);
  StudyProgress progress(a.common.quiet, total);
  const auto on_case = [&](const RecoveryCase& c) {
    progress.done(fmt::format("{}, seed {}: {} first", options.planted[c.planted].name, c.seed, c.order.front()));
  };
  const auto on_progress = [&](const CompareProgress& now) { progress.show(now); };
  const Recovery result = recover_models(options, on_case, {on_progress, {&executor(), &checkpoint}, parse_part(a.part)});
  if (!cluster().first() || !a.part.empty()) return 0;
  const Settings settings = resolved(a, options);
  write_recovery(dir, result, settings, kVersion);
  std::fputs(a.common.json ? to_json(result, settings).c_str() : recovery_text(result, style()).c_str(), stdout);
  return 0;
}

int recover_parameters_of(const RecoverArguments& a, const RecoveryOptions& options, const std::string& dir, Checkpoint& checkpoint) {
  const auto on_case = [&](std::size_t done) {
    if (!a.common.quiet) std::fprintf(stderr, "%zu/%d\n", done, options.seeds);
  };
  const ParameterRecovery result = recover_parameters(options, on_case, {&executor(), &checkpoint}, parse_part(a.part));
  if (!cluster().first() || !a.part.empty()) return 0;
  const Settings settings = resolved(a, options);
  write_parameter_recovery(dir, result, settings, kVersion);
  std::fputs(a.common.json ? to_json(result, settings).c_str() : parameter_recovery_text(result, style()).c_str(), stdout);
  return 0;
}

}  // namespace

int recover(const RecoverArguments& a) {
  use_threads(a.common);
  const RecoveryOptions options = recovery_options(a);
  parse_part(a.part);
  const std::string dir = a.out.empty() ? "swarmfit-recovery" : a.out;
  if (cluster().first()) check_run_directory(dir);
  if (a.max_time > 0) stop_after(a.max_time);
  Checkpoint checkpoint = checkpoint_in(dir, {kVersion, "", config_toml("recover", resolved(a, options))}, a.resume);
  try {
    const int code = a.parameters ? recover_parameters_of(a, options, dir, checkpoint) : recover_models_of(a, options, dir, checkpoint);
    if (!a.part.empty()) return cluster().first() ? part_done(dir, parse_part(a.part), a.common.quiet) : 0;
    remove_checkpoint(dir);
    return code;
  } catch (const Interrupted&) {
    return stopped_before_the_end(dir);
  }
}

}  // namespace swarmfit::cli
