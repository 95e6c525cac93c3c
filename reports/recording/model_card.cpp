// SPDX-License-Identifier: MIT
#include "reports/recording/model_card.h"

#include <fmt/format.h>

#include "reports/write/number.h"

namespace swarmfit {

Html model_card(const ModelCard& card) {
  Html out = element("p", "", escaped(card.summary + '.'));
  out += element("p", "note", escaped(card.citation));
  HtmlTable table(fmt::format("Parameters of {}", card.name));
  table.head({column("parameter"), column("symbol"), column("value", true), column("unit"), column("meaning")});
  for (const ParameterResult& p : card.parameters)
    table.row({name_cell(escaped(p.name)), text_cell(p.symbol), number_cell(rounded(p.value, 4)), text_cell(p.unit), text_cell(p.meaning)});
  if (card.parameters.empty()) return out;
  out += markup("<details><summary>Parameters</summary>");
  out += table.html();
  out += markup("</details>\n");
  return out;
}

}  // namespace swarmfit
