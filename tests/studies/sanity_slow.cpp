#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "damaged_set.hpp"
#include "flexspline/core/in_parallel.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/sanity.hpp"
#include "flexspline/studies/conceal.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

constexpr std::uint64_t kSeed = 61409;
constexpr std::size_t kSound = 500;
constexpr std::size_t kDamaged = 200;

/// A bench that hides nothing, one effect or two, as a trial draws it.
RecordingSet drawn_set(Rig rig, std::uint64_t seed) {
  ConcealPlan plan;
  plan.rig = rig;
  plan.seed = seed;
  plan.draw = ConcealDraw{};
  for (std::uint64_t more = 0; more < 8; ++more) {
    plan.seed = seed + 1000003 * more;  // a bench that cannot have its effect: another one
    if (auto made = conceal(plan)) return std::move(made->recordings);
  }
  ADD_FAILURE() << "no bench of seed " << seed;
  return {};
}

constexpr std::array kRigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo};

TEST(SanitySlow, SoundSetsRaiseNoAlarm) {
  std::vector<std::string> says(kSound);
  in_parallel(kSound, 2, [&](std::size_t k) {
    for (const auto& one : data::sanity_of(drawn_set(kRigs[k % 4], kSeed + k))) {
      says[k] += fmt::format("{} {}: {}\n", name_of(kRigs[k % 4]), kSeed + k, one.message());
    }
  });
  std::size_t alarms = 0;
  for (const std::string& one : says) {
    alarms += one.empty() ? 0 : 1;
    if (!one.empty()) fmt::print("{}", one);
  }
  fmt::print("{} alarms in {} sound sets\n", alarms, kSound);
  EXPECT_LE(alarms, kSound / 100);
}

/// Found: something is said that the sound set does not have.
TEST(SanitySlow, DamagedSetsAreFound) {
  std::vector<std::string> missed(kDamaged);
  in_parallel(kDamaged, 2, [&](std::size_t k) {
    const Damage& damage = damages()[k % damages().size()];
    const Rig rig = damage.rigs[(k / damages().size()) % damage.rigs.size()];
    RecordingSet set = drawn_set(rig, kSeed + 10000 + k);
    const std::size_t before = data::sanity_of(set).size();
    Draw draw(kSeed + k);
    damage.apply(set, draw);
    if (data::sanity_of(set).size() > before) return;
    missed[k] = fmt::format("{} {}: {}\n", name_of(rig), kSeed + 10000 + k, damage.name);
  });
  std::size_t found = 0;
  for (const std::string& one : missed) {
    found += one.empty() ? 1 : 0;
    if (!one.empty()) fmt::print("missed: {}", one);
  }
  fmt::print("{} of {} damaged sets found\n", found, kDamaged);
  EXPECT_GE(found, kDamaged * 95 / 100);
}

// Recordings by others are sound; they are no part of the project.
TEST(SanitySlow, RecordingsOfOthersRaiseNoAlarm) {
  const char* given = std::getenv("FLEXSPLINE_SHARED");
  const std::filesystem::path shared =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(FLEXSPLINE_SOURCE_DIR).parent_path() / "shared";
  if (!std::filesystem::exists(shared / "recordings")) {
    GTEST_SKIP() << "the real recordings are not at " << shared / "recordings";
  }
  for (const char* folder : {"recordings", "practice/cases"}) {
    for (const auto& entry : std::filesystem::directory_iterator(shared / folder)) {
      if (!entry.is_directory()) continue;
      const auto set = data::load_dataset(entry.path());
      ASSERT_TRUE(set) << set.error().message();
      for (const auto& one : data::sanity_of(*set)) ADD_FAILURE() << entry << one.message();
    }
  }
}

}  // namespace
}  // namespace flexspline::studies
