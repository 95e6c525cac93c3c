// SPDX-License-Identifier: MIT
#include "fit/infer/posterior.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fit/infer/ridge.h"
#include "libeval/robust.h"
#include "libtrack/linear_algebra.h"

namespace swarmfit {
namespace {

constexpr double kClip = 8;            // robust standard deviations at which features are cut off
constexpr double kLocal = 0.5;         // share of the simulations, nearest first, from which statistics are learned once more
constexpr double kMargin = 0.1;        // of the sample's range, added to it on either side for the next box
constexpr int kFewest = 40;            // simulations per dimension below which nothing is said
constexpr double kRescale = 1.0;       // largest change of a residual by the heteroscedastic correction, as a logarithm
constexpr double kLeastMargin = 1e-6;  // of the prior's range
constexpr double kSingular = 1e-9;     // added to diagonals
constexpr double kFlat = 0.8;          // interval over the prior's from which on a coordinate is flat
constexpr double kTouches = 0.05;      // of the interval's length: nearer to a bound, its end says nothing

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Simulations that ended well.
struct Bank {
  std::vector<Point> x;
  std::vector<VectorXd> features;
};

using RowList = std::vector<std::size_t>;

bool inside(const Point& x, const Box& box) { return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all(); }

// On the box, on a logistic scale: what is moved there stays in it.
double stretched(double x, double lower, double upper) {
  const double u = std::clamp((x - lower) / (upper - lower), 1e-9, 1 - 1e-9);
  return std::log(u / (1 - u));
}
double share(double x, double lower, double upper) { return (x - lower) / (upper - lower); }
double squeezed(double t, double lower, double upper) { return lower + (upper - lower) / (1 + std::exp(-t)); }

PosteriorRound simulate(Bank& bank, const Box& box, const Simulator& simulator, const Rng& rng, std::uint64_t first, int count,
                        Index features) {
  std::vector<Draw> draws;
  for (std::uint64_t k = first; k < first + static_cast<std::uint64_t>(count); ++k) {
    Draw& draw = draws.emplace_back(Draw{Point(box.lower.size()), rng.derive(Stream::posterior, k)});
    for (Index a = 0; a < draw.x.size(); ++a)
      draw.x[a] = box.lower[a] + (box.upper[a] - box.lower[a]) * rng.uniform(Stream::posterior, k, static_cast<std::uint32_t>(a));
  }
  auto out = simulator(draws);
  PosteriorRound round;
  round.simulations = count;
  round.volume = box.volume();
  for (std::size_t k = 0; k < draws.size(); ++k) {
    if (!out[k] || out[k]->size() != features || !out[k]->allFinite()) {
      ++round.blew_up;
      continue;
    }
    bank.x.push_back(std::move(draws[k].x));
    bank.features.push_back(std::move(*out[k]));
  }
  return round;
}

// Features of some rows and of the recording in robust standard deviations; those that do not vary are left out.
struct Standardised {
  MatrixXd rows;
  VectorXd observed;
};

Standardised standardised(const Bank& bank, const RowList& rows, const VectorXd& observed) {
  std::vector<VectorXd> columns;
  std::vector<double> at;
  const auto n = static_cast<Index>(rows.size());
  for (Index f = 0; f < observed.size(); ++f) {
    std::vector<double> values;
    double sum = 0, square = 0;
    for (const std::size_t r : rows) values.push_back(bank.features[r][f]), sum += values.back();
    const double mean = sum / static_cast<double>(n);
    for (const double v : values) square += (v - mean) * (v - mean);
    Robust typical = robust(values);
    if (!(typical.sd > 0)) typical.sd = std::sqrt(square / static_cast<double>(n));
    if (!(typical.sd > 1e-12 * std::abs(typical.median))) continue;
    const auto z = [&](double v) { return std::clamp((v - typical.median) / typical.sd, -kClip, kClip); };
    columns.emplace_back(n);
    for (Index i = 0; i < n; ++i) columns.back()[i] = z(values[static_cast<std::size_t>(i)]);
    at.push_back(z(observed[f]));
  }
  if (columns.empty()) columns.emplace_back(VectorXd::Zero(n)), at.push_back(0);
  Standardised out{MatrixXd(n, static_cast<Index>(columns.size())), VectorXd(static_cast<Index>(columns.size()))};
  for (Index c = 0; c < out.rows.cols(); ++c) {
    for (Index i = 0; i < n; ++i) out.rows(i, c) = columns[static_cast<std::size_t>(c)][i];
    out.observed[c] = at[static_cast<std::size_t>(c)];
  }
  return out;
}

// One statistic per coordinate, less that of the recording, in independent units of what it leaves open.
struct Learned {
  MatrixXd statistics;  // rows × dimensions
  VectorXd distance;    // of each row from the recording
};

// Points as rows, each coordinate through `scale` with the ends of the box.
template <class Scale>
MatrixXd coordinates(const Bank& bank, const RowList& rows, const Box& box, Scale scale) {
  MatrixXd t(static_cast<Index>(rows.size()), box.lower.size());
  for (Index i = 0; i < t.rows(); ++i)
    for (Index a = 0; a < t.cols(); ++a) t(i, a) = scale(bank.x[rows[static_cast<std::size_t>(i)]][a], box.lower[a], box.upper[a]);
  return t;
}

// Statistics are learned on the plain scale: on the logistic one, points near the faces of the box would decide the fit.
Learned learn(const Bank& bank, const RowList& rows, const Box& box, const VectorXd& observed) {
  const Standardised z = standardised(bank, rows, observed);
  const MatrixXd t = coordinates(bank, rows, box, share);
  const RidgeFit fit = ridge(z.rows, t, z.observed);
  const MatrixXd residual = t - fit.held_out;
  MatrixXd covariance = residual.transpose() * residual / static_cast<double>(t.rows());
  covariance.diagonal().array() += kSingular;  // a model without chance leaves nothing open
  const MatrixXd offset = (fit.held_out - VectorXd::Ones(t.rows()) * fit.predicted.transpose()).transpose();
  Learned out{solve_lower(cholesky_factor(covariance), offset).transpose(), VectorXd(t.rows())};
  for (Index i = 0; i < t.rows(); ++i) {
    double square = 0;
    for (Index a = 0; a < t.cols(); ++a) square += out.statistics(i, a) * out.statistics(i, a);
    out.distance[i] = std::sqrt(square);
  }
  return out;
}

// Places of the nearest, ascending in distance.
RowList nearest(const VectorXd& distance, std::size_t count) {
  RowList order(static_cast<std::size_t>(distance.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distance[static_cast<Index>(a)] < distance[static_cast<Index>(b)]; });
  order.resize(std::min(order.size(), count));
  return order;
}

struct Kept {
  RowList rows;  // of the bank
  MatrixXd statistics;
  VectorXd weight;  // Epanechnikov, sums to 1
};

Kept keep(const RowList& rows, const Learned& learned, std::size_t count) {
  const RowList near = nearest(learned.distance, count + 1);
  const double reach = learned.distance[static_cast<Index>(near.back())];
  const auto n = static_cast<Index>(near.size() - 1);
  Kept kept{{}, MatrixXd(n, learned.statistics.cols()), VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const std::size_t r = near[static_cast<std::size_t>(i)];
    kept.rows.push_back(rows[r]);
    const double near_by = reach > 0 ? learned.distance[static_cast<Index>(r)] / reach : 0;
    kept.weight[i] = std::max(1 - near_by * near_by, 1e-9);
    for (Index a = 0; a < kept.statistics.cols(); ++a) kept.statistics(i, a) = learned.statistics(static_cast<Index>(r), a);
  }
  kept.weight /= kept.weight.sum();
  return kept;
}

// Weighted least squares of every column of y on the statistics, which are zero for the recording: what is predicted there is the
// intercept. Residuals are those of rows left out; those that the fit saw would be too small.
struct Local {
  MatrixXd intercept;  // 1 × columns
  MatrixXd predicted, residual;
};

Local local_regression(const Kept& kept, const MatrixXd& y) {
  MatrixXd design(y.rows(), kept.statistics.cols() + 1);
  design << VectorXd::Ones(y.rows()), kept.statistics;
  MatrixXd gram = design.transpose() * kept.weight.asDiagonal() * design;
  gram.diagonal() *= 1 + kSingular;
  const MatrixXd moment = design.transpose() * kept.weight.asDiagonal() * y;
  const MatrixXd coefficients = solve_semidefinite(gram, moment), hat = solve_semidefinite(gram, design.transpose());
  Local out{coefficients.topRows(1), design * coefficients, MatrixXd(y.rows(), y.cols())};
  for (Index i = 0; i < y.rows(); ++i) {
    double leverage = 0;
    for (Index c = 0; c < design.cols(); ++c) leverage += kept.weight[i] * design(i, c) * hat(c, i);
    for (Index a = 0; a < y.cols(); ++a) out.residual(i, a) = (y(i, a) - out.predicted(i, a)) / std::max(1 - leverage, 0.1);
  }
  return out;
}

std::vector<Point> adjusted(const Bank& bank, const Kept& kept, const Box& box) {
  const MatrixXd t = coordinates(bank, kept.rows, box, stretched);
  const Local mean = local_regression(kept, t);
  const MatrixXd log_square = (mean.residual.array().square() + 1e-12).log().matrix();
  const Local spread = local_regression(kept, log_square);
  std::vector<Point> sample;
  for (Index i = 0; i < t.rows(); ++i) {
    Point x(t.cols());
    for (Index a = 0; a < t.cols(); ++a) {
      const double change = std::clamp((spread.intercept(0, a) - spread.predicted(i, a)) / 2, -kRescale, kRescale);
      x[a] = squeezed(mean.intercept(0, a) + mean.residual(i, a) * std::exp(change), box.lower[a], box.upper[a]);
    }
    sample.push_back(std::move(x));
  }
  return sample;
}

// The sample of one round, from all simulations in the box.
bool infer(Posterior& out, const Bank& bank, const Box& box, const VectorXd& observed, double part) {
  RowList rows;
  for (std::size_t r = 0; r < bank.x.size(); ++r)
    if (inside(bank.x[r], box)) rows.push_back(r);
  out.rounds.back().in_box = static_cast<int>(rows.size());
  const auto total = static_cast<double>(rows.size());
  if (total < kFewest * static_cast<double>(box.lower.size())) return false;
  const auto count = static_cast<std::size_t>(std::lround(part * total));
  Learned learned = learn(bank, rows, box, observed);
  const RowList near = nearest(learned.distance, std::max(static_cast<std::size_t>(kLocal * total), count + 1));
  RowList local;
  for (const std::size_t place : near) local.push_back(rows[place]);
  std::sort(local.begin(), local.end());
  learned = learn(bank, local, box, observed);
  const Kept kept = keep(local, learned, count);
  out.rounds.back().kept = static_cast<int>(kept.rows.size());
  out.sample = adjusted(bank, kept, box);
  out.weight.assign(kept.weight.data(), kept.weight.data() + kept.weight.size());
  out.effective = 1 / kept.weight.squaredNorm();
  return true;
}

std::vector<double> coordinate(const Posterior& p, Index a) {
  std::vector<double> values;
  for (const Point& x : p.sample) values.push_back(x[a]);
  return values;
}

// Generously round the sample: what is cut off here no later round can bring back. Never flat, though a recording may determine a
// coordinate to the last digit.
Box around(const Posterior& p, const Box& before) {
  Box box = before;
  for (Index a = 0; a < box.lower.size(); ++a) {
    const auto values = coordinate(p, a);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double margin = std::max(kMargin * (*most - *least), kLeastMargin);
    box.lower[a] = std::max(before.lower[a], *least - margin);
    box.upper[a] = std::min(before.upper[a], *most + margin);
  }
  return box;
}

double weighted_mean(const std::vector<double>& values, const std::vector<double>& weights) {
  return std::inner_product(values.begin(), values.end(), weights.begin(), 0.0);
}

MatrixXd covariance(const Posterior& p, Index d) {
  Point mean = Point::Zero(d);
  for (Index a = 0; a < d; ++a) mean[a] = weighted_mean(coordinate(p, a), p.weight);
  MatrixXd sum = MatrixXd::Zero(d, d);
  for (std::size_t i = 0; i < p.sample.size(); ++i) {
    const Point off = p.sample[i] - mean;
    sum += p.weight[i] * (off * off.transpose());
  }
  return sum;
}

std::vector<Marginal> marginals(const Posterior& p, const Box& prior) {
  const Index d = prior.lower.size();
  const MatrixXd c = covariance(p, d);
  std::vector<Marginal> out;
  for (Index a = 0; a < d; ++a) {
    Marginal m;
    const auto values = coordinate(p, a);
    const double side = prior.upper[a] - prior.lower[a];
    m.median = weighted_quantile(values, p.weight, 0.5);
    m.lower = weighted_quantile(values, p.weight, 0.025);
    m.upper = weighted_quantile(values, p.weight, 0.975);
    m.contraction = 1 - 12 * c(a, a) / (side * side);
    const double length = m.upper - m.lower, nearer = std::min(m.lower - prior.lower[a], prior.upper[a] - m.upper);
    m.verdict = length > kFlat * 0.95 * side ? Identifiability::flat
                : nearer < kTouches * length ? Identifiability::one_sided
                                             : Identifiability::identified;
    for (Index b = 0; b < d; ++b) {
      const double r = b == a ? 0 : c(a, b) / std::sqrt(c(a, a) * c(b, b));
      if (b != a && (m.partner < 0 || std::abs(r) > std::abs(m.correlation))) m.partner = static_cast<int>(b), m.correlation = r;
    }
    out.push_back(m);
  }
  return out;
}

std::vector<Marginal> of_prior(const Box& prior) {
  std::vector<Marginal> out(static_cast<std::size_t>(prior.lower.size()));
  for (std::size_t a = 0; a < out.size(); ++a)
    for (double* end : {&out[a].lower, &out[a].median, &out[a].upper})
      *end = prior.lower[static_cast<Index>(a)] + *end * (prior.upper - prior.lower)[static_cast<Index>(a)];
  return out;
}

}  // namespace

double Box::volume() const { return (upper - lower).prod(); }

double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights, double p) {
  RowList order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  double squares = 0;
  for (const double w : weights) squares += w * w;
  const double shrink = 1 / (1 + squares);  // n / (n + 1), n being the effective size
  double below = 0, previous_place = 0, previous = values[order.front()];
  for (const std::size_t k : order) {
    const double place = 0.5 + (below + weights[k] / 2 - 0.5) * shrink;
    if (place >= p) {
      if (below == 0) return values[k];
      return previous + (values[k] - previous) * (p - previous_place) / (place - previous_place);
    }
    below += weights[k];
    previous_place = place;
    previous = values[k];
  }
  return previous;
}

Posterior posterior(const VectorXd& observed, int dimensions, const Simulator& simulator, const Rng& rng, const PosteriorOptions& options,
                    const Box* start) {
  if (!observed.allFinite()) throw std::invalid_argument("posterior: observed features must be finite");
  Box prior;
  prior.lower = start ? start->lower : Point(Point::Zero(dimensions));
  prior.upper = start ? start->upper : Point(Point::Ones(dimensions));
  Posterior out;
  out.marginals = of_prior(prior);
  Bank bank;
  Box box = prior;
  for (int round = 0; round < options.rounds; ++round) {
    const auto first = static_cast<std::uint64_t>(round) * static_cast<std::uint64_t>(options.simulations);
    out.rounds.push_back(simulate(bank, box, simulator, rng, first, options.simulations, observed.size()));
    if (!infer(out, bank, box, observed, options.kept)) continue;
    if (round + 1 < options.rounds) box = around(out, box);
  }
  if (!out.sample.empty()) out.marginals = marginals(out, prior);
  return out;
}

}  // namespace swarmfit
