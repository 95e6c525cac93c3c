// SPDX-License-Identifier: MIT
#include "libtrack/read/pickled_names.h"

#include <map>

namespace swarmfit {
namespace {

constexpr std::size_t kMostSteps = 1'000'000;

// A value on the stack of the pickle's machine: a text, a tuple of texts, a list of tuples, or the mark.
struct Value {
  enum class Kind { mark, text, tuple, list } kind = Kind::text;
  std::string text{};
  std::vector<std::string> tuple{};
  std::vector<std::vector<std::string>> list{};
};

class Machine {
 public:
  explicit Machine(std::string_view pickle) : rest_(pickle) {}

  std::optional<std::vector<std::vector<std::string>>> run() {
    while (!rest_.empty()) {
      const char opcode = rest_.front();
      rest_.remove_prefix(1);
      if (opcode == '.') {
        if (stack_.size() != 1 || stack_[0].kind != Value::Kind::list) return std::nullopt;
        return std::move(stack_[0].list);
      }
      if (++steps_ > kMostSteps || !step(opcode)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  std::string argument() {
    const auto end = rest_.find('\n');
    std::string out(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return out;
  }

  bool step(char opcode) {
    switch (opcode) {
      case '(':
        stack_.push_back({Value::Kind::mark});
        return true;
      case 'V':
        stack_.push_back({Value::Kind::text, argument()});
        return true;
      case 'p': {  // remembers the topmost; only texts come back
        const auto key = argument();
        if (stack_.empty()) return false;
        if (stack_.back().kind == Value::Kind::text) memo_[key] = stack_.back().text;
        return true;
      }
      case 'g': {
        const auto hit = memo_.find(argument());
        if (hit == memo_.end()) return false;
        stack_.push_back({Value::Kind::text, hit->second});
        return true;
      }
      case 't':
        return close(Value::Kind::tuple);
      case 'l':
        return close(Value::Kind::list);
      case 'a':
        return append();
      default:
        return false;
    }
  }

  // Everything from the mark on becomes a tuple of texts or an empty list.
  bool close(Value::Kind kind) {
    Value out{kind};
    auto from = stack_.size();
    while (from > 0 && stack_[from - 1].kind != Value::Kind::mark) --from;
    if (from == 0 || (kind == Value::Kind::list && from != stack_.size())) return false;
    for (auto i = from; i < stack_.size(); ++i) {
      if (stack_[i].kind != Value::Kind::text) return false;
      out.tuple.push_back(std::move(stack_[i].text));
    }
    stack_.resize(from - 1);
    stack_.push_back(std::move(out));
    return true;
  }

  bool append() {
    if (stack_.size() < 2 || stack_.back().kind != Value::Kind::tuple || stack_[stack_.size() - 2].kind != Value::Kind::list) return false;
    auto tuple = std::move(stack_.back().tuple);
    stack_.pop_back();
    stack_.back().list.push_back(std::move(tuple));
    return true;
  }

  std::string_view rest_;
  std::vector<Value> stack_;
  std::map<std::string, std::string> memo_;
  std::size_t steps_ = 0;
};

}  // namespace

std::optional<std::vector<std::vector<std::string>>> pickled_names(std::string_view pickle) { return Machine(pickle).run(); }

}  // namespace swarmfit
