#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

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

constexpr std::size_t kSound = 500;

std::uint64_t number_in_environment(const char* name, std::uint64_t otherwise) {
  const char* given = std::getenv(name);
  return given == nullptr ? otherwise : std::strtoull(given, nullptr, 10);
}

/// Where the draws begin: FLEXSPLINE_SANITY_SEED asks for benches that nobody has looked at.
std::uint64_t seed() {
  static const std::uint64_t drawn = number_in_environment("FLEXSPLINE_SANITY_SEED", 61409);
  return drawn;
}

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
    for (const auto& one : data::sanity_of(drawn_set(kRigs[k % 4], seed() + k))) {
      says[k] += fmt::format("{} {}: {}\n", name_of(kRigs[k % 4]), seed() + k, one.message());
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

/// Sets of each damage: 200 where FLEXSPLINE_SANITY_SETS says so, as docs/sanity.md counts them.
std::size_t damaged_sets() { return number_in_environment("FLEXSPLINE_SANITY_SETS", 40); }

using Checks = std::set<std::string>;

Checks checks_that_find(const RecordingSet& set) {
  Checks checks;
  for (const auto& one : data::sanity_of(set)) checks.insert(one.check);
  return checks;
}

/// A drawn set, and what is said of it undamaged.
struct SoundSet {
  RecordingSet set;
  Checks checks;
};

std::map<Rig, std::vector<SoundSet>> sound_sets(std::size_t of_each) {
  std::map<Rig, std::vector<SoundSet>> sets;
  for (const Rig rig : kRigs) {
    auto& mine = sets[rig];
    mine.resize(of_each);
    in_parallel(of_each, 2, [&](std::size_t k) {
      mine[k].set = drawn_set(rig, seed() + 10000 + k);
      mine[k].checks = checks_that_find(mine[k].set);
    });
  }
  return sets;
}

/// Sets in which checks find something that they do not find undamaged, by check.
struct Found {
  std::size_t sets = 0;
  std::map<std::string, std::size_t> by_check;
};

Found found(const Damage& damage, const std::map<Rig, std::vector<SoundSet>>& sets,
            std::size_t count) {
  std::vector<Checks> said(count);
  in_parallel(count, 2, [&](std::size_t k) {
    const SoundSet& sound = sets.at(damage.rigs[k % damage.rigs.size()])[k / damage.rigs.size()];
    RecordingSet set = sound.set;
    Draw draw(seed() + k);
    damage.apply(set, draw);
    for (const std::string& check : checks_that_find(set)) {
      if (!sound.checks.contains(check)) said[k].insert(check);
    }
  });
  Found all;
  for (const Checks& checks : said) {
    all.sets += checks.empty() ? 0 : 1;
    for (const std::string& check : checks) ++all.by_check[check];
  }
  return all;
}

TEST(SanitySlow, EachDamageIsFound) {
  const std::size_t count = damaged_sets();
  const auto sets = sound_sets(count);
  for (const Damage& damage : damages()) {
    const Found all = found(damage, sets, count);
    std::string by;
    for (const auto& [check, of] : all.by_check) by += fmt::format(" `{}` {}", check, of);
    fmt::print("| {} | {} of {} |{} |\n", damage.name, all.sets, count, by);
    EXPECT_GE(static_cast<double>(all.sets), 0.95 * static_cast<double>(count)) << damage.name;
  }
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
