// Of two causes in one equation: which part of the small one an error in the form of the large one
// explains.
#include <gtest/gtest.h>

#include "diagnosis/search/form_error.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

ArrayXd wave_of(const Frame& f) { return (40.0 * f.clock / f.session).sin(); }
ArrayXd bent(const Frame& f) { return wave_of(f) * (f.torsion / f.torsion_range).square(); }
ArrayXd one_sided(const Frame& f) { return wave_of(f) * f.torsion / f.torsion_range; }
ArrayXd another(const Frame& f) { return (211.0 * f.clock / f.session).sin(); }

template <ArrayXd (*Signal)(const Frame&)>
const CauseForm& form() {
  static const CauseForm one{.equation = "a signal",
                             .rigs = {Rig::specimen},
                             .at = {Equation::torsion},
                             .columns = [](Equation, const Frame& f, const Reference&, Values) {
                               return Columns{Signal(f)};
                             }};
  return one;
}

/// A specimen whose torque has a wave, as large as the bench's torque, and a twentieth of another
/// signal; the model has both.
double share_of(const CauseForm& small, ArrayXd (*signal)(const Frame&)) {
  Frame f = drawn_frame(Rig::specimen);
  f.torque += 0.2 * f.torque_range * wave_of(f) + 0.01 * f.torque_range * signal(f);
  auto findings = fit_baseline(f);
  EXPECT_TRUE(findings);
  for (const CauseForm* one : {&form<wave_of>(), &small}) {
    auto fit = extended(f, *findings, {nullptr, one, {}}, 3);
    EXPECT_TRUE(fit);
    findings->fit = std::move(*fit);
    EXPECT_TRUE(refresh(f, *findings, 3));
  }
  return share_beyond_form(f, *findings, 1, 0);
}

TEST(FormError, TakesWhatIsAModulationOfTheLargerCause) {
  EXPECT_LT(share_of(form<bent>(), bent), 1e-6);
}

TEST(FormError, LeavesADifferenceOfTheSides) {
  EXPECT_GT(share_of(form<one_sided>(), one_sided), 0.8);
}

TEST(FormError, LeavesASignalOfItsOwn) { EXPECT_GT(share_of(form<another>(), another), 0.8); }

}  // namespace
}  // namespace flexspline::studies
