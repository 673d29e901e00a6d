#include "decision/system.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "diagnosis/baseline.hpp"
#include "diagnosis/noise.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRidge = 1e-5;          // of a column of the baseline, over its length
constexpr double kCycleShare = 0.25;     // of a cycle: noise that lasts longer is a misfit's
constexpr double kUsualFriction = 0.03;  // from day to day: 1 K of grease
constexpr double kUsualZero = 0.002;     // of the torsion range
constexpr double kNudge = 1e-3;          // of a shape's range, for its tangent

MatrixXd rows_of(const MatrixXd& all, const Rows& rows) { return all(rows.row, Eigen::all); }

// Columns of one recording each.
MatrixXd by_recording(const Frame& f, const Eigen::Ref<const VectorXd>& column) {
  MatrixXd each = MatrixXd::Zero(f.rows(), static_cast<Index>(f.segments.size()));
  for (std::size_t i = 0; i < f.segments.size(); ++i) {
    const Segment& s = f.segments[i];
    each.col(static_cast<Index>(i)).segment(s.first, s.count) = column.segment(s.first, s.count);
  }
  return each;
}

// How a bench differs from one day to the next, in units of what is usual, which is its most.
void add_nuisance(Discrepancy& to, const MatrixXd& columns, std::string coordinate,
                  std::string says) {
  const Index first = to.columns.cols();
  to.components.push_back(
      {std::move(coordinate), std::move(says), first, columns.cols(), true, 1.0});
  to.columns.conservativeResize(columns.rows(), first + columns.cols());
  to.columns.rightCols(columns.cols()) = columns;
}

// The laws' own freedom, and each recording's friction and zero.
Discrepancy nuisances(const Frame& seen, const BaselineDesign& design, const EquationRows& one,
                      const DriveState& state) {
  Discrepancy d{design.random * one.unit, design.components};
  const VectorXd& own = state.own[index_of(one.equation)];
  if (own.size() == 0 || seen.segments.size() < 2) return d;
  const VectorXd friction = design.columns.middleCols(design.friction, design.friction_size) *
                            own.segment(design.friction, design.friction_size);
  add_nuisance(d, by_recording(seen, kUsualFriction * friction), "temperature",
               "friction of each recording");
  if (one.equation != Equation::torsion || seen.travels || state.nonlinear.size() > 4) return d;
  add_nuisance(d, by_recording(seen, kUsualZero * design.tangents.col(3)), "constant",
               "zero of each recording");
  return d;
}

// [B; penalty] = Q R, of columns scaled to length one after whitening.
void orthonormalise(const EquationRows& one, const BaselineDesign& design, EquationSystem& s) {
  const Index m = design.columns.cols();
  const Index t = design.tangents.cols();
  MatrixXd all(design.columns.rows(), m + t);
  all << design.columns, design.tangents;
  const MatrixXd white = whitened(one.noise, one.rows, rows_of(all, one.rows));
  const Index n = white.rows();
  s.scale = white.colwise().norm().cwiseMax(1e-300);
  MatrixXd stacked = MatrixXd::Zero(n + m + t, m + t);
  for (Index k = 0; k < m + t; ++k) {
    const bool none = !(s.scale[k] > 1e-200);
    if (!none) stacked.col(k).head(n) = white.col(k) / s.scale[k];
    const double prior = k < m ? kRidge : 1.0 / (s.scale[k] * design.step[k - m]);
    stacked(n + k, k) = none ? 1.0 : std::max(prior, kRidge);
  }
  // Twice by Cholesky: products of matrices alone, orthonormal to rounding as the penalty bounds
  // the condition.
  MatrixXd q = stacked;
  s.r = MatrixXd::Identity(m + t, m + t);
  for (int pass = 0; pass < 2; ++pass) {
    MatrixXd square = MatrixXd::Zero(m + t, m + t);
    square.selfadjointView<Eigen::Lower>().rankUpdate(q.transpose());
    const Eigen::LLT<MatrixXd> factor(square.selfadjointView<Eigen::Lower>());
    const MatrixXd upper = factor.matrixU();
    upper.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(q);
    s.r = upper.triangularView<Eigen::Upper>() * s.r;
  }
  s.q = q.topRows(n);
}

ArrayXd residual_of(const Frame& frame, const Frame& all, Equation equation,
                    const DriveState& state) {
  const Frame seen = told(frame, all, equation);
  const BaselineDesign design = baseline_design(seen, equation, state, false);
  ArrayXd r = target_of(seen, equation) - baseline_prediction(design, equation, state);
  if (equation == Equation::torsion && state.random[0].size() > 0) {
    r -= (design.random * state.random[0]).array();
  }
  return r;
}

bool acts_on(const CauseForm& form, Equation equation) {
  return std::ranges::count(form.at, equation) > 0;
}

