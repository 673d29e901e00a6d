#include "flexspline/core/effect_dependence.hpp"

#include <algorithm>
#include <vector>

namespace flexspline {
namespace {

Instant<Complex> nowhere_zero() {
  Instant<Complex> x;
  double next = 0.37;
  for (auto member :
       {&Instant<Complex>::time, &Instant<Complex>::motor_angle, &Instant<Complex>::motor_speed,
        &Instant<Complex>::motor_acceleration, &Instant<Complex>::load_angle,
        &Instant<Complex>::load_speed, &Instant<Complex>::load_acceleration,
        &Instant<Complex>::torsion_rate, &Instant<Complex>::torsion_acceleration,
        &Instant<Complex>::transmitted_torque, &Instant<Complex>::transmitted_torque_rate,
        &Instant<Complex>::motor_torque, &Instant<Complex>::motor_torque_rate}) {
    x.*member = Complex(next += 0.23);
  }
  x.torsion = 1e-3;
  return x;
}

Instant<Complex> stepped(Complex Instant<Complex>::*variable) {
  Instant<Complex> x = nowhere_zero();
  x.*variable += Complex(0.0, 1e-20);
  return x;
}

std::vector<Complex> some_memory(const EffectRow& row, std::size_t parameters) {
  return std::vector<Complex>(state_count(row, parameters), Complex(1e-4));
}

}  // namespace

bool term_depends_on(const EffectRow& row, std::span<const double> values,
                     Complex Instant<Complex>::*variable) {
  const std::vector<Complex> p(values.begin(), values.end());
  const auto memory = some_memory(row, p.size());
  return row.complex.term(stepped(variable), p, memory).imag() != 0.0;
}

bool depends_on(const EffectRow& row, std::span<const double> values,
                Complex Instant<Complex>::*variable) {
  if (term_depends_on(row, values, variable)) return true;
  if (row.complex.rate == nullptr) return false;
  const Instant<Complex> x = stepped(variable);
  const std::vector<Complex> p(values.begin(), values.end());
  const auto memory = some_memory(row, p.size());
  std::vector<Complex> rates(memory.size());
  row.complex.rate(x, p, memory, rates);
  return std::ranges::any_of(rates, [](const Complex& rate) { return rate.imag() != 0.0; });
}

}  // namespace flexspline
