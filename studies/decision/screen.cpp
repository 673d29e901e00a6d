#include <algorithm>
#include <cmath>

#include "decision/search.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kEstimated = 5;  // candidates whose variances are estimated, of each ranking
constexpr int kIterations = 5;
constexpr double kSmallShare = 0.01;  // of the remainder's variance, the other start

double on_grid(const Shape& s, double share) {
  return s.logarithmic ? s.lower * std::pow(s.upper / s.lower, share)
                       : s.lower + share * (s.upper - s.lower);
}

// The first shape on its grid, the others in the middle of theirs.
std::vector<std::vector<double>> starts(const CauseForm& form, const Frame& frame) {
  if (form.shapes == nullptr) return {{}};
  if (form.start != nullptr) return {form.start(frame)};
  const auto shapes = form.shapes(frame);
  std::vector<double> middle;
  for (const Shape& s : shapes) middle.push_back(on_grid(s, 0.5));
  std::vector<std::vector<double>> list;
  const Shape& first = shapes.front();
  const int count = first.discrete ? static_cast<int>(first.upper - first.lower) + 1 : first.grid;
  for (int k = 0; k < count; ++k) {
    list.push_back(middle);
    list.back().front() = first.discrete ? first.lower + k : on_grid(first, (k + 0.5) / count);
  }
  return list;
}

/// The model's Gram matrices with the columns of a candidate.
struct Tried {
  Candidate candidate;
  std::vector<Gram> grams;
  FixedEffects columns;
};

Tried try_columns(const Bench& bench, const Fit& fit, const Taken& cause) {
  Tried tried{{cause, 0.0, 0.0, 0.0}, {}, fit.system.columns};
  const bool free = cause.form->columns != nullptr || steps(*cause.form);
  const bool whole = cause.form->transform != nullptr;
  ByEquation own(bench.equations.size());
  ByEquation change(bench.equations.size());
  if (free) own = columns_of(bench, fit.system, fit.state, cause);
  if (whole) change = change_by(bench, fit.state, cause);
  Index k = 0;
  for (const MatrixXd& m : own) k = std::max(k, m.cols());
  const Index at = fit.system.grams.front().ww.cols();
  if (whole) tried.columns.whole = at;
  for (Index c = 0; c < k; ++c) {
    tried.columns.free.push_back(at + (whole ? 1 : 0) + c);
    tried.columns.nonnegative.push_back(cause.form->nonnegative && !whole);
  }
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    const Index rows = bench.equations[e].rows.size();
    MatrixXd columns = MatrixXd::Zero(rows, k + (whole ? 1 : 0));
    if (whole && change[e].cols() > 0) columns.col(0) = change[e];
    if (own[e].cols() > 0) columns.rightCols(k) = own[e];
    tried.grams.push_back(with_columns(bench, fit.system, e, columns));
  }
  return tried;
}

std::vector<Reduced> with_new(const std::vector<Reduced>& base, const std::vector<Gram>& grams) {
  std::vector<Reduced> reduced = base;
  for (std::size_t e = 0; e < grams.size(); ++e) extend(reduced[e], grams[e]);
  return reduced;
}

std::vector<VectorXd> scaled_remainder(const System& system, std::vector<VectorXd> ratio,
                                       double by) {
  for (std::size_t e = 0; e < ratio.size(); ++e) {
    for (std::size_t k = 0; k < system.components[e].size(); ++k) {
      if (!system.components[e][k].nuisance) ratio[e][static_cast<Index>(k)] *= by;
    }
  }
  return ratio;
}

std::vector<Reduced> reduce_all(const System& system, const std::vector<VectorXd>& ratio) {
  std::vector<Reduced> list;
  for (std::size_t e = 0; e < system.grams.size(); ++e) {
    list.push_back(reduce(system.grams[e], system.components[e], ratio[e]));
  }
  return list;
}

double best_variances(const System& system, const std::vector<Gram>& grams,
                      const FixedEffects& columns, const std::vector<VectorXd>& ratio,
                      VectorXd* c) {
  double best = -1e300;
  for (const double share : {1.0, kSmallShare}) {
    const auto v = fit_variances(grams, system.components, columns,
                                 scaled_remainder(system, ratio, share), kIterations);
    if (v.solution.log_likelihood <= best) continue;
    best = v.solution.log_likelihood;
    if (c != nullptr) *c = v.solution.c;
  }
  return best;
}

