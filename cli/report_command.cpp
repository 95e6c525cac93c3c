// SPDX-License-Identifier: MIT
// report: what a run holds, in the formats of a paper.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "cli/commands.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/run/run_files.h"

namespace swarmfit::cli {
namespace {

constexpr const char* kConverter = "rsvg-convert";

// Runs a program of the path without a shell, its standard output thrown away. Its exit code; -1 if there is no such program.
int run_program(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

void require_converter() {
  if (run_program({kConverter, "--version"}) != 0)
    throw RunError(fmt::format("`format` pdf: {} does not run; install it (package librsvg2-bin), or take `format` svg", kConverter));
}

void write_pdf(const std::string& svg, const std::string& pdf) {
  const std::string unfinished = fmt::format("{}.{}.part", pdf, getpid());
  const bool done =
      run_program({kConverter, "--format", "pdf", "--output", unfinished, svg}) == 0 && std::rename(unfinished.c_str(), pdf.c_str()) == 0;
  if (done) return;
  unlink(unfinished.c_str());
  throw RunError(fmt::format("{}: {} cannot write it", pdf, kConverter));
}

// "runs/mine/" -> "runs/mine-paper"
std::string beside(const std::string& dir) {
  namespace fs = std::filesystem;
  fs::path path = fs::path(dir).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (path.filename() == "." || path.filename() == ".." || path.empty()) path = fs::canonical(dir);
  return path.string() + "-paper";
}

}  // namespace

int report(const Arguments& a) {
  struct Job {
    RunFile file;
    bool convert;
  };
  std::vector<Job> jobs;
  for (const auto& format : a.formats)
    for (RunFile& file : run_files(a.dir, format)) jobs.push_back({std::move(file), format == "pdf"});
  const std::string out = a.out.empty() ? beside(a.dir) : a.out;
  if (std::filesystem::exists(out) && !std::filesystem::is_directory(out))
    throw InputError("`out` " + out + ": is not a folder; expected one");
  setenv("SOURCE_DATE_EPOCH", "0", 0);  // no clock in a PDF: the same figure, the same bytes
  for (const Job& job : jobs)
    if (job.convert) {
      require_converter();
      break;
    }
  make_directory(out);
  for (const Job& job : jobs) {
    const std::string target = out + '/' + job.file.name;
    if (job.convert)
      write_pdf(job.file.path, target);
    else
      write_file_atomically(target, read_file(job.file.path));
    if (!a.common.quiet) std::printf("%s\n", target.c_str());
  }
  return 0;
}

}  // namespace swarmfit::cli
