// SPDX-License-Identifier: MIT
#include "fit/experiment/journal.h"

#include "fit/store/bytes.h"

namespace swarmfit {
namespace {

// `first` and `distributions` are not kept.
auto kept_fields(Outcome& o) { return std::tie(o.raw, o.guided, o.replicates, o.differences, o.failed, o.count); }

std::string encoded(Outcome o) {
  std::string out;
  std::apply([&](const auto&... each) { (put(out, each), ...); }, kept_fields(o));
  return out;
}

std::optional<Outcome> decoded(std::string_view bytes) {
  ByteReader from(bytes);
  Outcome o;
  std::apply([&](auto&... each) { (from.take(each), ...); }, kept_fields(o));
  if (!from.ended()) return {};
  return o;
}

}  // namespace

std::string Journal::key(const std::string& ensemble, std::span<const double> parameters, std::span<const Rng> seeds) {
  std::string bytes = ensemble;
  for (const double p : parameters) put(bytes, p);
  bytes += '\n';
  for (const Rng& seed : seeds) put(bytes, seed.seed);
  return sha256_hex(bytes);
}

std::optional<Outcome> Journal::find(const std::string& key) const {
  const auto kept = checkpoint_.find(key);
  return kept ? decoded(*kept) : std::nullopt;
}

void Journal::add(std::span<const std::pair<std::string, Outcome>> outcomes) {
  std::vector<Checkpoint::Record> records;
  for (const auto& [key, outcome] : outcomes) records.emplace_back(key, encoded(outcome));
  checkpoint_.add(records);
}

}  // namespace swarmfit
