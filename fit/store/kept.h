// SPDX-License-Identifier: MIT
// Parts of a study that are computed once.
#pragma once

#include <optional>
#include <string>

#include "fit/store/bytes.h"
#include "fit/store/checkpoint.h"

namespace swarmfit {

// The part of this name: from the checkpoint, or else made, and kept there if there is one. Nothing is a part, too. For T there must be
// put(std::string&, const T&) and take(Taker&, T&).
template <class T, class Make>
std::optional<T> kept(Checkpoint* checkpoint, const std::string& name, const Make& make) {
  if (!checkpoint) return make();
  const std::string key = sha256_hex(name);
  if (const auto bytes = checkpoint->find(key)) {
    Taker from(*bytes);
    std::optional<T> part;
    if (from.take<std::uint8_t>() == 1) take(from, part.emplace());
    if (from.ended()) return part;
  }
  std::optional<T> part = make();
  std::string bytes;
  put(bytes, std::uint8_t{part.has_value()});
  if (part) put(bytes, *part);
  const Checkpoint::Record record{key, std::move(bytes)};
  checkpoint->add({&record, 1});
  return part;
}

}  // namespace swarmfit
