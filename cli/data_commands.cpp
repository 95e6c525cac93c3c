// SPDX-License-Identifier: MIT
// describe, convert, simulate, and the lists.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "cli/commands.h"
#include "cli/model_page.h"
#include "cli/recordings.h"
#include "cli/scenario_schema.h"
#include "cli/scenes.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/compare/portrait.h"
#include "fit/experiment/expect.h"
#include "fit/experiment/scenery.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/kinematics.h"
#include "libtrack/read/read.h"
#include "libtrack/write/write.h"
#include "reports/comparison/json.h"
#include "reports/draw/picture.h"
#include "reports/recording/recording_text.h"
#include "reports/recording/tracks_html.h"
#include "reports/write/list_text.h"

namespace swarmfit::cli {
namespace {

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void write_tracks(const std::string& path, const Surrounded& all, const std::string& name = "") {
  const WrittenFormat& format = written_format(name, path);
  if (!format.write) {
    format.write_several(all, path, [](const std::string& file, const std::string& bytes) {
      if (const std::size_t folder = file.rfind('/'); folder != file.npos) make_directory(file.substr(0, folder));
      write_file_atomically(file, bytes);
    });
    return;
  }
  const std::string bytes = format.write(all.tracks);
  if (path == "-")
    print(bytes);
  else
    write_file_atomically(path, bytes);
}

int list(const char* what, const std::vector<ListEntry>& entries, const Common& common) {
  print(common.json ? to_json(what, entries) : list_text(entries, style()));
  return 0;
}

// Every number that a scene expects, what came and what should; 1 if they do not agree.
int check(const std::vector<Finding>& all, bool json) {
  bool met = true;
  std::vector<ListEntry> entries;
  for (const Finding& f : all) {
    met = met && f.met();
    const std::string bound = std::isinf(f.below)   ? fmt::format("at least {:g}", f.above)
                              : std::isinf(f.above) ? fmt::format("at most {:g}", f.below)
                                                    : fmt::format("{:g} to {:g}", f.above, f.below);
    ListEntry entry{f.name, fmt::format("{} {:.4g}, expected {}: {}", f.measure, f.value, bound, f.met() ? "met" : "not met"), {}};
    if (json)
      entry.facts = {{"measure", f.measure}, {"value", fmt::format("{}", f.value)}, {"expected", bound}, {"met", f.met() ? "yes" : "no"}};
    if (!f.published.empty()) entry.facts.emplace_back("published", f.published);
    entries.push_back(std::move(entry));
  }
  print(json ? to_json("expectations", entries) : list_text(entries, style()));
  return met ? 0 : 1;
}

}  // namespace

int describe(const Arguments& a) {
  const Tracks tracks = load(a, a.recordings.front());
  const Summary summary = summarise(tracks);
  print(a.common.json ? to_json(tracks.meta(), summary)
                      : describe_text(tracks.meta(), summary, style()) + first_rows_text(tracks, style()));
  if (!a.html.empty()) write_file_atomically(a.html, tracks_html(portrait(tracks), tracks.meta(), summary, {a.line, kVersion, {}}));
  return 0;
}

int convert(const Arguments& a) {
  Tracks tracks = load(a, a.recordings.front());
  if (a.smoothing > 0) tracks = smooth(tracks, a.smoothing);
  write_tracks(a.out, {tracks}, a.write_as);
  return 0;
}

int simulate(const Arguments& a) {
  if (a.out.empty() && a.picture.empty() && a.html.empty() && !a.check)
    throw InputError("simulate: nothing to write; expected --out FILE, --picture FILE, --html FILE or --check");
  const Scenario scene = scenario_of(a.scene);
  check_expectations(scene);
  if (a.check && scene.expectations.empty())
    throw InputError(fmt::format("--check: {} expects nothing; expected a scenario with [expect.NAME]", scene.name));
  const Film made = film(scene, {.sigma = a.scene.noise, .dropout = a.scene.dropout});
  const Tracks& tracks = made.tracks;
  const Scenery around = scenery_of(scene, made);
  if (!a.common.quiet && scene.curve) std::fprintf(stderr, "swarmfit: %s\n", drawn_text(scene, tracks).c_str());
  if (!a.out.empty()) write_tracks(a.out, {tracks, bodies_of(around, scene.dims), &made.stimuli});
  if (!a.picture.empty()) write_file_atomically(a.picture, picture_svg(tracks, scene.model.name, around));
  if (!a.html.empty()) {
    Comparison drawn = portrait(tracks);
    drawn.around = around;
    write_file_atomically(a.html, tracks_html(drawn, tracks.meta(), summarise(tracks), {a.line, kVersion, card_of(scene)}));
  }
  return a.check ? check(findings(scene, made), a.common.json) : 0;
}

int list_models(const Arguments& a) {
  if (a.name.empty()) {
    if (a.page || a.flags) throw InputError("models --page, --scene: of which model? expected a name before it; see swarmfit models");
    std::vector<ListEntry> entries;
    for (const auto& spec : models()) entries.push_back(model_entry(spec));
    return list("models", entries, a.common);
  }
  const ModelSpec& spec = *parse_model(a.name).spec;
  if (a.flags)
    print(scene_showing(spec.name) + '\n');
  else if (a.page)
    print(model_page(spec));
  else if (a.common.json)
    print(to_json("models", {model_entry(spec)}));
  else
    print(model_manual(spec) + '\n' + list_text({model_entry(spec)}, style()));
  return 0;
}

int list_scenarios(const Arguments& a) {
  if (a.schema) {
    print(scenario_schema());
    return 0;
  }
  if (!a.name.empty()) {
    print(std::string(scenario_file(a.name).text));
    return 0;
  }
  std::vector<ListEntry> entries;
  for (const ScenarioFile& file : scenario_files()) entries.push_back(scenario_entry(scenario_named(file.name)));
  return list("scenarios", entries, a.common);
}

int list_formats(const Arguments& a) {
  std::vector<ListEntry> entries;
  for (const auto& format : formats())
    entries.push_back({std::string(format.name), std::string(format.summary), {{"endings", std::string(format.endings)}}});
  return list("formats", entries, a.common);
}

}  // namespace swarmfit::cli
