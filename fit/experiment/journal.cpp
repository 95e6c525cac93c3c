// SPDX-License-Identifier: MIT
#include "fit/experiment/journal.h"

#include "fit/store/bytes.h"

namespace swarmfit {
namespace {

void put_all(std::string& to, const Energies& energies) {
  for (std::size_t j = 0; j < energies.size(); ++j) put(to, energies[j]);
}

Energies take_all(Taker& from, std::size_t columns) {
  Energies out(columns);
  for (std::size_t j = 0; j < columns; ++j) out[j] = from.take<double>();
  return out;
}

std::string encoded(const Outcome& o) {
  std::string out;
  put(out, static_cast<std::uint32_t>(o.raw.size()));
  put(out, static_cast<std::uint32_t>(o.replicates.size()));
  put(out, o.failed);
  put(out, o.count);
  put_all(out, o.raw);
  put_all(out, o.guided);
  for (const Energies& e : o.replicates) put_all(out, e);
  return out;
}

std::optional<Outcome> decoded(std::string_view bytes) {
  Taker from(bytes);
  Outcome o;
  const auto columns = from.take<std::uint32_t>(), replicates = from.take<std::uint32_t>();
  if ((std::uint64_t{replicates} + 2) * columns * sizeof(double) > bytes.size()) return {};
  from.take(o.failed);
  from.take(o.count);
  o.raw = take_all(from, columns);
  o.guided = take_all(from, columns);
  for (std::uint32_t r = 0; r < replicates; ++r) o.replicates.push_back(take_all(from, columns));
  if (!from.ended()) return {};
  return o;
}

}  // namespace

std::string Journal::key(const std::string& model, int steps, std::span<const double> parameters, std::span<const Rng> seeds) {
  std::string bytes = model + '\n';
  put(bytes, steps);
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
