#include "decision/fit.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/baseline.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLawStart = 1.0;         // variance ratio of a law's own freedom
constexpr double kRemainderStart = 0.05;  // of what is not known to be there
constexpr double kWorse = 0.5;            // nats that a step may lose
constexpr double kMostModulationStep = 1.0;
constexpr double kMostModulation = 4.0;
constexpr double kMostZeroStep = 0.1;
constexpr double kMostZero = 0.6;
constexpr double kMostMounting = 0.05;
constexpr double kNoRemainder = 1e-3;  // of the residual's square
constexpr double kGone = 1e-7;         // a variance ratio below it is none
constexpr int kPruningIterations = 2;
constexpr int kFirstIterations = 3;
constexpr int kIterations = 6;
constexpr int kLastIterations = 10;

// Components come and go with the nuisances that a state can have: those behind keep their ratio.
void match(const System& system, std::vector<VectorXd>& ratio, Remainder kind) {
  for (std::size_t e = 0; e < system.components.size(); ++e) {
    const auto& components = system.components[e];
    const Index gone = ratio[e].size() - static_cast<Index>(components.size());
    VectorXd next(static_cast<Index>(components.size()));
    for (Index k = 0; k < next.size(); ++k) {
      const bool nuisance = components[static_cast<std::size_t>(k)].nuisance;
      const bool known = ratio[e].size() > 0 && k + gone >= 0;
      next[k] = known ? ratio[e][k + gone] : nuisance ? kLawStart : 0.0;
      if (kind == Remainder::none && !nuisance) next[k] = 0.0;
    }
    ratio[e] = next;
  }
}

void raise_remainder(const System& system, std::vector<VectorXd>& ratio, double to) {
  for (std::size_t e = 0; e < ratio.size(); ++e) {
    for (std::size_t k = 0; k < system.components[e].size(); ++k) {
      double& d = ratio[e][static_cast<Index>(k)];
      if (!system.components[e][k].nuisance) d = std::max(d, to);
    }
  }
}

Index law_columns(const System& system, std::size_t e) {
  Index n = 0;
  for (const Component& c : system.components[e]) {
    if (!c.nuisance || c.coordinate != "torsion") break;
    n += c.size;
  }
  return n;
}

// The baseline's coefficients and steps that go with u and c.
VectorXd baseline_step(const System& system, const VarianceFit& v, std::size_t e) {
  const EquationSystem& s = system.equations[e];
  VectorXd right = s.qy - s.qz * v.u[e];
  for (std::size_t i = 0; i < system.columns.free.size(); ++i) {
    right -= v.solution.c[static_cast<Index>(i)] * s.qw.col(system.columns.free[i]);
  }
  const VectorXd step = s.r.triangularView<Eigen::Upper>().solve(right);
  return step.cwiseQuotient(s.scale);
}

void step_nonlinear(const Frame& frame, const VectorXd& step, DriveState& state) {
  if (frame.travels) {
    const double low = std::log(1e-4 * frame.rate_range);
    const double high = std::log(0.3 * frame.rate_range);
    state.nonlinear[0] = std::clamp(state.nonlinear[0] + std::clamp(step[0], -0.5, 0.5), low, high);
    return;
  }
  for (Index k = 0; k < 3; ++k) {
    const double by = std::clamp(step[k], -kMostModulationStep, kMostModulationStep);
    state.nonlinear[k] = std::clamp(state.nonlinear[k] + by, -kMostModulation, kMostModulation);
  }
  if (state.nonlinear.size() == 4) {
    const double by = std::clamp(step[3], -kMostZeroStep, kMostZeroStep);
    state.nonlinear[3] = std::clamp(state.nonlinear[3] + by, -kMostZero, kMostZero);
  }
  for (Index k = 4; k < state.nonlinear.size(); ++k) {
    state.nonlinear[k] += std::clamp(step[k], -kMostMounting, kMostMounting);
  }
}

void take_coefficients(const Frame& frame, const System& system, const VectorXd& c, bool moves,
                       DriveState& state) {
  for (std::size_t i = 0; i < state.causes.size(); ++i) {
    Taken& cause = state.causes[i];
    const VectorXd own = c.segment(system.first[i], system.count[i]);
    if (!steps(*cause.form)) {
      cause.coefficients = own;
      continue;
    }
    if (!moves) continue;
    const auto shapes = cause.form->shapes(frame);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const double most = 0.25 * (shapes[k].upper - shapes[k].lower);
      const double by = std::clamp(own[static_cast<Index>(k)], -most, most);
      cause.shape[k] = std::clamp(cause.shape[k] + by, shapes[k].lower, shapes[k].upper);
    }
  }
}

