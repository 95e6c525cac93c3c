// SPDX-License-Identifier: MIT
// What reports/comparison/figures.cpp puts together. A figure without SVG has nothing to show.
#pragma once

#include "reports/comparison/figures.h"
#include "reports/draw/plot.h"

namespace swarmfit::parts {

Figure densities(const Comparison&);  // all columns, a row per lag
Figure density_of(const Comparison&, std::size_t column);
Figure scores(const Comparison&);
Figure energies(const Comparison&);
Figure convergence(const Comparison&);
Figure parameters(const Comparison&);
Figure neighbours(const Comparison&);        // density around a focal animal, recording beside every model
Figure responses(const Comparison&);         // turning and acceleration by the place of a neighbour
Figure curves(const Comparison&);            // autocorrelation, displacement, g(r), correlation of headings
Figure forces(const Comparison&);            // drag, confinement, attraction and alignment, by regression
Figure order(const Comparison&);             // polarisation, milling and spread over time
Figure space(const Comparison&);             // trajectories and use of space
Figure trajectory_strip(const Comparison&);  // of the recording and the best model, for the head of a page
Figure data_quality(const Comparison&);      // of the recording, over time
Figure posterior(const Comparison&, std::size_t model);

// Columns in the order in which they are drawn: those of motion lag by lag, then d and eta.
std::vector<std::size_t> drawing_order(const Comparison&);
// "lag 4 (0.04 s)"; empty if there is only one lag, and for d and eta.
std::string lag_title(const Comparison&, std::size_t column);
// Entries for all models in the order of their ranks.
std::vector<plot::Entry> model_entries(const Comparison&, plot::Sample);

}  // namespace swarmfit::parts
