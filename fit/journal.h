// SPDX-License-Identifier: MIT
// The checkpoint of a run: every outcome it has simulated. A search is a function of its inputs alone, so a run that starts again and finds
// its simulations here takes the same path to the same bits, and nothing else of its state needs to be kept.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/outcome.h"
#include "libtrack/file.h"
#include "libtrack/rng.h"

namespace swarmfit {

// What an outcome is a function of beside the parameters: all of it must be the same when a run goes on.
struct RunIdentity {
  std::string version;
  std::string recording;  // SHA-256 of its file
  std::string config;     // text of config.toml
};

// A file that only grows: a head that says of which run it is, then records, each sealed by a SHA-256 over everything before it. A record
// that is torn or altered ends the journal there, and the run simulates again what followed. Safe against kill -9 after every add(); a
// power cut may cost the latest records. All members may be called from several threads at once.
class Journal {
 public:
  // A new one. Nothing is touched before the first add(), when all input has been found good: then `prepare` is called, which must create
  // the folder, and whatever was at `path` is replaced.
  Journal(std::string path, const RunIdentity& run, std::function<void()> prepare);
  // Takes up the one at `path`. Throws InputError if there is none, if it belongs to another run, or if its head is damaged.
  Journal(std::string path, const RunIdentity& run);

  // Of a model (canonical name) with these parameters on these seeds.
  static std::string key(const std::string& model, std::span<const double> parameters, std::span<const Rng> seeds);

  // Without distributions and `first`, which are not kept.
  std::optional<Outcome> find(const std::string& key) const;
  // Throws RunError when the disk is full; what was added before stays good.
  void add(std::span<const std::pair<std::string, Outcome>> outcomes);

  std::size_t size() const;

 private:
  void read(std::string_view records);

  std::string path_, head_;
  std::function<void()> prepare_;
  std::map<std::string, Outcome, std::less<>> outcomes_;
  std::string seal_;  // of the last record
  std::optional<AppendedFile> file_;
  mutable std::mutex lock_;
};

}  // namespace swarmfit
