#include "bench/everett_memory.hpp"

#include <cmath>

namespace flexspline::data {

double EverettShape::between(double up, double down) const {
  const double u = up - down;
  const double m = 0.5 * (up + down);
  const double growth = 1.0 + 0.15 * m * m / (m * m + reach * reach);
  return height * growth * u / (0.5 * u + width);
}

/// A branch that passes the turn before last closes its loop and both are forgotten.
void EverettMemory::wipe_out(bool rising) {
  while (turns_.size() >= 2) {
    const double mark = turns_[turns_.size() - 2].torsion;
    if (rising ? torsion_ < mark : torsion_ > mark) return;
    turns_.resize(turns_.size() - 2);
  }
  // The virgin curve takes over where the largest turn is mirrored.
  if (turns_.size() == 1 && std::abs(torsion_) >= std::abs(turns_[0].torsion)) turns_.clear();
}

EverettMemory EverettMemory::moved(double torsion) const {
  if (torsion == torsion_) return *this;
  EverettMemory next = *this;
  const int heading = torsion > torsion_ ? 1 : -1;
  if (heading_ != 0 && heading != heading_) next.turns_.push_back({torsion_, torque_});
  next.heading_ = heading;
  next.torsion_ = torsion;
  next.wipe_out(heading > 0);
  if (next.turns_.empty()) {
    const double size = std::abs(torsion);
    next.torque_ = std::copysign(0.5 * shape_.between(size, -size), torsion);
  } else {
    const Turn& last = next.turns_.back();
    next.torque_ = heading > 0 ? last.torque + shape_.between(torsion, last.torsion)
                               : last.torque - shape_.between(last.torsion, torsion);
  }
  return next;
}

}  // namespace flexspline::data
