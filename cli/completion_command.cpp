// SPDX-License-Identifier: MIT
// What a shell completes after swarmfit: commands, their flags, and the values that a flag allows. Where these are not known, files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "cli/commands.h"
#include "cli/setting.h"
#include "libswarm/model_spec.h"
#include "libswarm/scenario/read.h"

namespace swarmfit::cli {
namespace {

using Words = std::vector<std::string_view>;

Words command_names() {
  Words out;
  for (const Command& c : commands()) out.push_back(c.name);
  return out;
}

// What may be given for a setting, as far as that is a list.
Words values_of(const Setting& s, const Command& command) {
  Words out;
  if (s.allowed.kind == Allowed::Kind::choice) return s.allowed.choices;
  if (s.name == "model" || (s.name == "NAME" && command.bit == kModels))
    for (const ModelSpec& m : models()) out.push_back(m.name);
  if (s.name == "SCENE" || (s.name == "NAME" && command.bit == kScenarios))
    for (const ScenarioFile& f : scenario_files()) out.push_back(f.name);
  if (s.name == "DATA") out.emplace_back("demo");
  return out;
}

bool takes_value(const Setting& s) { return s.allowed.kind != Allowed::Kind::flag; }

// Calls visit(setting) for every setting of a command.
template <class Visit>
void for_settings(const Command& command, Visit visit) {
  for (const Setting& s : settings())
    if ((s.in & command.bit) != 0) visit(s);
}

// ---- bash ---------------------------------------------------------------------------------------------------------------------

std::string bash_command(const Command& command) {
  std::string flags = "--help", places, values;
  for_settings(command, [&](const Setting& s) {
    const auto words = values_of(s, command);
    if (is_positional(s)) {
      places += fmt::format("{}{}", words.empty() ? "" : " ", fmt::join(words, " "));
      return;
    }
    flags += ' ' + flag_of(s);
    if (!takes_value(s)) return;
    const std::string names = s.letter == 0 ? flag_of(s) : fmt::format("{}|-{}", flag_of(s), s.letter);
    values += fmt::format("        {}) words='{}' ;;\n", names, fmt::join(words, " "));
  });
  return fmt::format("    {})\n      flags='{}'\n      words='{}'\n      case $before in\n{}      esac\n      ;;\n", command.name, flags,
                     places.empty() ? places : places.substr(1), values);
}

// A flag that takes a value and has no list of them is completed by files, as an argument is.
std::string bash() {
  std::string out =
      "# bash completion of swarmfit, written by: swarmfit completion bash\n"
      "_swarmfit() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} flags='' words=''\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n";
  out += fmt::format("    mapfile -t COMPREPLY < <(compgen -W '--help --version {}' -- \"$word\")\n    return\n  fi\n",
                     fmt::join(command_names(), " "));
  out += "  case ${COMP_WORDS[1]} in\n";
  for (const Command& c : commands()) out += bash_command(c);
  return out +
         "  esac\n"
         "  case $word in\n"
         "    -*) mapfile -t COMPREPLY < <(compgen -W \"$flags\" -- \"$word\") ;;\n"
         "    *)\n"
         "      mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\"; compgen -f -- \"$word\")\n"
         "      compopt -o filenames 2>/dev/null\n"
         "      ;;\n"
         "  esac\n"
         "}\n"
         "complete -F _swarmfit swarmfit\n";
}

// ---- zsh ----------------------------------------------------------------------------------------------------------------------

// Within single quotes, in a text where brackets and colons mean something.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      out += fmt::format("\\{}", c);
    else
      out += c;
  }
  return out;
}

std::string zsh_setting(const Setting& s, const Command& command) {
  const auto words = values_of(s, command);
  const std::string action = words.empty()      ? "_files"
                             : is_positional(s) ? fmt::format("{{compadd {}; _files}}", fmt::join(words, " "))
                                                : fmt::format("({})", fmt::join(words, " "));
  if (is_positional(s)) return fmt::format(" \\\n        '*:{}:{}'", s.name, action);
  const std::string value = takes_value(s) ? fmt::format(":{}:{}", s.name, action) : "";
  std::string out;
  if (s.letter != 0) out += fmt::format(" \\\n        '*-{}[{}]{}'", s.letter, zsh_text(s.help), value);
  return out + fmt::format(" \\\n        '*{}{}[{}]{}'", flag_of(s), takes_value(s) ? "=" : "", zsh_text(s.help), value);
}

std::string zsh() {
  std::string out =
      "#compdef swarmfit\n# zsh completion of swarmfit, written by: swarmfit completion zsh\n"
      "_swarmfit() {\n  local -a names=(\n";
  for (const Command& c : commands()) out += fmt::format("    '{}:{}'\n", c.name, zsh_text(c.help));
  out +=
      "  )\n  if (( CURRENT == 2 )); then\n    _describe command names\n    return\n  fi\n"
      "  local name=$words[2]\n  words=(\"${(@)words[2,-1]}\")\n  (( CURRENT-- ))\n  case $name in\n";
  for (const Command& command : commands()) {
    out += fmt::format("    {})\n      _arguments '--help[help]'", command.name);
    bool placed = false;  // one rule serves all that is given by its place
    for_settings(command, [&](const Setting& s) {
      if (is_positional(s) && std::exchange(placed, true)) return;
      out += zsh_setting(s, command);
    });
    out += "\n      ;;\n";
  }
  return out + "  esac\n}\nif [ \"$funcstack[1]\" = _swarmfit ]; then _swarmfit; else compdef _swarmfit swarmfit; fi\n";
}

// ---- fish ---------------------------------------------------------------------------------------------------------------------

std::string fish_text(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\'' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
  return out;
}

std::string fish_setting(const Setting& s, const Command& command) {
  const auto words = values_of(s, command);
  std::string line = fmt::format("complete -c swarmfit -n '__fish_seen_subcommand_from {}'", command.name);
  if (is_positional(s)) return words.empty() ? "" : line + fmt::format(" -a '{}'\n", fmt::join(words, " "));
  line += fmt::format(" -l {}", s.name);
  if (s.letter != 0) line += fmt::format(" -s {}", s.letter);
  if (takes_value(s)) line += words.empty() ? " -r" : fmt::format(" -x -a '{}'", fmt::join(words, " "));
  return line + fmt::format(" -d '{}'\n", fish_text(s.help));
}

std::string fish() {
  std::string out = "# fish completion of swarmfit, written by: swarmfit completion fish\n";
  for (const Command& c : commands())
    out += fmt::format("complete -c swarmfit -n __fish_use_subcommand -f -a {} -d '{}'\n", c.name, fish_text(c.help));
  for (const Command& c : commands()) for_settings(c, [&](const Setting& s) { out += fish_setting(s, c); });
  return out;
}

}  // namespace

int completion(const Arguments& a) {
  fmt::print("{}", a.name == "bash" ? bash() : a.name == "zsh" ? zsh() : fish());
  return 0;
}

}  // namespace swarmfit::cli
