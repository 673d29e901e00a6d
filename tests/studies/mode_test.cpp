// What a mode that rings answers to what drives it.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "diagnosis/frame/mode.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Mode kMode{40.0, 0.1};

// The frequency response w^2/(w^2 - v^2 + 2 i z w v), once the start has decayed; linear between
// rows a sine of v dt = 0.02 is off by (v dt)^2/12.
TEST(Mode, AnswersASineByItsFrequencyResponse) {
  constexpr double kRate = 10.0;
  const Frame frame = closed_form_frame();
  const ArrayXd u = (kRate * frame.time).sin();
  const ModeAnswer answer = answer_of(frame, u, kMode);
  const auto [w, z] = kMode;
  const std::complex<double> response =
      w * w / std::complex<double>(w * w - kRate * kRate, 2.0 * z * w * kRate);
  for (const Segment& s : frame.segments) {
    for (Index r = s.first + s.count / 2; r < s.first + s.count; ++r) {
      const auto phase = std::polar(1.0, kRate * frame.time[r]);
      EXPECT_NEAR(answer.place[r], std::imag((response - 1.0) * phase), 1e-4);
      EXPECT_NEAR(answer.speed[r], kRate / w * std::real(response * phase), 1e-4);
    }
  }
}

// Exact for a ramp: behind it by 2 z/w of its slope.
TEST(Mode, FollowsARampByItsDamping) {
  const Frame frame = closed_form_frame();
  const ModeAnswer answer = answer_of(frame, 3.0 * frame.time, kMode);
  const Index last = frame.segments.front().count - 1;
  EXPECT_NEAR(answer.place[last], -3.0 * 2.0 * kMode.damping / kMode.frequency, 1e-9);
  EXPECT_NEAR(answer.speed[last], 3.0 / kMode.frequency, 1e-9);
  EXPECT_EQ(answer.place[last + 1], 0.0) << "at rest where the next recording starts";
}

}  // namespace
}  // namespace flexspline::studies
