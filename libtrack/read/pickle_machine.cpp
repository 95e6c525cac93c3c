// SPDX-License-Identifier: MIT
#include "libtrack/read/pickle_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/utf8.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostValues = 1'000'000;
constexpr std::size_t kMostDims = 8;

enum class Call : std::uint8_t { reconstruct, from_buffer, scalar, encode, dtype, ndarray, empty_bytes };

struct Name {
  std::string_view module, name;
  Call call;
};
constexpr std::array kNames = {
    Name{"numpy.core.multiarray", "_reconstruct", Call::reconstruct},
    Name{"numpy._core.multiarray", "_reconstruct", Call::reconstruct},
    Name{"numpy.core.numeric", "_frombuffer", Call::from_buffer},
    Name{"numpy._core.numeric", "_frombuffer", Call::from_buffer},
    Name{"numpy.core.multiarray", "scalar", Call::scalar},
    Name{"numpy._core.multiarray", "scalar", Call::scalar},
    Name{"numpy", "ndarray", Call::ndarray},
    Name{"numpy", "dtype", Call::dtype},
    Name{"_codecs", "encode", Call::encode},
    Name{"builtins", "bytes", Call::empty_bytes},
    Name{"__builtin__", "bytes", Call::empty_bytes},
};

}  // namespace

void PickleMachine::refuse(const std::string& why) const {
  throw InputError(
      fmt::format("{}: is a Python pickle {}; expected numbers, texts, tuples, lists, dicts and arrays of NumPy (in Python: "
                  "load it with numpy.load(FILE, allow_pickle=True) and save rows of id,frame,x,y as CSV)",
                  file_, why));
}

std::string_view PickleMachine::bytes(std::uint64_t count) {
  if (count > rest_.size()) refuse("that ends early");
  const auto out = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return out;
}

std::uint64_t PickleMachine::whole(std::size_t size) {
  const auto raw = bytes(size);
  std::uint64_t out = 0;
  for (std::size_t k = size; k-- > 0;) out = out << 8U | static_cast<unsigned char>(raw[k]);
  return out;
}

std::string_view PickleMachine::line() {
  const auto out = bytes(std::min(rest_.find('\n'), rest_.size()));
  bytes(1);
  return out;
}

void PickleMachine::push(PickleValue value) {
  if (values_.size() == kMostValues) refuse(fmt::format("of more than {} values", kMostValues));
  stack_.push_back(values_.size());
  values_.push_back(std::move(value));
}

std::size_t PickleMachine::pop() {
  if (stack_.size() <= (marks_.empty() ? 0 : marks_.back())) refuse("that takes more than there is");
  const std::size_t out = stack_.back();
  stack_.pop_back();
  return out;
}

std::vector<std::size_t> PickleMachine::from_mark() {
  if (marks_.empty()) refuse("without a mark");
  const auto first = stack_.begin() + static_cast<std::ptrdiff_t>(marks_.back());
  marks_.pop_back();
  std::vector<std::size_t> out(first, stack_.end());
  stack_.erase(first, stack_.end());
  return out;
}

PickleValue& PickleMachine::top() {
  const std::size_t number = pop();
  stack_.push_back(number);
  return values_[number];
}

const PickleValue& PickleMachine::argument(const PickleValue& sequence, std::size_t number, Kind kind) const {
  if (sequence.kind != Kind::sequence || number >= sequence.items.size() || values_[sequence.items[number]].kind != kind)
    refuse("whose arrays are made in no way of NumPy's");
  return values_[sequence.items[number]];
}

std::size_t PickleMachine::run() {
  for (std::size_t steps = 0;; ++steps) {
    const auto opcode = static_cast<unsigned char>(bytes(1)[0]);
    if (opcode == '.') {
      if (stack_.size() != 1 || !marks_.empty()) refuse("that leaves more than one value");
      return stack_[0];
    }
    if (steps > 4 * kMostValues) refuse("of more steps than any recording needs");
    if (!(literal(opcode) || text(opcode) || container(opcode) || remember(opcode) || object(opcode)))
      refuse(fmt::format("with the opcode {:#04x}", opcode));
  }
}

