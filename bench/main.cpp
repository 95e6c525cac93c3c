// SPDX-License-Identifier: MIT
// What every benchmark program begins with: memory as swarmfit itself uses it.
#include <benchmark/benchmark.h>

#include "libtrack/memory.h"

int main(int argc, char** argv) {
  swarmfit::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
