#pragma once

namespace flexspline::studies {

/// Figures of Table I's loop on the pure sine of the paper.
struct PaperLoop {
  double peak_torque = 0.0;   ///< Nm
  double peak_damping = 0.0;  ///< Nm, largest g^-1 on the loop
  double area = 0.0;          ///< Nm deg, by the trapezoidal rule, exact on a periodic polynomial
};
PaperLoop measure_paper_loop();

/// Sum over k of b_k v0^(2k-1) A 2 pi (2k-1)!!/(2k)!!, Nm deg.
double closed_form_area();

}  // namespace flexspline::studies
