#include "ode_fit/inequalities.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

constexpr double kActive = 1e-6;  // distance from a bound, over 1 + |bound|, that counts as on it

bool is_active(double g, double bound) {
  return std::isfinite(bound) && std::abs(g - bound) < kActive * (1.0 + std::abs(bound));
}

}  // namespace

Eigen::MatrixXd inequality_gradients(const OdeInequalities& inequalities,
                                     std::span<const double> p) {
  std::vector<HyperDual> dual(p.begin(), p.end());
  std::vector<HyperDual> g(inequalities.count());
  Eigen::MatrixXd gradient(static_cast<Eigen::Index>(g.size()),
                           static_cast<Eigen::Index>(p.size()));
  for (std::size_t k = 0; k < p.size(); ++k) {
    dual[k].first = 1.0;
    inequalities.values(std::span<const HyperDual>(dual), std::span(g));
    dual[k].first = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      gradient(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = g[i].first;
    }
  }
  return gradient;
}

void note_active_inequalities(const OdeLayout& layout, OdeSolution& solution) {
  if (layout.inequalities == nullptr) return;
  const auto& all = *layout.inequalities;
  const auto p = std::span<const double>(solution.q).first(layout.system->parameters());
  std::vector<double> g(all.count());
  all.values(p, g);
  std::vector<Eigen::Index> active;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!is_active(g[i], all.lower(i)) && !is_active(g[i], all.upper(i))) continue;
    active.push_back(static_cast<Eigen::Index>(i));
    solution.active_inequalities.push_back(all.name(i));
  }
  const Eigen::MatrixXd gradient = inequality_gradients(all, p);
  solution.active_gradients = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(active.size()),
                                                    static_cast<Eigen::Index>(solution.q.size()));
  solution.active_gradients.leftCols(gradient.cols()) = gradient(active, Eigen::all);
}

}  // namespace flexspline::estimators
