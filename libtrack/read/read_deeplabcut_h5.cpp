// SPDX-License-Identifier: MIT
// DeepLabCut's HDF5: a table of pandas, one row per frame, whose columns are x, y and likelihood of every body part and, where there are
// several animals, of every individual. Their names are pickled in attributes and read without unpickling. Pixels; no frame rate.
// Mathis et al., Nature Neuroscience 21:1281 (2018), doi:10.1038/s41593-018-0209-y.
#include <fmt/format.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/pickled_names.h"
#include "libtrack/read/postures.h"

namespace swarmfit {
namespace {

constexpr const char* kTable = "/df_with_missing/table";
constexpr const char* kBlock = "values_block_0";

const Hdf5Object* table_of(const Hdf5Contents* contents) {
  const auto* table = contents ? contents->find(kTable) : nullptr;
  const auto has = [&](const char* name) { return std::find(table->members.begin(), table->members.end(), name) != table->members.end(); };
  return table && table->dims.size() == 1 && has("index") && has(kBlock) ? table : nullptr;
}

bool recognises(const Source& source, const ReadOptions&) { return table_of(source.hdf5()) != nullptr; }

// What the columns of the table are, by individual and node.
struct Layout {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::string> individuals, nodes;
  std::vector<std::array<std::size_t, 3>> column;  // of individual * nodes + node: x, y, likelihood
};

std::size_t place_of(const std::string& name, std::vector<std::string>& names) {
  const auto hit = std::find(names.begin(), names.end(), name);
  if (hit == names.end()) names.push_back(name);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Layout layout_of(const Hdf5Object& table, const std::string& file) {
  const auto names = pickled_names(table.text("values_block_0_kind"));
  const auto fail = InputError(
      file + ": the names of its columns cannot be read; expected scorer, individuals, bodyparts and coords as DeepLabCut writes them");
  if (!names || names->empty()) throw fail;
  Layout out;
  for (const auto& name : *names) {  // scorer, [individual,] body part, coordinate
    if (name.size() != names->front().size() || name.size() < 3 || name.size() > 4) throw fail;
    place_of(name.size() == 4 ? name[1] : "1", out.individuals);
    place_of(name[name.size() - 2], out.nodes);
  }
  if (out.individuals.size() * out.nodes.size() > names->size()) throw fail;
  out.column.assign(out.individuals.size() * out.nodes.size(), {Layout::none, Layout::none, Layout::none});
  for (std::size_t c = 0; c < names->size(); ++c) {
    const auto& name = (*names)[c];
    const auto who = place_of(name.size() == 4 ? name[1] : "1", out.individuals), node = place_of(name[name.size() - 2], out.nodes);
    const auto coordinate = name.back() == "x" ? 0u : name.back() == "y" ? 1u : 2u;
    if (coordinate == 2 && name.back() != "likelihood") throw fail;
    out.column[who * out.nodes.size() + node][coordinate] = c;
  }
  return out;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto* object = table_of(source.hdf5());
  if (!object) throw InputError(fmt::format("{}: there is no table {}; expected HDF5 of DeepLabCut", source.name, kTable));
  const auto layout = layout_of(*object, source.name);
  const auto data = read_hdf5(source.name, source.bytes, {{kTable, "index"}, {kTable, kBlock}});
  const auto& index = data[0].numbers;
  const auto& values = data[1].numbers;
  const std::size_t width = data[1].dims.size() == 2 ? data[1].dims[1] : 1, nodes = layout.nodes.size();

  RawTable table;
  table.file = source.name;
  table.unit = "px";
  Postures postures(table, options, layout.nodes);
  std::array<std::vector<double>, 3> point;
  for (auto& p : point) p.resize(nodes);
  for (std::size_t who = 0; who < layout.individuals.size(); ++who) {
    const auto track = table.names.number(layout.individuals[who]);
    for (std::size_t row = 0; row < index.size(); ++row) {
      for (std::size_t n = 0; n < nodes; ++n)
        for (std::size_t a = 0; a < 3; ++a) {
          const auto column = layout.column[who * nodes + n][a];
          point[a][n] = column < width ? values[row * width + column] : kNaN;
        }
      postures.add({track, index[row], kNaN, point[0], point[1], {}, point[2]});
    }
  }
  postures.finish();
  check_numbers(table);
  return table;
}

}  // namespace

const Reader kDeepLabCutHdf5 = {{"deeplabcut-h5", "DeepLabCut tables in HDF5", ".h5"}, recognises, read};

}  // namespace swarmfit
