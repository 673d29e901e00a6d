#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "dataset_fixture.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/commitment.hpp"

namespace flexspline::data {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

const Json kAnswer = {{"effects", {"backlash"}}, {"size", {0.1 + 0.2}}, {"coordinate", {nullptr}}};

TEST(Commitment, IsTheHashOfSaltLineFeedAndAnswer) {
  const Json open = commitment_to(Json{{"a", 1}}, "pepper", "a number");
  EXPECT_EQ(open.at("hash"), sha256_hex("pepper\n{\"a\":1}"));
  EXPECT_EQ(open.at("commits_to"), "a number");
  EXPECT_EQ(open.dump().find("pepper"), std::string::npos) << "the salt is not in the open";
}

TEST(Commitment, DependsOnTheSalt) {
  EXPECT_NE(commitment_to(kAnswer, "one", "").at("hash"),
            commitment_to(kAnswer, "two", "").at("hash"));
}

TEST(Commitment, OpensWhatWasSealed) {
  const auto answer = unseal(commitment_to(kAnswer, "salt", ""), sealed(kAnswer, "salt"));
  ASSERT_TRUE(answer.has_value()) << answer.error().message();
  EXPECT_EQ(*answer, kAnswer);
}

TEST(Commitment, FindsAnyTampering) {
  const Json open = commitment_to(kAnswer, "salt", "");
  Json other = sealed(kAnswer, "salt");
  other["answer"]["effects"][0] = "stribeck_friction";
  Json digit = sealed(kAnswer, "salt");
  digit["answer"]["size"][0] = 0.3;  // 0.1 + 0.2 but for the last binary digit
  Json order = sealed(Json{{"size", kAnswer["size"]}, {"effects", kAnswer["effects"]}}, "salt");
  for (const Json& bad : {other, digit, order, sealed(kAnswer, "sal")}) {
    const auto answer = unseal(open, bad);
    ASSERT_FALSE(answer.has_value()) << bad;
    EXPECT_EQ(answer.error().code, ErrorCode::bad_data);
    EXPECT_THAT(answer.error().problem, HasSubstr("not what was committed to"));
  }
}

TEST(Commitment, RefusesOtherFormats) {
  const Json open = commitment_to(kAnswer, "salt", "");
  Json md5 = open;
  md5["algorithm"] = "MD5";
  EXPECT_THAT(unseal(md5, sealed(kAnswer, "salt")).error().problem, HasSubstr("MD5"));
  EXPECT_FALSE(unseal(Json::object(), sealed(kAnswer, "salt")).has_value());
  EXPECT_FALSE(unseal(open, Json::object()).has_value());
  EXPECT_FALSE(unseal(open, sealed(kAnswer, "")).has_value()) << "an answer without salt";
}

TEST(Commitment, FreshSaltsDiffer) {
  const auto one = fresh_salt();
  const auto two = fresh_salt();
  ASSERT_TRUE(one.has_value() && two.has_value());
  EXPECT_EQ(one->size(), 64U);
  EXPECT_NE(*one, *two);
}

class CommitmentFiles : public InFolder {};

TEST_F(CommitmentFiles, OpenAsArtefacts) {
  const auto open = folder_ / "commitment.json";
  const auto closed = folder_ / "answer.sealed.json";
  ASSERT_TRUE(write_artefact(open, commitment_to(kAnswer, "salt", "")).has_value());
  EXPECT_EQ(unseal(open, closed).error().code, ErrorCode::input_missing);
  ASSERT_TRUE(write_artefact(closed, sealed(kAnswer, "salt")).has_value());
  const auto answer = unseal(open, closed);
  ASSERT_TRUE(answer.has_value()) << answer.error().message();
  EXPECT_EQ(*answer, kAnswer);
}

}  // namespace
}  // namespace flexspline::data
