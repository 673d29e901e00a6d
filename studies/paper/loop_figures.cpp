#include "paper/loop_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "paper/odd_polynomial.hpp"

namespace flexspline::studies {

PaperLoop measure_paper_loop() {
  constexpr int kSamples = 40000;
  PaperLoop loop;
  for (int i = 0; i < kSamples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSamples;
    const double damping = kDamping.value(kSpeedDeg * std::cos(angle));
    const double torque = kStiffness.value(kAmplitudeDeg * std::sin(angle)) + damping;
    loop.peak_torque = std::max(loop.peak_torque, std::abs(torque));
    loop.peak_damping = std::max(loop.peak_damping, std::abs(damping));
    loop.area += torque * kAmplitudeDeg * std::cos(angle) * 2.0 * std::numbers::pi / kSamples;
  }
  return loop;
}

double closed_form_area() {
  double sum = 0.0;
  double power = kSpeedDeg;
  double ratio = 0.5;  // (2k-1)!!/(2k)!!
  for (std::size_t k = 1; k <= kDamping.coefficients.size(); ++k) {
    sum += kDamping.coefficients[k - 1] * power * ratio;
    power *= kSpeedDeg * kSpeedDeg;
    ratio *= static_cast<double>(2 * k + 1) / static_cast<double>(2 * k + 2);
  }
  return 2.0 * std::numbers::pi * kAmplitudeDeg * sum;
}

}  // namespace flexspline::studies