bool PickleMachine::literal(unsigned char opcode) {
  const auto number = [&](double value) { push({.kind = Kind::number, .number = value}); };
  switch (opcode) {
    case 0x80:  // protocol
      bytes(1);
      return true;
    case 0x95:  // frame
      bytes(8);
      return true;
    case 'N':
      push({});
      return true;
    case 0x88:  // true
    case 0x89:
      number(opcode == 0x88 ? 1 : 0);
      return true;
    case 'J':
      number(static_cast<std::int32_t>(whole(4)));
      return true;
    case 'K':
      number(static_cast<double>(whole(1)));
      return true;
    case 'M':
      number(static_cast<double>(whole(2)));
      return true;
    case 0x8a: {  // a whole number of so many bytes, two's complement
      const std::size_t size = whole(1);
      if (size > 8) refuse("with a number of more than 64 bits");
      const std::size_t shift = 64 - 8 * size;
      number(size == 0 ? 0 : static_cast<double>(static_cast<std::int64_t>(whole(size) << shift) >> shift));
      return true;
    }
    case 'G': {  // big-endian
      std::uint64_t bits = 0;
      for (const char c : bytes(8)) bits = bits << 8U | static_cast<unsigned char>(c);
      number(std::bit_cast<double>(bits));
      return true;
    }
    default:
      return false;
  }
}

bool PickleMachine::text(unsigned char opcode) {
  struct Opcode {
    unsigned char opcode;
    std::size_t size;  // of its length
    Kind kind;
  };
  constexpr std::array opcodes = {Opcode{'X', 4, Kind::text},  Opcode{0x8c, 1, Kind::text}, Opcode{0x8d, 8, Kind::text},
                                  Opcode{'B', 4, Kind::bytes}, Opcode{'C', 1, Kind::bytes}, Opcode{0x8e, 8, Kind::bytes},
                                  Opcode{'T', 4, Kind::bytes}, Opcode{'U', 1, Kind::bytes}, Opcode{0x96, 8, Kind::bytes}};
  const auto found = std::find_if(opcodes.begin(), opcodes.end(), [&](const Opcode& o) { return o.opcode == opcode; });
  if (found == opcodes.end()) return false;
  push({.kind = found->kind, .text = bytes(whole(found->size))});
  return true;
}

bool PickleMachine::container(unsigned char opcode) {
  const auto popped = [&](std::size_t count) {
    std::vector<std::size_t> items(count);
    for (std::size_t k = count; k-- > 0;) items[k] = pop();
    return items;
  };
  switch (opcode) {
    case '(':
      marks_.push_back(stack_.size());
      return true;
    case ')':
    case ']':
      sequence({});
      return true;
    case 0x85:
    case 0x86:
    case 0x87:
      sequence(popped(opcode - 0x84U));
      return true;
    case 't':
      sequence(from_mark());
      return true;
    case '}':
      push({.kind = Kind::dict});
      return true;
    case 'a':
      extend(Kind::sequence, popped(1));
      return true;
    case 'e':
      extend(Kind::sequence, from_mark());
      return true;
    case 's':
      extend(Kind::dict, popped(2));
      return true;
    case 'u':
      extend(Kind::dict, from_mark());
      return true;
    default:
      return false;
  }
}

void PickleMachine::sequence(std::vector<std::size_t> items) { push({.kind = Kind::sequence, .items = std::move(items)}); }

void PickleMachine::extend(Kind kind, const std::vector<std::size_t>& items) {
  PickleValue& to = top();
  if (to.kind != kind || (kind == Kind::dict && items.size() % 2 != 0)) refuse("that adds to what is neither list nor dict");
  to.items.insert(to.items.end(), items.begin(), items.end());
}

bool PickleMachine::remember(unsigned char opcode) {
  switch (opcode) {
    case 'q':
    case 'r':
    case 0x94: {
      const std::uint64_t key = opcode == 0x94 ? memo_.size() : whole(opcode == 'q' ? 1 : 4);
      top();
      memo_[key] = stack_.back();
      return true;
    }
    case 'h':
    case 'j': {
      const auto hit = memo_.find(whole(opcode == 'h' ? 1 : 4));
      if (hit == memo_.end()) refuse("that recalls what it has not remembered");
      stack_.push_back(hit->second);
      return true;
    }
    default:
      return false;
  }
}

