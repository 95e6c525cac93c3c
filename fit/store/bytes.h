// SPDX-License-Identifier: MIT
// Values as bytes, exactly, for checkpoints and other processes: they are read back by the same program on the same kind of machine.
//
// Numbers, enumerations and plain structs without pointers go as they lie in memory, strings, containers and optionals with their size
// before them. A struct of such members needs a function `fields` that ties them, next to it or where it is first kept.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace swarmfit {

template <class T>
concept WithFields = requires(T& value) {
  fields(value);
};
template <class T>
concept Sequence = requires(T& value) {
  value.emplace_back();
  value.resize(std::size_t{});
};
template <class T>
concept Maybe = requires(T& value) {
  value.emplace();
  value.has_value();
};

template <class T>
void put(std::string& to, const T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    put(to, static_cast<std::uint32_t>(value.size()));
    to += value;
  } else if constexpr (WithFields<T>) {
    std::apply([&](const auto&... each) { (put(to, each), ...); }, fields(const_cast<T&>(value)));  // which only ties them
  } else if constexpr (Sequence<T>) {
    put(to, static_cast<std::uint32_t>(value.size()));
    for (const auto& each : value) put(to, each);
  } else if constexpr (Maybe<T>) {
    put(to, std::uint8_t{value.has_value()});
    if (value) put(to, *value);
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
}

// Takes values off the front of bytes; what is not there is a zero, and noticed.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void take(T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      value = text(count(1));
    } else if constexpr (WithFields<T>) {
      std::apply([&](auto&... each) { (take(each), ...); }, fields(value));
    } else if constexpr (Sequence<T>) {
      value.resize(count(1));
      for (auto& each : value) take(each);
    } else if constexpr (Maybe<T>) {
      value.reset();
      if (take<std::uint8_t>() == 1) take(value.emplace());
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      const auto part = text(sizeof value);
      if (part.size() == sizeof value) std::memcpy(&value, part.data(), sizeof value);
    }
  }

  template <class T>
  T take() {
    T value{};
    take(value);
    return value;
  }

  std::string_view text(std::size_t size) {
    whole_ = whole_ && bytes_.size() >= size;
    const auto part = bytes_.substr(0, size);
    bytes_.remove_prefix(part.size());
    return part;
  }

  bool whole() const { return whole_; }  // was everything there?
  bool empty() const { return bytes_.empty(); }
  bool ended() const { return whole_ && bytes_.empty(); }

 private:
  // How many follow, each of at least so many bytes; 0 if that cannot be.
  std::size_t count(std::size_t least) {
    const auto n = take<std::uint32_t>();
    if (n * least <= bytes_.size()) return n;
    whole_ = false;
    return 0;
  }

  std::string_view bytes_;
  bool whole_ = true;
};

template <class T>
std::string to_bytes(const T& value) {
  std::string bytes;
  put(bytes, value);
  return bytes;
}

// Throws std::logic_error on bytes that are none of a T.
template <class T>
T from_bytes(std::string_view bytes) {
  ByteReader from(bytes);
  T value = from.take<T>();
  if (!from.ended()) throw std::logic_error("bytes have lost their shape");
  return value;
}

}  // namespace swarmfit
