// SPDX-License-Identifier: MIT
// The way of plain values out of a child process: sizes and contents, one after the other.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swarmfit {

// What a child process that reads a file of `size` bytes may need [bytes]: numbers of one byte become eight, twice, and files are packed.
constexpr std::size_t child_memory(std::size_t size) { return (std::size_t{256} << 20) + 100 * size; }

class Packer {
 public:
  void add(std::size_t n) { bytes.append(reinterpret_cast<const char*>(&n), sizeof n); }
  void add(const std::string& text) {
    add(text.size());
    bytes += text;
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    if constexpr (std::is_arithmetic_v<T>)
      bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    else
      for (const auto& value : values) add(value);
  }
  std::string bytes;
};

// Trusts its input, which our own child process has packed.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}
  std::size_t size() { return values<std::size_t>(1)[0]; }
  std::string text() {
    const auto letters = values<char>(size());
    return {letters.begin(), letters.end()};
  }
  template <class T>
  std::vector<T> list() {
    return values<T>(size());
  }
  std::vector<std::string> texts() {
    std::vector<std::string> out(size());
    for (auto& text : out) text = this->text();
    return out;
  }

 private:
  template <class T>
  std::vector<T> values(std::size_t n) {
    std::vector<T> out(n);
    if (n > 0) std::memcpy(out.data(), bytes_.data(), n * sizeof(T));
    bytes_.remove_prefix(n * sizeof(T));
    return out;
  }
  std::string_view bytes_;
};

}  // namespace swarmfit
