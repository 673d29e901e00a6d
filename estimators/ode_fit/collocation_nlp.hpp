#pragma once

#include "flexspline/core/twice_ode_system.hpp"
#include "ode_fit/mesh.hpp"
#include "solvers/ipopt_nlp.hpp"

namespace flexspline::estimators {

/// The fit as one sparse problem: half the sum of squared residuals over the unknowns and the
/// states at all nodes, subject to the law at each node. Variables are divided by their scales; the
/// states of node n are variables unknowns + n states, and its rows n states of the constraints;
/// Where noise is coloured its process as the filter foretells it is a variable an instant, with a
/// linear row each, so that innovations stay sparse. Inequalities are the last rows.
class CollocationNlp final : public SparseNlp {
 public:
  CollocationNlp(const OdeLayout& layout, const TwiceOdeSystem& system,
                 const std::vector<Mesh>& meshes);

  std::size_t variables() const override;
  std::size_t constraints() const override { return laws() + processes_.size() + inequalities(); }
  std::size_t elements() const { return nodes_.size() / kStages; }
  void constraint_bounds(std::span<double> lower, std::span<double> upper) const override;
  void bounds(std::span<double> lower, std::span<double> upper) const override;
  SparsePattern jacobian_pattern() const override;
  SparsePattern hessian_pattern() const override;
  bool objective(std::span<const double> x, double& f) const override;
  bool gradient(std::span<const double> x, std::span<double> g) const override;
  bool constraint(std::span<const double> x, std::span<double> c) const override;
  bool jacobian(std::span<const double> x, std::span<double> values) const override;
  bool hessian(std::span<const double> x, double factor, std::span<const double> lambda,
               std::span<double> values) const override;

  std::vector<double> pack(std::span<const double> q, const std::vector<NodeStates>& states) const;
  std::vector<double> unknowns(std::span<const double> x) const;
  std::vector<NodeStates> node_states(std::span<const double> x) const;

 private:
  struct Node {
    std::size_t experiment;
    std::size_t stage;
    bool in_first_element;
    double time;
    double width;
  };
  // A measured instant and its place in the trajectory.
  struct Reading {
    static constexpr std::size_t kStart = static_cast<std::size_t>(-1);
    std::size_t experiment;
    std::size_t instant;
    std::size_t node;
    std::size_t first_term = 0;
    std::size_t last_term = 0;
  };
  // A residual: of an output at a reading, less the process of its noise, times a weight.
  struct Term {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::size_t reading;
    std::size_t output;
    double weight = 1.0;
    double transition = 0.0;      // of the process since the term before
    double update = 0.0;          // share of its innovation that the process takes on
    std::size_t before = kNone;   // term of the same output before it
    std::size_t process = kNone;  // variable
  };

  std::size_t laws() const { return nodes_.size() * states_; }
  std::size_t inequalities() const {
    return layout_.inequalities != nullptr ? layout_.inequalities->count() : 0;
  }
  std::size_t first_process() const { return unknown_count_ + laws(); }
  void add_terms();
  /// Residual over sigma, before the noise's process is taken off.
  double plain_residual(std::span<const double> x, const Term& term) const;
  double residual(std::span<const double> x, const Term& term) const;
  void process_rows(std::span<const double> x, std::span<double> c) const;
  void process_pattern(SparsePattern& pattern) const;
  void process_slopes(std::span<double> values) const;
  void process_curvature_pattern(SparsePattern& pattern) const;
  void process_curvature(std::span<const double> x, double factor, std::span<double> values) const;
  std::vector<double> parameters(std::span<const double> x) const;
  void inequality_slopes(std::span<const double> x, std::span<double> values) const;
  void add_inequality_curvature(std::span<const double> x, std::span<const double> lambda,
                                std::span<double> values) const;
  const LaidOutExperiment& experiment(std::size_t e) const { return layout_.experiments[e]; }
  std::size_t first_variable(std::size_t node) const { return unknown_count_ + node * states_; }
  double scale(std::size_t variable) const;
  double value(std::span<const double> x, std::size_t variable) const {
    return x[variable] * scale(variable);
  }
  /// State i where the element of a node starts: a variable or a known number.
  Source element_start(std::size_t node, std::size_t i) const;
  Source reading_source(const Reading& reading, std::size_t i) const;
  double value(std::span<const double> x, const Source& source) const {
    return source.known() ? source.value : value(x, source.unknown);
  }
  std::vector<double> read(std::span<const double> x, const Reading& reading) const;
  std::vector<double> arguments(std::span<const double> x, std::size_t node) const;
  void add_rate_jacobian(std::span<const double> x, std::size_t node,
                         Eigen::MatrixXd& derivative) const;
  void add_law_curvature(std::span<const double> x, std::size_t node,
                         std::span<const double> lambda, Eigen::MatrixXd& curvature) const;
  Eigen::MatrixXd reading_curvature(std::span<const double> x, const Reading& reading,
                                    double factor) const;

  const OdeLayout& layout_;
  const TwiceOdeSystem& system_;
  std::size_t states_;
  std::size_t parameters_;
  std::size_t unknown_count_;
  std::vector<Node> nodes_;
  std::vector<Reading> readings_;
  std::vector<Term> terms_;
  std::vector<std::size_t> processes_;  // terms that have one
};

}  // namespace flexspline::estimators
