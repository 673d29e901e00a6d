#include "spoilt_inputs.hpp"

namespace flexspline::studies {
namespace {

/// Number of tries of each kind; FLEXSPLINE_TRIES gives another.
std::uint64_t tries() {
  const char* given = std::getenv("FLEXSPLINE_TRIES");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 200;
}

/// As many of these calls, evenly spread.
void attempt_some(SpoiltInputs& inputs, const std::vector<std::vector<std::string>>& calls) {
  const std::size_t step =
      std::max<std::size_t>(1, calls.size() / std::max<std::size_t>(1, tries()));
  for (std::size_t i = 0; i < calls.size(); i += step) inputs.attempt(calls[i]);
  inputs.print_counts();
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
  attempt_some(inputs, inputs.crossed());
}

TEST_F(AllTries, EveryCommandWithEveryOption) {
  SpoiltInputs inputs;
  attempt_some(inputs, inputs.with_options());
}

TEST_F(AllTries, EveryCommandOnSpoiltInputs) {
  constexpr std::uint64_t kSeed = 20030;
  SpoiltInputs inputs;
  for (std::uint64_t i = 0; i < tries(); ++i) inputs.attempt(inputs.spoilt_call(kSeed + i));
  inputs.print_counts();
}

}  // namespace
}  // namespace flexspline::studies
