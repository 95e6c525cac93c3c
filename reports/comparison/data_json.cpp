// SPDX-License-Identifier: MIT
// The documents of commands that fit nothing.
#include <nlohmann/json.hpp>

#include "reports/comparison/json.h"
#include "reports/write/json_parts.h"

namespace swarmfit {

using namespace json_parts;

// ---- evaluate -----------------------------------------------------------------------------------------------------------------

namespace {

Json source(const TrackMeta& meta) {
  return {{"path", meta.from.path},           {"sha256", meta.from.sha256}, {"format", meta.from.format}, {"columns", meta.from.columns},
          {"synthetic", meta.from.synthetic}, {"dims", meta.dims},          {"unit", meta.unit},          {"dt", meta.dt},
          {"notes", meta.from.notes}};
}

Json order(const OrderMeans& o) { return {{"polarisation", o.polarisation}, {"milling", o.milling}, {"extent", o.extent}}; }

// The same fact of recording and simulation, per metric.
template <class Fact>
Json both(const Evaluation& e, Fact fact) {
  return {{"real", fact(e.columns, e.real_distribution)}, {"simulated", fact(e.columns, e.simulated_distribution)}};
}

Json ratios(const Evaluation& e, double (*moment)(const Moments&)) {
  PerColumn<double> ratio(e.columns.size());
  for (std::size_t m = 0; m < ratio.size(); ++m)
    ratio[m] = moment(e.simulated_distribution[m].moments) / moment(e.real_distribution[m].moments);
  return per_column(e.columns, ratio);
}

}  // namespace

std::string to_json(const Evaluation& e) {
  return text({{"schema", "swarmfit-evaluation/1"},
               {"real", source(e.real)},
               {"simulated", source(e.simulated)},
               {"normalisation", name(e.binning.normalisation)},
               {"bins", e.binning.bins},
               {"interval", {e.binning.lower, e.binning.upper}},
               {"clip", e.binning.clip},
               {"lags", lags_of(e.columns)},
               {"axis_lower", per_column(e.columns, e.axis_lower)},
               {"axis_width", per_column(e.columns, e.axis_width)},
               {"raw_energies", per_column(e.columns, e.raw_energies)},
               {"samples", both(e, samples)},
               {"means", both(e, means)},
               {"sds", both(e, sds)},
               {"mean_ratio", ratios(e, [](const Moments& x) { return x.mean; })},
               {"sd_ratio", ratios(e, [](const Moments& x) { return x.sd(); })},
               {"order", {{"real", order(e.real_order)}, {"simulated", order(e.simulated_order)}}}});
}

// ---- weigh --------------------------------------------------------------------------------------------------------------------

namespace {

Json by_name(const std::vector<std::string>& keys, const std::vector<double>& values) {
  Json out = Json::object();
  for (std::size_t k = 0; k < keys.size(); ++k) out[keys[k]] = values[k];
  return out;
}

}  // namespace

std::string to_json(const WeighedTable& t) {
  Json models = Json::array();
  for (std::size_t i = 0; i < t.models.size(); ++i) {
    Json energies = Json::object();
    for (std::size_t j = 0; j < t.metrics.size(); ++j) energies[t.metrics[j]] = t.energies(static_cast<Index>(i), static_cast<Index>(j));
    models.push_back({{"name", t.models[i]}, {"score", t.scores[i]}, {"energies", std::move(energies)}});
  }
  return text({{"schema", "swarmfit-weights/1"},
               {"weights", by_name(t.metrics, t.weighting.weights)},
               {"entropy", by_name(t.metrics, t.weighting.entropy)},
               {"p1", by_name(t.metrics, t.weighting.p1)},
               {"p2", by_name(t.metrics, t.weighting.p2)},
               {"models", std::move(models)}});
}

// ---- describe -----------------------------------------------------------------------------------------------------------------

namespace {

Json quantile_object(const Quantiles& q) {
  return {{"count", q.count}, {"mean", q.mean},     {"sd", q.sd},   {"min", q.min},
          {"q05", q.q05},     {"median", q.median}, {"q95", q.q95}, {"max", q.max}};
}

Json localisation(const Localisation& l) {
  return {{"sigma", array(l.sigma)},
          {"samples", l.samples},
          {"white", l.white},
          {"rounding", l.rounding},
          {"acceleration_share", l.acceleration_share},
          {"jerk_share", l.jerk_share}};
}

Json suspicions(const std::vector<Suspicion>& list) {
  Json out = Json::array();
  for (const Suspicion& s : list) out.push_back({{"what", s.what}, {"message", s.message}, {"examples", s.examples}});
  return out;
}

}  // namespace

std::string to_json(const TrackMeta& meta, const Summary& s) {
  return text({{"schema", "swarmfit-summary/1"},
               {"data", source(meta)},
               {"rows", s.rows},
               {"tracks", s.tracks},
               {"segments", s.segments},
               {"gaps", s.gaps},
               {"missing_frames", s.missing_frames},
               {"frames", s.frames},
               {"first_frame", s.first_frame},
               {"last_frame", s.last_frame},
               {"duration", s.duration},
               {"lower", array(s.lower)},
               {"upper", array(s.upper)},
               {"individuals", quantile_object(s.individuals)},
               {"track_length", quantile_object(s.track_length)},
               {"segment_length", quantile_object(s.segment_length)},
               {"speed", quantile_object(s.speed)},
               {"acceleration", quantile_object(s.acceleration)},
               {"nearest", quantile_object(s.nearest)},
               {"extent", quantile_object(s.extent)},
               {"polarisation", quantile_object(s.polarisation)},
               {"milling", quantile_object(s.milling)},
               {"speed_outliers", s.speed_outliers},
               {"acceleration_outliers", s.acceleration_outliers},
               {"localisation", localisation(s.localisation)},
               {"suspicions", suspicions(s.suspicions)}});
}

// ---- models, scenarios, formats -----------------------------------------------------------------------------------------------

std::string to_json(const std::string& what, const std::vector<ListEntry>& entries) {
  Json list = Json::array();
  for (const ListEntry& entry : entries) {
    Json one = {{"name", entry.name}, {"summary", entry.summary}};
    for (const auto& [key, value] : entry.facts) one[key] = value;
    list.push_back(std::move(one));
  }
  return text({{"schema", "swarmfit-list/1"}, {what, std::move(list)}});
}

}  // namespace swarmfit
