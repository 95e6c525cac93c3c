// SPDX-License-Identifier: MIT
#include "libtrack/read/pickle.h"

#include "libtrack/error.h"
#include "libtrack/read/pickle_machine.h"
#include "libtrack/utf8.h"

namespace swarmfit {
namespace {

using Kind = PickleValue::Kind;

// Characters up to U+00FF are bytes of this number.
std::string latin1(std::string_view text) {
  std::string out;
  for (const char32_t c : to_utf32(text)) out += static_cast<char>(c);
  return out;
}

bool is_text(const PickleValue& value) { return value.kind == Kind::text || value.kind == Kind::bytes; }

}  // namespace

Pickle::Pickle(std::string file, std::string_view bytes) : file_(std::move(file)), size_(bytes.size()) {
  PickleMachine machine(file_, bytes);
  root_ = machine.run();
  values_ = machine.take();
  const PickleValue& root = values_[root_];
  if (root.kind != Kind::array || root.items.size() != 2 || !root.dims.empty()) return;
  if (const PickleValue& data = item(root, 1); data.kind == Kind::sequence && data.items.size() == 1) root_ = data.items[0];
}

const PickleValue* Pickle::find(const PickleValue& dict, std::string_view key) const {
  if (dict.kind != Kind::dict) return nullptr;
  for (std::size_t k = 0; k + 1 < dict.items.size(); k += 2)
    if (is_text(item(dict, k)) && item(dict, k).text == key) return &item(dict, k + 1);
  return nullptr;
}

bool Pickle::is_numbers(const PickleValue& value) const {
  return value.kind == Kind::array && value.items.size() == 2 && item(value, 0).kind == Kind::type && is_number_type(item(value, 0).text) &&
         item(value, 1).kind == Kind::bytes;
}

NumberArray Pickle::array(const std::string& name, const PickleValue& array) const {
  if (!is_numbers(array)) throw InputError(file_ + ": array '" + name + "' holds no numbers; expected some");
  const PickleValue &type = item(array, 0), &data = item(array, 1);
  const NumberLayout layout{(type.order == '>' ? '>' : '<') + std::string(type.text), array.fortran, array.dims};
  return data.characters ? numbers_of(file_, name, layout, latin1(data.text)) : numbers_of(file_, name, layout, data.text);
}

std::vector<NumberArray> Pickle::arrays() const {
  if (is_numbers(root())) return {array("", root())};
  std::vector<NumberArray> out;
  std::size_t numbers = 0;
  if (root().kind != Kind::dict) return out;
  for (std::size_t k = 0; k + 1 < root().items.size(); k += 2)
    if (const PickleValue& key = item(root(), k), &value = item(root(), k + 1); is_text(key) && is_numbers(value)) {
      out.push_back(array(plain_name(key.text.substr(0, 100)), value));
      numbers += out.back().value.size();
      if (numbers > size_) throw InputError(file_ + ": is a Python pickle with the same array many times; expected each once");
    }
  return out;
}

}  // namespace swarmfit