// What the solution says of the state; moves: the nonlinear parameters too.
DriveState advanced(const Bench& bench, const System& system, const VarianceFit& v,
                    DriveState state, bool moves) {
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    const EquationRows& one = bench.equations[e];
    const VectorXd step = baseline_step(system, v, e);
    VectorXd& own = state.own[index_of(one.equation)];
    const bool torsion = one.equation == Equation::torsion;
    const Index m = step.size() - (torsion ? state.nonlinear.size() : 0);
    const bool first = own.size() == 0;
    own = first ? VectorXd(step.head(m)) : VectorXd(own + step.head(m));
    if (torsion) {
      state.random[index_of(one.equation)] = one.unit * v.u[e].head(law_columns(system, e));
      if (moves && !first) step_nonlinear(*bench.frame, step.tail(state.nonlinear.size()), state);
    }
  }
  take_coefficients(*bench.frame, system, v.solution.c, moves, state);
  return state;
}

DriveState halfway(const DriveState& good, const DriveState& bad) {
  DriveState state = good;
  state.nonlinear = 0.5 * (good.nonlinear + bad.nonlinear);
  for (std::size_t i = 0; i < state.causes.size(); ++i) {
    for (std::size_t k = 0; k < state.causes[i].shape.size(); ++k) {
      state.causes[i].shape[k] = 0.5 * (good.causes[i].shape[k] + bad.causes[i].shape[k]);
    }
  }
  return state;
}

int active(const VectorXd& coefficients) {
  int n = 0;
  for (const double c : coefficients) n += c != 0.0 ? 1 : 0;
  return n;
}

int remainder_components(const Fit& fit) {
  int n = 0;
  for (std::size_t e = 0; e < fit.ratio.size(); ++e) {
    for (std::size_t k = 0; k < fit.system.components[e].size(); ++k) {
      const bool there = fit.ratio[e][static_cast<Index>(k)] > kGone;
      n += there && !fit.system.components[e][k].nuisance ? 1 : 0;
    }
  }
  return n;
}

void set_score(const Bench& bench, Fit& fit) {
  fit.parameters = 0;
  for (const Taken& cause : fit.state.causes) fit.parameters += parameters_of(cause);
  fit.components = remainder_components(fit);
  fit.score = fit.log_likelihood - 0.5 * fit.parameters * std::log(bench.contrasts()) -
              kNameless * fit.components;
}

}  // namespace

int parameters_of(const Taken& cause) {
  return std::max(1, active(cause.coefficients) + static_cast<int>(cause.shape.size()));
}

Fit fit_state(const Bench& bench, DriveState state, std::vector<VectorXd> ratio, int passes,
              Remainder remainder) {
  const bool fresh = ratio.empty();
  if (fresh) ratio.resize(bench.equations.size());
  Fit best;
  bool known = false;
  for (int pass = 0; pass < passes; ++pass) {
    const bool last = pass == passes - 1;
    Fit fit;
    fit.system = system_at(bench, state);
    match(fit.system, ratio, remainder);
    const bool raises =
        fresh && remainder == Remainder::estimated && pass == std::max(0, passes - 2);
    if (raises) raise_remainder(fit.system, ratio, kRemainderStart), known = false;
    const bool early = fresh && pass < passes - 2;
    fit.variances =
        fit_variances(fit.system.grams, fit.system.components, fit.system.columns, ratio,
                      last    ? kLastIterations
                      : early ? kFirstIterations
                              : kIterations);
    fit.ratio = ratio = fit.variances.ratio;
    fit.log_likelihood = fit.variances.solution.log_likelihood;
    fit.built = state;
    fit.state = advanced(bench, fit.system, fit.variances, state, false);
    const bool better = !known || early || fit.log_likelihood > best.log_likelihood - kWorse;
    const DriveState next = better ? advanced(bench, fit.system, fit.variances, state, true)
                                   : halfway(best.state, state);
    if (better && (!known || early || fit.log_likelihood > best.log_likelihood || !last)) {
      best = std::move(fit);
      known = true;
    }
    if (!better) ratio = best.ratio;
    state = next;
  }
  set_score(bench, best);
  return best;
}