// Change of the residual by the shapes of a cause, divided by a factor.
ByEquation difference(const Bench& bench, const DriveState& from, const DriveState& to,
                      const CauseForm& form, double factor) {
  const Frame before = seen_by(*bench.frame, from);
  const Frame after = seen_by(*bench.frame, to);
  ByEquation list;
  for (const EquationRows& one : bench.equations) {
    MatrixXd column(one.rows.size(), 0);
    if (acts_on(form, one.equation)) {
      const MatrixXd whole = ((residual_of(*bench.frame, before, one.equation, from) -
                               residual_of(*bench.frame, after, one.equation, to)) *
                              factor)
                                 .matrix();
      column = rows_of(whole, one.rows);
    }
    list.push_back(std::move(column));
  }
  return list;
}

DriveState with(const DriveState& state, const Taken& cause) {
  DriveState next = state;
  for (Taken& one : next.causes) {
    if (one.form != cause.form) continue;
    one.shape = cause.shape;
    return next;
  }
  next.causes.push_back(cause);
  return next;
}

// Tangents of the residual's fall by every shape.
ByEquation tangents_of(const Bench& bench, const DriveState& state, const Taken& cause) {
  const auto shapes = cause.form->shapes(*bench.frame);
  ByEquation list(bench.equations.size());
  const DriveState from = with(state, cause);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const double range = shapes[k].upper - shapes[k].lower;
    const bool at_top = cause.shape[k] + kNudge * range > shapes[k].upper;
    const double nudge = (at_top ? -kNudge : kNudge) * range;
    Taken moved = cause;
    moved.shape[k] += nudge;
    const ByEquation one = difference(bench, from, with(state, moved), *cause.form, 1.0 / nudge);
    for (std::size_t e = 0; e < one.size(); ++e) {
      MatrixXd all(one[e].rows(), list[e].cols() + one[e].cols());
      if (list[e].cols() > 0) all.leftCols(list[e].cols()) = list[e];
      all.rightCols(one[e].cols()) = one[e];
      list[e] = std::move(all);
    }
  }
  return list;
}

void take_columns(const Bench& bench, const DriveState& state, System& system) {
  std::vector<ByEquation> blocks;
  for (const Taken& cause : state.causes) {
    system.first.push_back(0);
    system.count.push_back(0);
    const bool has = cause.form->columns != nullptr || steps(*cause.form);
    blocks.push_back(has ? columns_of(bench, system, state, cause) : ByEquation{});
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Index k = 0;
    for (const MatrixXd& m : blocks[i]) k = std::max(k, m.cols());
    system.first[i] = static_cast<Index>(system.columns.free.size());
    system.count[i] = k;
    for (Index c = 0; c < k; ++c) {
      system.columns.free.push_back(system.first[i] + c);
      system.columns.nonnegative.push_back(state.causes[i].form->nonnegative &&
                                           state.causes[i].form->columns != nullptr);
    }
    for (std::size_t e = 0; e < bench.equations.size(); ++e) {
      MatrixXd columns = MatrixXd::Zero(bench.equations[e].rows.size(), k);
      if (k > 0 && blocks[i][e].cols() > 0) columns = blocks[i][e];
      const Gram more = with_columns(bench, system, e, columns);
      EquationSystem& s = system.equations[e];
      const MatrixXd white = whitened(bench.equations[e].noise, bench.equations[e].rows, columns);
      MatrixXd w(white.rows(), s.w.cols() + k), qw(s.q.cols(), s.w.cols() + k);
      w << s.w, white;
      qw << s.qw, s.q.transpose() * white;
      s.w = std::move(w), s.qw = std::move(qw);
      system.grams[e] = more;
    }
  }
}

}  // namespace

double Bench::contrasts() const {
  double n = 0.0;
  for (const EquationRows& one : equations) n += static_cast<double>(one.rows.size());
  return n;
}

void set_noise(EquationRows& one, NoiseModel noise) {
  one.noise = std::move(noise);
  one.white = whitened(one.noise, one.rows, rows_of(one.discrepancy.columns, one.rows));
  one.inner.setZero(one.white.cols(), one.white.cols());
  one.inner.selfadjointView<Eigen::Lower>().rankUpdate(one.white.transpose());
  one.inner = MatrixXd(one.inner.selfadjointView<Eigen::Lower>());
}

Bench bench_of(const Frame& frame, unsigned threads) {
  Bench bench;
  bench.frame = &frame;
  bench.usable = frame.usable;
  bench.threads = threads;
  for (const Equation equation : frame.equations) {
    EquationRows one;
    one.equation = equation;
    one.rows = decision::rows_of(frame, bench.usable);
    one.discrepancy = discrepancy_of(frame, equation);
    one.unit = 0.01 * frame.largest_torque(equation);
    one.memory = kCycleShare * rows_per_cycle(frame, equation);
    std::vector<double> level = noise_levels(frame, target_of(frame, equation));
    for (double& l : level) l = std::max(l, 1e-6 * one.unit);
    set_noise(one, white_noise(one.rows, std::move(level)));
    bench.equations.push_back(std::move(one));
  }
  return bench;
}

