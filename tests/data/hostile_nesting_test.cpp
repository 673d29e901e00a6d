#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "dataset_fixture.hpp"
#include "flexspline/core/nesting.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/model_toml.hpp"

namespace flexspline::data {
namespace {

using testing::HasSubstr;

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

TEST(Nesting, IsAllowedUpToItsLimitAndNoFurther) {
  for (const auto& [open, close] : {std::pair("[", "]"), {"{\"a\":", "}"}}) {
    const auto nested = [&](int depth) {
      return repeated(open, depth) + "1" + repeated(close, depth);
    };
    EXPECT_TRUE(check_nesting(nested(kDeepestNesting)).has_value());
    EXPECT_FALSE(check_nesting(nested(kDeepestNesting + 1)).has_value());
  }
  const auto dotted = [](int parts) { return "\n[a" + repeated(".a", parts - 1) + "]\n"; };
  EXPECT_TRUE(check_nesting(dotted(kDeepestNesting)).has_value());
  const auto refused = check_nesting(dotted(kDeepestNesting + 1));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().problem, "line 2 nests deeper than 64 levels");
}

TEST(Nesting, LeavesStringsRemarksAndNeighboursAlone) {
  const std::string deep = repeated("[.{", 200);
  for (const std::string& text :
       {"\"" + deep + "\\\"" + deep + "\"", "'" + deep + "'", "# " + deep + "\na = 1",
        "\"\"\"\n" + deep + "\n\"" + deep + "\"\"\"", "'''\n" + deep + "'" + deep + "'''",
        repeated("[1.5],\n", 200), repeated("a.b = 1\n", 200), repeated("1.5, ", 200)}) {
    EXPECT_TRUE(check_nesting(text).has_value()) << text.substr(0, 20);
  }
}

TEST(Nesting, EndsAtATextThatIsCutShort) {
  for (const char* text : {"\"", "\"\\", "'''", "#", "a = \"x", "\"\"\"\\"}) {
    EXPECT_TRUE(check_nesting(text).has_value()) << text;
  }
}

class DeepFile : public InFolder {};

TEST_F(DeepFile, IsRefusedAsAnArtefact) {
  const std::string deep = repeated("[", 100000) + repeated("]", 100000);
  put("a.json", "{\"schema\":\"x/1\",\"a\":" + deep + ",\"sha256\":\"\"}");
  const auto artefact = read_artefact(folder_ / "a.json", "x/1");
  ASSERT_FALSE(artefact.has_value());
  EXPECT_EQ(artefact.error().code, ErrorCode::bad_data);
  EXPECT_THAT(artefact.error().problem, HasSubstr("line 1 nests deeper than 64 levels"));
}

TEST_F(DeepFile, IsRefusedAsAModel) {
  const auto model = parse_model(repeated("a.", 50000) + "a = 1\n", "m.toml");
  ASSERT_FALSE(model.has_value());
  EXPECT_THAT(model.error().problem, HasSubstr("m.toml: line 1 nests deeper than 64 levels"));
}

}  // namespace
}  // namespace flexspline::data
