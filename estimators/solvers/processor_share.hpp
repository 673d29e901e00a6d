#pragma once

#include <cstddef>

namespace flexspline::estimators {

/// The processors that a fit may use beside the others that run now: cases in parallel come before
/// recordings in parallel. Counts the fit as running as long as it lives.
class ProcessorShare {
 public:
  /// wanted: 0 for the share, else that many.
  explicit ProcessorShare(std::size_t wanted);
  ~ProcessorShare();
  ProcessorShare(const ProcessorShare&) = delete;
  ProcessorShare& operator=(const ProcessorShare&) = delete;

  std::size_t threads() const { return threads_; }

 private:
  std::size_t threads_;
};

}  // namespace flexspline::estimators
