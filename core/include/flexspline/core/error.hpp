#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace flexspline {

/// Why something could not be computed. The numbers are the exit codes of the command line.
enum class ErrorCode : int {
  usage = 2,
  bad_data = 65,
  input_missing = 66,
  defect = 70,
  cannot_write = 73,
  interrupted = 75,
  numerics = 1,
};

/// A failure told to a person: what is wrong, by name and value; what to do about it; and where it
/// happened, outermost last.
struct Error {
  ErrorCode code = ErrorCode::defect;
  std::string problem;
  std::string remedy;
  std::vector<std::string> context;

  /// "case a=0.2 deg: recording sine-1: <problem>; <remedy>".
  std::string message() const;
};

/// A value, or the reason why there is none.
template <class T>
using Result = tl::expected<T, Error>;

/// An unexpected value for returning from a function that gives a Result.
tl::unexpected<Error> failure(ErrorCode code, std::string problem, std::string remedy = {});

/// The error with one more place added on its way up.
Error in_context(Error error, std::string place);

/// Defects: stops the program with a message when a condition the caller promised does not hold.
void expects(bool condition, std::string_view promise);

}  // namespace flexspline