bool PickleMachine::object(unsigned char opcode) {
  switch (opcode) {
    case 'c': {
      const auto module = line();
      callable(module, line());
      return true;
    }
    case 0x93: {  // names on the stack
      const PickleValue &name = values_[pop()], &module = values_[pop()];
      if (name.kind != Kind::text || module.kind != Kind::text) refuse("with a name that is not text");
      callable(module.text, name.text);
      return true;
    }
    case 'R':
      call();
      return true;
    case 'b':
      build();
      return true;
    default:
      return false;
  }
}

void PickleMachine::callable(std::string_view module, std::string_view name) {
  const auto found = std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.module == module && n.name == name; });
  if (found == kNames.end()) refuse(fmt::format("with a {} of {}", plain_name(name.substr(0, 40)), plain_name(module.substr(0, 40))));
  push({.kind = Kind::callable, .number = static_cast<double>(found->call)});
}

void PickleMachine::call() {
  const PickleValue &arguments = values_[pop()], &what = values_[pop()];
  if (what.kind != Kind::callable) refuse("that calls what cannot be called");
  switch (static_cast<Call>(what.number)) {
    case Call::reconstruct:
      return push({.kind = Kind::array});
    case Call::from_buffer:  // of protocol 5: data, type, dims, order
      argument(arguments, 0, Kind::bytes);
      argument(arguments, 1, Kind::type);
      return push({.kind = Kind::array,
                   .fortran = argument(arguments, 3, Kind::text).text == "F",
                   .items = {arguments.items[1], arguments.items[0]},
                   .dims = dims_of(argument(arguments, 2, Kind::sequence))});
    case Call::dtype: {
      const bool is_bytes = !arguments.items.empty() && values_[arguments.items[0]].kind == Kind::bytes;  // of Python 2
      return push({.kind = Kind::type, .text = argument(arguments, 0, is_bytes ? Kind::bytes : Kind::text).text});
    }
    case Call::encode:  // how protocol 2 writes bytes: as a text in Latin-1
      return push({.kind = Kind::bytes, .text = argument(arguments, 0, Kind::text).text, .characters = true});
    case Call::scalar: {
      argument(arguments, 0, Kind::type);
      argument(arguments, 1, Kind::bytes);
      return push({.kind = Kind::array, .items = {arguments.items[0], arguments.items[1]}});
    }
    case Call::empty_bytes:
      if (arguments.kind != Kind::sequence || !arguments.items.empty()) refuse("that makes bytes of something else");
      return push({.kind = Kind::bytes});
    case Call::ndarray:
      refuse("whose arrays are made in no way of NumPy's");
  }
}

std::vector<std::size_t> PickleMachine::dims_of(const PickleValue& sequence) const {
  if (sequence.items.size() > kMostDims) refuse("whose arrays are made in no way of NumPy's");
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < sequence.items.size(); ++k) {
    const double size = argument(sequence, k, Kind::number).number;
    if (!(size >= 0 && size <= 9e15 && size == std::floor(size))) refuse("with an array of no size");
    out.push_back(static_cast<std::size_t>(size));
  }
  return out;
}

void PickleMachine::build() {
  const PickleValue& state = values_[pop()];
  PickleValue& value = top();
  if (value.kind == Kind::array) return build_array(value, state);
  if (value.kind != Kind::type) refuse("that gives a state to a plain value");
  if (state.kind != Kind::sequence || state.items.size() < 2) refuse("with a type that has no byte order");
  const auto order = values_[state.items[1]].text;
  if (order.size() != 1) refuse("with a type that has no byte order");
  value.order = order[0];
}

// (version, dims, type, is Fortran's order, data)
void PickleMachine::build_array(PickleValue& array, const PickleValue& state) {
  argument(state, 2, Kind::type);
  if (state.items.size() != 5) refuse("whose arrays are made in no way of NumPy's");
  array.dims = dims_of(argument(state, 1, Kind::sequence));
  array.fortran = argument(state, 3, Kind::number).number != 0;
  array.items = {state.items[2], state.items[4]};
}

}  // namespace swarmfit
