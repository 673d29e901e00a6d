#include "flexspline/core/recording.hpp"

namespace flexspline {

const std::vector<double>* Recording::find(Quantity quantity) const {
  if (quantity == Quantity::time) return &time;
  const auto found = channels.find(quantity);
  return found == channels.end() ? nullptr : &found->second;
}

}  // namespace flexspline
