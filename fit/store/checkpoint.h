// SPDX-License-Identifier: MIT
// The checkpoint of a run: everything that it has computed and would take long to compute again. A run is a function of its inputs alone,
// so one that starts again and finds its simulations here takes the same path to the same bits, and nothing else of its state needs to be
// kept.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "libtrack/file.h"

namespace swarmfit {

// What everything in a checkpoint is a function of: all of it must be the same when a run goes on.
struct RunIdentity {
  std::string version;
  std::string recording;  // SHA-256 of its file; empty: the run has none
  std::string config;     // text of config.toml
};

// A file that only grows: a head that says of which run it is, then records, each sealed by a SHA-256 over everything before it. A record
// that is torn or altered ends the checkpoint there, and the run computes again what followed. Safe against kill -9 after every add(); a
// power cut may cost the latest records. All members may be called from several threads at once.
class Checkpoint {
 public:
  using Record = std::pair<std::string, std::string>;  // key of 64 hexadecimal digits (sha256_hex), and what is kept under it

  // A new one. Nothing is touched before the first add(), when all input has been found good: then `prepare` is called, which must create
  // the folder, and whatever was at `path` is replaced.
  Checkpoint(std::string path, const RunIdentity& run, std::function<void()> prepare);
  // Takes up the one at `path`. Throws InputError if there is none, if it belongs to another run, or if its head is damaged.
  Checkpoint(std::string path, const RunIdentity& run);

  // What the one with these bytes holds, in memory only: for processes that share a run whose checkpoint another one writes. No bytes: as a
  // new one. Throws as the one above, naming `path`.
  static Checkpoint copy_of(std::string_view bytes, const std::string& path, const RunIdentity& run);

  // A new one at `to`, with all that these hold. Throws InputError if one is damaged at its head or belongs to another run than the first.
  static void merge(std::span<const std::string> paths, const std::string& to);

  // Of what was there when it was taken up; a run does not ask twice, and need not have in memory what it adds.
  std::optional<std::string> find(const std::string& key) const;
  // Throws RunError when the disk is full; what was added before stays good.
  void add(std::span<const Record> records);
  // Called after every add() of something that has reached the file, from its thread. Not while anything is added.
  void on_add(std::function<void()> tell) { tell_ = std::move(tell); }

  std::size_t size() const;

 private:
  Checkpoint(const std::string& path, const RunIdentity& run, std::string_view bytes);
  std::size_t read(std::string_view records, const std::string& first_seal);  // that of their head; returns how many bytes were good

  std::string path_, head_;
  bool written_ = true;  // to disk
  std::function<void()> prepare_, tell_;
  std::map<std::string, std::string, std::less<>> kept_;
  std::string seal_;  // of the last record
  std::optional<AppendedFile> file_;
  mutable std::mutex lock_;
};

}  // namespace swarmfit
