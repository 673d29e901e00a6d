// Jacobian and Hessian of the collocation problem. Per node the Jacobian's rows hold the other
// stages, the element's start where it is a variable, then the law's states and parameters; the
// Hessian holds the parameters' block once, free initial values that are measured, and per node the
// states' triangle with the states-by-parameters block.
#include <algorithm>
#include <cmath>

#include "ode_fit/collocation_nlp.hpp"

namespace flexspline::estimators {
namespace {

Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }

void add_triangle(const Eigen::MatrixXd& m, std::size_t size, std::span<double> values) {
  std::size_t at = 0;
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b <= a; ++b) values[at++] += m(index(a), index(b));
  }
}

std::size_t triangle(std::size_t size) { return size * (size + 1) / 2; }

std::vector<std::size_t> free_states(const LaidOutExperiment& experiment) {
  std::vector<std::size_t> free;
  if (!experiment.measured_at_start()) return free;
  for (std::size_t i = 0; i < experiment.initial.size(); ++i) {
    if (!experiment.initial[i].known()) free.push_back(i);
  }
  return free;
}

}  // namespace

SparsePattern CollocationNlp::jacobian_pattern() const {
  SparsePattern pattern;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    for (std::size_t i = 0; i < states_; ++i) {
      const std::size_t row = n * states_ + i;
      for (std::size_t k = 0; k < kStages; ++k) {
        if (k != nodes_[n].stage) pattern.add(row, first_variable(n - nodes_[n].stage + k) + i);
      }
      const Source start = element_start(n, i);
      if (!start.known()) pattern.add(row, start.unknown);
      for (std::size_t l = 0; l < states_; ++l) pattern.add(row, first_variable(n) + l);
      for (std::size_t k = 0; k < parameters_; ++k) pattern.add(row, k);
    }
  }
  process_pattern(pattern);
  for (std::size_t i = 0; i < inequalities(); ++i) {
    for (std::size_t k = 0; k < parameters_; ++k) {
      pattern.add(laws() + processes_.size() + i, k);
    }
  }
  return pattern;
}

// Adds -width dF/d(states, parameters), kMostDirections at a time.
void CollocationNlp::add_rate_jacobian(std::span<const double> x, std::size_t node,
                                       Eigen::MatrixXd& derivative) const {
  const auto z = arguments(x, node);
  constexpr std::size_t kWidth = kMostDirections;
  std::vector<Dual> rate(states_);
  for (std::size_t first = 0; first < z.size(); first += kWidth) {
    const std::size_t width = std::min(kWidth, z.size() - first);
    std::vector<Dual> dual(z.begin(), z.end());
    for (std::size_t k = 0; k < width; ++k) {
      dual[first + k] = Dual(z[first + k], static_cast<int>(width), static_cast<int>(k));
    }
    system_.rate(nodes_[node].time, std::span<const Dual>(dual).first(states_),
                 std::span<const Dual>(dual).subspan(states_), std::span(rate));
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t k = 0; k < width; ++k) {
        derivative(index(i), index(first + k)) -=
            nodes_[node].width * rate[i].slope(static_cast<int>(k));
      }
    }
  }
}

bool CollocationNlp::jacobian(std::span<const double> x, std::span<double> values) const {
  std::size_t at = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const std::size_t stage = nodes_[n].stage;
    const auto& weight = radau().derivative[stage];
    Eigen::MatrixXd law = Eigen::MatrixXd::Zero(index(states_), index(states_ + parameters_));
    law.diagonal().head(index(states_)).setConstant(weight[stage]);
    add_rate_jacobian(x, n, law);
    for (std::size_t i = 0; i < states_; ++i) {
      const double size = layout_.state_scale[i];
      for (std::size_t k = 0; k < kStages; ++k) {
        if (k != stage) values[at++] = weight[k];
      }
      const Source start = element_start(n, i);
      if (!start.known()) values[at++] = radau().of_start[stage] * scale(start.unknown) / size;
      for (std::size_t l = 0; l < states_; ++l) {
        values[at++] = law(index(i), index(l)) * layout_.state_scale[l] / size;
      }
      for (std::size_t k = 0; k < parameters_; ++k) {
        values[at++] = law(index(i), index(states_ + k)) * scale(k) / size;
      }
    }
  }
  process_slopes(values.subspan(at));
  inequality_slopes(x, values.last(inequalities() * parameters_));
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

