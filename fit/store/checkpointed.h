// SPDX-License-Identifier: MIT
// Parts of a study that are computed once.
#pragma once

#include <optional>
#include <string>

#include "fit/store/bytes.h"
#include "fit/store/checkpoint.h"

namespace swarmfit {

// The part of this name: from the checkpoint, or else made, and kept there if there is one. Nothing is a part, too. T can be put into
// bytes.
template <class T, class Make>
std::optional<T> checkpointed(Checkpoint* checkpoint, const std::string& name, const Make& make) {
  if (!checkpoint) return make();
  const std::string key = sha256_hex(name);
  if (const auto bytes = checkpoint->find(key)) {
    ByteReader from(*bytes);
    auto part = from.take<std::optional<T>>();
    if (from.ended()) return part;
  }
  std::optional<T> part = make();
  std::string bytes;
  put(bytes, part);
  const Checkpoint::Record record{key, std::move(bytes)};
  checkpoint->add({&record, 1});
  return part;
}

}  // namespace swarmfit
