#include "flexspline/data/artefact.hpp"

#include <gmock/gmock.h>

#include <limits>

#include <nlohmann/json.hpp>

#include "dataset_fixture.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::data {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

class Artefact : public InFolder {
 protected:
  std::string refusal(const std::string& text) {
    put("case.json", text);
    const auto content = read_artefact(folder_ / "case.json", "flexspline-case/1");
    if (content) return "";
    EXPECT_EQ(content.error().code, ErrorCode::bad_data);
    EXPECT_THAT(content.error().problem, HasSubstr("case.json:"));
    return content.error().problem;
  }

  std::string written() {
    const Json content = {{"schema", "flexspline-case/1"},
                          {"value", 0.1},
                          {"zero", 0.0},
                          {"whole", 3},
                          {"failed", std::numeric_limits<double>::quiet_NaN()},
                          {"name", "caf\xE9"}};
    EXPECT_TRUE(write_artefact(folder_ / "case.json", content).has_value());
    return read_file(folder_ / "case.json").value();
  }
};

TEST(Checksum, IsThatOfFips180) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  Sha256 pieces;
  pieces.add("a");
  pieces.add("bc");
  EXPECT_EQ(pieces.hex(), sha256_hex("abc"));
}

// A recording may be larger than any text that is read whole.
TEST_F(Artefact, AChecksumIsOfAFileOfAnySize) {
  constexpr std::size_t kBytes = (std::size_t{1} << 30U) + 1;
  put("large.csv", "");
  std::filesystem::resize_file(folder_ / "large.csv", kBytes);
  Sha256 of_file;
  ASSERT_TRUE(of_file.add_file(folder_ / "large.csv"));
  Sha256 of_zeros;
  const std::string zeros(std::size_t{1} << 20U, '\0');
  for (std::size_t k = 0; k < 1024; ++k) of_zeros.add(zeros);
  of_zeros.add({zeros.data(), 1});
  EXPECT_EQ(of_file.hex(), of_zeros.hex());
  Sha256 other;
  EXPECT_THAT(other.add_file("/dev/zero").error().problem, HasSubstr("no regular file"));
  EXPECT_THAT(other.add_file(folder_ / "none.csv").error().problem, HasSubstr("none.csv"));
}

TEST_F(Artefact, ReadsBackWithSchemaFirstAndChecksumLast) {
  const std::string text = written();
  EXPECT_THAT(text, testing::StartsWith(R"({"schema":"flexspline-case/1",)"));
  const Json raw = Json::parse(text);
  EXPECT_EQ(std::prev(raw.end()).key(), "sha256");
  const auto content = read_artefact(folder_ / "case.json", "flexspline-case/1");
  ASSERT_TRUE(content.has_value()) << content.error().message();
  EXPECT_EQ(content->at("value"), 0.1);
  EXPECT_TRUE(content->at("failed").is_null());
  EXPECT_FALSE(content->contains("sha256"));
}

TEST_F(Artefact, IsTheSameHoweverItIsIndented) {
  EXPECT_EQ(refusal(Json::parse(written()).dump(2)), "");
}

TEST_F(Artefact, IsRefusedWhenTamperedWith) {
  EXPECT_THAT(refusal(with(written(), "0.1", "0.2")), HasSubstr("checksum does not hold"));
  EXPECT_THAT(refusal(with(written(), "\"value\"", "\"valve\"")), HasSubstr("checksum"));
  EXPECT_THAT(refusal(with(written(), "sha256", "sha25")), HasSubstr("sha256 is null"));
  EXPECT_THAT(refusal(written().substr(0, 40)), HasSubstr("cut short"));
  EXPECT_THAT(refusal("[]"), HasSubstr("not a JSON object"));
  EXPECT_THAT(refusal("{\"a\": 1e400}"), HasSubstr("beyond 1e308"));
  EXPECT_THAT(refusal(""), HasSubstr("not JSON"));
  EXPECT_THAT(refusal(with(written(), "case/1", "case/2")), HasSubstr("flexspline-case/2"));
}

TEST_F(Artefact, ThatIsNotThereIsMissingInput) {
  const auto absent = read_artefact(folder_ / "absent.json", "flexspline-case/1");
  ASSERT_FALSE(absent.has_value());
  EXPECT_EQ(absent.error().code, ErrorCode::input_missing);
}

}  // namespace
}  // namespace flexspline::data
