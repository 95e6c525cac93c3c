// SPDX-License-Identifier: MIT
#include "fit/experiment/executor.h"

#include "libtrack/parallel_for.h"

namespace swarmfit {

std::vector<std::string> Threads::run(std::size_t pieces, const Work& work) const {
  std::vector<std::string> results(pieces);
  parallel_for(pieces, [&](std::size_t k) {
    stop_if_asked();
    results[k] = work(k);
  });
  return results;
}

void Threads::stop_if_asked() const {
  if (stopped_ && stopped_()) throw Interrupted{};
}

const Executor& threads() {
  static const Threads all;
  return all;
}

}  // namespace swarmfit
