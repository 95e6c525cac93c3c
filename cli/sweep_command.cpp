// SPDX-License-Identifier: MIT
// sweep: a model over a range of its parameters, options and scene settings.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/checkpoints.h"
#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/parse.h"
#include "cli/parts.h"
#include "cli/progress.h"
#include "cli/scenes.h"
#include "cli/setting.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/study/sweep.h"
#include "libtrack/error.h"
#include "reports/study/sweep_report.h"

namespace swarmfit::cli {
namespace {

const Setting* scene_setting(const std::string& name) {
  const Setting* s = find_setting(name, kSimulate);
  const bool number = s && (s->allowed.kind == Allowed::Kind::whole || s->allowed.kind == Allowed::Kind::number);
  return number && (s->in & kSweep) != 0 && name != "seed" && name != "threads" ? s : nullptr;
}

bool is_option(const ModelSpec& spec, const std::string& name) {
  return std::any_of(spec.options.begin(), spec.options.end(), [&](const Option& o) { return o.name == name; });
}

// The same model with one option at another value.
ModelChoice with_option(const ModelChoice& model, const std::string& option, const std::string& value) {
  std::string text;
  for (const auto& [name, now] : model.options) text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, name == option ? value : now);
  return parse_model(fmt::format("{}[{}]", model.spec->name, text));
}

// A word per axis is a value of a parameter, of an option of the model, or of a setting of the scene.
Scenario scene_at(const Arguments& given, const std::vector<SweepAxis>& axes, const std::vector<std::string>& words) {
  Arguments a = given;
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (const Setting* s = scene_setting(axes[k].name)) s->use(a, {checked(*s, {words[k]}), Values()});
  Scenario scene = scenario_of(a.scene);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const std::string& name = axes[k].name;
    const ModelSpec& spec = *scene.model.spec;
    const bool option = is_option(spec, name);
    if (spec.find(name) >= 0 && (axes[k].numeric || !option))
      set_parameter(scene, name, parse_assignments({name + "=" + words[k]}).at(name));
    else if (option)
      scene.model = with_option(scene.model, name, words[k]);
    else if (scene_setting(name) == nullptr)
      throw InputError(fmt::format("`axis` {}: {} has no such parameter or option, and a scene no such number; see swarmfit models {}",
                                   name, spec.name, spec.name));
  }
  return scene;
}

// Of a Latin hypercube: what takes whole numbers only.
bool takes_whole_numbers(const ModelSpec& spec, const SweepAxis& axis) {
  const int row = spec.find(axis.name);
  if (row >= 0) return spec.parameters[static_cast<std::size_t>(row)].integer;
  const Setting* s = scene_setting(axis.name);
  return s && s->allowed.kind == Allowed::Kind::whole;
}

void refuse_impossible(const SweepOptions& o) {
  constexpr std::size_t kMostAxes = 3;
  if (o.axes.empty()) throw InputError("sweep: nothing is varied; expected --axis name=lo:hi:n");
  for (std::size_t k = 0; k < o.axes.size(); ++k)
    for (std::size_t i = 0; i < k; ++i)
      if (o.axes[i].name == o.axes[k].name)
        throw InputError(fmt::format("`axis` {}: given twice; expected different ones", o.axes[k].name));
  if (o.latin == 0 && o.axes.size() > kMostAxes)
    throw InputError(
        fmt::format("`axis`: {} of them make no grid that can be drawn; expected {} at most, or `latin`", o.axes.size(), kMostAxes));
  if (o.hysteresis && o.latin > 0)
    throw InputError("`hysteresis`: a Latin hypercube has no axis to go up and down; expected one of the two");
}

}  // namespace

int sweep(const Arguments& a) {
  SweepOptions options = a.sweep;
  options.measure = a.measure;
  options.seeds = a.seeds;
  options.seed = a.common.seed;
  options.scene_at = [&](const std::vector<std::string>& words) { return scene_at(a, options.axes, words); };
  refuse_impossible(options);
  const ModelChoice model = scenario_of(a.scene).model;
  for (SweepAxis& axis : options.axes) axis.whole = takes_whole_numbers(*model.spec, axis);
  const std::string dir = a.out.empty() ? "swarmfit-sweep" : a.out;
  if (cluster().first()) check_run_directory(dir);
  if (a.max_time > 0) stop_after(a.max_time);
  Checkpoint checkpoint = checkpoint_in(dir, {kVersion, "", config_toml("sweep", a.config)}, a.resume);
  checkpoint.on_add(something_was_kept);
  Sweep result;
  try {
    CountLine count(a.common.quiet || !cluster().first(), "runs");
    result = run_sweep(
        options, [&](std::size_t done, std::size_t all) { count.show(done, all); }, {&executor(), &checkpoint}, a.part);
  } catch (const Interrupted&) {
    return stopped_before_the_end(dir);
  }
  if (!cluster().first()) return 0;
  if (a.part.of > 1) return part_done(dir, a.part, a.common.quiet);
  write_sweep(dir, result, a.config, kVersion);
  remove_checkpoint(dir);
  std::fputs(a.common.json ? to_json(result, a.config).c_str() : sweep_text(result, style()).c_str(), stdout);
  return 0;
}

}  // namespace swarmfit::cli
