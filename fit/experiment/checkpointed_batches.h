// SPDX-License-Identifier: MIT
// Pieces of work whose results are kept in a checkpoint batch by batch.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fit/experiment/executor.h"
#include "fit/store/checkpoint.h"

namespace swarmfit {

// Does the pieces of these numbers and returns their results in this order.
using DoPieces = std::function<std::vector<std::string>(std::span<const std::size_t>)>;
// Told how many results there are, after what was found and after every batch.
using OnKept = std::function<void(std::size_t)>;

// The result of every piece: what is in the checkpoint under its key, the others done and kept 64 at a time, at most what a kill costs.
// Without a checkpoint the batches are done, and nothing is kept. Throws what the work throws, Interrupted, RunError.
std::vector<std::string> checkpointed_batches(Checkpoint* checkpoint, std::span<const std::string> keys, const DoPieces& work,
                                              const OnKept& on_kept = {});

}  // namespace swarmfit
