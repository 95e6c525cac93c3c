// SPDX-License-Identifier: MIT
// What the command line says, in the types of the rooms that are to do it: filled from the table of settings, read by the commands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/compare/compare.h"
#include "fit/study/recovery.h"
#include "fit/study/sweep.h"
#include "fit/synthesis/extend.h"
#include "libeval/group/measured.h"
#include "libtrack/clean.h"
#include "libtrack/read/read.h"

namespace swarmfit::cli {

struct Common {
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores
  bool json = false;
  bool quiet = false;
  bool verbose = false;
};

// What simulate is to play: a scenario or a model, and what of it is to be otherwise.
struct SceneArguments {
  std::string scene;  // name or file of a scenario, or a model
  std::vector<std::string> set;
  std::optional<std::uint64_t> seed;
  std::optional<int> agents, dims;
  std::optional<std::int64_t> frames, warm_up;
  std::optional<double> fps, box, start_radius, start_speed;
  std::optional<std::string> unit;
  double noise = 0, dropout = 0;    // of the camera
  std::string curve;                // heart, star or a file; empty: none
  WorldFile world = {};             // bounds and obstacles instead of the scenario's
  std::optional<std::string> like;  // recording that models learn from that need one
};

struct Arguments {
  std::string command;
  std::string line;  // the whole command as it was given, for pages
  Common common;

  std::vector<std::string> recordings;  // paths, "-" or "demo"; of evaluate the real one
  ReadOptions read;                     // how to read them
  std::string kind;                     // of individuals, by name or number; empty: all
  Cleaning clean;                       // of what was read
  std::string simulated, simulated_columns;
  double smoothing = 0;  // of convert
  std::string write_as;  // of convert: name of a format; empty: by the ending of `out`

  CompareOptions compare;    // of fit, compare, power and recover; its lags, binning and velocity also of evaluate
  RecoveryOptions recovery;  // without its CompareOptions
  bool by_preset = false;    // models were named together
  bool parameters = false;   // recover the parameters of one model, instead of which model
  int seeds = 0;             // of power and sweep
  Part part;                 // of a study: recover, power or sweep
  SceneArguments scene;
  MeasureOptions measure;  // of measure and sweep
  SweepOptions sweep;      // without what it is measured by, seeds and scene

  ExtendOptions extending;  // of extend; its pilot also of augment
  int add = 0;              // of augment: agents

  std::string out, html, picture;    // to write
  std::string table, dir, name;      // to read: a table of energies, a run; a model to tell of
  std::vector<std::string> dirs;     // to read: parts of a study
  std::vector<std::string> formats;  // of report
  bool page = false, flags = false;  // of models: as Markdown; flags of its scene
  double max_time = 0;               // [s]; 0: none
  bool schema = false;               // of scenarios: for editors
  bool check = false;                // of simulate: what the scenario expects
  bool resume = false;               // take up the checkpoint in `out`

  // What config.toml says of all this, name and TOML value.
  std::vector<std::pair<std::string, std::string>> config;
};

}  // namespace swarmfit::cli