// Coefficients and stepped shapes of the candidate as the solution has them.
void take(const Frame& frame, const VectorXd& c, Index at, Taken& cause) {
  const VectorXd own = c.tail(c.size() - at);
  if (!steps(*cause.form)) {
    cause.coefficients = own;
    return;
  }
  const auto shapes = cause.form->shapes(frame);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    cause.shape[k] =
        std::clamp(cause.shape[k] + own[static_cast<Index>(k)], shapes[k].lower, shapes[k].upper);
  }
}

bool in_model(const DriveState& state, const CauseRow& row) {
  return std::ranges::any_of(state.causes, [&](const Taken& t) { return t.row == &row; });
}

std::vector<Taken> all_starts(const Frame& frame, const DriveState& state) {
  std::vector<Taken> list;
  for (const CauseRow& row : causes()) {
    if (in_model(state, row)) continue;
    for (const CauseForm* form : forms_on(row, frame)) {
      for (auto& shape : starts(*form, frame)) list.push_back({&row, form, std::move(shape), {}});
    }
  }
  return list;
}

// Best of every row by one ranking, the best rows first.
std::vector<std::size_t> leaders(const std::vector<Tried>& tried, double Candidate::*by,
                                 std::size_t most) {
  std::vector<std::size_t> order(tried.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return tried[a].candidate.*by > tried[b].candidate.*by;
  });
  std::vector<std::size_t> list;
  for (const std::size_t i : order) {
    const bool seen = std::ranges::any_of(list, [&](std::size_t j) {
      return tried[j].candidate.cause.row == tried[i].candidate.cause.row;
    });
    if (!seen && list.size() < most) list.push_back(i);
  }
  return list;
}

}  // namespace

std::vector<Candidate> screen(const Bench& bench, const Fit& fit) {
  const std::vector<Taken> list = all_starts(*bench.frame, fit.state);
  const auto reduced = reduce_all(fit.system, fit.ratio);
  const auto bare = reduce_all(fit.system, scaled_remainder(fit.system, fit.ratio, 0.0));
  const double here = solve(fit.system.grams, reduced, fit.system.columns).log_likelihood;
  const double there = solve(fit.system.grams, bare, fit.system.columns).log_likelihood;
  std::vector<Tried> tried(list.size());
  const double ln_n = std::log(bench.contrasts());
  in_parallel(list.size(), bench.threads, [&](std::size_t i) {
    Tried one = try_columns(bench, fit, list[i]);
    const double price = 0.5 * ln_n;
    const auto near = solve(one.grams, with_new(reduced, one.grams), one.columns);
    const auto far = solve(one.grams, with_new(bare, one.grams), one.columns);
    const auto paid = [&](const Solution& s) {
      Taken cause = list[i];
      take(*bench.frame, s.c, static_cast<Index>(fit.system.columns.free.size()), cause);
      return price * parameters_of(cause);
    };
    one.candidate.beside = near.log_likelihood - here - paid(near);
    one.candidate.instead = far.log_likelihood - there - paid(far);
    tried[i] = std::move(one);
  });
  std::vector<std::size_t> chosen = leaders(tried, &Candidate::beside, kEstimated);
  for (const std::size_t i : leaders(tried, &Candidate::instead, kEstimated)) {
    if (std::ranges::find(chosen, i) == chosen.end()) chosen.push_back(i);
  }
  const double base =
      best_variances(fit.system, fit.system.grams, fit.system.columns, fit.ratio, nullptr);
  std::vector<Candidate> best(chosen.size());
  in_parallel(chosen.size(), bench.threads, [&](std::size_t k) {
    Tried& one = tried[chosen[k]];
    VectorXd c;
    const double l = best_variances(fit.system, one.grams, one.columns, fit.ratio, &c);
    take(*bench.frame, c, static_cast<Index>(fit.system.columns.free.size()), one.candidate.cause);
    one.candidate.gain = l - base - 0.5 * ln_n * parameters_of(one.candidate.cause);
    best[k] = one.candidate;
  });
  std::ranges::stable_sort(best, std::ranges::greater{}, &Candidate::gain);
  std::vector<Candidate> once;
  for (Candidate& one : best) {
    const bool seen =
        std::ranges::any_of(once, [&](const Candidate& c) { return c.cause.row == one.cause.row; });
    if (!seen) once.push_back(std::move(one));
  }
  return once;
}

}  // namespace flexspline::studies::decision
