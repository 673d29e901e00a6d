// Vectors of doubles by the compiler's extensions. Included by translation units that are compiled
// for one instruction set each, inside a namespace of their own: no function of these may be
// shared.
#pragma once

template <int kLanes>
struct Lane {
  typedef double Number __attribute__((vector_size(kLanes * 8)));
  typedef long long Whole __attribute__((vector_size(kLanes * 8)));
  typedef Number Stored __attribute__((may_alias, aligned(8)));

  static inline Number load(const double* from) { return *reinterpret_cast<const Stored*>(from); }
  static inline void store(double* to, Number x) { *reinterpret_cast<Stored*>(to) = x; }

  static inline Number magnitude(Number x) { return x < 0.0 ? -x : x; }
  static inline Number larger(Number a, Number b) { return a > b ? a : b; }

  static inline bool any(Whole flags) {
    long long each[kLanes];
    __builtin_memcpy(each, &flags, sizeof each);
    long long all = 0;
    for (int k = 0; k < kLanes; ++k) all |= each[k];
    return all != 0;
  }

  /// exp(x) to an ulp or two; beyond +-700 as there. x = n ln 2 + r with |r| <= ln(2)/2.
  static inline Number exponential(Number x) {
    constexpr double kRounding = 0x1.8p52;
    x = x > 700.0 ? Number{} + 700.0 : x;
    x = x < -700.0 ? Number{} - 700.0 : x;
    const Number shifted = x * 1.4426950408889634 + kRounding;
    const Number n = shifted - kRounding;
    const Number r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
    const Number r2 = r * r;
    const Number r4 = r2 * r2;
    const Number low = (1.0 + r) + r2 * (1.0 / 2 + r * (1.0 / 6));
    const Number middle = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
    const Number high = (1.0 / 40320 + r * (1.0 / 362880)) +
                        r2 * (1.0 / 3628800 + r * (1.0 / 39916800)) +
                        r4 * (1.0 / 479001600 + r * (1.0 / 6227020800));
    const Number mantissa = low + r4 * (middle + r4 * high);
    return reinterpret_cast<Number>(reinterpret_cast<Whole>(mantissa) +
                                    (reinterpret_cast<Whole>(shifted) << 52));
  }
};
