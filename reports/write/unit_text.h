// SPDX-License-Identifier: MIT
// Units of metrics and observables, in print.
#pragma once

#include <string>

#include "libeval/metrics.h"
#include "libeval/panel.h"

namespace swarmfit {

// "mm/s²", "rad/s", "1/s"; of a density of that metric "1/(mm/s²)".
std::string metric_unit(std::size_t metric, const std::string& length_unit);
std::string density_unit(std::size_t metric, const std::string& length_unit);

// Unit of an observable of the panel: "mm²", "s", "1/s²"; empty for a pure number.
std::string panel_unit(const PanelItem&, const std::string& length_unit);

}  // namespace swarmfit
