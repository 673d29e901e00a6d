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

void SystemDuals::load(const double* y) {
  std::copy_n(y, states(), states_.begin());
  std::copy(p_.begin(), p_.end(), parameters_.begin());
}

void SystemDuals::differentiate(double t, std::size_t first, Eigen::Map<Eigen::MatrixXd> out,
                                std::size_t width) {
  system_.rate(t, std::span<const Dual>(states_), std::span<const Dual>(parameters_),
               std::span<Dual>(rates_));
  for (std::size_t i = 0; i < states(); ++i) {
    for (std::size_t k = 0; k < width; ++k) {
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(first + k)) =
          rates_[i].slope(static_cast<int>(k));
    }
  }
}

void SystemDuals::jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out) {
  in_chunks(states(), [&](std::size_t first, std::size_t width) {
    load(y);
    for (std::size_t k = 0; k < width; ++k) {
      states_[first + k] = Dual(y[first + k], static_cast<int>(width), static_cast<int>(k));
    }
    differentiate(t, first, out, width);
  });
}

void SystemDuals::parameter_jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out) {
  in_chunks(parameters(), [&](std::size_t first, std::size_t width) {
    load(y);
    for (std::size_t k = 0; k < width; ++k) {
      parameters_[first + k] = Dual(p_[first + k], static_cast<int>(width), static_cast<int>(k));
    }
    differentiate(t, first, out, width);
  });
}

void SystemDuals::sensitivity_rate(double t, const double* z, double* zdot) {
  const std::size_t n = states();
  if (parameters() == 0) return rate(t, z, zdot);
  in_chunks(parameters(), [&](std::size_t first, std::size_t width) {
    load(z);
    for (Dual& state : states_) state = Dual(state.value(), static_cast<int>(width));
    for (std::size_t k = 0; k < width; ++k) {
      parameters_[first + k] = Dual(p_[first + k], static_cast<int>(width), static_cast<int>(k));
      const double* column = z + n * (1 + first + k);
      for (std::size_t i = 0; i < n; ++i) states_[i].slopes()[k] = column[i];
    }
    system_.rate(t, std::span<const Dual>(states_), std::span<const Dual>(parameters_),
                 std::span<Dual>(rates_));
    for (std::size_t i = 0; i < n; ++i) {
      zdot[i] = rates_[i].value();
      for (std::size_t k = 0; k < width; ++k) {
        zdot[n * (1 + first + k) + i] = rates_[i].slope(static_cast<int>(k));
      }
    }
  });
}

}  // namespace flexspline
