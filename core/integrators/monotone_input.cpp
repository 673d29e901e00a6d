#include "flexspline/core/monotone_input.hpp"

#include <algorithm>
#include <cmath>

#include <math.h>  // Boost 1.74 calls isnan without a namespace

#include <fmt/format.h>
#include <boost/math/interpolators/pchip.hpp>

namespace flexspline {

struct MonotoneInput::Cubic {
  double first;
  double last;
  boost::math::interpolators::pchip<std::vector<double>> curve;
};

Result<MonotoneInput> MonotoneInput::through(std::span<const double> time,
                                             std::span<const double> value) {
  expects(time.size() == value.size(), "one value an instant");
  if (time.size() < 4) {
    return failure(ErrorCode::bad_data, fmt::format("an input of {} samples", time.size()),
                   "a monotone cubic needs four or more");
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!std::isfinite(value[i]) || !std::isfinite(time[i])) {
      return failure(ErrorCode::bad_data,
                     fmt::format("sample {} of an input, {:.6g} at {:.6g} s, is not finite", i + 1,
                                 value[i], time[i]),
                     "fill the gap or cut the recording");
    }
    if (i > 0 && !(time[i] > time[i - 1])) {
      return failure(ErrorCode::bad_data,
                     fmt::format("sample {} of an input, at {:.9g} s, does not follow {:.9g} s",
                                 i + 1, time[i], time[i - 1]),
                     "sort the samples and drop repeated ones");
    }
  }
  return MonotoneInput(std::make_shared<const Cubic>(Cubic{
      time.front(), time.back(), {{time.begin(), time.end()}, {value.begin(), value.end()}}}));
}

double MonotoneInput::value(double t) const {
  return cubic_->curve(std::clamp(t, cubic_->first, cubic_->last));
}

double MonotoneInput::slope(double t) const {
  return t < cubic_->first || t > cubic_->last ? 0.0 : cubic_->curve.prime(t);
}

}  // namespace flexspline
