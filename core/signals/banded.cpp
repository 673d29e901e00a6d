#include "signals/banded.hpp"

#include <algorithm>
#include <utility>

namespace flexspline {

using Eigen::Index;

Band band_of(const Eigen::SparseMatrix<double>& symmetric) {
  Band band = Band::Zero(4, symmetric.cols());
  for (Index j = 0; j < symmetric.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(symmetric, j); it; ++it) {
      const Index below = it.row() - j;
      if (below >= 0 && below < band.rows()) band(below, j) = it.value();
    }
  }
  return band;
}

// In the order of a row by row elimination, so that rounding is that of a general sparse solver.
BandFactors::BandFactors(Band a) : l_(std::move(a)) {
  const Index n = l_.cols();
  for (Index j = 0; j < n; ++j) {
    const Eigen::Vector4d column = l_.col(j);
    l_.col(j) /= column[0];
    l_(0, j) = 1.0 / column[0];
    const Index below = std::min<Index>(3, n - 1 - j);
    for (Index k = 1; k <= below; ++k) {
      for (Index i = k; i <= below; ++i) l_(i - k, j + k) -= l_(k, j) * column[i];
    }
  }
}

Rows BandFactors::solve(Rows right) const {
  const Index n = l_.cols();
  for (Index j = 0; j < n; ++j) {
    for (Index k = 1; k <= std::min<Index>(3, n - 1 - j); ++k) {
      right.row(j + k) -= l_(k, j) * right.row(j);
    }
  }
  for (Index j = n; j-- > 0;) {
    right.row(j) *= l_(0, j);
    for (Index k = 1; k <= std::min<Index>(3, n - 1 - j); ++k) {
      right.row(j) -= l_(k, j) * right.row(j + k);
    }
  }
  return right;
}

}  // namespace flexspline
