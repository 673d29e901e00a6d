#pragma once

namespace flexspline {

/// Integrates phi' = h(phi) g(tau - f(phi)), eq. (3), for several recordings at once, one a lane of
/// the processor's vectors, with exact derivatives of the discrete solution beside the states.
/// Plain structures and pointers only: the kernels are compiled for processors that the rest of the
/// program is not compiled for, and share no inline code with it.

/// f(x) = sum f_k x^(2k+1), g(u) = sum g_k u^(2k+1), h(x) = exp(sum h_k x^(2k+2)).
struct LaneLaws {
  int f = 0;  ///< number of coefficients, from 0 on
  int g = 0;
  int h = 0;
  const double* coefficient = nullptr;  ///< of f, g, h one after the other
  bool free_initial = false;            ///< the initial state is one more direction, the last
};

inline constexpr int kMostLaneDirections = 40;

/// Recordings side by side: values of one instant lie next to each other, one a lane. A recording
/// that ends before the others goes on with weight 0.
struct LaneBlock {
  int lanes = 0;
  long intervals = 0;
  int parts = 1;                     ///< steps of an interval between two samples
  int first_parts = 1;               ///< steps of the first interval
  const double* width = nullptr;     ///< [interval][lane], s
  long width_stride = 0;             ///< from interval to interval; 0: all alike
  const double* torque = nullptr;    ///< [node][lane], nodes in the order of their times
  const double* measured = nullptr;  ///< [interval][lane], at the end of each
  const double* weight = nullptr;    ///< [interval][lane]
  long weight_stride = 0;
  const double* initial = nullptr;  ///< [lane]
};

/// What is computed. d directions: the coefficients, and the initial state if it is free.
struct LaneResult {
  /// [(d+1)(d+2)/2][lane]: lower triangle, row by row, of B'B with B = (J, r), r = weight (state -
  /// measured), J = dr/d(coefficients). Null: states alone.
  double* normal = nullptr;
  double* stiffness = nullptr;  ///< [lane] largest |width of a step * d phi'/d phi|
  double* state = nullptr;      ///< [interval][lane] at the end of each; null: not wanted
};

/// runge_kutta: the classical one of order 4; torque at the start, then middle and end of each
/// step. radau: Radau IIA with three stages, order 5, L-stable; torque at the three stages of each
/// step. What overflows, or a Newton iteration that does not settle, shows as states that are no
/// numbers.
enum class LaneFormula { runge_kutta, radau };

enum class InstructionSet { baseline, avx2, avx512 };

using LaneKernel = void (*)(const LaneLaws&, const LaneBlock&, const LaneResult&);

/// The best that this processor has.
InstructionSet best_instruction_set();
/// Recordings that an instruction set takes side by side: 2, 4, 8.
int most_lanes(InstructionSet set);
/// The kernel for so many lanes, a power of two from 2 to most_lanes(set).
LaneKernel lane_kernel(InstructionSet set, LaneFormula formula, int lanes);

/// Nodes of the torque in a step, as shares of its width.
inline constexpr double kRungeKuttaNodes[] = {0.5, 1.0};
inline constexpr double kRadauNodes[] = {0.15505102572168219, 0.64494897427831781, 1.0};

}  // namespace flexspline
