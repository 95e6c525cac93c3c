// SPDX-License-Identifier: MIT
// The program: what goes in and out of a process, and the one line for whatever goes wrong.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/program.h"
#include "cli/setting.h"
#include "libtrack/error.h"
#include "libtrack/memory.h"

namespace swarmfit::cli {
namespace {

// The command as it was given, fit to be pasted into a shell.
std::string command_line(int argc, char** argv) {
  std::string line = "swarmfit";
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const bool plain = word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/%@") == word.npos;
    line += ' ';
    if (plain && !word.empty()) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

// What is closed at the start must not be opened by chance as a file of results: 0 to 2 are taken, and writing to them fails.
void take_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDONLY) == -1) return;
}

// Output that did not arrive is a failure, and the only way to learn of it is to ask.
void require_written_output() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw RunError(fmt::format("standard output: cannot be written: {}", std::strerror(errno == 0 ? EIO : errno)));
}

int run_line(int argc, char** argv) {
  auto arguments = parse({argv + 1, argv + argc});
  int code = 0;
  if (arguments) {
    arguments->line = command_line(argc, argv);
    code = run(*arguments);
  }
  require_written_output();
  return code;
}

// Libraries name a setting as `scoring`; here it is a flag.
std::string with_flags(std::string text) {
  for (const Setting& s : settings()) {
    const std::string name = fmt::format("`{}`", s.name);
    for (auto found = text.find(name); found != text.npos; found = text.find(name, found)) text.replace(found, name.size(), flag_of(s));
  }
  return text;
}

// One line on standard error for whatever went wrong.
int complain(const std::string& what, int code) {
  constexpr std::size_t kLongestLine = 2000;
  std::string line;
  for (const char c : with_flags(what).substr(0, kLongestLine)) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  std::fprintf(stderr, "swarmfit: %s\n", line.c_str());
  return cluster().leave(code, what);
}

}  // namespace
}  // namespace swarmfit::cli

int main(int argc, char** argv) {
  using swarmfit::cli::complain;
  swarmfit::cli::take_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a failed write, and said to be one
  swarmfit::keep_freed_memory();
  swarmfit::cli::cluster();
  try {
    return swarmfit::cli::cluster().leave(swarmfit::cli::run_line(argc, argv), "");
  } catch (const swarmfit::InputError& e) {
    return complain(e.what(), 2);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory; expected a smaller job", 1);
  } catch (const std::exception& e) {
    return complain(e.what(), 1);
  } catch (...) {
    return complain("an unknown error", 1);
  }
}
