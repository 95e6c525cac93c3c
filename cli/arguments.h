// SPDX-License-Identifier: MIT
// What the command line says, in the types of the rooms that are to do it: filled from the table of settings, read by the commands.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fit/compare/compare.h"
#include "fit/study/recovery.h"
#include "fit/synthesis/extend.h"
#include "libtrack/read/read.h"

namespace swarmfit::cli {

struct Common {
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores
  bool json = false;
  bool quiet = false;
};

// What simulate and the gallery make, in simulation units.
struct SceneArguments {
  std::string model;
  std::vector<std::string> set;
  std::uint64_t seed = 1;
  int agents = 100, dims = 3;
  std::int64_t frames = 500, warm_up = 0;
  double fps = 100, box = 20, noise = 0, dropout = 0;
  double start_radius = 0, start_speed = 0.3;
  std::string unit = "su";
  std::string curve;          // heart, star or a file; empty: none
  std::string like = "demo";  // recording of which models are told that need one
};

struct Arguments {
  std::string command;
  std::string line;  // the whole command as it was given, for pages
  Common common;

  std::vector<std::string> recordings;  // paths, "-" or "demo"; of evaluate the real one
  ReadOptions read;                     // how to read them
  std::string kind;                     // of individuals, by name or number; empty: all
  std::string simulated, simulated_columns;
  double smoothing = 0;  // of convert

  CompareOptions compare;        // of fit, compare, power and recover; its lags, binning and velocity also of evaluate
  bool common_dynamics = false;  // fit what the models have in common once
  RecoveryOptions recovery;      // without its CompareOptions
  bool parameters = false;       // recover the parameters of one model, instead of which model
  int seeds = 0;                 // of power
  Part part;                     // of a study: recover or power
  SceneArguments scene;

  ExtendOptions extending;  // of extend; its pilot also of augment
  int add = 0;              // of augment: agents

  std::string out, html, picture;    // to write
  std::string table, dir, name;      // to read: a table of energies, a run; a model to tell of
  std::vector<std::string> dirs;     // to read: parts of a study
  std::vector<std::string> formats;  // of report
  bool page = false, flags = false;  // of models: as Markdown; flags of its scene
  double max_time = 0;               // [s]; 0: none
  bool resume = false;               // take up the checkpoint in `out`

  // What config.toml says of all this, name and TOML value.
  std::vector<std::pair<std::string, std::string>> config;
};

}  // namespace swarmfit::cli
