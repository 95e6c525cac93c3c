// SPDX-License-Identifier: MIT
// Several processes that do one job, started by mpirun or srun. All run the same program on the same input and take the same decisions;
// pieces of work are shared out among them, and every result is brought to all. The first alone writes and speaks.
#pragma once

#include <atomic>

#include "fit/experiment/executor.h"

namespace swarmfit::cli {

// All processes. Without MPI, or where nobody started several: a cluster of one.
class Cluster {
 public:
  Cluster();
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  int size() const { return size_; }
  int rank() const { return rank_; }
  bool first() const { return rank_ == 0; }
  bool by_mpi() const { return threads_ > 0; }  // started by mpirun or its like, if only once
  // Threads that are this process's share of its machine; 0: all.
  int threads() const { return threads_; }

  // What each process has to tell, in order of their ranks. All must call it, as often as each other. Throws RunError with the reason where
  // one of them has left.
  std::vector<std::string> exchange(const std::string& bytes);
  // What the first process has.
  std::string broadcast(const std::string& bytes) { return exchange(first() ? bytes : "").front(); }

  // The last thing that a process does. An exit code other than 0 ends the work of the others, too, with this line. Returns the exit code
  // of all: the largest.
  int leave(int code, const std::string& why);

 private:
  void finish();

  int size_ = 1, rank_ = 0, threads_ = 0;
  bool left_ = false, finished_ = false;
};

// The one that this process belongs to.
Cluster& cluster();

// Shares work out among the threads of all processes: piece k is done by process k modulo their number.
class Processes : public Executor {
 public:
  // `stopped` is asked before every piece and within long ones, from any thread, and ends the work. It is enough that one process says so.
  Processes(Cluster& cluster, std::function<bool()> stopped) : cluster_(cluster), here_(std::move(stopped)) {}
  std::vector<std::string> run(std::size_t pieces, const Work& work) const override;
  // Of several processes not between two batches: there all take the same path.
  void stop_if_asked() const override;

 private:
  Cluster& cluster_;
  Threads here_;
  mutable std::atomic<bool> in_batch_ = false;
};

}  // namespace swarmfit::cli
