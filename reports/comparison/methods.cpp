// SPDX-License-Identifier: MIT
#include "reports/comparison/methods.h"

#include <fmt/format.h>

#include <algorithm>

#include "libeval/lags.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/paper_text.h"

namespace swarmfit {
namespace {

// In the order in which the text refers to them.
constexpr const char* kRen2016 =
    "Ren J, Wang X, Jin X, Manocha D (2016) Simulating flying insects using dynamics and data-driven noise modeling to generate diverse "
    "collective behaviors. PLoS ONE 11(5): e0155698. doi:10.1371/journal.pone.0155698 (metrics, energy, score, calibration loop)";
constexpr const char* kZou2006 =
    "Zou ZH, Yun Y, Sun JN (2006) Entropy method for determination of weight of evaluating indicators in fuzzy synthetic evaluation for "
    "water quality assessment. J Environ Sci 18(5): 1020–1023. doi:10.1016/S1001-0742(06)60032-6 (entropy weights)";
constexpr const char* kTanabe2013 =
    "Tanabe R, Fukunaga A (2013) Success-history based parameter adaptation for differential evolution. IEEE CEC 2013: 71–78. "
    "doi:10.1109/CEC.2013.6557555 (search)";
constexpr const char* kNlopt =
    "Johnson SG (2007) The NLopt nonlinear-optimization package. github.com/stevengj/nlopt (refinement: Nelder–Mead inside bounds)";
constexpr const char* kCook1994 =
    "Cook JR, Stefanski LA (1994) Simulation-extrapolation estimation in parametric measurement error models. J Am Stat Assoc 89(428): "
    "1314–1328. doi:10.1080/01621459.1994.10476871 (share of measurement error)";
constexpr const char* kCartis2019 =
    "Cartis C, Fiala J, Marteau B, Roberts L (2019) Improving the flexibility and robustness of model-based derivative-free optimization "
    "solvers. ACM Trans Math Softw 45(3): 32. doi:10.1145/3338517 (least-squares steps)";
constexpr const char* kGneiting2007 =
    "Gneiting T, Raftery AE (2007) Strictly proper scoring rules, prediction, and estimation. J Am Stat Assoc 102(477): 359–378. "
    "doi:10.1198/016214506000001437 (energy score)";

// "5 motion metrics (v, a, ω, d, η)"
std::string metrics_text(const Comparison& c) {
  std::string symbols;
  int number = 0;
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    if (counts(c, m)) symbols += fmt::format("{}{}", number++ > 0 ? ", " : "", c.recording.columns[m].symbol());
  return fmt::format("{} motion metrics ({})", number, symbols);
}

std::string what_was_done(const Comparison& c) {
  const Budget& b = c.run.budget;
  const std::string models = fmt::format("{} model{}", c.models.size(), c.models.size() == 1 ? " was" : "s were");
  const std::string error = c.recording.observation.error_source == "none" || c.recording.observation.sigma.isZero()
                                ? ""
                                : fmt::format(", measurement error ({})", sigma_text(c));
  const std::string smooth =
      c.recording.observation.smoothing > 0 ? fmt::format(", smoothing ({} frames)", brief(c.recording.observation.smoothing)) : "";
  const std::string fixed = kept_fixed(c);
  const std::string kept = fmt::format(
      "{} Simulation steps per frame: {}.",
      fixed.empty() ? "" : fmt::format(" These parameters were kept fixed: {}.", in_print(unit_in_print(fixed))), steps_taken(c));
  return fmt::format(
      "{} fitted with swarmfit {} to {} frames of {} ({} individuals per frame, frame interval {} s{}). Simulations started from the "
      "recording's positions and velocities under its conditions (presence: {}, arena: {}{}{}). Parameters were searched by differential "
      "evolution with least-squares steps and refinement inside bounds [3, 4, 6] ({} replicates per candidate, budget {}), maximising the "
      "entropy-weighted score of "
      "{} "
      "[1, 2]; the best candidates were searched again with {} replicates and compared on {} others; final scores rest on {} "
      "fresh "
      "replicates.{} Seed {}.",
      models, c.run.version, c.recording.data.frames, file_name(c.recording.data.path), brief(c.recording.data.individuals_per_frame, 3),
      brief(c.recording.data.dt), c.recording.data.synthetic ? ", synthetic" : "", c.recording.observation.presence,
      c.recording.observation.arena, error, smooth, b.search.replicates, budget_text(c), metrics_text(c), b.selection.replicates,
      b.confirmation_replicates, b.final_replicates, kept, c.run.seed);
}

constexpr const char* kMetricsDefined =
    "Per individual and frame, with velocities v(k) = (p(k+1) − p(k))/dt: speed v, acceleration a, angular velocity ω, angular "
    "acceleration α, jerk μ, distance d to the nearest neighbour, and velocity difference η = | |v(nearest)| − |v| | / d. No difference is "
    "taken across a gap.";

std::string how_it_is_measured(const Comparison& c) {
  const std::string energy =
      c.recording.binning.pooled
          ? "its energy is the L1 distance Σ |Q − Q'| between the recording and all replicates pooled [1]"
          : "its energy is the energy score of the recording, the mean L1 distance Σ |Q − Q'| between recording and replicates "
            "minus half its mean between two replicates [7]";
  return fmt::format(
      "{} Each metric becomes a discrete density Q; {}, normalised over the models as (energy − p1)/p2 with p1 the least and p2 "
      "the range. Weights follow from the entropy of the normalised energies, and the search is repeated until they converge.",
      kMetricsDefined, energy);
}

std::vector<std::string> references(const Comparison& c) {
  std::vector<std::string> out = {kRen2016, kZou2006, kTanabe2013, kNlopt, kCook1994, kCartis2019, kGneiting2007};
  for (const ModelFit& r : c.models)
    if (!r.citation.empty() && std::none_of(out.begin(), out.end(), [&](const std::string& old) { return old.starts_with(r.citation); }))
      out.push_back(fmt::format("{} ({})", r.citation, r.model));
  return out;
}

// By what the values of a metric are put into bins.
std::string binning_text(const Binning& b) {
  switch (b.normalisation) {
    case Normalisation::reference:
      return "standardised by the mean and standard deviation of the recording";
    case Normalisation::separate:
      return "standardised for each of the two by its own mean and standard deviation";
    case Normalisation::none:
      return "in physical units over the recording's 0.5 to 99.5 percentile range";
  }
  return {};
}

std::string lags_measured_at(const Evaluation& e) {
  const std::vector<int> lags = lags_of(e.columns);
  return lags == std::vector<int>{1} ? "" : fmt::format(" At lag l, p(k+l) and l dt replace p(k+1) and dt; l = {}.", lags_text(lags));
}

}  // namespace

Methods methods(const Evaluation& e, bool recorded_velocities, const std::string& version) {
  return {
      {fmt::format("{} was compared with {} by swarmfit {}.", file_name(e.simulated.from.path), file_name(e.real.from.path), version),
       fmt::format("{}{}{} Each metric becomes a discrete density Q of {} bins, {}; its energy is the L1 distance Σ |Q − Q'| [1].",
                   kMetricsDefined, lags_measured_at(e), recorded_velocities ? " Velocities are the files' own." : "", e.binning.bins,
                   binning_text(e.binning)),
       "Polarisation is the length of the mean heading over individuals [2], milling that of the mean r̂ × v̂ about the centroid [3], "
       "the rms radius the root mean square distance to the centroid; each is the mean over frames."},
      {kRen2016,
       "Vicsek T, Czirók A, Ben-Jacob E, Cohen I, Shochet O (1995) Novel type of phase transition in a system of self-driven particles. "
       "Phys Rev Lett 75(6): 1226–1229. doi:10.1103/PhysRevLett.75.1226 (polarisation)",
       "Couzin ID, Krause J, James R, Ruxton GD, Franks NR (2002) Collective memory and spatial sorting in animal groups. J Theor Biol "
       "218(1): 1–11. doi:10.1006/jtbi.2002.3065 (milling)"}};
}

Methods methods(const Comparison& c) { return {{what_was_done(c), how_it_is_measured(c)}, references(c)}; }

std::string methods_markdown(const Comparison& c) {
  const Methods m = methods(c);
  std::string out;
  for (const std::string& paragraph : m.paragraphs) out += markdown_text(paragraph) + "\n\n";
  int number = 0;
  for (const std::string& reference : m.references) out += fmt::format("{}. {}\n", ++number, markdown_text(reference));
  return out;
}

std::string methods_latex(const Comparison& c) {
  const Methods m = methods(c);
  std::string out;
  for (const std::string& paragraph : m.paragraphs) out += latex_text(paragraph) + "\n\n";
  out += "\\begin{enumerate}\n";
  for (const std::string& reference : m.references) out += "  \\item " + latex_text(reference) + '\n';
  return out + "\\end{enumerate}\n";
}

}  // namespace swarmfit
