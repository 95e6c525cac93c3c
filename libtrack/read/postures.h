// SPDX-License-Identifier: MIT
// From the points of postures to one position per individual and frame: --node and --min-confidence.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libtrack/read/raw_table.h"

namespace swarmfit {

// Collects postures into the rows of a table, as the same trackers' files of any container need it.
class Postures {
 public:
  // `nodes`: the names of the points in the file's order. Throws InputError when --node names none of them, or is missing where there
  // are several; `usual` is the point taken then, for trackers where one of them is the individual's position by definition.
  Postures(RawTable& table, const ReadOptions& options, std::vector<std::string> nodes, const std::string& usual = {});

  // One individual in one frame: coordinates per node, NaN where not seen; z and confidence may be empty. Confidences of NaN are none.
  // `time` is kept when it is not NaN. A posture without the chosen point makes no row, and is counted.
  struct Posture {
    std::uint32_t track;
    double frame, time;
    std::span<const double> x, y, z, confidence;
  };
  void add(const Posture&);

  // Writes the notes. The table is not to be used before.
  void finish();

 private:
  RawTable& table_;
  double least_;
  std::vector<std::string> nodes_;
  std::vector<std::size_t> chosen_;  // indices of nodes; several: their mean
  std::string choice_;
  std::size_t postures_ = 0, unseen_ = 0, points_ = 0, unsure_ = 0, partial_ = 0;
};

}  // namespace swarmfit
