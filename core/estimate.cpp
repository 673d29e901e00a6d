#include "flexspline/core/estimate.hpp"

#include <array>

namespace flexspline {

std::string_view name_of(Termination termination) {
  constexpr std::array<std::string_view, 5> names = {"not_run", "converged", "iteration_limit",
                                                     "no_progress", "failed"};
  return names.at(static_cast<std::size_t>(termination));
}

}  // namespace flexspline
