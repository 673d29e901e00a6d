#define FLEXSPLINE_LANES lanes_baseline
#define FLEXSPLINE_MOST_LANES 2
#include "kernels/lane_source.hpp"