SparsePattern CollocationNlp::hessian_pattern() const {
  SparsePattern pattern;
  for (std::size_t a = 0; a < parameters_; ++a) {
    for (std::size_t b = 0; b <= a; ++b) pattern.add(a, b);
  }
  for (const auto& each : layout_.experiments) {
    const auto free = free_states(each);
    for (std::size_t a = 0; a < free.size(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        pattern.add(each.initial[free[a]].unknown, each.initial[free[b]].unknown);
      }
    }
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const std::size_t first = first_variable(n);
    for (std::size_t a = 0; a < states_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) pattern.add(first + a, first + b);
    }
    for (std::size_t a = 0; a < states_; ++a) {
      for (std::size_t k = 0; k < parameters_; ++k) pattern.add(first + a, k);
    }
  }
  process_curvature_pattern(pattern);
  return pattern;
}

// Lower triangle over (states, parameters), scaled, of lambda' c's part at the node.
void CollocationNlp::add_law_curvature(std::span<const double> x, std::size_t node,
                                       std::span<const double> lambda,
                                       Eigen::MatrixXd& curvature) const {
  const auto z = arguments(x, node);
  const auto scale_of = [&](std::size_t a) {
    return a < states_ ? layout_.state_scale[a] : scale(a - states_);
  };
  std::vector<HyperDual> dual(z.begin(), z.end());
  std::vector<HyperDual> rate(states_);
  for (std::size_t a = 0; a < z.size(); ++a) {
    dual[a].first = scale_of(a);
    for (std::size_t b = 0; b <= a; ++b) {
      dual[b].second = scale_of(b);
      system_.rate(nodes_[node].time, std::span<const HyperDual>(dual).first(states_),
                   std::span<const HyperDual>(dual).subspan(states_), std::span(rate));
      dual[b].second = 0.0;
      for (std::size_t i = 0; i < states_; ++i) {
        curvature(index(a), index(b)) -= nodes_[node].width * lambda[node * states_ + i] /
                                         layout_.state_scale[i] * rate[i].mixed;
      }
    }
    dual[a].first = 0.0;
  }
}

// Of the residuals at one instant by the states read there, scaled.
Eigen::MatrixXd CollocationNlp::reading_curvature(std::span<const double> x, const Reading& reading,
                                                  double factor) const {
  const auto& source = experiment(reading.experiment);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(index(states_), index(states_));
  for (std::size_t t = reading.first_term; t < reading.last_term; ++t) {
    const Term& term = terms_[t];
    Eigen::VectorXd slope(index(states_));
    for (std::size_t i = 0; i < states_; ++i) {
      const Source at = reading_source(reading, i);
      slope[index(i)] =
          at.known() ? 0.0 : term.weight * source.slope(term.output, i) * scale(at.unknown);
    }
    m += factor * layout_.loss.curvature(residual(x, term)) * slope * slope.transpose();
  }
  return m;
}

bool CollocationNlp::hessian(std::span<const double> x, double factor,
                             std::span<const double> lambda, std::span<double> values) const {
  std::ranges::fill(values, 0.0);
  std::vector<std::size_t> initial_block;
  std::size_t at = triangle(parameters_);
  for (const auto& each : layout_.experiments) {
    initial_block.push_back(at);
    at += triangle(free_states(each).size());
  }
  const std::size_t per_node = triangle(states_) + states_ * parameters_;
  for (const auto& reading : readings_) {
    const Eigen::MatrixXd m = reading_curvature(x, reading, factor);
    if (reading.node != Reading::kStart) {
      add_triangle(m, states_, values.subspan(at + reading.node * per_node));
      continue;
    }
    std::vector<Eigen::Index> free;
    for (const std::size_t i : free_states(experiment(reading.experiment))) {
      free.push_back(index(i));
    }
    add_triangle(m(free, free), free.size(), values.subspan(initial_block[reading.experiment]));
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const std::size_t size = states_ + parameters_;
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(index(size), index(size));
    add_law_curvature(x, n, lambda, m);
    const auto block = values.subspan(at + n * per_node, per_node);
    add_triangle(m, states_, block);
    for (std::size_t a = 0; a < states_; ++a) {
      for (std::size_t k = 0; k < parameters_; ++k) {
        block[triangle(states_) + a * parameters_ + k] = m(index(states_ + k), index(a));
      }
    }
    add_triangle(m.bottomRightCorner(index(parameters_), index(parameters_)), parameters_, values);
  }
  if (inequalities() > 0) add_inequality_curvature(x, lambda, values);
  process_curvature(x, factor, values.subspan(at + nodes_.size() * per_node));
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace flexspline::estimators
