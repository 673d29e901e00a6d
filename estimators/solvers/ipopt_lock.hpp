#pragma once

#include <mutex>

namespace flexspline::estimators {

/// Held during every solve by Ipopt: MUMPS has global state and crashes when two solves run at
/// once.
inline std::mutex& ipopt_lock() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace flexspline::estimators
