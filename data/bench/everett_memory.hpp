#pragma once

#include <vector>

namespace flexspline::data {

/// E(up, down), the change of torque on a branch from down up to up after a turn, as a Preisach
/// model needs it: E = a u (1 + 0.15 m^2/(m^2 + s^2)) / (u/2 + w), u = up - down, m their mean.
/// Its loops grow with the distance from the centre, which no sum of slip elements can do.
struct EverettShape {
  double height = 0.0;  ///< a, Nm: half height of a wide loop
  double width = 0.0;   ///< w, rad
  double reach = 1.0;   ///< s, rad

  double between(double up, double down) const;
};

/// Rate-independent memory with return points: the dominant turns since the demagnetised start.
class EverettMemory {
 public:
  explicit EverettMemory(const EverettShape& shape) : shape_(shape) {}

  /// The memory after a monotone move to the torsion.
  EverettMemory moved(double torsion) const;
  double torque() const { return torque_; }

 private:
  struct Turn {
    double torsion;
    double torque;
  };

  void wipe_out(bool rising);

  EverettShape shape_;
  std::vector<Turn> turns_;  ///< the first is on the virgin curve; then valleys and crests in turn
  double torsion_ = 0.0;
  double torque_ = 0.0;
  int heading_ = 0;  ///< +1 rising, -1 falling, 0 not moved yet
};

}  // namespace flexspline::data
