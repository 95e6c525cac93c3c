// SPDX-License-Identifier: MIT
// Where work is done.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fit/store/bytes.h"

namespace swarmfit {

// Thrown by long work that was asked to stop; what was kept before is good.
struct Interrupted {};

class Executor {
 public:
  // The result of one piece of work, as bytes: it may be needed in another process. Called from several threads at once; a function of its
  // argument alone.
  using Work = std::function<std::string(std::size_t)>;

  virtual ~Executor() = default;
  // The results of work(0) .. work(pieces - 1), in order. Each piece is done once; who does it and when changes nothing. What a piece
  // throws is thrown on, that of the first of them; Interrupted where the work was asked to stop.
  virtual std::vector<std::string> run(std::size_t pieces, const Work& work) const = 0;

  // For long pieces, which call it now and then, from any thread: throws Interrupted where the work was asked to stop.
  virtual void stop_if_asked() const {}

  // The same for results that can be put into bytes (fit/store/bytes.h).
  template <class T, class Make>
  std::vector<T> each(std::size_t pieces, const Make& make) const {
    std::vector<T> out;
    for (const std::string& bytes : run(pieces, [&](std::size_t k) { return to_bytes(T(make(k))); })) out.push_back(from_bytes<T>(bytes));
    return out;
  }
};

// All threads of this process (OpenMP's). Before every piece and within long ones `stopped` is asked, if there is one, from any thread.
class Threads : public Executor {
 public:
  explicit Threads(std::function<bool()> stopped = {}) : stopped_(std::move(stopped)) {}
  std::vector<std::string> run(std::size_t pieces, const Work& work) const override;
  void stop_if_asked() const override;

 private:
  std::function<bool()> stopped_;
};

// Those of this process, never stopped.
const Executor& threads();

}  // namespace swarmfit
