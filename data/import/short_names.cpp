#include "import/short_names.hpp"

#include <algorithm>

namespace flexspline::data {
namespace {

using ShortName = std::pair<Quantity, std::string_view>;
constexpr ShortName kShortNames[] = {
    {Quantity::time, "t"},
    {Quantity::motor_angle, "theta_m"},
    {Quantity::load_angle, "theta_l"},
    {Quantity::transmitted_torque, "tau"},
    {Quantity::motor_torque, "tau_m"},
};

}  // namespace

std::string_view short_name(Quantity quantity) {
  const auto* found = std::ranges::find(kShortNames, quantity, &ShortName::first);
  return found == std::end(kShortNames) ? name_of(quantity) : found->second;
}

std::optional<Quantity> quantity_of_short_name(std::string_view name) {
  const auto* found = std::ranges::find(kShortNames, name, &ShortName::second);
  if (found == std::end(kShortNames)) return std::nullopt;
  return found->first;
}

}  // namespace flexspline::data
