#pragma once

#include <cmath>
#include <span>

#include "flexspline/core/scalar.hpp"

namespace flexspline {

/// sum_k a_k sin(m_k angle + p_k) for parameters (a, m, p) an element: amplitude, order, phase.
template <class S>
S harmonics(const S& angle, std::span<const S> p) {
  using std::sin;
  S sum(0.0);
  for (std::size_t k = 0; k + 2 < p.size(); k += 3) {
    sum += p[k] * sin(p[k + 1] * angle + p[k + 2]);
  }
  return sum;
}

}  // namespace flexspline
