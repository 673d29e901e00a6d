#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <utility>

#include "flexspline/core/error.hpp"

namespace flexspline::python {

/// Raises flexspline.Error with the code, the problem and the remedy of an error.
[[noreturn]] void raise(const Error& error);

/// The value of a result, or flexspline.Error.
template <class T>
T value_of(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

/// Runs work on a thread of its own while Python looks for signals, so that Ctrl-C is answered
/// within a tenth of a second. Work that is left behind then ends by itself; what it needs it has
/// to own. The interpreter's lock is not held meanwhile.
void interruptible(std::function<void()> work);

void bind_recordings(pybind11::module_& module);
void bind_models(pybind11::module_& module);
void bind_fits(pybind11::module_& module);

}  // namespace flexspline::python
