// SPDX-License-Identifier: MIT
// Values as bytes, exactly, for checkpoints: they are read back by the same program on the same kind of machine.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swarmfit {

template <class T>
requires std::is_trivially_copyable_v<T>
void put(std::string& to, const T& value) { to.append(reinterpret_cast<const char*>(&value), sizeof value); }

inline void put(std::string& to, const std::string& text) {
  put(to, static_cast<std::uint32_t>(text.size()));
  to += text;
}

template <class T>
void put(std::string& to, const std::vector<T>& values) {
  put(to, static_cast<std::uint32_t>(values.size()));
  for (const T& value : values) put(to, value);
}

// Takes values off the front of bytes; what is not there is a zero, and noticed.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void take(T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      value = text(count(1));
    } else if constexpr (requires { value.emplace_back(); }) {
      value.resize(count(1));
      for (auto& each : value) take(each);
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

}  // namespace swarmfit
