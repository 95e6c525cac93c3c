// SPDX-License-Identifier: MIT
// What documents in JSON have in common.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "libeval/energy.h"
#include "libeval/metrics.h"

namespace swarmfit::json_parts {

using Json = nlohmann::ordered_json;
using Columns = std::vector<Column>;

std::string text(const Json& json);
Json finite(double value);  // null, if it is not
Json array(const Eigen::Array3d& v);
const char* name(Normalisation normalisation);

// One value per column, by its key.
Json per_column(const Columns& columns, const PerColumn<double>& values);
Json per_column(const Columns& columns, const PerColumn<bool>& values);
Json per_column(const Columns& columns, const PerColumn<std::string>& values);
Json samples(const Columns& columns, const PerColumn<Distribution>& d);
Json means(const Columns& columns, const PerColumn<Distribution>& d);
Json sds(const Columns& columns, const PerColumn<Distribution>& d);

}  // namespace swarmfit::json_parts
