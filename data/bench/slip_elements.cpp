#include "bench/slip_elements.hpp"

#include <algorithm>
#include <cstddef>

namespace flexspline::data {
namespace {

constexpr int kStepsPerSample = 2;  // in which the speed may change its sign once
constexpr int kBisections = 40;

class SlipPath {
 public:
  SlipPath(const std::vector<std::pair<double, double>>& elements, const PrescribedMotion& motion,
           double late_s)
      : elements_(elements), motion_(motion), late_s_(late_s), deflections_(elements.size(), 0.0) {}

  /// Moves from one sample to the next.
  void advance_to(int sample) {
    for (int step = kStepsPerSample - 1; step >= 0; --step) {
      const double offset = -static_cast<double>(step) / kStepsPerSample;
      const MotionPoint next = point(sample, offset);
      if (next.velocity * last_.velocity < 0.0) move_to(turning_point(sample, offset));
      move_to(next);
    }
  }

  double torque() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      sum += elements_[i].first * deflections_[i];
    }
    return sum;
  }

 private:
  MotionPoint point(int sample, double offset) const {
    return motion_.at(motion_.instant(sample, offset, late_s_));
  }

  void move_to(const MotionPoint& next) {
    const double travel = next.position - last_.position;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const double yield = elements_[i].second;
      deflections_[i] = std::clamp(deflections_[i] + travel, -yield, yield);
    }
    last_ = next;
  }

  /// Where the speed passes zero in the step that ends at offset.
  MotionPoint turning_point(int sample, double offset) const {
    double before = offset - 1.0 / kStepsPerSample;
    double after = offset;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (before + after);
      const bool turned = point(sample, middle).velocity * last_.velocity < 0.0;
      (turned ? after : before) = middle;
    }
    return point(sample, after);
  }

  const std::vector<std::pair<double, double>>& elements_;
  const PrescribedMotion& motion_;
  double late_s_;
  std::vector<double> deflections_;
  MotionPoint last_;
};

}  // namespace

std::vector<double> slip_torque(const std::vector<std::pair<double, double>>& elements,
                                const PrescribedMotion& motion, int samples, double late_s) {
  std::vector<double> torque(static_cast<std::size_t>(samples), 0.0);
  if (elements.empty()) return torque;
  SlipPath path(elements, motion, late_s);
  for (int k = 1; k < samples; ++k) {
    path.advance_to(k);
    torque[static_cast<std::size_t>(k)] = path.torque();
  }
  return torque;
}

}  // namespace flexspline::data
