#pragma once

#include <optional>

#include "sanity/relations.hpp"

namespace flexspline::data {

enum class LagKind { delay, low_pass, drift };

/// How a relation's response comes after its columns.
struct Lag {
  LagKind kind = LagKind::delay;
  double amount = 0.0;  ///< s of a delay or time constant; share of the time of a drift
  double phase = 0.0;   ///< of the fastest motion by it, rad
  double left = 1.0;    ///< sum of squares that it leaves, over that without it
};

/// The lag of one kind that explains most, up to 4 rad of the fastest motion. Absent where the
/// relation does not hold with it either, or no lag in that range explains most.
std::optional<Lag> best_lag(const Relation& relation, LagKind kind);

}  // namespace flexspline::data
