// SPDX-License-Identifier: MIT
// The table of settings as a man page and as the Markdown of docs/reference/settings.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/setting.h"
#include "cli/version.h"

namespace swarmfit::cli {
namespace {

constexpr std::string_view kFirstGroup = "General";

std::string names_of(Commands bits) {
  std::vector<std::string_view> names;
  for (const Command& c : commands())
    if ((c.bit & bits) != 0) names.push_back(c.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// What is given by its place: "DATA...", "[NAME]".
std::string arguments_of(const Command& command) {
  std::string out;
  for (const Setting& s : settings()) {
    if ((s.in & command.bit) == 0 || !is_positional(s)) continue;
    const std::string name = fmt::format("{}{}", s.name, s.allowed.many ? "..." : "");
    out += fmt::format("{}{}", out.empty() ? "" : " ", s.required ? name : '[' + name + ']');
  }
  return out;
}

std::string default_of(const Setting& s) {
  if (s.allowed.kind == Allowed::Kind::flag) return "off";
  std::string out(s.initial);
  if (out.empty() && s.follows != nullptr) out = "follows from other settings";
  if (s.elsewhere.in != 0)
    out += fmt::format("; {}: {}", names_of(s.elsewhere.in & s.in), s.elsewhere.initial.empty() ? "none" : s.elsewhere.initial);
  if (!s.ren2016.empty()) out += fmt::format("; with --protocol ren2016: {}", s.ren2016);
  return out;
}

// In the order in which they first appear.
std::vector<std::string_view> groups() {
  std::vector<std::string_view> out;
  for (const Setting& s : settings())
    if (std::find(out.begin(), out.end(), s.group) == out.end()) out.push_back(s.group);
  return out;
}

std::string replaced(std::string_view text, char what, std::string_view with) {
  std::string out;
  for (const char c : text) out += c == what ? std::string(with) : std::string(1, c);
  return out;
}

// ---- Markdown -----------------------------------------------------------------------------------------------------------------

std::string cell(std::string_view text) { return replaced(replaced(text, '|', "\\|"), '<', "&lt;"); }

std::string markdown_row(const Setting& s) {
  const std::string letter = s.letter == 0 ? "" : fmt::format("`-{}`, ", s.letter);
  return fmt::format("| {}`{}` | {} | {} | {} | {} |\n", letter, flag_of(s),
                     s.allowed.kind == Allowed::Kind::flag ? "" : cell(expected(s.allowed)), cell(default_of(s)), cell(s.help),
                     names_of(s.in));
}

std::string markdown() {
  std::string out =
      "# Commands and settings\n\n"
      "`swarmfit manual markdown` writes this page from the program's own table of settings. `swarmfit COMMAND --help` says the same "
      "of one command, `man swarmfit` of all.\n\n"
      "A setting of `fit`, `compare`, `recover`, `power`, `measure` and `sweep` may also stand in a TOML file, by its name without dashes; "
      "`--config FILE` reads it, and the command line wins. Every run leaves its `config.toml`.\n\n"
      "## Commands\n\n| command | arguments | what it does |\n|---|---|---|\n";
  for (const Command& c : commands()) {
    const std::string arguments = arguments_of(c);
    out += fmt::format("| `{}` | {} | {} |\n", c.name, arguments.empty() ? "" : fmt::format("`{}`", arguments), cell(c.help));
  }
  out += "\nEvery command has `--help`, and the program has `--version`. Exit codes: 0 done, 1 failed, 2 bad input, 130 interrupted.\n";
  for (const std::string_view group : groups()) {
    out += fmt::format(
        "\n## {}\n\n| setting | value | default | what it does | commands |\n"
        "|---|---|---|---|---|\n",
        group.empty() ? kFirstGroup : group);
    for (const Setting& s : settings())
      if (s.group == group) out += markdown_row(s);
  }
  return out;
}

// ---- man ----------------------------------------------------------------------------------------------------------------------

// A line that begins with a full stop or an apostrophe would be a request.
std::string roff(std::string_view text) {
  std::string out = replaced(replaced(text, '\\', "\\e"), '-', "\\-");
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

// With a full stop, unless it asks something.
std::string ended(std::string_view text) { return roff(text) + (text.ends_with('?') ? "" : "."); }

std::string sentence(std::string_view label, const std::string& text) {
  return text.empty() ? "" : fmt::format("{}: {}\n", label, ended(text));
}

std::string man_entry(const Setting& s) {
  const bool flag = s.allowed.kind == Allowed::Kind::flag;
  std::string out = ".TP\n";
  if (s.letter != 0) out += fmt::format("\\fB\\-{}\\fR, ", s.letter);
  out += fmt::format("\\fB{}\\fR{}\n{}\n", roff(flag_of(s)), flag || is_positional(s) ? "" : "=\\fIVALUE\\fR", ended(s.help));
  if (!flag && s.allowed.kind != Allowed::Kind::text) out += sentence("Value", expected(s.allowed));
  if (!flag) out += sentence("Default", default_of(s));
  return out + sentence("Commands", names_of(s.in));
}

std::string man() {
  std::string out = fmt::format(
      ".TH SWARMFIT 1 \"\" \"swarmfit {}\" \"User Commands\"\n.SH NAME\n"
      "swarmfit \\- fits and ranks models of collective motion on recorded tracks\n.SH SYNOPSIS\n"
      ".B swarmfit\n\\fICOMMAND\\fR [\\fIARGUMENTS\\fR] [\\fISETTINGS\\fR]\n.SH DESCRIPTION\n"
      "swarmfit reads tracks of animals, simulates published models under the same conditions, fits the parameters of each model, and\n"
      "ranks the models by how closely their motion matches the recording.\n.SH COMMANDS\n",
      kVersion);
  for (const Command& c : commands()) out += fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", c.name, roff(arguments_of(c)), ended(c.help));
  out += ".SH SETTINGS\n";
  for (const std::string_view group : groups()) {
    out += fmt::format(".SS {}\n", group.empty() ? kFirstGroup : group);
    for (const Setting& s : settings())
      if (s.group == group) out += man_entry(s);
  }
  return out +
         ".SH EXIT STATUS\n0: done; 1: failed; 2: bad input; 130: interrupted, and can be resumed.\n.SH EXAMPLE\n.nf\n"
         "swarmfit describe tracks.csv \\-\\-fps 25 \\-\\-unit m\n"
         "swarmfit compare tracks.csv \\-\\-fps 25 \\-\\-unit m \\-\\-preset models \\-\\-out results\n.fi\n";
}

}  // namespace

int manual(const Arguments& a) {
  fmt::print("{}", a.name == "man" ? man() : markdown());
  return 0;
}

}  // namespace swarmfit::cli
