// SPDX-License-Identifier: MIT
#include "cli/style.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "cli/cluster.h"

namespace swarmfit::cli {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// The first of the three that is set decides, as in setlocale(3).
bool utf8_locale() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const auto value = variable(name);
    if (!value.empty()) return value.find("UTF-8") != value.npos || value.find("utf8") != value.npos;
  }
  return false;
}

}  // namespace

TextStyle style() {
  TextStyle out;
  // mpirun shows every process a terminal, wherever the output goes.
  out.colour = isatty(STDOUT_FILENO) != 0 && !cluster().by_mpi() && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
  out.unicode = utf8_locale();
  return out;
}

}  // namespace swarmfit::cli
