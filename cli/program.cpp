// SPDX-License-Identifier: MIT
// The only file that includes CLI11, which takes long to compile.
#include "cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <iterator>

#include "cli/config_file.h"
#include "cli/setting.h"
#include "cli/version.h"
#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

// What the parser saw of one setting.
struct Slot {
  const Setting* setting = nullptr;
  CLI::Option* option = nullptr;
  std::string word;
  std::vector<std::string> words;
};

struct Subcommand {
  const Command* command = nullptr;
  CLI::App* app = nullptr;
  std::deque<Slot> slots;
};

CLI::Option* add_option(CLI::App& app, Slot& slot, const std::string& names, const std::string& help) {
  const Allowed& allowed = slot.setting->allowed;
  if (allowed.kind == Allowed::Kind::flag) return app.add_flag(names, slot.word, help);
  if (allowed.many) return app.add_option(names, slot.words, help)->take_all();
  return app.add_option(names, slot.word, help);
}

void add_setting(Subcommand& sub, const Setting& s) {
  Slot& slot = sub.slots.emplace_back();
  slot.setting = &s;
  const std::string names = s.letter == 0 ? flag_of(s) : fmt::format("-{},{}", s.letter, flag_of(s));
  slot.option = add_option(*sub.app, slot, names, std::string(s.help));
  if (s.allowed.kind != Allowed::Kind::flag) slot.option->type_name(label(s.allowed));
  if (const auto initial = initial_of(s, sub.command->bit); !initial.empty() && !governed(s, sub.command->bit))
    slot.option->default_str(std::string(initial));
  if (!s.group.empty()) slot.option->group(std::string(s.group));
  if (s.required) slot.option->required();
}

// Reads --config by the table, with a TOML reader that knows quotes. What the command line does not give is kept in `found`; CLI11 itself
// is told no more than that what it requires is there.
class ConfigReader : public CLI::Config {
 public:
  ConfigReader(const CLI::App& app, const std::deque<Subcommand>& subcommands, Values& found)
      : app_(app), subcommands_(subcommands), found_(found) {}

  std::string to_config(const CLI::App* /*app*/, bool /*defaults*/, bool /*help*/, std::string /*prefix*/) const override { return ""; }

  std::vector<CLI::ConfigItem> from_config(std::istream& in) const override {
    const std::string path = app_.get_config_ptr()->as<std::string>();
    const std::string text(std::istreambuf_iterator<char>(in), {});
    std::vector<CLI::ConfigItem> required;
    for (const Subcommand& sub : subcommands_) {
      if (!app_.got_subcommand(sub.app)) continue;
      const Values values = read_config(path, text, *sub.command);
      for (const Slot& slot : sub.slots) {
        if (!slot.option->empty() || !values.has(slot.setting->name)) continue;
        found_.set(slot.setting->name, checked(*slot.setting, values.words(slot.setting->name)));
        if (slot.setting->required) required.push_back({{std::string(sub.command->name)}, std::string(slot.setting->name), {"given"}});
      }
    }
    return required;
  }

 private:
  const CLI::App& app_;
  const std::deque<Subcommand>& subcommands_;
  Values& found_;
};

class Parser {
 public:
  Parser() {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", std::string("swarmfit ") + kVersion);
    app_.set_config("--config", "", "read options from a TOML file, such as config.toml of a run");
    app_.config_formatter(std::make_shared<ConfigReader>(app_, subcommands_, configured_));
    app_.allow_config_extras(CLI::config_extras_mode::error);
    app_.fallthrough();
    for (const Command& command : commands()) {
      Subcommand& sub = subcommands_.emplace_back();
      sub.command = &command;
      sub.app = app_.add_subcommand(std::string(command.name), std::string(command.help));
      for (const Setting& s : settings())
        if ((s.in & command.bit) != 0) add_setting(sub, s);
    }
  }

  std::optional<Arguments> parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());  // CLI11 takes them last first
    try {
      app_.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() != 0) throw InputError(fmt::format("{}; see --help", e.what()));
      app_.exit(e);  // prints help or version
      return std::nullopt;
    }
    const auto chosen = std::find_if(subcommands_.begin(), subcommands_.end(), [&](const auto& s) { return app_.got_subcommand(s.app); });
    Values given = configured_;
    for (const Slot& slot : chosen->slots)
      if (slot.option->count() > 0 && !configured_.has(slot.setting->name))
        given.set(slot.setting->name, checked(*slot.setting, words_of(slot)));
    return understood(*chosen->command, given);
  }

 private:
  static std::vector<std::string> words_of(const Slot& slot) {
    if (slot.setting->allowed.kind == Allowed::Kind::flag) return {slot.word};
    return slot.option->results();
  }

  CLI::App app_{"swarmfit - which model of collective motion moves most like my animals, with which parameters, and how sure can I be?",
                "swarmfit"};
  std::deque<Subcommand> subcommands_;
  Values configured_;
};

}  // namespace

std::optional<Arguments> parse(const std::vector<std::string>& words) { return Parser().parse(words); }

}  // namespace swarmfit::cli
