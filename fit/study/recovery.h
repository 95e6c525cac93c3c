// SPDX-License-Identifier: MIT
// Model recovery: recordings made by each model in turn are compared with all of them. Which model wins on whose recording?
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fit/compare/compare.h"
#include "fit/experiment/plant.h"
#include "fit/results/recovery.h"
#include "fit/store/checkpoint.h"

namespace swarmfit {

struct RecoveryOptions {
  std::vector<ModelChoice> planted;  // models that make recordings; compare.models must hold them, and may hold more
  std::map<std::string, std::map<std::string, double>> set;  // planted parameters by model name, physical units; others as below
  CompareOptions compare;
  PlantOptions film;  // length, group and camera; its seed, start and scales are not used
  Scales scales;      // of the planted swarms: parameters are the defaults of the fit table in these scales
  int seeds = 10;     // recordings per model; their seeds count up from compare.seed
  double spread = 2;  // planted values of fitted parameters are multiplied by up to this factor, or divided, anew for every recording
};

// Planted parameters of a model: the fit table's defaults in these scales, with some set by name. Throws InputError on an unknown name.
std::vector<double> planted_parameters(const ModelChoice& model, const Scales& scales, const std::map<std::string, double>& set = {});

// What its parameters are called.
std::vector<PlantedRow> planted_rows(const ModelChoice& model, const std::string& length_unit);

// The same values with every fitted parameter that is not in `set` multiplied by spread^u, u uniform on [-1, 1] and drawn from the seed,
// and kept within the fit bounds. A search starts at the defaults: what it is to recover must lie elsewhere.
std::vector<double> varied(const ModelChoice& model, std::vector<double> parameters, const Scales& scales, double spread,
                           std::uint64_t seed, const std::map<std::string, double>& set = {});

// One planted recording: agents start in a ball (disc) with the rms radius of the scales, at their speed, and are filmed after a warm-up of
// two times L / V.
Tracks planted_recording(const ModelChoice& model, const std::vector<double>& parameters, PlantOptions film, const Scales& scales,
                         std::uint64_t seed);

// Options under which parameters that are not fitted have the same values, and time steps the same length, in the planted swarms and in all
// models compared with them, whatever scales a planted recording turns out to have; values that were set already stay.
CompareOptions with_shared_constants(CompareOptions compare, const Scales& scales);

// What a comparison of a planted recording says of the model that made it.
RecoveryCase recovery_case(std::size_t planted, const std::string& name, std::uint64_t seed, std::vector<double> parameters,
                           const Comparison& result);

// Appends a case and counts its winner.
void add_case(Recovery& recovery, RecoveryCase one);

// Every n-th recording of a study, from the k-th on: for many jobs that do one study. What the others do is left out of the result, which
// is then of no use; what this one did is in the checkpoint.
struct Part {
  int number = 1, of = 1;  // k, n
  bool has(std::size_t recording) const { return static_cast<int>(recording) % of == number - 1; }
};

// How a study of many comparisons is watched, by whom its simulations are made, and where it finds and keeps those that are done.
struct StudyHooks {
  OnCompareProgress on_progress{};  // of the comparison it is at
  Runtime runtime{};
  Part part{};
};

// Called after every case, from the checkpoint or not.
using OnRecoveryCase = std::function<void(const RecoveryCase&)>;
Recovery recover_models(const RecoveryOptions& options, const OnRecoveryCase& on_case = {}, const StudyHooks& hooks = {});

}  // namespace swarmfit
