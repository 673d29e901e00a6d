#include "bench/smooth_base.hpp"

namespace flexspline::data {

TruthRow describe_unity() {
  return {"unity", "h = 1; everything the paper assumes holds",
          "smooth stand-in for Table I, strictly monotone everywhere", smooth_base};
}

}  // namespace flexspline::data
