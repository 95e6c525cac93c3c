// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "libswarm/model.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

[[noreturn]] void refuse(const ModelSpec& spec, const std::string& why) { throw InputError(fmt::format("model {}: {}", spec.name, why)); }

void check_dimensions(const ModelSpec& spec, const Setup& setup) {
  if (std::find(spec.dims.begin(), spec.dims.end(), setup.dims) == spec.dims.end())
    refuse(spec, fmt::format("does not move in {} dimensions; expected {}", setup.dims, fmt::join(spec.dims, " or ")));
  if (setup.reference && setup.reference->dims() != setup.dims)
    refuse(spec,
           fmt::format("given a recording in {} dimensions; expected one in {}, as it moves in", setup.reference->dims(), setup.dims));
}

void check_step(const ModelSpec& spec, const Setup& setup) {
  if (!spec.fixed_step || setup.step == 0) return;
  const double own = setup.reference ? setup.reference->dt() : spec.native_dt;
  if (std::abs(setup.step - own) > 1e-9 * own)
    refuse(spec, fmt::format("steps of {:g} s; expected {:g} s, {}", setup.step, own,
                             setup.reference ? "the recording's frame interval" : "the model's own step"));
}

void check_kinds(const ModelSpec& spec, const Setup& setup) {
  const auto own = static_cast<int>(spec.kinds.size());
  if (own > 0 && setup.kinds > own)
    refuse(spec, fmt::format("{} kinds of agents; expected at most {}: {}", setup.kinds, own, fmt::join(spec.kinds, ", ")));
}

// The enum by which a model finds its parameters must not drift from the table in which it describes them.
void check_rows(const ModelSpec& spec) {
  for (std::size_t p = 0; p < spec.parameters.size(); ++p)
    if (spec.parameters[p].row != p)
      refuse(spec, fmt::format("parameter {} is row {} of the table and calls itself {}; expected the order of the model's enum",
                               spec.parameters[p].name, p, spec.parameters[p].row));
}

}  // namespace

std::unique_ptr<Model> make_model(const ModelChoice& choice, Setup setup) {
  const ModelSpec& spec = *choice.spec;
  setup.options = spec.resolve(choice.options);
  check_dimensions(spec, setup);
  if (spec.needs_reference && !setup.reference) refuse(spec, "cannot be made without a recording; expected one to learn from, as in fit");
  check_step(spec, setup);
  check_kinds(spec, setup);
  check_rows(spec);
  if (!spec.make) refuse(spec, "has no rule of motion; expected ModelSpec::make");
  auto model = std::invoke(spec.make, setup);
  if (model->columns() != static_cast<Index>(spec.columns.size()))
    refuse(spec, fmt::format("has {} private columns and names {}; expected as many names", model->columns(), spec.columns.size()));
  model->name_ = choice.name;
  model->update_ = spec.update;
  return model;
}

}  // namespace swarmfit
