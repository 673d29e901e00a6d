#pragma once

#include "flexspline/core/lane_kernels.hpp"

namespace flexspline {

/// Columns of one length in memory, one after the other, and how many.
struct ColumnBlock {
  const double* data = nullptr;
  long count = 0;
};

/// out = A^T B by columns: out[i + j count_a] = sum_r A(r, i) B(r, j), summed over a fixed order of
/// rows. With `lower` only what lies on and below the diagonal is sought, and what is above may be
/// partly filled. Few columns beside many rows are what it is quick for.
using ColumnProducts = void (*)(const ColumnBlock& a, const ColumnBlock& b, long rows, bool lower,
                                double* out);

/// The kernel for an instruction set that this processor has.
ColumnProducts column_products(InstructionSet set);

}  // namespace flexspline
