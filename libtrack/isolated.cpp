// SPDX-License-Identifier: MIT
#include "libtrack/isolated.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>
#include <string_view>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

// First byte of what the child sends.
constexpr char kDone = 'd', kBadInput = 'i', kFailed = 'f';

bool send(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

std::string receive(int fd) {
  std::string out;
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return out;
    out.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

// Data and stack of this process now [bytes]: the sixth number of /proc/self/statm, in pages. 0: not known.
std::size_t data_size() {
  std::ifstream in("/proc/self/statm");
  std::size_t pages = 0;
  for (int i = 0; i < 6; ++i) in >> pages;
  return in ? pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

void limit_memory(std::size_t more) {
  const std::size_t now = data_size();
  if (now == 0) return;
  const rlimit data{static_cast<rlim_t>(now + more), static_cast<rlim_t>(now + more)};
  ::setrlimit(RLIMIT_DATA, &data);
}

[[noreturn]] void be_the_child(int fd, const std::function<std::string()>& work, int seconds, std::size_t memory,
                               const std::string& on_crash) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would read the answer
  const rlimit time{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds)}, no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(memory);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) std::signal(signal, SIG_DFL);
  char kind = kDone;
  std::string answer;
  try {
    answer = work();
  } catch (const InputError& error) {
    kind = kBadInput;
    answer = error.what();
  } catch (const std::bad_alloc&) {
    kind = kBadInput;
    answer = on_crash;
  } catch (const std::exception& error) {
    kind = kFailed;
    answer = error.what();
  }
  const bool sent = send(fd, std::string_view(&kind, 1)) && send(fd, answer);
  ::_exit(sent ? 0 : 1);
}

}  // namespace

std::string isolated(const std::function<std::string()>& work, int seconds, std::size_t memory, const std::string& on_crash) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw RunError("no pipe can be opened");
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw RunError("no child process can be started");
  }
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(ends[1], work, seconds, memory, on_crash);
  }
  ::close(ends[1]);
  std::string answer = receive(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty()) throw InputError(on_crash);
  const char kind = answer[0];
  answer.erase(0, 1);
  if (kind == kBadInput) throw InputError(answer);
  if (kind == kFailed) throw RunError(answer);
  return answer;
}

}  // namespace swarmfit
