// SPDX-License-Identifier: MIT
// What idtracker.ai has found, whatever the container: positions in pixels, NaN where an animal was not seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libtrack/read/npy.h"
#include "libtrack/read/raw_table.h"

namespace swarmfit {

struct IdTrackerFile {
  NumberArray positions;   // frames x animals x 2
  NumberArray confidence;  // of identities: frames x animals, or frames x animals x 1; of other dimensions: none
  std::optional<double> fps;
  std::vector<std::string> names;  // as the user gave them; numbers from 1 where there are not as many as animals
};

RawTable idtracker_table(const std::string& file, const IdTrackerFile& found, const ReadOptions& options);

}  // namespace swarmfit
