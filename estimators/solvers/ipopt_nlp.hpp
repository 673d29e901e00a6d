#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::estimators {

/// Places of a sparse matrix, in the order in which its values are given.
struct SparsePattern {
  std::vector<int> row;
  std::vector<int> column;

  void add(std::size_t r, std::size_t c) {
    row.push_back(static_cast<int>(r));
    column.push_back(static_cast<int>(c));
  }
  std::size_t size() const { return row.size(); }
};

/// min f(x) subject to bounds on x and on c(x) (c = 0 unless said), with exact sparse derivatives.
/// What is evaluated returns false where x cannot be evaluated; the solver then takes a shorter
/// step.
class SparseNlp {
 public:
  virtual ~SparseNlp() = default;

  virtual std::size_t variables() const = 0;
  virtual std::size_t constraints() const = 0;
  virtual void bounds(std::span<double> lower, std::span<double> upper) const = 0;
  virtual void constraint_bounds(std::span<double> lower, std::span<double> upper) const;
  virtual SparsePattern jacobian_pattern() const = 0;
  /// Lower triangle of the Lagrangian's Hessian; no place twice.
  virtual SparsePattern hessian_pattern() const = 0;

  virtual bool objective(std::span<const double> x, double& f) const = 0;
  virtual bool gradient(std::span<const double> x, std::span<double> g) const = 0;
  virtual bool constraint(std::span<const double> x, std::span<double> c) const = 0;
  virtual bool jacobian(std::span<const double> x, std::span<double> values) const = 0;
  /// Of factor * f + lambda' c.
  virtual bool hessian(std::span<const double> x, double factor, std::span<const double> lambda,
                       std::span<double> values) const = 0;
};

struct NlpSettings {
  double tolerance = 1e-11;
  int max_iterations = 300;
  double objective_scale = 1.0;  ///< the solver minimises objective_scale * f
  double barrier_start = 0.1;    ///< smaller for a start near the solution
};

struct NlpSolution {
  std::vector<double> x;
  double objective = kNotComputed;
  double violation = kNotComputed;  ///< largest distance of c from its bounds
  Termination termination = Termination::not_run;
  std::string status;  ///< the solver's word for it
  int iterations = 0;
  long evaluations = 0;  ///< of the constraints
};

/// Minimises by Ipopt with MUMPS, one solve at a time in the process.
/// Errors: numerics when the start cannot be evaluated or the solver breaks down.
Result<NlpSolution> minimise(const SparseNlp& nlp, std::span<const double> start,
                             const NlpSettings& settings);

}  // namespace flexspline::estimators
