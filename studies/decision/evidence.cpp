#include "decision/evidence.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGone = 1e-7;    // a variance ratio below it is none
constexpr double kRidge = 1e-10;  // of a column's own square, for columns that repeat each other
constexpr int kScalePasses = 4;   // of the equations' noise against each other

MatrixXd scaled_inverse_times(const Reduced& r, const MatrixXd& zw) {
  MatrixXd t(static_cast<Index>(r.z.size()), zw.cols());
  for (std::size_t i = 0; i < r.z.size(); ++i) {
    t.row(static_cast<Index>(i)) = r.root[static_cast<Index>(i)] * zw.row(r.z[i]);
  }
  r.lower.triangularView<Eigen::Lower>().solveInPlace(t);
  return t;
}

MatrixXd with_target(const MatrixXd& w, const VectorXd& y) {
  MatrixXd both(w.rows(), w.cols() + 1);
  both << w, y;
  return both;
}

// Normal equations over the bound columns left out, those that want to be negative first.
VectorXd bounded(const MatrixXd& a, const VectorXd& b, const std::vector<bool>& nonnegative,
                 std::vector<bool>& bound) {
  const Index k = a.rows();
  VectorXd c = VectorXd::Zero(k);
  for (int pass = 0; pass < 3 * static_cast<int>(k) + 3; ++pass) {
    std::vector<Index> in;
    for (Index i = 0; i < k; ++i) {
      if (!bound[static_cast<std::size_t>(i)]) in.push_back(i);
    }
    c.setZero();
    if (!in.empty()) {
      const MatrixXd part = a(in, in);
      const VectorXd right = b(in);
      const VectorXd solved = part.ldlt().solve(right);
      c(in) = solved;
    }
    Index worst = -1;
    for (Index i : in) {
      if (nonnegative[static_cast<std::size_t>(i)] && c[i] < 0.0 &&
          (worst < 0 || c[i] * std::sqrt(a(i, i)) < c[worst] * std::sqrt(a(worst, worst)))) {
        worst = i;
      }
    }
    if (worst >= 0) {
      bound[static_cast<std::size_t>(worst)] = true;
      continue;
    }
    const VectorXd pull = b - a * c;
    Index back = -1;
    for (Index i = 0; i < k; ++i) {
      const bool wants = bound[static_cast<std::size_t>(i)] && pull[i] > 1e-6 * std::sqrt(a(i, i));
      if (wants && (back < 0 || pull[i] > pull[back])) back = i;
    }
    if (back < 0 || pass > 2 * k) break;
    bound[static_cast<std::size_t>(back)] = false;
  }
  return c;
}

}  // namespace

void append(Gram& gram, const MatrixXd& z_new, const MatrixXd& w_new, const MatrixXd& new_new,
            const VectorXd& new_y) {
  const Index old = gram.ww.cols();
  const Index k = new_new.cols();
  gram.zw.conservativeResize(gram.zz.rows(), old + k);
  gram.zw.rightCols(k) = z_new;
  gram.ww.conservativeResize(old + k, old + k);
  gram.ww.topRightCorner(old, k) = w_new;
  gram.ww.bottomLeftCorner(k, old) = w_new.transpose();
  gram.ww.bottomRightCorner(k, k) = new_new;
  gram.wy.conservativeResize(old + k);
  gram.wy.tail(k) = new_y;
}

Reduced reduce(const Gram& gram, std::span<const Component> components, const VectorXd& ratio) {
  Reduced r;
  std::vector<double> root;
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (ratio[static_cast<Index>(k)] <= kGone) continue;
    for (Index i = 0; i < components[k].size; ++i) {
      r.z.push_back(components[k].first + i);
      root.push_back(std::sqrt(ratio[static_cast<Index>(k)]));
    }
  }
  r.root = Eigen::Map<VectorXd>(root.data(), static_cast<Index>(root.size()));
  MatrixXd m = gram.zz(r.z, r.z);
  m = r.root.asDiagonal() * m * r.root.asDiagonal();
  m.diagonal().array() += 1.0;
  r.lower = m.llt().matrixL();
  r.log_det = r.lower.diagonal().array().log().sum();
  r.t = scaled_inverse_times(r, with_target(gram.zw, gram.zy));
  const Index k = gram.ww.cols();
  r.s.resize(k + 1, k + 1);
  r.s << gram.ww, gram.wy, gram.wy.transpose(), gram.yy;
  r.s.noalias() -= r.t.transpose() * r.t;
  return r;
}

void extend(Reduced& r, const Gram& gram) {
  const Index old = r.s.cols() - 1;
  const Index k = gram.ww.cols() - old;
  const MatrixXd t_new = scaled_inverse_times(r, gram.zw.rightCols(k));
  const VectorXd t_y = r.t.col(old);
  const VectorXd s_y = r.s.col(old);
  MatrixXd t(r.t.rows(), old + k + 1);
  t << r.t.leftCols(old), t_new, t_y;
  MatrixXd s(old + k + 1, old + k + 1);
  s.topLeftCorner(old, old) = r.s.topLeftCorner(old, old);
  s.block(0, old, old, k) = gram.ww.topRightCorner(old, k) - t.leftCols(old).transpose() * t_new;
  s.block(old, 0, k, old) = s.block(0, old, old, k).transpose();
  s.block(old, old, k, k) = gram.ww.bottomRightCorner(k, k) - t_new.transpose() * t_new;
  s.block(0, old + k, old, 1) = s_y.head(old);
  s.block(old, old + k, k, 1) = gram.wy.tail(k) - t_new.transpose() * t_y;
  s.row(old + k).head(old + k) = s.col(old + k).head(old + k).transpose();
  s(old + k, old + k) = s_y[old];
  r.t = std::move(t);
  r.s = std::move(s);
}