void prune(const Bench& bench, Fit& fit) {
  const System& system = fit.system;
  for (bool again = true; again;) {
    again = false;
    VarianceFit best;
    double least = kNameless;
    for (std::size_t e = 0; e < fit.ratio.size(); ++e) {
      for (std::size_t k = 0; k < system.components[e].size(); ++k) {
        if (system.components[e][k].nuisance || fit.ratio[e][static_cast<Index>(k)] <= kGone)
          continue;
        auto ratio = fit.ratio;
        ratio[e][static_cast<Index>(k)] = 0.0;
        auto less = fit_variances(system.grams, system.components, system.columns, std::move(ratio),
                                  kPruningIterations);
        const double loss = fit.log_likelihood - less.solution.log_likelihood;
        if (!(loss < least)) continue;
        least = loss;
        best = std::move(less);
        again = true;
      }
    }
    if (!again) break;
    fit.variances = std::move(best);
    fit.ratio = fit.variances.ratio;
    fit.log_likelihood = fit.variances.solution.log_likelihood;
    fit.state = advanced(bench, fit.system, fit.variances, fit.built, false);
  }
  set_score(bench, fit);
}

Fit refit(const Bench& bench, const Fit& from, DriveState state, int passes) {
  std::vector<VectorXd> ratio = from.ratio;
  raise_remainder(from.system, ratio, 1e-3 * kRemainderStart);
  Fit fit = fit_state(bench, std::move(state), std::move(ratio), passes);
  prune(bench, fit);
  return fit;
}

VectorXd part_of(const Bench& bench, const Fit& fit, std::size_t e, std::size_t component) {
  const EquationSystem& s = fit.system.equations[e];
  const EquationRows& one = bench.equations[e];
  const Component& c = fit.system.components[e][component];
  const VectorXd u = fit.variances.u[e].segment(c.first, c.size);
  const Index own = s.raw_z.cols();
  if (c.first < own) return s.raw_z.middleCols(c.first, c.size) * u;
  return one.discrepancy.columns.middleCols(c.first - own, c.size)(one.rows.row, Eigen::all) * u;
}

VectorXd remainder(const Bench& bench, const Fit& fit, std::size_t e) {
  VectorXd sum = VectorXd::Zero(bench.equations[e].rows.size());
  for (std::size_t k = 0; k < fit.system.components[e].size(); ++k) {
    if (!fit.system.components[e][k].nuisance) sum += part_of(bench, fit, e, k);
  }
  return sum;
}

VectorXd unexplained(const Bench& bench, const Fit& fit, std::size_t e) {
  const EquationRows& one = bench.equations[e];
  const Frame seen = told(*bench.frame, seen_by(*bench.frame, fit.state), one.equation);
  const BaselineDesign design = baseline_design(seen, one.equation, fit.state, false);
  Eigen::ArrayXd r =
      target_of(seen, one.equation) - baseline_prediction(design, one.equation, fit.state);
  VectorXd left = r.matrix()(one.rows.row);
  for (std::size_t k = 0; k < fit.system.components[e].size(); ++k) {
    if (fit.system.components[e][k].nuisance) left -= part_of(bench, fit, e, k);
  }
  for (const Taken& cause : fit.state.causes) {
    if (steps(*cause.form) || cause.coefficients.size() == 0) continue;
    const Eigen::MatrixXd columns = columns_of(bench, fit.system, fit.state, cause)[e];
    if (columns.cols() > 0) left -= columns * cause.coefficients;
  }
  return left;
}

Fit with_fitted_noise(Bench& bench, Fit fit) {
  const std::size_t recordings = bench.frame->segments.size();
  std::vector<EquationRows> about_all = bench.equations;
  std::vector<EquationRows> about_laws = bench.equations;
  double share = 0.0;
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    const EquationRows& one = bench.equations[e];
    const VectorXd left = unexplained(bench, fit, e);
    const VectorXd part = remainder(bench, fit, e);
    share = std::max(share, part.squaredNorm() / left.squaredNorm());
    set_noise(about_all[e], fit_noise(one.rows, recordings, left - part, one.memory));
    set_noise(about_laws[e], fit_noise(one.rows, recordings, left, one.memory));
  }
  bench.equations = std::move(about_all);
  Fit first = refit(bench, fit, fit.state, 2);
  if (share < kNoRemainder) return first;
  Bench other = bench;
  other.equations = std::move(about_laws);
  Fit second = refit(other, fit, fit.state, 2);
  if (second.log_likelihood <= first.log_likelihood) return first;
  bench = std::move(other);
  return second;
}

}  // namespace flexspline::studies::decision
