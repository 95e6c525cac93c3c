// SPDX-License-Identifier: MIT
#include "libtrack/read/mat_trx.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

class Trx {
 public:
  Trx(const MatFile& mat, const std::string& file) : mat_(mat), file_(file) {
    count_ = 1;
    for (const auto d : find(mat.variables, "trx")->dims) count_ *= d;
  }

  RawTable read() {
    table_.file = file_;
    table_.row_name = "row";
    const bool mm = all_have("x_mm") && all_have("y_mm");
    table_.unit = mm ? "mm" : "px";
    table_.columns = mm ? "x_mm,y_mm" : "x,y";
    for (std::size_t k = 0; k < count_; ++k) add(k, mm ? "x_mm" : "x", mm ? "y_mm" : "y");
    check_numbers(table_);
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::size_t k, const std::string& what) const {
    throw InputError(fmt::format("{}: trx({}) {}", file_, k + 1, what));
  }

  const std::vector<double>* field(std::size_t k, const std::string& name) const {
    const auto hit = mat_.array.find(fmt::format("trx({}).{}", k + 1, name));
    return hit == mat_.array.end() || hit->second.value.empty() ? nullptr : &hit->second.value;
  }

  bool all_have(const std::string& name) const {
    for (std::size_t k = 0; k < count_; ++k)
      if (field(k, "x") && !field(k, name)) return false;
    return count_ > 0 && field(0, name);
  }

  void add(std::size_t k, const char* x_name, const char* y_name) {
    const auto *x = field(k, x_name), *y = field(k, y_name), *first = field(k, "firstframe"), *id = field(k, "id");
    if (!x && !y) return;  // a fly without a frame
    if (!x || !y || x->size() != y->size()) fail(k, fmt::format("has {} and {} of different lengths; expected the same", x_name, y_name));
    if (!first || (*first)[0] != std::floor((*first)[0])) fail(k, "has no firstframe; expected a whole number");
    if (const auto* fps = field(k, "fps"); fps && (*fps)[0] > 0) state_rate(k, (*fps)[0]);
    const double own[] = {id ? (*id)[0] : static_cast<double>(k + 1)};
    const std::size_t before = table_.track.size();
    add_ids(table_, own);
    table_.track.resize(before + x->size(), table_.track.back());
    for (std::size_t i = 0; i < x->size(); ++i) table_[FileColumn::frame].push_back((*first)[0] + static_cast<double>(i));
    table_[FileColumn::x].insert(table_[FileColumn::x].end(), x->begin(), x->end());
    table_[FileColumn::y].insert(table_[FileColumn::y].end(), y->begin(), y->end());
  }

  void state_rate(std::size_t k, double fps) {
    if (table_.dt > 0 && std::abs(table_.dt * fps - 1) > 1e-6)
      fail(k, fmt::format("has {} frames per second, others {}; expected one rate", fps, 1 / table_.dt));
    table_.dt = 1 / fps;
  }

  const MatFile& mat_;
  const std::string& file_;
  std::size_t count_ = 0;
  RawTable table_;
};

}  // namespace

bool has_trx(const MatVariables& variables) {
  const auto* trx = find(variables, "trx");
  if (!trx) return false;
  const auto has = [&](const char* name) { return std::find(trx->fields.begin(), trx->fields.end(), name) != trx->fields.end(); };
  return has("x") && has("y") && has("firstframe");
}

RawTable read_trx(const MatFile& mat, const std::string& file) { return Trx(mat, file).read(); }

}  // namespace swarmfit
