#include "spoilt_inputs.hpp"

namespace flexspline::studies {
namespace {

/// Number of tries on spoilt inputs; FLEXSPLINE_TRIES=2000 is the whole of it.
std::uint64_t tries() {
  const char* given = std::getenv("FLEXSPLINE_TRIES");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 500;
}

// FLEXSPLINE_PROGRAM names another executable to try, for instance one with sanitizers.
class AllTries : public testing::Test {
 protected:
  void SetUp() override {
    if (!exists(program_path())) GTEST_SKIP() << program_path() << " is not built";
    setenv("ASAN_OPTIONS", "exitcode=99:detect_leaks=0:allocator_may_return_null=1", 0);
    setenv("UBSAN_OPTIONS", "exitcode=99:print_stacktrace=1", 0);
  }
};

TEST_F(AllTries, EveryCommandWithEveryFileOfEveryOther) {
  SpoiltInputs inputs;
  for (const auto& words : inputs.crossed()) inputs.attempt(words);
  inputs.print_counts();
}

TEST_F(AllTries, EveryCommandWithEveryOption) {
  SpoiltInputs inputs;
  for (const auto& words : inputs.with_options()) inputs.attempt(words);
  inputs.print_counts();
}

TEST_F(AllTries, EveryCommandOnSpoiltInputs) {
  constexpr std::uint64_t kSeed = 20030;
  SpoiltInputs inputs;
  for (std::uint64_t i = 0; i < tries(); ++i) inputs.attempt(inputs.spoilt_call(kSeed + i));
  inputs.print_counts();
}

}  // namespace
}  // namespace flexspline::studies
