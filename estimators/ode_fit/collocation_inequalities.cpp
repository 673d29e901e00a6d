// What inequalities of the parameters add to the derivatives of the collocation problem.
#include "ode_fit/collocation_nlp.hpp"
#include "ode_fit/inequalities.hpp"

namespace flexspline::estimators {

void CollocationNlp::inequality_slopes(std::span<const double> x, std::span<double> values) const {
  if (inequalities() == 0) return;
  const Eigen::MatrixXd slopes = inequality_gradients(*layout_.inequalities, parameters(x));
  std::size_t to = 0;
  for (const auto& row : slopes.rowwise()) {
    for (std::size_t k = 0; k < parameters_; ++k) {
      values[to++] = row[static_cast<Eigen::Index>(k)] * scale(k);
    }
  }
}

void CollocationNlp::add_inequality_curvature(std::span<const double> x,
                                              std::span<const double> lambda,
                                              std::span<double> values) const {
  const auto p = parameters(x);
  std::vector<HyperDual> dual(p.begin(), p.end());
  std::vector<HyperDual> g(inequalities());
  for (std::size_t a = 0, at = 0; a < parameters_; ++a) {
    dual[a].first = scale(a);
    for (std::size_t b = 0; b <= a; ++b, ++at) {
      dual[b].second = scale(b);
      layout_.inequalities->values(std::span<const HyperDual>(dual), std::span(g));
      dual[b].second = 0.0;
      for (std::size_t i = 0; i < g.size(); ++i)
        values[at] += lambda[laws() + processes_.size() + i] * g[i].mixed;
    }
    dual[a].first = 0.0;
  }
}

}  // namespace flexspline::estimators
