// Radau IIA with three stages: order 5, L-stable. Newton's iteration on the stages of all lanes.
#pragma once

#include "kernels/lane_rate.hpp"

constexpr double kRoot6 = 2.4494897427831781;
constexpr double kRadau[3][3] = {
    {(88 - 7 * kRoot6) / 360, (296 - 169 * kRoot6) / 1800, (-2 + 3 * kRoot6) / 225},
    {(296 + 169 * kRoot6) / 1800, (88 + 7 * kRoot6) / 360, (-2 - 3 * kRoot6) / 225},
    {(16 - kRoot6) / 36, (16 + kRoot6) / 36, 1.0 / 9}};
constexpr int kMostNewtonSteps = 25;
constexpr double kSettled = 1e-7;  // change of a stage whose square no longer matters

/// M = 1 - width A diag(slope), factorised without pivoting: near the diagonal wherever the law
/// dissipates.
template <int kLanes>
struct StageMatrix {
  using Number = typename Lane<kLanes>::Number;
  Number m[3][3];
  Number pivot[3];  // inverse

  StageMatrix(const Rate<kLanes>* stage, Number width) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k)
        m[i][k] = (i == k ? 1.0 : 0.0) - width * kRadau[i][k] * stage[k].slope;
    }
    pivot[0] = 1.0 / m[0][0];
    for (int i = 1; i < 3; ++i) {
      m[i][0] *= pivot[0];
      for (int k = 1; k < 3; ++k) m[i][k] -= m[i][0] * m[0][k];
    }
    pivot[1] = 1.0 / m[1][1];
    m[2][1] *= pivot[1];
    m[2][2] -= m[2][1] * m[1][2];
    pivot[2] = 1.0 / m[2][2];
  }

  void solve(Number* b) const {
    b[1] -= m[1][0] * b[0];
    b[2] = (b[2] - m[2][0] * b[0] - m[2][1] * b[1]) * pivot[2];
    b[1] = (b[1] - m[1][2] * b[2]) * pivot[1];
    b[0] = (b[0] - m[0][1] * b[1] - m[0][2] * b[2]) * pivot[0];
  }

  /// z with M' z = (0, 0, 1).
  void solve_last_row(Number* z) const {
    z[2] = pivot[2];
    z[1] = -m[2][1] * z[2];
    z[0] = -m[1][0] * z[1] - m[2][0] * z[2];
  }
};

template <int kLanes>
class RadauStep {
 public:
  using Number = typename Lane<kLanes>::Number;

  RadauStep(const double* torque, Number x) : torque_(torque) {
    for (auto& stage : x_) stage = x;
    for (auto& d : difference_) d = Number{};
  }

  void take(const Terms& terms, Number width, Number& x) {
    if (last_known_) predict(width / last_);
    Number torque[3];
    for (int i = 0; i < 3; ++i) torque[i] = Lane<kLanes>::load(torque_ + i * kLanes);
    bool settled = false;
    for (int round = 0; round < kMostNewtonSteps && !settled; ++round) {
      for (int i = 0; i < 3; ++i) stage_[i] = rate_of<kLanes>(terms, torque[i], x_[i]);
      settled = newton(width, x);
    }
    if (!settled) x_[2] *= __builtin_nan("");
    keep_polynomial(x);
    x = x_[2];
    last_ = width;
    last_known_ = true;
    torque_ += 3 * kLanes;
  }

  Number slope() const { return stage_[2].slope; }

  /// The last row of the inverse of M gives what the end of the step takes from start and stages.
  Number weigh(Number width) {
    Number z[3];
    StageMatrix<kLanes>(stage_, width).solve_last_row(z);
    for (int k = 0; k < 3; ++k) {
      share_[k] = width * (kRadau[0][k] * z[0] + kRadau[1][k] * z[1] + kRadau[2][k] * z[2]);
    }
    return z[0] + z[1] + z[2];
  }

  void advance(const Terms& terms, Number keep, Number* tangent) const {
    advance_tangents<kLanes, 3>(terms, stage_, share_, keep, tangent);
  }

 private:
  /// One step on the stages; true when it was too small to matter.
  bool newton(Number width, Number x) {
    Number change[3];
    for (int i = 0; i < 3; ++i) {
      change[i] = x - x_[i] +
                  width * (kRadau[i][0] * stage_[0].value + kRadau[i][1] * stage_[1].value +
                           kRadau[i][2] * stage_[2].value);
    }
    StageMatrix<kLanes>(stage_, width).solve(change);
    Number largest = {};
    for (int i = 0; i < 3; ++i) {
      x_[i] += change[i];
      largest = Lane<kLanes>::larger(largest, Lane<kLanes>::magnitude(change[i]));
    }
    return !Lane<kLanes>::any(largest > kSettled);
  }

  /// Divided differences of start and stages at 0 and the nodes.
  void keep_polynomial(Number start) {
    constexpr double c1 = kRadauNodes[0];
    constexpr double c2 = kRadauNodes[1];
    const Number first = (x_[0] - start) * (1.0 / c1);
    const Number second = (x_[1] - x_[0]) * (1.0 / (c2 - c1));
    const Number third = (x_[2] - x_[1]) * (1.0 / (1.0 - c2));
    const Number bend = (second - first) * (1.0 / c2);
    const Number next = (third - second) * (1.0 / (1.0 - c1));
    difference_[0] = start;
    difference_[1] = first;
    difference_[2] = bend;
    difference_[3] = next - bend;
  }

  /// The last step's polynomial, read beyond its end.
  void predict(Number ratio) {
    for (int i = 0; i < 3; ++i) {
      const Number s = 1.0 + kRadauNodes[i] * ratio;
      x_[i] = difference_[0] +
              s * (difference_[1] +
                   (s - kRadauNodes[0]) * (difference_[2] + (s - kRadauNodes[1]) * difference_[3]));
    }
  }

  const double* torque_;
  Number x_[3];
  Number difference_[4];
  Number last_ = {};
  bool last_known_ = false;
  Rate<kLanes> stage_[3];
  Number share_[3];
};
