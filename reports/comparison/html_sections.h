// SPDX-License-Identifier: MIT
// What the sections of pages are made of (page_sections.h).
#pragma once

#include "fit/results/comparison.h"
#include "reports/write/html_table.h"

namespace swarmfit::sections {

Html badge(const Comparison&);  // "synthetic data"
Html data_facts(const Comparison&, std::string_view what = "recording");
Html warnings(const Comparison&);       // nothing if there are none
Html ranking(const Comparison&);        // what decides, and what describes, one row per model
Html result_figure(const Comparison&);  // models with what they are, paired intervals, letters, fit
Html strip(const Comparison&);          // trajectories of the recording and the best model
Html heat_map(const Comparison&);       // signed misfit, model by metric
Html pictures(const Comparison&);       // recording beside every model; nothing without pictures
Html forces_figure(const Comparison&);  // curves by regression; nothing where there was too little to see
Html quality(const Comparison&);        // of the tracks over time
Html convergence(const Comparison&);
Html posteriors(const Comparison&);   // nothing without samples
Html motion(const Comparison&);       // films of the recording and every model in their surroundings; nothing without a film
Html settings(const Comparison&);     // what was kept fixed, and the time step
Html legend(const Comparison&);       // check boxes of the charts
Html pdf_figures(const Comparison&);  // an empty canvas per column
Html pdf_note(const Comparison&);
Html band_note(const Comparison&);  // nothing if there is no band
Html moments(const Comparison&);    // mean and sd of every model against the recording
Html weights(const Comparison&);
Html lags(const Comparison&);  // which lag carried the decision
Html weights_converged(const Comparison&);
Html parameters(const Comparison&);
Html search(const Comparison&);
Html observation(const Comparison&);
Html methods(const Comparison&);  // paragraphs to paste
Html references(const Comparison&);
Html skill(const Comparison&);    // distances, floor and null; interaction
Html without(const Comparison&);  // rankings with one model left out
Html panel(const Comparison&);    // what was not fitted
Html provenance(const Comparison&);

}  // namespace swarmfit::sections
