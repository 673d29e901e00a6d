#include "export/inertia_there.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flexspline::data {
namespace {

std::vector<std::string> lacking(const RigModel& model, bool as_one) {
  std::vector<std::string> keys;
  const bool with_load = as_one || model.rig != Rig::locked;
  if (!(model.drive.motor_inertia > 0.0)) keys.emplace_back("motor_inertia");
  if (with_load && !(model.drive.load_inertia > 0.0)) keys.emplace_back("load_inertia");
  if (as_one && keys.size() < 2) keys.clear();
  return keys;
}

}  // namespace

Result<void> inertia_there(const RigModel& model, std::string_view form, bool as_one) {
  const bool rigid = as_one || model.rig == Rig::servo;
  const auto keys = lacking(model, rigid);
  if (keys.empty()) return {};
  return failure(
      ErrorCode::bad_data,
      fmt::format("the model's [rig] lacks {}: what turns has to have an inertia in {}",
                  fmt::join(keys, " and "), form),
      fmt::format("state {} of the {} rig in [rig] in kg m2, for instance {} = {}, by the data "
                  "sheet; a diagnosis writes it where dataset.toml states {}_kgm2",
                  rigid ? "one of them" : fmt::format("{}", fmt::join(keys, " and ")),
                  name_of(model.rig), keys.back(), keys.back() == "motor_inertia" ? 7e-4 : 2.9,
                  keys.back()));
}

}  // namespace flexspline::data