Solution solve(std::span<const Gram> grams, std::span<const Reduced> reduced,
               const FixedEffects& columns) {
  const auto k = static_cast<Index>(columns.free.size());
  const auto equations = static_cast<Index>(grams.size());
  Solution out;
  out.noise = VectorXd::Ones(equations);
  out.c = VectorXd::Zero(k);
  std::vector<MatrixXd> a;
  std::vector<VectorXd> b;
  std::vector<double> yy;
  for (std::size_t e = 0; e < grams.size(); ++e) {
    const MatrixXd& s = reduced[e].s;
    const Index y = s.cols() - 1;
    a.push_back(s(columns.free, columns.free));
    VectorXd target = s.col(y);
    double square = s(y, y);
    if (columns.whole >= 0) {
      target -= s.col(columns.whole);
      square += s(columns.whole, columns.whole) - 2.0 * s(columns.whole, y);
    }
    b.push_back(target(columns.free));
    yy.push_back(square);
  }
  std::vector<bool> bound(static_cast<std::size_t>(k), false);
  MatrixXd normal = MatrixXd::Zero(k, k);
  for (int pass = 0; pass < (k > 0 && equations > 1 ? kScalePasses : 1); ++pass) {
    normal.setZero();
    VectorXd right = VectorXd::Zero(k);
    if (pass == 0) {
      for (std::size_t e = 0; e < grams.size(); ++e) {
        out.noise[static_cast<Index>(e)] = yy[e] / grams[e].contrasts;
      }
    }
    for (std::size_t e = 0; e < grams.size(); ++e) {
      normal += a[e] / out.noise[static_cast<Index>(e)];
      right += b[e] / out.noise[static_cast<Index>(e)];
    }
    normal.diagonal().array() += kRidge * normal.diagonal().array() + 1e-300;
    bound.assign(bound.size(), false);
    if (k > 0) out.c = bounded(normal, right, columns.nonnegative, bound);
    for (std::size_t e = 0; e < grams.size(); ++e) {
      const double rss = yy[e] - 2.0 * out.c.dot(b[e]) + out.c.dot(a[e] * out.c);
      out.noise[static_cast<Index>(e)] = std::max(rss, 1e-12 * yy[e]) / grams[e].contrasts;
    }
  }
  out.log_likelihood = 0.0;
  for (std::size_t e = 0; e < grams.size(); ++e) {
    const double n = grams[e].contrasts;
    out.log_likelihood += grams[e].log_jacobian - reduced[e].log_det -
                          0.5 * n * (std::log(out.noise[static_cast<Index>(e)]) + 1.0);
  }
  std::vector<Index> in;
  for (Index i = 0; i < k; ++i) {
    if (!bound[static_cast<std::size_t>(i)]) in.push_back(i);
  }
  out.active = static_cast<int>(in.size());
  out.covariance = MatrixXd::Zero(k, k);
  if (!in.empty()) {
    const auto m = static_cast<Index>(in.size());
    const MatrixXd part = normal(in, in);
    const MatrixXd inverse = part.ldlt().solve(MatrixXd::Identity(m, m));
    out.covariance(in, in) = inverse;
  }
  return out;
}

VarianceFit fit_variances(std::span<const Gram> grams,
                          std::span<const std::vector<Component>> components,
                          const FixedEffects& columns, std::vector<VectorXd> ratio,
                          int iterations) {
  VarianceFit fit;
  for (int pass = 0;; ++pass) {
    std::vector<Reduced> reduced;
    for (std::size_t e = 0; e < grams.size(); ++e) {
      reduced.push_back(reduce(grams[e], components[e], ratio[e]));
    }
    fit.solution = solve(grams, reduced, columns);
    fit.u.clear();
    for (std::size_t e = 0; e < grams.size(); ++e) {
      const Reduced& r = reduced[e];
      VectorXd t = r.t.col(r.t.cols() - 1);
      for (std::size_t i = 0; i < columns.free.size(); ++i) {
        t -= fit.solution.c[static_cast<Index>(i)] * r.t.col(columns.free[i]);
      }
      if (columns.whole >= 0) t -= r.t.col(columns.whole);
      r.lower.triangularView<Eigen::Lower>().transpose().solveInPlace(t);
      const VectorXd u = r.root.cwiseProduct(t);
      fit.u.push_back(VectorXd::Zero(grams[e].zz.rows()));
      fit.u.back()(r.z) = u;
    }
    if (pass == iterations) break;
    for (std::size_t e = 0; e < grams.size(); ++e) {
      const Reduced& r = reduced[e];
      const auto q = static_cast<Index>(r.z.size());
      const MatrixXd inverse =
          r.lower.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(q, q));
      const VectorXd spread = inverse.colwise().squaredNorm();
      Index at = 0;
      for (std::size_t k = 0; k < components[e].size(); ++k) {
        double& d = ratio[e][static_cast<Index>(k)];
        if (d <= kGone) continue;
        const Component& one = components[e][k];
        const double freedom = static_cast<double>(one.size) - spread.segment(at, one.size).sum();
        d = fit.u[e].segment(one.first, one.size).squaredNorm() /
            (fit.solution.noise[static_cast<Index>(e)] * std::max(freedom, 1e-9));
        d = std::min(d, one.most);
        at += one.size;
      }
    }
  }
  fit.ratio = std::move(ratio);
  return fit;
}

}  // namespace flexspline::studies::decision