void mask(Bench& bench, Index first, Index count) {
  bench.usable.segment(first, count).setZero();
  for (EquationRows& one : bench.equations) {
    one.rows = decision::rows_of(*bench.frame, bench.usable);
    NoiseModel noise = one.noise;
    noise.weight = ArrayXd::Ones(one.rows.size());
    set_noise(one, std::move(noise));
  }
}

System system_at(const Bench& bench, const DriveState& state) {
  System system;
  system.seen = seen_by(*bench.frame, state);
  system.known = reference_of(system.seen, state);
  for (const EquationRows& one : bench.equations) {
    const BaselineDesign design = baseline_design(system.seen, one.equation, state);
    EquationSystem s;
    orthonormalise(one, design, s);
    const Discrepancy own = nuisances(system.seen, design, one, state);
    s.raw_z = rows_of(own.columns, one.rows);
    const MatrixXd white = whitened(one.noise, one.rows, s.raw_z);
    s.z.resize(white.rows(), white.cols() + one.white.cols());
    s.z << white, one.white;
    s.w.resize(white.rows(), 0);
    s.qw.resize(s.q.cols(), 0);
    s.qz = s.q.transpose() * s.z;
    const Frame seen = told(*bench.frame, system.seen, one.equation);
    const MatrixXd residual =
        (target_of(seen, one.equation) - baseline_prediction(design, one.equation, state)).matrix();
    s.y = whitened(one.noise, one.rows, rows_of(residual, one.rows)).col(0);
    s.qy = s.q.transpose() * s.y;
    Gram gram;
    const Index a = white.cols();
    gram.zz.resize(s.z.cols(), s.z.cols());
    gram.zz.leftCols(a) = s.z.transpose() * white;
    gram.zz.topRows(a) = gram.zz.leftCols(a).transpose();
    gram.zz.bottomRightCorner(one.inner.rows(), one.inner.cols()) = one.inner;
    gram.zz.noalias() -= s.qz.transpose() * s.qz;
    gram.zw.resize(s.z.cols(), 0);
    gram.zy = s.z.transpose() * s.y - s.qz.transpose() * s.qy;
    gram.yy = s.y.squaredNorm() - s.qy.squaredNorm();
    gram.contrasts = static_cast<double>(one.rows.size() - design.columns.cols());
    gram.log_jacobian = log_jacobian(one.noise, one.rows);
    std::vector<Component> components = own.components;
    for (Component c : one.discrepancy.components) {
      c.first += a;
      components.push_back(std::move(c));
    }
    system.equations.push_back(std::move(s));
    system.grams.push_back(std::move(gram));
    system.components.push_back(std::move(components));
  }
  take_columns(bench, state, system);
  return system;
}

ByEquation columns_of(const Bench& bench, const System& system, const DriveState& state,
                      const Taken& cause) {
  if (steps(*cause.form)) return tangents_of(bench, state, cause);
  if (cause.form->columns == nullptr) return change_by(bench, state, cause);
  ByEquation list;
  for (const EquationRows& one : bench.equations) {
    if (!acts_on(*cause.form, one.equation)) {
      list.emplace_back(one.rows.size(), 0);
      continue;
    }
    Columns columns = cause.form->columns(
        one.equation, told(*bench.frame, system.seen, one.equation), system.known, cause.shape);
    MatrixXd all(bench.frame->rows(), static_cast<Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      all.col(static_cast<Index>(k)) = system.seen.recorded(columns[k]).matrix();
    }
    list.push_back(rows_of(all, one.rows));
  }
  return list;
}

ByEquation change_by(const Bench& bench, const DriveState& state, const Taken& cause) {
  return difference(bench, state, with(state, cause), *cause.form, 1.0);
}

Gram with_columns(const Bench& bench, const System& system, std::size_t equation,
                  const MatrixXd& columns) {
  const EquationSystem& s = system.equations[equation];
  const EquationRows& one = bench.equations[equation];
  Gram gram = system.grams[equation];
  const MatrixXd white = whitened(one.noise, one.rows, columns);
  const MatrixXd qc = s.q.transpose() * white;
  append(gram, s.z.transpose() * white - s.qz.transpose() * qc,
         s.w.transpose() * white - s.qw.transpose() * qc,
         white.transpose() * white - qc.transpose() * qc,
         white.transpose() * s.y - qc.transpose() * s.qy);
  return gram;
}

}  // namespace flexspline::studies::decision
