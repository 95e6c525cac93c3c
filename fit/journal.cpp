// SPDX-License-Identifier: MIT
#include "fit/journal.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <limits>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr std::string_view kMagic = "swarmfit checkpoint 1\n";
constexpr std::size_t kDigest = 64;  // hexadecimal digits
constexpr std::uint32_t kLongest = 1u << 24;

template <class T>
void put(std::string& to, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& to, const Energies& energies) {
  for (std::size_t j = 0; j < energies.size(); ++j) put(to, energies[j]);
}

// Takes values off the front of bytes; what is not there is a zero, and noticed.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T take() {
    T value{};
    const auto part = text(sizeof value);
    if (part.size() == sizeof value) std::memcpy(&value, part.data(), sizeof value);
    return value;
  }
  Energies energies(std::size_t columns) {
    Energies out(columns);
    for (std::size_t j = 0; j < columns; ++j) out[j] = take<double>();
    return out;
  }
  std::string_view text(std::size_t size) {
    whole_ = whole_ && bytes_.size() >= size;
    const auto part = bytes_.substr(0, size);
    bytes_.remove_prefix(part.size());
    return part;
  }
  bool whole() const { return whole_; }
  bool empty() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
  bool whole_ = true;
};

std::string encoded(const std::string& key, const Outcome& o) {
  std::string out = key;
  put(out, static_cast<std::uint32_t>(o.raw.size()));
  put(out, static_cast<std::uint32_t>(o.replicates.size()));
  put(out, o.failed);
  put(out, o.count);
  put(out, o.raw);
  put(out, o.guided);
  for (const Energies& e : o.replicates) put(out, e);
  return out;
}

std::optional<std::pair<std::string, Outcome>> decoded(std::string_view payload) {
  Taker from(payload);
  std::pair<std::string, Outcome> out{std::string(from.text(kDigest)), Outcome{}};
  Outcome& o = out.second;
  const auto columns = from.take<std::uint32_t>(), replicates = from.take<std::uint32_t>();
  if ((std::uint64_t{replicates} + 2) * columns * sizeof(double) > payload.size()) return {};
  o.failed = from.take<int>();
  o.count = from.take<Counters>();
  o.raw = from.energies(columns);
  o.guided = from.energies(columns);
  for (std::uint32_t r = 0; r < replicates; ++r) o.replicates.push_back(from.energies(columns));
  if (!from.whole() || !from.empty()) return {};
  return out;
}

std::string sealed(const std::string& seal, std::string_view payload) { return sha256_hex(seal + std::string(payload)); }

std::string head(const RunIdentity& run) {
  return fmt::format("{}version {}\nrecording {}\nconfig {}\n", kMagic, run.version, run.recording, sha256_hex(run.config));
}

std::string_view line(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const auto out = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return out;
}

// Of whose run is it? Throws unless of this one.
void require_same_run(const std::string& path, std::string_view bytes, const RunIdentity& run) {
  const auto refuse = [&](std::string_view what) {
    throw InputError(fmt::format("{}: {}; expected the checkpoint of this very run (start it anew, or undo the change)", path, what));
  };
  std::string expected = head(run);
  if (bytes.starts_with(expected)) return;
  if (!bytes.starts_with(kMagic)) refuse("is no checkpoint, or its head is damaged");
  std::string_view wanted = expected;
  line(bytes), line(wanted);
  if (const auto version = line(bytes); version != line(wanted)) refuse(fmt::format("was written by another {}", version.substr(0, 40)));
  if (line(bytes) != line(wanted)) refuse("belongs to another recording, or the recording has changed");
  refuse("belongs to a run with other settings: config.toml has changed");
}

}  // namespace

Journal::Journal(std::string path, const RunIdentity& run, std::function<void()> prepare)
    : path_(std::move(path)), head_(head(run)), prepare_(std::move(prepare)), seal_(sha256_hex(head_)) {}

Journal::Journal(std::string path, const RunIdentity& run) : path_(std::move(path)), head_(head(run)), seal_(sha256_hex(head_)) {
  const std::string bytes = read_file(path_);
  require_same_run(path_, bytes, run);
  file_.emplace(path_);
  read(std::string_view(bytes).substr(head_.size()));
}

// Whole records up to the first that is not; the file is cut there.
void Journal::read(std::string_view records) {
  Taker from(records);
  std::size_t good = 0;
  while (!from.empty()) {
    const auto size = from.take<std::uint32_t>();
    if (size > kLongest) break;
    const auto payload = from.text(size), seal = from.text(kDigest);
    if (!from.whole() || seal != sealed(seal_, payload)) break;
    auto record = decoded(payload);
    if (!record) break;
    seal_ = seal;
    outcomes_.insert_or_assign(std::move(record->first), std::move(record->second));
    good += sizeof size + payload.size() + seal.size();
  }
  if (good < records.size()) file_->truncate(head_.size() + good);
}

std::string Journal::key(const std::string& model, std::span<const double> parameters, std::span<const Rng> seeds) {
  std::string bytes = model + '\n';
  for (const double p : parameters) put(bytes, p);
  bytes += '\n';
  for (const Rng& seed : seeds) put(bytes, seed.seed);
  return sha256_hex(bytes);
}

std::optional<Outcome> Journal::find(const std::string& key) const {
  const std::lock_guard guard(lock_);
  const auto it = outcomes_.find(key);
  return it == outcomes_.end() ? std::nullopt : std::optional(it->second);
}

void Journal::add(std::span<const std::pair<std::string, Outcome>> outcomes) {
  const std::lock_guard guard(lock_);
  std::string bytes;
  for (const auto& [key, outcome] : outcomes) {
    const std::string payload = encoded(key, outcome);
    put(bytes, static_cast<std::uint32_t>(payload.size()));
    seal_ = sealed(seal_, payload);
    bytes += payload + seal_;
  }
  if (bytes.empty()) return;
  if (!file_) {
    prepare_();
    file_.emplace(path_);
    file_->truncate(0);
    file_->append(head_);
  }
  file_->append(bytes);
}

std::size_t Journal::size() const {
  const std::lock_guard guard(lock_);
  return outcomes_.size();
}

}  // namespace swarmfit
