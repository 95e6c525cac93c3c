// SPDX-License-Identifier: MIT
#include "reports/comparison/force_tables.h"

#include <fmt/format.h>

#include <tuple>

#include "reports/comparison/tables.h"
#include "reports/write/number.h"

namespace swarmfit {

std::string forces_csv(const Comparison& c) {
  using Values = std::vector<double>;
  const ForceFacts& f = c.recording.forces;
  const std::tuple<const char*, Values ForceCurves::*, const Values*> all[] = {
      {"drag", &ForceCurves::drag, &f.grid.speeds},
      {"confinement", &ForceCurves::confinement, &f.grid.distances},
      {"attraction", &ForceCurves::attraction, &f.grid.pairs},
      {"alignment", &ForceCurves::alignment, &f.grid.pairs}};
  std::string out = "curve,model,x,value,sd\n";
  for (const auto& [name, member, x] : all) {
    const auto add = [&, curve = name, places = x](const std::string& who, const Values& values, const Values& sd) {
      for (std::size_t k = 0; k < values.size(); ++k)
        out += fmt::format("{},{},{},{},{}\n", curve, who, exact((*places)[k]), exact(values[k]), k < sd.size() ? exact(sd[k]) : "");
    };
    add("recording", f.recording.*member, f.se.*member);
    for (const ModelFit& m : c.models) add(csv_field(m.model), m.likeness.forces.median.*member, m.likeness.forces.sd.*member);
  }
  return out;
}

}  // namespace swarmfit
