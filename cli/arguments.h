// SPDX-License-Identifier: MIT
// What the command line says, as plain values: filled by the parser, read by the commands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmfit::cli {

struct Common {
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores
  bool json = false;
  bool quiet = false;
};

// A recording and how to read it.
struct DataArguments {
  std::string path;
  std::string time_unit, dates, decimal, missing;
  bool wide = false, join = false;
  std::string columns, delimiter, unit, variable, format, node, frames, times, kind;
  double fps = 0;
  double min_confidence = -1;  // negative: all points
  int fill_gaps = 0;
};

struct FitArguments {
  Common common;
  DataArguments data;                   // its path is not used
  std::vector<std::string> recordings;  // one or more paths
  std::vector<std::string> models;      // one per element, settings included
  std::string preset;
  std::string out;
  std::string budget = "default";
  std::int64_t max_evaluations = 0;
  double max_time = 0;  // [s]; 0: none
  std::vector<std::string> set, fix, bounds;
  std::string presence = "recorded", arena = "open", velocity = "difference", protocol = "default";
  std::string normalisation, scoring, observation_error, lags, resolution, calibration, steps;  // empty: the protocol's
  double smoothing = 0;
  double error_limit = -1;  // negative: the protocol's
  int bins = 0;
  int replicates = 0;
  int population = 0;
  bool common_dynamics = false;
  bool posterior = false, hold_out = false;
  bool resume = false;  // take up the checkpoint in `out`
};

struct ResumeArguments {
  std::string dir, part;
  int threads = 0;
  double max_time = 0;
  bool json = false, quiet = false;
};

struct MergeArguments {
  std::vector<std::string> dirs;
  std::string out;
  ResumeArguments resume;  // how the whole is finished
};

struct ReportArguments {
  std::string dir, out;
  std::vector<std::string> formats;
  bool quiet = false;
};

struct RecoverArguments {
  Common common;
  std::string part;  // "k/n"; empty: all
  std::vector<std::string> models, planted, set;
  std::string preset, out, budget = "quick", protocol = "default", scoring, observation_error, lags, resolution, calibration, steps;
  std::int64_t max_evaluations = 0, frames = 300;
  double max_time = 0;      // [s]; 0: none
  bool resume = false;      // take up the checkpoint in `out`
  bool parameters = false;  // of one model, instead of which model
  int seeds = 10, agents = 10, dims = 3;
  double fps = 100, noise = 0, dropout = 0, spread = 2;
  double extent = 100, spacing = 70, speed = 225;  // a laboratory swarm of midges, in mm and s
  std::string unit = "mm";
};

struct PowerArguments {
  FitArguments fit;
  std::string part;  // "k/n"; empty: all
  int seeds = 3;
};

struct DescribeArguments {
  Common common;
  DataArguments data;
  std::string html;  // page to write, too
  std::string line;  // the command as it was given, for the page
};

struct ConvertArguments {
  Common common;
  DataArguments data;
  std::string out;
  double smoothing = 0;
};

struct EvaluateArguments {
  Common common;
  DataArguments real;
  std::string simulated, simulated_columns;
  std::string html;  // page to write, too
  std::string line;  // the command as it was given, for the page
  std::string normalisation = "reference", velocity = "difference", lags = "1";
  int bins = 0;
};

struct WeighArguments {
  Common common;
  std::string table;
};

struct ModelsArguments {
  Common common;
  std::string name;    // one model only
  bool page = false;   // as Markdown
  bool scene = false;  // flags of `simulate`
};

struct GalleryArguments {
  Common common;
  std::string out;
};

struct SimulateArguments {
  Common common;
  std::string model, out, picture, html;
  std::string line;  // the command as it was given, for the page
  std::vector<std::string> set;
  int agents = 100, dims = 3;
  std::int64_t frames = 500, warm_up = 0;
  double fps = 100, box = 20, noise = 0, dropout = 0;
  double start_radius = 0, start_speed = 0.3;
  std::string unit = "su";
};

}  // namespace swarmfit::cli
