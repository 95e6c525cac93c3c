// SPDX-License-Identifier: MIT
#include "cli/parts.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "fit/store/checkpoint.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/write/run_folder.h"

namespace swarmfit::cli {
namespace {

std::string note_in(const std::string& dir) { return dir + "/part.json"; }

Part part_of(const std::string& dir) {
  if (!std::filesystem::exists(note_in(dir)))
    throw InputError(dir + ": no finished part of a study; expected one made with --part (an interrupted one goes on with resume --part)");
  const auto note = nlohmann::json::parse(read_file(note_in(dir)), nullptr, false);
  if (!note.is_object() || !note.value("part", nlohmann::json()).is_number_integer() ||
      !note.value("of", nlohmann::json()).is_number_integer())
    throw InputError(note_in(dir) + ": damaged; expected what --part wrote");
  return {note["part"], note["of"]};
}

}  // namespace

Part parse_part(const std::string& text) {
  Part part{0, 0};
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, part.number);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
    const auto of = std::from_chars(number.ptr + 1, end, part.of);
    if (of.ec == std::errc() && of.ptr == end && part.number >= 1 && part.number <= part.of) return part;
  }
  throw InputError(fmt::format("{} is not a part; expected k/n with k from 1 to n, as in 3/20", text));
}

int part_done(const std::string& dir, const Part& part, bool quiet) {
  write_file_atomically(note_in(dir), nlohmann::ordered_json{{"part", part.number}, {"of", part.of}}.dump() + '\n');
  if (!quiet) std::fprintf(stderr, "part %d of %d is done; when all are: swarmfit merge DIR... --out DIR\n", part.number, part.of);
  return 0;
}

void merge_parts(const std::vector<std::string>& dirs, const std::string& out) {
  check_run_directory(out);
  std::map<int, std::string> parts;
  const int of = part_of(dirs.front()).of;
  const std::string config = read_file(dirs.front() + "/config.toml");
  for (const std::string& dir : dirs) {
    const Part part = part_of(dir);
    if (part.of != of || read_file(dir + "/config.toml") != config)
      throw InputError(
          fmt::format("{}: a part of another study than {}; expected parts of one, with the same settings", dir, dirs.front()));
    if (!parts.emplace(part.number, dir).second)
      throw InputError(fmt::format("{}: part {} of {}, as is {}; expected each part once", dir, part.number, of, parts[part.number]));
  }
  for (int k = 1; k <= of; ++k)
    if (!parts.contains(k)) throw InputError(fmt::format("merge: part {} of {} is missing; expected all parts", k, of));
  std::vector<std::string> checkpoints;
  for (const auto& [number, dir] : parts)
    if (std::filesystem::exists(dir + "/checkpoint"))
      checkpoints.push_back(dir + "/checkpoint");  // with more parts than cases, some are empty
  begin_run(out, config);
  Checkpoint::merge(checkpoints, out + "/checkpoint");
}

}  // namespace swarmfit::cli
