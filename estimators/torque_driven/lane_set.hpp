#pragma once

#include <memory>
#include <vector>

#include "flexspline/core/lane_kernels.hpp"
#include "torque_driven/series.hpp"

namespace flexspline::estimators {

/// How a recording is integrated.
struct LanePlan {
  LaneFormula formula = LaneFormula::runge_kutta;
  int parts = 1;  ///< steps between two samples

  bool operator==(const LanePlan&) const = default;
};

/// What one recording adds to the fit: B'B as a kernel leaves it, and how stiff it was.
struct LaneSums {
  std::vector<double> normal;     ///< summed over all recordings
  std::vector<double> squares;    ///< [recording] sum of squared weighted residuals
  std::vector<double> stiffness;  ///< [recording] of a step
};

/// The recordings packed side by side by their plans, ready for the kernels. Packing allocates;
/// evaluating does not.
class LaneSet {
 public:
  LaneSet(const DrivenProblem& problem, const std::vector<LanePlan>& plans, InstructionSet set,
          std::size_t threads);

  /// B'B at coefficients p, lower triangle row by row.
  const LaneSums& sums(std::span<const double> p);
  /// Motion of every recording at its samples after the first; what the sums at the same p came by.
  std::vector<std::vector<double>> states(std::span<const double> p);
  /// [recording] the largest difference of those states from ones with half the steps, weighted; 0
  /// where either is no number.
  std::vector<double> change_by_half_steps(std::span<const double> p);

 private:
  struct Alignment {
    void operator()(double* memory) const;
  };
  using Memory = std::unique_ptr<double[], Alignment>;

  struct Packed {
    std::vector<std::size_t> series;  // of the lanes in use
    LanePlan plan;
    LaneKernel kernel = nullptr;
    LaneBlock block{};
    Memory memory{};
    double* normal = nullptr;
    double* stiffness = nullptr;
    double* state = nullptr;
  };

  void arrange(const std::vector<LanePlan>& plans, InstructionSet set);
  void measure(Packed& packed) const;
  void pack(Packed& packed) const;
  const DrivenSeries& series_in(const Packed& packed, std::size_t lane) const;
  void fill_torque(const Packed& packed, const LaneBlock& block, std::size_t from,
                   double* torque) const;
  void fill_lane(const Packed& packed, std::size_t lane, double* width, double* measured,
                 double* weight) const;
  LaneLaws laws(std::span<const double> p) const;
  void integrate(const Packed& packed, std::span<const double> p) const;
  void compare_by_half_steps(const Packed& packed, std::span<const double> p,
                             std::vector<double>& change) const;
  double largest_difference(const Packed& packed, std::size_t lane, std::size_t from,
                            std::span<const double> others) const;

  const DrivenProblem& problem_;
  std::size_t threads_;
  std::vector<Packed> blocks_;
  std::vector<double> states_at_;  // coefficients that the blocks' states belong to
  LaneSums sums_;
};

}  // namespace flexspline::estimators
