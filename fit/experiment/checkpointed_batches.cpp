// SPDX-License-Identifier: MIT
#include "fit/experiment/checkpointed_batches.h"

#include <algorithm>

namespace swarmfit {

namespace {

constexpr std::size_t kKeptTogether = 64;  // pieces between two records of a checkpoint, at most: what a kill costs

}  // namespace

std::vector<std::string> checkpointed_batches(Checkpoint* checkpoint, std::span<const std::string> keys, const DoPieces& work,
                                              const OnKept& on_kept) {
  std::vector<std::string> results(keys.size());
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    auto kept = checkpoint ? checkpoint->find(keys[k]) : std::nullopt;
    if (kept)
      results[k] = std::move(*kept);
    else
      missing.push_back(k);
  }
  if (on_kept) on_kept(keys.size() - missing.size());
  for (std::size_t done = 0; done < missing.size(); done += kKeptTogether) {
    const std::span batch(missing.begin() + static_cast<std::ptrdiff_t>(done), std::min(kKeptTogether, missing.size() - done));
    auto fresh = work(batch);
    std::vector<Checkpoint::Record> records;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (checkpoint) records.emplace_back(keys[batch[i]], fresh[i]);
      results[batch[i]] = std::move(fresh[i]);
    }
    if (checkpoint) checkpoint->add(records);
    if (on_kept) on_kept(keys.size() - missing.size() + done + batch.size());
  }
  return results;
}

}  // namespace swarmfit
