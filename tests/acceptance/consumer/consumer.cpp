// SPDX-License-Identifier: MIT
// A program of somebody else's that uses the installed libraries: the mean polarisation of a recording, and how many models there are.
#include <cstdio>

#include "libeval/order.h"
#include "libswarm/model_spec.h"
#include "libtrack/read/read.h"

int main(int, char** argv) {
  const swarmfit::OrderSeries series = swarmfit::order_parameters(swarmfit::read_tracks(argv[1]));
  std::printf("polarisation %.3f, %zu models\n", swarmfit::mean_defined(series.polarisation), swarmfit::models().size());
}
