// What a person sees of a long command: on a terminal, by script(1).
#include <gtest/gtest.h>

#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;
using testing::Not;

class OnATerminal : public Program {};

TEST_F(OnATerminal, ALongCommandSaysHowFarItIs) {
  if (std::system("command -v script > /dev/null") != 0) GTEST_SKIP() << "there is no script(1)";
  const std::string seen = path("seen.txt");
  const std::string line = "script -qec \"" + program_path().string() + " selftest\" " + seen +
                           " > /dev/null < /dev/null";
  ASSERT_EQ(std::system(line.c_str()), 0);
  EXPECT_THAT(read_text(seen), HasSubstr(" s left: "));
}

TEST_F(OnATerminal, HelpIsGroupedAndHasExamples) {
  const Ended help = run_program({"--help"});
  for (const char* said : {"\nFit and diagnose:", "\nStudies:", "\nExamples:", "--color"}) {
    EXPECT_THAT(help.result, HasSubstr(said));
  }
}

TEST_F(OnATerminal, MessagesHaveColourWhereItIsAskedFor) {
  EXPECT_THAT(run_program({"--color", "always", "explain", "nothing"}).said, HasSubstr("\x1b[31m"));
  EXPECT_THAT(run_program({"explain", "nothing"}).said, Not(HasSubstr("\x1b[")));
  EXPECT_EQ(run_program({"--color", "sometimes", "explain", "nothing"}).code, 2);
}

}  // namespace
}  // namespace flexspline::studies
