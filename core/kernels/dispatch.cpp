#include "flexspline/core/column_products.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/lane_kernels.hpp"

namespace flexspline {

namespace lanes_baseline {
LaneKernel find(LaneFormula formula, int lanes);
ColumnProducts find_products();
}  // namespace lanes_baseline
#ifdef FLEXSPLINE_X86_KERNELS
namespace lanes_avx2 {
LaneKernel find(LaneFormula formula, int lanes);
ColumnProducts find_products();
}  // namespace lanes_avx2
namespace lanes_avx512 {
LaneKernel find(LaneFormula formula, int lanes);
ColumnProducts find_products();
}  // namespace lanes_avx512
#endif

InstructionSet best_instruction_set() {
#ifdef FLEXSPLINE_X86_KERNELS
  static const InstructionSet best = [] {
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
      return InstructionSet::avx512;
    }
    return avx2 ? InstructionSet::avx2 : InstructionSet::baseline;
  }();
  return best;
#else
  return InstructionSet::baseline;
#endif
}

int most_lanes(InstructionSet set) {
  if (set == InstructionSet::avx512) return 8;
  return set == InstructionSet::avx2 ? 4 : 2;
}

LaneKernel lane_kernel(InstructionSet set, LaneFormula formula, int lanes) {
  LaneKernel found = nullptr;
#ifdef FLEXSPLINE_X86_KERNELS
  if (set == InstructionSet::avx512) found = lanes_avx512::find(formula, lanes);
  if (set == InstructionSet::avx2) found = lanes_avx2::find(formula, lanes);
#endif
  if (set == InstructionSet::baseline) found = lanes_baseline::find(formula, lanes);
  expects(found != nullptr,
          "a kernel takes 2, 4 or 8 SIMD lanes, up to what its instructions hold");
  return found;
}

ColumnProducts column_products(InstructionSet set) {
#ifdef FLEXSPLINE_X86_KERNELS
  if (set == InstructionSet::avx512) return lanes_avx512::find_products();
  if (set == InstructionSet::avx2) return lanes_avx2::find_products();
#endif
  expects(set == InstructionSet::baseline, "a kernel of instructions that are not built");
  return lanes_baseline::find_products();
}

}  // namespace flexspline
