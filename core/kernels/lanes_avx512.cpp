#define FLEXSPLINE_LANES lanes_avx512
#define FLEXSPLINE_MOST_LANES 8
#include "kernels/lane_source.hpp"
