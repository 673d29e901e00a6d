#include "version.hpp"

#include <fmt/format.h>

#include "build_identity.hpp"

namespace flexspline::app {

std::map<std::string, std::string> versions() {
  return {{"flexspline", FLEXSPLINE_VERSION},
          {"commit", kCommit},
          {"build", build_id().substr(0, 12)},
          {"compiler", fmt::format("{} {}", FLEXSPLINE_COMPILER, __VERSION__)},
          {"Ceres", FLEXSPLINE_CERES_VERSION},
          {"Eigen", FLEXSPLINE_EIGEN_VERSION},
          {"Ipopt", FLEXSPLINE_IPOPT_VERSION},
          {"SUNDIALS", FLEXSPLINE_SUNDIALS_VERSION}};
}

std::string version_text() {
  std::string text = fmt::format("flexspline {}\n", FLEXSPLINE_VERSION);
  for (const auto& [name, value] : versions()) {
    if (name != "flexspline") text += fmt::format("  {:<9} {}\n", name, value);
  }
  text.pop_back();
  return text;
}

std::string build_id() { return kBuildId; }

}  // namespace flexspline::app
