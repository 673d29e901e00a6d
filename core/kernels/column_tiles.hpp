// Products of columns by tiles of their pairs. Included by translation units that are compiled for
// one instruction set each, inside a namespace of their own.
#pragma once

constexpr long kRowsAtOnce = 512;  // so that the columns stay in the processor's second cache

template <int kLanes>
double sum_of(typename Lane<kLanes>::Number x) {
  double each[kLanes];
  __builtin_memcpy(each, &x, sizeof each);
  double sum = 0.0;
  for (int k = 0; k < kLanes; ++k) sum += each[k];
  return sum;
}

/// Some rows of kHigh columns and kWide others; from column to column it is `stride`.
template <int kLanes, int kHigh, int kWide>
void add_tile(const double* a, const double* b, long stride, long rows, double* out,
              long out_stride) {
  typename Lane<kLanes>::Number sums[kHigh][kWide] = {};
  long r = 0;
  for (; r + kLanes <= rows; r += kLanes) {
    typename Lane<kLanes>::Number y[kWide];
    for (int j = 0; j < kWide; ++j) y[j] = Lane<kLanes>::load(b + j * stride + r);
    for (int i = 0; i < kHigh; ++i) {
      const auto x = Lane<kLanes>::load(a + i * stride + r);
      for (int j = 0; j < kWide; ++j) sums[i][j] += x * y[j];
    }
  }
  for (int i = 0; i < kHigh; ++i) {
    for (int j = 0; j < kWide; ++j) {
      double sum = sum_of<kLanes>(sums[i][j]);
      for (long k = r; k < rows; ++k) sum += a[i * stride + k] * b[j * stride + k];
      out[i + j * out_stride] += sum;
    }
  }
}

template <int kLanes, int kHigh>
void add_strip(const double* a, const double* b, long columns, long stride, long rows, double* out,
               long out_stride) {
  long j = 0;
  for (; j + 2 <= columns; j += 2) {
    add_tile<kLanes, kHigh, 2>(a, b + j * stride, stride, rows, out + j * out_stride, out_stride);
  }
  if (j < columns) {
    add_tile<kLanes, kHigh, 1>(a, b + j * stride, stride, rows, out + j * out_stride, out_stride);
  }
}

template <int kLanes>
void multiply_columns(const ColumnBlock& a, const ColumnBlock& b, long rows, bool lower,
                      double* out) {
  for (long i = 0; i < a.count * b.count; ++i) out[i] = 0.0;
  for (long first = 0; first < rows; first += kRowsAtOnce) {
    const long some = rows - first < kRowsAtOnce ? rows - first : kRowsAtOnce;
    const double* left = a.data + first;
    const double* right = b.data + first;
    const auto wide = [&](long last) { return lower && last < b.count ? last : b.count; };
    long i = 0;
    for (; i + 4 <= a.count; i += 4) {
      add_strip<kLanes, 4>(left + i * rows, right, wide(i + 4), rows, some, out + i, a.count);
    }
    for (; i < a.count; ++i) {
      add_strip<kLanes, 1>(left + i * rows, right, wide(i + 1), rows, some, out + i, a.count);
    }
  }
}
