// SPDX-License-Identifier: MIT
#include "fit/store/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>

#include "fit/store/bytes.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr std::string_view kMagic = "swarmfit checkpoint 1\n";
constexpr std::size_t kDigest = 64;  // hexadecimal digits
constexpr std::uint32_t kLongest = 1u << 24;

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

// The lines at the top that say whose it is; empty if they are not there.
std::string_view head_of(std::string_view bytes) {
  std::size_t end = 0;
  for (int k = 0; k < 4 && end != bytes.npos; ++k) end = bytes.find('\n', end + (k > 0));
  return bytes.starts_with(kMagic) && end != bytes.npos ? bytes.substr(0, end + 1) : std::string_view();
}

bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

// Of whose run is it? Throws unless of this one.
void require_same_run(const std::string& path, std::string_view bytes, const RunIdentity& run) {
  const auto refuse = [&](std::string_view what) {
    throw InputError(fmt::format("{}: {}; expected the checkpoint of this very run (start it anew, or undo the change)", path, what));
  };
  std::string expected = head(run);
  if (bytes.starts_with(expected)) return;
  if (!bytes.starts_with(kMagic)) refuse("is not a checkpoint, or its head is damaged");
  std::string_view wanted = expected;
  line(bytes), line(wanted);
  if (const auto version = line(bytes); version != line(wanted))
    refuse(fmt::format("was written by another {}", is_text(version) ? version.substr(0, 40) : "version"));
  if (line(bytes) != line(wanted)) refuse("belongs to another recording, or the recording has changed");
  refuse("belongs to a run with other settings: config.toml has changed");
}

}  // namespace

Checkpoint::Checkpoint(std::string path, const RunIdentity& run, std::function<void()> prepare)
    : path_(std::move(path)), head_(head(run)), prepare_(std::move(prepare)), seal_(sha256_hex(head_)) {}

Checkpoint::Checkpoint(std::string path, const RunIdentity& run) : path_(std::move(path)), head_(head(run)), seal_(sha256_hex(head_)) {
  const std::string bytes = read_file(path_);
  require_same_run(path_, bytes, run);
  file_.emplace(path_);
  const std::size_t good = head_.size() + read(std::string_view(bytes).substr(head_.size()), seal_);
  if (good < bytes.size()) file_->truncate(good);
}

Checkpoint::Checkpoint(const std::string& path, const RunIdentity& run, std::string_view bytes)
    : path_(path), head_(head(run)), written_(false), seal_(sha256_hex(head_)) {
  if (bytes.empty()) return;
  require_same_run(path, bytes, run);
  read(bytes.substr(head_.size()), seal_);
}

Checkpoint Checkpoint::copy_of(std::string_view bytes, const std::string& path, const RunIdentity& run) { return {path, run, bytes}; }

void Checkpoint::merge(std::span<const std::string> paths, const std::string& to) {
  Checkpoint all(to, {}, std::string_view());
  all.written_ = true;
  all.prepare_ = [] {};
  for (const std::string& path : paths) {
    const std::string bytes = read_file(path);
    const std::string_view head = head_of(bytes);
    if (head.empty()) throw InputError(path + ": is not a checkpoint, or its head is damaged; expected that of a part");
    if (path == paths.front()) all.head_ = head;
    if (all.head_ != head)
      throw InputError(
          fmt::format("{}: belongs to another study than {}; expected parts of one, with the same settings", path, paths.front()));
    all.read(std::string_view(bytes).substr(head.size()), sha256_hex(head));
  }
  all.seal_ = sha256_hex(all.head_);
  const std::vector<Record> records(all.kept_.begin(), all.kept_.end());
  all.add(records);
}

// Whole records up to the first that is not.
std::size_t Checkpoint::read(std::string_view records, const std::string& first_seal) {
  seal_ = first_seal;
  ByteReader from(records);
  std::size_t good = 0;
  while (!from.empty()) {
    const auto size = from.take<std::uint32_t>();
    if (size < kDigest || size > kLongest) break;
    const auto payload = from.text(size), seal = from.text(kDigest);
    if (!from.whole() || seal != sealed(seal_, payload)) break;
    seal_ = seal;
    kept_.insert_or_assign(std::string(payload.substr(0, kDigest)), std::string(payload.substr(kDigest)));
    good += sizeof size + payload.size() + seal.size();
  }
  return good;
}

std::optional<std::string> Checkpoint::find(const std::string& key) const {
  const std::lock_guard guard(lock_);
  const auto it = kept_.find(key);
  return it == kept_.end() ? std::nullopt : std::optional(it->second);
}

void Checkpoint::add(std::span<const Record> records) {
  if (!written_) return;
  const std::lock_guard guard(lock_);
  std::string bytes;
  for (const auto& [key, value] : records) {
    const std::string payload = key + value;
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
  if (tell_) tell_();
}

std::size_t Checkpoint::size() const {
  const std::lock_guard guard(lock_);
  return kept_.size();
}

}  // namespace swarmfit
