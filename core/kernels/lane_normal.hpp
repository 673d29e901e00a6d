// B'B with B = (J, r) on the fly, four samples at a time so that each sum is fetched once for four.
#pragma once

#include "kernels/lane_numbers.hpp"

template <int kLanes>
class NormalSums {
 public:
  using Number = typename Lane<kLanes>::Number;

  NormalSums(double* sums, int directions) : sums_(sums), size_(directions + 1) {
    for (long k = 0; k < long{size_} * (size_ + 1) / 2 * kLanes; ++k) sums[k] = 0.0;
  }

  void add(const Number* tangent, Number difference, Number weight) {
    Number* row = rows_[filled_];
    for (int k = 0; k + 1 < size_; ++k) row[k] = weight * tangent[k];
    row[size_ - 1] = weight * difference;
    if (++filled_ == kRows) flush();
  }

  void finish() {
    if (filled_ == 0) return;
    for (; filled_ < kRows; ++filled_) {
      for (int k = 0; k < size_; ++k) rows_[filled_][k] = Number{};
    }
    flush();
  }

 private:
  static constexpr int kRows = 4;

  void flush() {
    double* out = sums_;
    for (int i = 0; i < size_; ++i) {
      const Number a = rows_[0][i];
      const Number b = rows_[1][i];
      const Number c = rows_[2][i];
      const Number d = rows_[3][i];
      for (int k = 0; k <= i; ++k, out += kLanes) {
        Lane<kLanes>::store(out, Lane<kLanes>::load(out) + a * rows_[0][k] + b * rows_[1][k] +
                                     (c * rows_[2][k] + d * rows_[3][k]));
      }
    }
    filled_ = 0;
  }

  double* sums_;
  int size_;
  int filled_ = 0;
  Number rows_[kRows][kMostLaneDirections + 1];
};
