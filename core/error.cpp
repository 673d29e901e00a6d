#include "flexspline/core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace flexspline {

std::string Error::message() const {
  std::string text;
  for (auto place = context.rbegin(); place != context.rend(); ++place)
    text.append(*place).append(": ");
  text += problem;
  if (!remedy.empty()) text.append("; ").append(remedy);
  return text;
}

tl::unexpected<Error> failure(ErrorCode code, std::string problem, std::string remedy) {
  return tl::unexpected<Error>(Error{code, std::move(problem), std::move(remedy), {}});
}

Error in_context(Error error, std::string place) {
  error.context.push_back(std::move(place));
  return error;
}

void expects(bool condition, std::string_view promise) {
  if (condition) return;
  std::fprintf(stderr, "flexspline: defect: this does not hold: %.*s\n",
               static_cast<int>(promise.size()), promise.data());
  std::abort();
}

}  // namespace flexspline
