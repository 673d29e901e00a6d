#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drive_frame.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

inline Diagnosis diagnosed(const RecordingSet& set) {
  auto result = diagnose(set, {}, {.nested = false});
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message());
  return result ? *std::move(result) : Diagnosis{};
}

inline std::vector<std::string> names(const Diagnosis& diagnosis) {
  std::vector<std::string> list;
  for (const Cause& cause : diagnosis.causes) list.push_back(cause.effect);
  return list;
}

struct Bench {
  Rig rig;
  std::uint64_t seed;
  std::string effect;  ///< of 6 %; empty: none

  std::string words() const {
    return std::string(name_of(rig)) + " " + std::to_string(seed) + " " + effect;
  }
  ConcealedCase make() const {
    return drawn_case(rig, seed,
                      effect.empty() ? std::vector<data::HiddenEffect>{}
                                     : std::vector<data::HiddenEffect>{{effect, 0.06}});
  }
};

/// Says that nothing was left out.
inline void expect_nothing(const Bench& bench) {
  const Diagnosis d = diagnosed(bench.make().recordings);
  EXPECT_EQ(d.verdict, Verdict::adequate) << bench.words();
  EXPECT_TRUE(d.causes.empty()) << bench.words() << ": " << names(d).front();
  EXPECT_NEAR(d.holdout.ratio, 1.0, 1e-12) << "nothing was added";
}

/// Says that something was left out that has no name.
inline void expect_no_name(const Bench& bench) {
  const Diagnosis d = diagnosed(bench.make().recordings);
  EXPECT_TRUE(d.causes.empty()) << bench.words() << ": " << names(d).front();
  EXPECT_EQ(d.verdict, Verdict::unexplained) << bench.words();
}

/// Names it first, says where, and proves it on recordings held out.
inline void expect_found(const Bench& bench) {
  const ConcealedCase hidden = bench.make();
  const Diagnosis d = diagnosed(hidden.recordings);
  ASSERT_FALSE(d.causes.empty());
  const Cause& first = d.causes.front();
  EXPECT_TRUE(first.effect == bench.effect ||
              std::ranges::count(first.alternatives, bench.effect) > 0)
      << first.effect;
  EXPECT_TRUE(d.verdict == Verdict::explained || d.verdict == Verdict::partly_explained);
  // No law is judged where it was not fitted, so what shows at the extremes alone may gain nothing.
  EXPECT_LT(d.holdout.ci95_lower, 1.0);
  EXPECT_LE(d.holdout.ci95_lower, d.holdout.ratio);
  EXPECT_GE(d.holdout.ci95_upper, d.holdout.ratio);
  EXPECT_GT(first.probability, 0.3);
  EXPECT_LE(first.probability, 1.0);
  EXPECT_LT(first.evidence.delta_bic, 0.0);
  EXPECT_LE(first.alternatives.size(), 2U);
  const auto located = std::ranges::count(
      d.mismatch.begin(), d.mismatch.begin() + std::min<long>(3, std::ssize(d.mismatch)),
      hidden.answer.effects.front().coordinate, &Mismatch::coordinate);
  EXPECT_GT(located, 0);
  if (bench.rig != Rig::locked) return;
  EXPECT_LT(d.holdout.rmse_after, 1.15 * hidden.answer.noise_std);
}

/// What a diagnosis says, without what depends on names and clocks.
struct Said {
  explicit Said(const Diagnosis& d)
      : verdict(d.verdict), causes(names(d)), rmse_after(d.holdout.rmse_after) {
    for (const Mismatch& m : d.mismatch) coordinates.push_back(m.coordinate);
    for (const Cause& c : d.causes) sizes.push_back(c.size_fraction);
  }
  Verdict verdict;
  std::vector<std::string> causes, coordinates;
  std::vector<double> sizes;
  double rmse_after;
};

inline void expect_same(const Said& a, const Said& b, double tolerance) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.causes, b.causes);
  EXPECT_EQ(a.coordinates, b.coordinates);
  EXPECT_NEAR(a.rmse_after, b.rmse_after, tolerance * a.rmse_after);
  ASSERT_EQ(a.sizes.size(), b.sizes.size());
  for (std::size_t k = 0; k < a.sizes.size(); ++k) {
    EXPECT_NEAR(a.sizes[k], b.sizes[k], tolerance * a.sizes[k]);
  }
}

/// Other names for everything that has one, and nothing nominal.
inline void rename(RecordingSet& set) {
  set.name = "adequate";
  set.note = "nothing was left out";
  int k = 0;
  for (Recording& recording : set.recordings) {
    recording.id = "r" + std::to_string((7 * ++k) % 101);
    recording.excitation.clear();
    recording.amplitude.reset(), recording.frequency_hz.reset();
  }
}

}  // namespace flexspline::studies
