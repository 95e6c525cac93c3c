// SPDX-License-Identifier: MIT
// Outcomes of candidates in a checkpoint.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/experiment/outcome.h"
#include "fit/store/checkpoint.h"
#include "libtrack/rng.h"

namespace swarmfit {

// All members may be called from several threads at once.
class Journal {
 public:
  // The checkpoint must outlive it.
  explicit Journal(Checkpoint& checkpoint) : checkpoint_(checkpoint) {}

  // Of an ensemble (Ensemble::identity), with these parameters on these seeds.
  static std::string key(const std::string& ensemble, std::span<const double> parameters, std::span<const Rng> seeds);

  // Without distributions and `first`, which are not kept.
  std::optional<Outcome> find(const std::string& key) const;
  // Throws as Checkpoint::add.
  void add(std::span<const std::pair<std::string, Outcome>> outcomes);

 private:
  Checkpoint& checkpoint_;
};

}  // namespace swarmfit
