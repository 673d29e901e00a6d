#include "integrators/system_duals.hpp"

#include <algorithm>

#include "flexspline/core/error.hpp"

namespace flexspline {
namespace {

template <class Take>
void in_chunks(std::size_t directions, Take take) {
  constexpr std::size_t kWidth = kMostDirections;
  for (std::size_t first = 0; first < directions; first += kWidth) {
    take(first, std::min(kWidth, directions - first));
  }
}

void set_zero(Dual& x, double value, std::size_t width) {
  x.value() = value;
  x.derivatives().setZero(static_cast<Eigen::Index>(width));
}

void set_unit(Dual& x, std::size_t direction) {
  x.derivatives()[static_cast<Eigen::Index>(direction)] = 1.0;
}

}  // namespace

SystemDuals::SystemDuals(const OdeSystem& system, std::span<const double> p)
    : system_(system),
      p_(p),
      states_(system.states()),
      parameters_(system.parameters()),
      rates_(system.states()) {
  expects(p.size() == system.parameters(), "one value a parameter");
}

void SystemDuals::rate(double t, const double* y, double* ydot) const {
  system_.rate(t, std::span(y, states()), p_, std::span(ydot, states()));
}

void SystemDuals::load(const double* y, std::size_t width) {
  for (std::size_t i = 0; i < states(); ++i) set_zero(states_[i], y[i], width);
  for (std::size_t k = 0; k < parameters(); ++k) set_zero(parameters_[k], p_[k], width);
}

void SystemDuals::evaluate(double t, std::size_t width) {
  system_.rate(t, std::span<const Dual>(states_), std::span<const Dual>(parameters_),
               std::span<Dual>(rates_));
  for (Dual& rate : rates_) {  // a rate that is constant has no directions
    if (rate.derivatives().size() == 0) set_zero(rate, rate.value(), width);
  }
}

void SystemDuals::jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out) {
  in_chunks(states(), [&](std::size_t first, std::size_t width) {
    load(y, width);
    for (std::size_t k = 0; k < width; ++k) set_unit(states_[first + k], k);
    evaluate(t, width);
    for (std::size_t i = 0; i < states(); ++i) {
      out.block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(first), 1,
                static_cast<Eigen::Index>(width)) = rates_[i].derivatives().transpose();
    }
  });
}

void SystemDuals::parameter_jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out) {
  in_chunks(parameters(), [&](std::size_t first, std::size_t width) {
    load(y, width);
    for (std::size_t k = 0; k < width; ++k) set_unit(parameters_[first + k], k);
    evaluate(t, width);
    for (std::size_t i = 0; i < states(); ++i) {
      out.block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(first), 1,
                static_cast<Eigen::Index>(width)) = rates_[i].derivatives().transpose();
    }
  });
}

void SystemDuals::sensitivity_rate(double t, const double* z, double* zdot) {
  const std::size_t n = states();
  if (parameters() == 0) return rate(t, z, zdot);
  in_chunks(parameters(), [&](std::size_t first, std::size_t width) {
    load(z, width);
    for (std::size_t k = 0; k < width; ++k) {
      set_unit(parameters_[first + k], k);
      const double* column = z + n * (1 + first + k);
      const auto direction = static_cast<Eigen::Index>(k);
      for (std::size_t i = 0; i < n; ++i) states_[i].derivatives()[direction] = column[i];
    }
    evaluate(t, width);
    for (std::size_t i = 0; i < n; ++i) {
      zdot[i] = rates_[i].value();
      for (std::size_t k = 0; k < width; ++k) {
        zdot[n * (1 + first + k) + i] = rates_[i].derivatives()[static_cast<Eigen::Index>(k)];
      }
    }
  });
}

}  // namespace flexspline
