#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include <nlohmann/json.hpp>

#include "dataset_fixture.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/data/estimate_json.hpp"
#include "flexspline/data/model_toml.hpp"
#include "source_dir.hpp"

namespace flexspline::data {
namespace {

using testing::HasSubstr;

ModelSpec table_like_model() {
  ModelSpec model;
  model.f = {"odd_polynomial", 0.0034906585039886592, {}, {1.0 / 3.0, -2e-310, 3.0}, 0.1 + 0.2};
  model.g_inverse = {"odd_polynomial", 1e-5, {}, {4.123456789012345, -1e300}, 0.0};
  model.h = {"odd_polynomial", 1.0, {}, {5e-324}, 1.0};
  model.effects = {
      {"torque_sensor_offset", {{"offset", 1.0 / 7.0}}},
      {"presliding_hysteresis",
       {{"stiffness", 2.0 / 3.0}, {"yield", 1e-4}, {"stiffness", 9.0}, {"yield", 0.01}}}};
  return model;
}

void expect_same(const LawSpec& a, const LawSpec& b) {
  EXPECT_EQ(a.law, b.law);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.knots, b.knots);
  EXPECT_EQ(a.coefficients, b.coefficients);
  EXPECT_EQ(a.valid_to, b.valid_to);
}

void expect_same(const ModelSpec& a, const ModelSpec& b) {
  expect_same(a.f, b.f);
  expect_same(a.g_inverse, b.g_inverse);
  expect_same(a.h, b.h);
  ASSERT_EQ(a.effects.size(), b.effects.size());
  for (std::size_t i = 0; i < a.effects.size(); ++i) {
    EXPECT_EQ(a.effects[i].effect, b.effects[i].effect);
    EXPECT_EQ(a.effects[i].parameters, b.effects[i].parameters);
  }
}

std::string refusal(const std::string& text) {
  const auto model = parse_model(text, "MODEL.toml");
  return model ? "" : model.error().message();
}

TEST(ModelFile, ReadsBackToTheLastBit) {
  const ModelSpec model = table_like_model();
  const auto back = parse_model(model_toml(model), "MODEL.toml");
  ASSERT_TRUE(back.has_value()) << back.error().message();
  expect_same(*back, model);
}

/// Every effect once, with odd fractions of its nominal values; two elements where they repeat.
ModelSpec model_with_every_effect() {
  ModelSpec model = table_like_model();
  model.effects.clear();
  for (const EffectRow& row : effects()) {
    EffectSpec effect{std::string(row.id), {}};
    for (int element = 0; element < (row.repeats ? 2 : 1); ++element) {
      for (const EffectParameter& one : row.parameters) {
        effect.parameters.emplace_back(one.name, one.nominal + (one.upper - one.nominal) / 3.0);
      }
    }
    model.effects.push_back(effect);
  }
  return model;
}

TEST(ModelFile, ReadsEveryEffectBack) {
  const ModelSpec model = model_with_every_effect();
  const auto back = parse_model(model_toml(model), "MODEL.toml");
  ASSERT_TRUE(back.has_value()) << back.error().message();
  expect_same(*back, model);
  const auto from_json = model_from_json(nlohmann::ordered_json::parse(to_json(model).dump()));
  ASSERT_TRUE(from_json.has_value()) << from_json.error().message();
  expect_same(*from_json, model);
}

// Alone, so that every refusal is this effect's.
TEST(ModelFile, RefusesAnyEffectBeyondItsBoundsOrShortOfAParameter) {
  for (const EffectSpec& sound : model_with_every_effect().effects) {
    ModelSpec model = table_like_model();
    for (std::size_t k = 0; k < sound.parameters.size(); ++k) {
      model.effects = {sound};
      auto& [name, value] = model.effects[0].parameters[k];
      value = 1e300;
      EXPECT_THAT(refusal(model_toml(model)), HasSubstr(name + " is 1e+300")) << sound.effect;
      value = std::nan("");
      EXPECT_NE(refusal(model_toml(model)), "") << sound.effect;
    }
    model.effects = {sound};
    model.effects[0].parameters.pop_back();
    EXPECT_THAT(refusal(model_toml(model)), HasSubstr("it takes")) << sound.effect;
  }
}

TEST(ModelFile, WithoutHHasHOfOne) {
  ModelSpec model = table_like_model();
  model.h = {};
  const auto back = parse_model(model_toml(model), "MODEL.toml");
  ASSERT_TRUE(back.has_value()) << back.error().message();
  const auto h = make_law(back->h);
  ASSERT_TRUE(h.has_value()) << h.error().message();
  EXPECT_EQ(h.value()->value(0.3), 1.0);
}

TEST(ModelFile, IsAsItsDocumentationShows) {
  const auto page = read_file(FLEXSPLINE_SOURCE_DIR "/docs/model-file.md");
  ASSERT_TRUE(page.has_value()) << page.error().message();
  const auto from = page->find("```toml\n") + 8;
  const auto model = parse_model(page->substr(from, page->find("```", from) - from), "page");
  ASSERT_TRUE(model.has_value()) << model.error().message();
  EXPECT_EQ(model->f.coefficients.size(), 2U);
  EXPECT_EQ(model->effects.size(), 1U);
}

TEST(ModelFile, RefusesNamingThePlace) {
  const std::string sound = model_toml(table_like_model());
  EXPECT_THAT(refusal(with(sound, "model/1", "model/9")),
              HasSubstr("MODEL.toml:1:10: unknown schema 'flexspline-model/9'"));
  EXPECT_THAT(refusal(with(sound, "valid_to", "valid_from")),
              HasSubstr("MODEL.toml:8:1: unknown key 'valid_from'"));
  EXPECT_THAT(refusal(with(sound, "[g_inverse]", "[g_invers]")),
              HasSubstr("MODEL.toml:10:2: unknown key 'g_invers'; did you mean 'g_inverse'?"));
  EXPECT_THAT(refusal(with(sound, "odd_polynomial", "odd_polynomal")),
              HasSubstr("MODEL.toml:4:7: unknown law 'odd_polynomal'; did you mean"));
  EXPECT_THAT(refusal(with(sound, "torque_sensor_offset", "torque_sensor_ofset")),
              HasSubstr("did you mean 'torque_sensor_offset'?"));
  EXPECT_THAT(refusal(with(sound, "\"offset\"", "\"ofset\"")),
              HasSubstr("MODEL.toml:27:3: parameter 'ofset' stands where 'offset' belongs"));
  EXPECT_THAT(refusal(with(sound, "{ name = \"stiffness\", value = 9.0 },", "")),
              HasSubstr("parameter 'yield' stands where 'stiffness' belongs"));
  EXPECT_THAT(refusal(with(sound, "{ name = \"yield\", value = 0.01 },", "")),
              HasSubstr("has 3 parameters; it takes 2 an element"));
  EXPECT_THAT(refusal(with(sound, "value = 9.0", "value = -9.0")), HasSubstr("out of range"));
  EXPECT_THAT(refusal(with(sound, "scale = 1e-05", "scale = -1.0")), HasSubstr("scale"));
  EXPECT_THAT(refusal(with(sound, "scale = 1e-05", "scale = inf")), HasSubstr("not finite"));
  EXPECT_THAT(refusal("schema = \"flexspline-model/1\"\n"), HasSubstr("no [g_inverse]"));
}

TEST(ModelJson, ReadsBackToTheLastBit) {
  const ModelSpec model = table_like_model();
  const auto text = to_json(model).dump();
  const auto back = model_from_json(nlohmann::ordered_json::parse(text));
  ASSERT_TRUE(back.has_value()) << back.error().message();
  expect_same(*back, model);
}

TEST(ModelJson, RefusesWhatIsNoModel) {
  auto json = to_json(table_like_model());
  json["f"]["scale"] = nullptr;
  EXPECT_FALSE(model_from_json(json).has_value());
  EXPECT_FALSE(model_from_json(nlohmann::ordered_json::array()).has_value());
}

Estimate estimate_with_bands() {
  Estimate estimate;
  estimate.estimator = "paper";
  estimate.model = table_like_model();
  estimate.parameters = {{.name = "a1", .value = 2.0, .unit = "Nm"}};
  estimate.termination = Termination::converged;
  estimate.fits = {{"one", Split::train, 0.5}, {"two", Split::holdout, 0.75}};
  const double degree = std::acos(-1.0) / 180.0;
  for (const char* function : {"f", "g_inverse", "h"}) {
    estimate.bands.push_back({function, {degree}, {3.0}, {2.0}, {kNotComputed}, -degree, degree});
  }
  return estimate;
}

TEST(EstimateJson, ShowsBandsInDisplayUnits) {
  const auto json = to_json(estimate_with_bands(), {"deg", "kNm"});
  const auto& f = json["bands"][0];
  EXPECT_EQ(f["unit_argument"], "deg");
  EXPECT_EQ(f["unit_value"], "kNm");
  EXPECT_DOUBLE_EQ(f["argument"][0], 1.0);
  EXPECT_DOUBLE_EQ(f["value"][0], 0.003);
  EXPECT_DOUBLE_EQ(f["valid_from"], -1.0);
  EXPECT_TRUE(f["upper"][0].is_null());
  EXPECT_EQ(json["bands"][1]["unit_argument"], "deg/s");
  EXPECT_EQ(json["bands"][2]["unit_value"], "1");
  EXPECT_DOUBLE_EQ(json["bands"][2]["value"][0], 3.0);
  EXPECT_DOUBLE_EQ(json["domain_of_validity"]["h"]["to"], 1.0);
}

TEST(EstimateJson, HasNullForWhatWasNotComputed) {
  const auto json = to_json(estimate_with_bands(), {});
  EXPECT_EQ(json.begin().key(), "schema");
  EXPECT_EQ(json["schema"], "flexspline-estimate/1");
  EXPECT_EQ(json["termination"], "converged");
  EXPECT_TRUE(json["cost"].is_null());
  EXPECT_TRUE(json["seconds"].is_null());
  EXPECT_TRUE(json["parameters"][0]["ci95"][1].is_null());
  EXPECT_EQ(json["parameters"][0]["value"], 2.0);
  EXPECT_EQ(json["rmse"]["train"]["one"], 0.5);
  EXPECT_EQ(json["rmse"]["holdout"]["two"], 0.75);
  EXPECT_EQ(json["identifiability"]["verdict"], "not_computed");
}

}  // namespace
}  // namespace flexspline::data
