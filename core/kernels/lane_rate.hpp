// phi' of the torsion law and what its derivatives are made of, for all lanes.
#pragma once

#include "kernels/lane_numbers.hpp"

/// Coefficients with those of the derivatives: every loop of a kernel reads them.
struct Terms {
  int f;
  int g;
  int h;
  const double* value;                // of f, g, h
  double slope[kMostLaneDirections];  // of f', g' and the derivative of ln h
};

inline Terms terms_of(const LaneLaws& laws) {
  Terms terms{laws.f, laws.g, laws.h, laws.coefficient, {}};
  for (int k = 0; k < laws.f; ++k) terms.slope[k] = (2 * k + 1) * laws.coefficient[k];
  for (int k = laws.f; k < laws.f + laws.g; ++k) {
    terms.slope[k] = (2 * (k - laws.f) + 1) * laws.coefficient[k];
  }
  for (int k = laws.f + laws.g; k < laws.f + laws.g + laws.h; ++k) {
    terms.slope[k] = (2 * (k - laws.f - laws.g) + 2) * laws.coefficient[k];
  }
  return terms;
}

template <int kLanes>
struct Rate {
  using Number = typename Lane<kLanes>::Number;
  Number value;    // F
  Number slope;    // dF/dphi
  Number spring;   // dF/df_k = spring x2^k
  Number damping;  // dF/dg_k = damping u2^k
  Number growth;   // dF/dh_k = growth x2^k
  Number x2;
  Number u2;
};

template <int kLanes>
inline typename Lane<kLanes>::Number horner(const double* c, int n,
                                            typename Lane<kLanes>::Number x2) {
  typename Lane<kLanes>::Number sum = {};
  for (int k = n; k-- > 0;) sum = sum * x2 + c[k];
  return sum;
}

template <int kLanes>
inline Rate<kLanes> rate_of(const Terms& t, typename Lane<kLanes>::Number torque,
                            typename Lane<kLanes>::Number x) {
  using Number = typename Lane<kLanes>::Number;
  Rate<kLanes> r;
  const double* g = t.value + t.f;
  const double* h = g + t.g;
  r.x2 = x * x;
  const Number ln_h = horner<kLanes>(h, t.h, r.x2) * r.x2;
  const Number ln_h_slope = horner<kLanes>(t.slope + t.f + t.g, t.h, r.x2) * x;
  const Number u = torque - horner<kLanes>(t.value, t.f, r.x2) * x;
  const Number f_slope = horner<kLanes>(t.slope, t.f, r.x2);
  const Number modulation = Lane<kLanes>::exponential(ln_h);
  r.u2 = u * u;
  r.damping = modulation * u;
  r.value = r.damping * horner<kLanes>(g, t.g, r.u2);
  const Number stiffness = modulation * horner<kLanes>(t.slope + t.f, t.g, r.u2);
  r.slope = r.value * ln_h_slope - stiffness * f_slope;
  r.spring = -stiffness * x;
  r.growth = r.value * r.x2;
  return r;
}

/// s_j <- keep s_j + sum_i share_i dF_i/dp_j: a step of every tangent, since the stages of all
/// share their coefficients. Counts stages at compile time.
template <int kLanes, int kStages>
inline void advance_tangents(const Terms& t, const Rate<kLanes>* stage,
                             const typename Lane<kLanes>::Number* share,
                             typename Lane<kLanes>::Number keep,
                             typename Lane<kLanes>::Number* tangent) {
  using Number = typename Lane<kLanes>::Number;
  Number power[kStages];
  for (int i = 0; i < kStages; ++i) power[i] = share[i] * stage[i].spring;
  for (int k = 0; k < t.f; ++k) {
    Number sum = keep * tangent[k];
    for (int i = 0; i < kStages; ++i) sum += power[i];
    for (int i = 0; i < kStages; ++i) power[i] *= stage[i].x2;
    tangent[k] = sum;
  }
  for (int i = 0; i < kStages; ++i) power[i] = share[i] * stage[i].damping;
  for (int k = t.f; k < t.f + t.g; ++k) {
    Number sum = keep * tangent[k];
    for (int i = 0; i < kStages; ++i) sum += power[i];
    for (int i = 0; i < kStages; ++i) power[i] *= stage[i].u2;
    tangent[k] = sum;
  }
  for (int i = 0; i < kStages; ++i) power[i] = share[i] * stage[i].growth;
  for (int k = t.f + t.g; k < t.f + t.g + t.h; ++k) {
    Number sum = keep * tangent[k];
    for (int i = 0; i < kStages; ++i) sum += power[i];
    for (int i = 0; i < kStages; ++i) power[i] *= stage[i].x2;
    tangent[k] = sum;
  }
}
