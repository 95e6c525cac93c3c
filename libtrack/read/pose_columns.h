// SPDX-License-Identifier: MIT
// Tables with one row per frame: pairs of columns x, y for every individual, for every point of a body, or for both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libtrack/read/read_text.h"

namespace swarmfit {

// One pair (or triple) of position columns.
struct PoseColumns {
  std::string individual;  // empty: that of the row
  std::string node;        // empty: the only one
  std::optional<std::size_t> x{}, y{}, z{}, confidence{};
};

// What "x1", "x_fish1", "nose.x" and "nose.score" have in common: a label and a part. Nothing for other names.
struct PoseName {
  std::string label;  // as written, "" for plain x
  char part = 'x';    // x, y, z, or c: confidence
};
std::optional<PoseName> pose_name(std::string_view name);

// Whether labels number individuals: "1", "fish2", "Arena0_Ind3", but not "nose" or "tail1".
bool numbers_individuals(const std::string& label);

// The table with one row per individual and frame. `map` names frame, time and, where individuals have rows of their own, the id.
RawTable read_pose_rows(const Source& source, const TextHeader& header, const ColumnMap& map, const std::vector<PoseColumns>& poses,
                        const ReadOptions& options, const std::string& usual_node = {});

}  // namespace swarmfit
