// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/read/pickle.h"

namespace swarmfit {

// The stack machine of a pickle. Values refer to each other by their numbers, so that they may hold themselves without harm.
class PickleMachine {
 public:
  PickleMachine(const std::string& file, std::string_view bytes) : file_(file), rest_(bytes) {}

  // The number of the value that was pickled. Throws InputError.
  std::size_t run();
  std::deque<PickleValue> take() { return std::move(values_); }

 private:
  using Kind = PickleValue::Kind;
  [[noreturn]] void refuse(const std::string& why) const;

  // Arguments of opcodes, in the pickle.
  std::string_view bytes(std::uint64_t count);
  std::uint64_t whole(std::size_t size);  // little-endian
  std::string_view line();

  // Values and the stack.
  void push(PickleValue value);
  std::size_t pop();
  std::vector<std::size_t> from_mark();
  PickleValue& top();
  const PickleValue& argument(const PickleValue& sequence, std::size_t number, Kind kind) const;

  // Opcodes by what they do; false: it is none of them.
  bool literal(unsigned char opcode);
  bool text(unsigned char opcode);
  bool container(unsigned char opcode);
  bool remember(unsigned char opcode);
  bool object(unsigned char opcode);

  void sequence(std::vector<std::size_t> items);
  void extend(Kind kind, const std::vector<std::size_t>& items);
  void callable(std::string_view module, std::string_view name);
  void call();
  std::vector<std::size_t> dims_of(const PickleValue& sequence) const;
  void build();
  void build_array(PickleValue& array, const PickleValue& state);

  std::string file_;
  std::string_view rest_;
  std::deque<PickleValue> values_;  // stay where they are when others come
  std::vector<std::size_t> stack_, marks_;
  std::map<std::uint64_t, std::size_t> memo_;
};

}  // namespace swarmfit
