#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The cubic model, with the ranges that its recordings support: 0.2 deg, and twice the rate of
/// 0.2 deg at 0.005 Hz.
class SimulatedModel : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::string model = read_text(path("model.toml"));
    model.replace(model.find("coefficients = [10"), 0, "valid_to = 0.0034906585\n");
    model.replace(model.find("coefficients = [3"), 0, "valid_to = 2.1932454e-4\n");
    folder_.write("model.toml", model);
  }
  Ended at(const std::string& amplitude, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"simulate",    path("model.toml"), "--excitation", "sine",
                                      "--amplitude", amplitude,          "--frequency",  "0.005Hz",
                                      "--out",       path("out")};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
};

TEST_F(SimulatedModel, IsTakenAtItsWordWithinItsDomain) {
  ASSERT_EQ(at("0.2deg").code, 0);
  EXPECT_THAT(read_text(path("out/dataset.toml")), Not(HasSubstr("extrapolated")));
}

TEST_F(SimulatedModel, IsNotExtrapolatedUnasked) {
  const Ended refused = at("10deg");
  EXPECT_EQ(refused.code, 65);
  EXPECT_THAT(refused.said, HasSubstr("50 times the range of f"));
  EXPECT_THAT(refused.said, HasSubstr("--extrapolate"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(SimulatedModel, SaysInItsOutputThatItIsExtrapolated) {
  const Ended done = at("10deg", {"--extrapolate"});
  ASSERT_EQ(done.code, 0) << done.said;
  EXPECT_THAT(done.said, HasSubstr("extrapolated"));
  EXPECT_THAT(read_text(path("out/dataset.toml")), HasSubstr("note = \"extrapolated"));
  EXPECT_EQ(run_program({"validate", path("out")}).code, 0);
}

// Driven by the torque, the motion that follows is what has to stay within.
TEST_F(SimulatedModel, IsNotExtrapolatedByATorque) {
  EXPECT_EQ(at("5Nm", {"--direction", "torsion"}).code, 0);
  const Ended refused = at("100Nm", {"--direction", "torsion", "--force"});
  EXPECT_EQ(refused.code, 65) << refused.said;
}

}  // namespace
}  // namespace flexspline::studies
