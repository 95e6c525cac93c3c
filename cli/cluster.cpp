// SPDX-License-Identifier: MIT
#include "cli/cluster.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "libtrack/error.h"

#ifdef SWARMFIT_MPI
#include <mpi.h>
#include <sched.h>

#include <chrono>
#include <thread>
#endif

namespace swarmfit::cli {
namespace {

// How a process's share of the work ended, and what it threw: the same must be thrown by all.
enum class End : std::uint8_t { good, interrupted, input_error, error };
struct Share {
  End end = End::good;
  std::string why;
  std::vector<std::string> results;
};
auto fields(Share& s) { return std::tie(s.end, s.why, s.results); }

Share done(const Threads& here, std::size_t first, std::size_t step, std::size_t pieces, const Executor::Work& work) {
  const std::size_t count = pieces > first ? (pieces - first + step - 1) / step : 0;
  try {
    return {End::good, {}, here.run(count, [&](std::size_t k) { return work(first + k * step); })};
  } catch (const Interrupted&) {
    return {End::interrupted, {}, {}};
  } catch (const InputError& e) {
    return {End::input_error, e.what(), {}};
  } catch (const std::exception& e) {
    return {End::error, e.what(), {}};
  }
}

void throw_again(const Share& share) {
  switch (share.end) {
    case End::good:
      return;
    case End::interrupted:
      throw Interrupted{};
    case End::input_error:
      throw InputError(share.why);
    case End::error:
      throw RunError(share.why);
  }
}

// What travels in one exchange: a message, or why there will be no more.
struct Letter {
  bool leaves = false;
  std::int32_t code = 0;
  std::string text;
};
auto fields(Letter& l) { return std::tie(l.leaves, l.code, l.text); }

#ifdef SWARMFIT_MPI

// Only mpirun, srun and their like say so; a program that starts MPI without them would start a server of its own.
bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"})
    if (std::getenv(name)) return true;
  return false;
}

// Processes of one machine may be tied to processors of their own, or all to all of them: each gets its part of those that any of them may
// use.
int share_of_processors() {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  cpu_set_t mine, all;
  CPU_ZERO(&mine);
  sched_getaffinity(0, sizeof mine, &mine);
  MPI_Allreduce(&mine, &all, sizeof mine, MPI_BYTE, MPI_BOR, machine);
  int processes = 1;
  MPI_Comm_size(machine, &processes);
  MPI_Comm_free(&machine);
  return std::max(1, CPU_COUNT(&all) / processes);
}

// Sleeps between looks: a process that spins takes time from those that work, where there are more of them than processors.
void wait_for(MPI_Request request) {
  int done = 0;
  while (MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done) std::this_thread::sleep_for(std::chrono::microseconds(50));
}

std::vector<std::string> gathered(const std::string& bytes, int size) {
  MPI_Request request = MPI_REQUEST_NULL;
  std::vector<int> sizes(static_cast<std::size_t>(size)), starts(sizes.size());
  const int own = static_cast<int>(bytes.size());
  MPI_Iallgather(&own, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
  wait_for(request);
  int total = 0;
  for (std::size_t k = 0; k < sizes.size(); ++k) starts[k] = total, total += sizes[k];
  std::string all(static_cast<std::size_t>(total), '\0');
  MPI_Iallgatherv(bytes.data(), own, MPI_BYTE, all.data(), sizes.data(), starts.data(), MPI_BYTE, MPI_COMM_WORLD, &request);
  wait_for(request);
  std::vector<std::string> out;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    out.push_back(all.substr(static_cast<std::size_t>(starts[k]), static_cast<std::size_t>(sizes[k])));
  return out;
}

#else

std::vector<std::string> gathered(const std::string& bytes, int) { return {bytes}; }

#endif

std::vector<Letter> letters(const Letter& own, int size) {
  std::vector<Letter> out;
  for (const std::string& bytes : gathered(to_bytes(own), size)) out.push_back(from_bytes<Letter>(bytes));
  return out;
}

}  // namespace

#ifdef SWARMFIT_MPI
Cluster::Cluster() {
  if (!started_by_mpi()) return;
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  threads_ = share_of_processors();
  if (!first() && !(std::freopen("/dev/null", "w", stdout) && std::freopen("/dev/null", "w", stderr))) std::abort();
}

void Cluster::finish() {
  if (by_mpi() && !finished_) MPI_Finalize();
  finished_ = true;
}
#else
Cluster::Cluster() = default;
void Cluster::finish() {}
#endif

Cluster& cluster() {
  static Cluster all;
  return all;
}

std::vector<std::string> Cluster::exchange(const std::string& bytes) {
  if (size_ == 1) return {bytes};
  std::vector<std::string> out;
  for (Letter& letter : letters({false, 0, bytes}, size_)) {
    if (letter.leaves) {
      left_ = true;
      throw RunError("another process: " + (letter.text.empty() ? "it has ended" : letter.text));
    }
    out.push_back(std::move(letter.text));
  }
  return out;
}

int Cluster::leave(int code, const std::string& why) {
  if (size_ > 1 && !left_)
    for (const Letter& letter : letters({true, code, why}, size_)) code = std::max(code, static_cast<int>(letter.code));
  left_ = true;
  finish();
  return code;
}

std::vector<std::string> Processes::run(std::size_t pieces, const Work& work) const {
  if (cluster_.size() == 1) return here_.run(pieces, work);
  const auto processes = static_cast<std::size_t>(cluster_.size());
  in_batch_ = true;
  const Share own = done(here_, static_cast<std::size_t>(cluster_.rank()), processes, pieces, work);
  in_batch_ = false;
  std::vector<Share> shares;
  for (const std::string& bytes : cluster_.exchange(to_bytes(own))) shares.push_back(from_bytes<Share>(bytes));
  for (const Share& share : shares) throw_again(share);
  std::vector<std::string> results;
  for (std::size_t k = 0; k < pieces; ++k) results.push_back(std::move(shares[k % processes].results[k / processes]));
  return results;
}

void Processes::stop_if_asked() const {
  if (cluster_.size() == 1 || in_batch_) here_.stop_if_asked();
}

}  // namespace swarmfit::cli
