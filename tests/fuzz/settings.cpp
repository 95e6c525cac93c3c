// SPDX-License-Identifier: MIT
// What the program reads back from itself, and what people may have changed in it: config.toml, checkpoints, words of settings.
#include <optional>
#include <tuple>

#include "cli/config_file.h"
#include "cli/setting.h"
#include "fit/store/bytes.h"
#include "fit/store/checkpoint.h"
#include "libtrack/error.h"
#include "tests/fuzz/fuzz.h"

namespace swarmfit::fuzz {
namespace {

using namespace swarmfit::cli;

// The command is that of the first heading that names one; all settings are checked and understood, and nothing is run.
void config(const std::string& text) {
  for (const Command& command : commands()) {
    if (text.find('[' + std::string(command.name) + ']') == std::string::npos) continue;
    contract([&] {
      Values given;
      const Values found = read_config("config.toml", text, command);
      for (const Setting& s : settings())
        if ((s.in & command.bit) != 0 && found.has(s.name)) given.set(s.name, checked(s, found.words(s.name)));
      const auto arguments = understood(command, given);
      for (const auto& [name, value] : arguments.config)
        if (name.empty() || value.empty()) broken("config.toml would have an empty entry");
    });
  }
}

// A word for every setting in turn.
void word(const std::string& text) {
  for (const Setting& s : settings()) contract([&] { static_cast<void>(checked(s, {text})); });
}

RunIdentity one_run() { return {"0", "recording", "config"}; }

// A checkpoint of the run as seeds have it; what is kept in it is taken up as a study takes it.
void checkpoint(const std::string& bytes) {
  contract([&] {
    const auto taken = Checkpoint::copy_of(bytes, "checkpoint", one_run());
    if (taken.size() > bytes.size()) broken("more records than bytes");
  });
}

struct Part {
  std::string name;
  std::vector<double> values;
  std::optional<std::vector<std::string>> words;
};
auto fields(Part& part) { return std::tie(part.name, part.values, part.words); }

// The bytes below a record's seal.
void kept(const std::string& bytes) {
  ByteReader from(bytes);
  const auto part = from.take<std::optional<Part>>();
  if (!from.ended()) return;
  std::string again;
  put(again, part);
  if (again.size() != bytes.size()) broken("a part comes back in another size");
}

}  // namespace

std::vector<Target> targets() { return {{"config.toml", config}, {"words", word}, {"checkpoint", checkpoint}, {"kept", kept}}; }

}  // namespace swarmfit::fuzz
