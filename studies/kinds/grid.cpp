#include "flexspline/studies/kind.hpp"

namespace flexspline::studies {

KindRow describe_grid() {
  return {.id = "grid",
          .summary = "estimators against inputs, held out by whole recordings",
          .cases = "every input x the estimators named for it x replicates"};
}

}  // namespace flexspline::studies
