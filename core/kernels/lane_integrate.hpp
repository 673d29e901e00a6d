// The loop over samples and steps, the same for every formula.
#pragma once

#include "kernels/lane_normal.hpp"
#include "kernels/lane_rate.hpp"

template <int kLanes, class Step>
void integrate_lanes(const LaneLaws& laws, const LaneBlock& block, const LaneResult& result) {
  using Number = typename Lane<kLanes>::Number;
  const Terms terms = terms_of(laws);
  const int coefficients = laws.f + laws.g + laws.h;
  const int directions = coefficients + (laws.free_initial ? 1 : 0);
  const bool tangents = result.normal != nullptr;
  Number tangent[kMostLaneDirections] = {};
  if (laws.free_initial) tangent[coefficients] = Number{} + 1.0;
  double unused[kLanes * 3];
  NormalSums<kLanes> sums(tangents ? result.normal : unused, tangents ? directions : 0);
  Number x = Lane<kLanes>::load(block.initial);
  Number stiffest = {};
  Step step(block.torque, x);
  for (long n = 0; n < block.intervals; ++n) {
    const int parts = n == 0 ? block.first_parts : block.parts;
    const Number width = Lane<kLanes>::load(block.width + n * block.width_stride) / double(parts);
    for (int part = 0; part < parts; ++part) {
      step.take(terms, width, x);
      stiffest = Lane<kLanes>::larger(stiffest, Lane<kLanes>::magnitude(width * step.slope()));
      if (!tangents) continue;
      const Number keep = step.weigh(width);
      step.advance(terms, keep, tangent);
      if (laws.free_initial) tangent[coefficients] *= keep;
    }
    if (result.state != nullptr) Lane<kLanes>::store(result.state + n * kLanes, x);
    if (!tangents) continue;
    const Number measured = Lane<kLanes>::load(block.measured + n * kLanes);
    sums.add(tangent, x - measured, Lane<kLanes>::load(block.weight + n * block.weight_stride));
  }
  if (tangents) sums.finish();
  if (result.stiffness != nullptr) Lane<kLanes>::store(result.stiffness, stiffest);
}
