// SPDX-License-Identifier: MIT
#include "reports/write/json_parts.h"

#include <nlohmann/json.hpp>

namespace swarmfit::json_parts {
namespace {

template <class T, class Fact>
Json facts(const Columns& columns, const PerColumn<T>& of, Fact fact) {
  Json out = Json::object();
  for (std::size_t j = 0; j < columns.size(); ++j) out[columns[j].key()] = fact(of[j]);
  return out;
}

constexpr auto kItself = [](const auto& value) { return value; };

}  // namespace

std::string text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json array(const Eigen::Array3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

const char* name(Normalisation normalisation) {
  switch (normalisation) {
    case Normalisation::reference:
      return "reference";
    case Normalisation::separate:
      return "separate";
    case Normalisation::none:
      return "none";
  }
  return "";
}

Json per_column(const Columns& columns, const PerColumn<double>& values) { return facts(columns, values, kItself); }
Json per_column(const Columns& columns, const PerColumn<bool>& values) { return facts(columns, values, kItself); }
Json per_column(const Columns& columns, const PerColumn<std::string>& values) { return facts(columns, values, kItself); }

Json samples(const Columns& columns, const PerColumn<Distribution>& d) {
  return facts(columns, d, [](const Distribution& x) { return x.histogram.samples; });
}

Json means(const Columns& columns, const PerColumn<Distribution>& d) {
  return facts(columns, d, [](const Distribution& x) { return x.moments.mean; });
}

Json sds(const Columns& columns, const PerColumn<Distribution>& d) {
  return facts(columns, d, [](const Distribution& x) { return x.moments.sd(); });
}

}  // namespace swarmfit::json_parts
