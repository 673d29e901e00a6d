#define FLEXSPLINE_LANES lanes_avx2
#define FLEXSPLINE_MOST_LANES 4
#include "kernels/lane_source.hpp"
