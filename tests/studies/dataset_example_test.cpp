#include <sstream>

#include <gmock/gmock.h>
#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "flexspline/data/dataset.hpp"
#include "json_schema.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kSource = FLEXSPLINE_SOURCE_DIR;
const std::string kExample = kSource + "/docs/examples/locked-gear";

json json_of_toml(const std::string& text) {
  std::ostringstream out;
  out << toml::json_formatter{toml::parse(text)};
  return json::parse(out.str());
}

class DatasetExample : public CommandLine {
 protected:
  JsonSchema schema(const std::string& name) const {
    const Finished done = call("schema " + name);
    EXPECT_EQ(done.code, 0) << done.output;
    return JsonSchema(json::parse(done.result));
  }
};

TEST_F(DatasetExample, IsWhatThePageShows) {
  const std::string page = read_text(kSource + "/docs/dataset.md");
  const std::string fence = "```toml\n";
  const auto from = page.find(fence) + fence.size();
  EXPECT_EQ(page.substr(from, page.find("```", from) - from),
            read_text(kExample + "/dataset.toml"));
  const data::DatasetReading reading = data::read_dataset(kExample);
  for (const data::Finding& error : reading.errors) ADD_FAILURE() << error.message();
  EXPECT_THAT(reading.notes, testing::IsEmpty());
}

TEST_F(DatasetExample, IsUnderstoodByValidate) {
  const Finished done = call("validate --json " + kExample);
  ASSERT_EQ(done.code, 0) << done.output;
  const json understood = json::parse(done.result).at("understood");
  EXPECT_EQ(understood.at("rig"), "locked");
  EXPECT_EQ(understood.at("constants").at("gear_ratio"), 50.0);
  const auto set = data::read_dataset(kExample).set;
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(understood.at("recordings").size(), set->recordings.size());
  for (std::size_t r = 0; r < set->recordings.size(); ++r) {
    const Recording& recording = set->recordings[r];
    const json& said = understood.at("recordings").at(r);
    EXPECT_EQ(said.at("rows"), recording.time.size());
    const double duration = recording.time.back() - recording.time.front();
    EXPECT_DOUBLE_EQ(said.at("duration_s").get<double>(), duration);
    EXPECT_NEAR(said.at("rate_hz").get<double>() * duration,
                static_cast<double>(recording.time.size() - 1), 1e-9);
    const auto& torque = *recording.find(Quantity::transmitted_torque);
    for (const json& channel : said.at("channels")) {
      if (channel.at("quantity") != "transmitted_torque") continue;
      EXPECT_EQ(channel.at("unit"), "Nm");
      EXPECT_EQ(channel.at("least").get<double>(), *std::ranges::min_element(torque));
      EXPECT_EQ(channel.at("greatest").get<double>(), *std::ranges::max_element(torque));
    }
    const json& excitation = said.at("excitation");
    const json& stated = excitation.at("stated");
    const json& measured = excitation.at("measured");
    const auto share = [&](const char* key) {
      return measured.at(key).get<double>() / stated.at(key).get<double>();
    };
    EXPECT_NEAR(share("frequency_hz"), 1.0, 0.02) << recording.id;
    EXPECT_NEAR(share("amplitude"), 1.0, 0.1) << recording.id << ", with its run-up from rest";
  }
  const Finished words = call("validate " + kExample);
  for (const char* part :
       {"locked rig, 4 recordings", "slow: 600 rows", "peak", "strongest sine"}) {
    EXPECT_THAT(words.result, HasSubstr(part));
  }
}

TEST_F(DatasetExample, IsDiagnosedAndEveryFileObeysItsSchema) {
  const JsonSchema dataset = schema("dataset");
  json description = json_of_toml(read_text(kExample + "/dataset.toml"));
  EXPECT_EQ(dataset.complaint(description), "");
  ASSERT_EQ(call("diagnose " + kExample + " --quiet --out " + path("d")).code, 0);
  const json diagnosis = json::parse(read_text(path("d/diagnosis.json")));
  EXPECT_EQ(schema("diagnosis").complaint(diagnosis), "");
  ASSERT_FALSE(diagnosis.at("causes").empty());
  EXPECT_EQ(diagnosis.at("causes").at(0).at("effect"), "presliding_hysteresis");
  ASSERT_EQ(
      call("fit " + kExample + " --estimator midpoint_polynomial --quiet --out " + path("f")).code,
      0);
  EXPECT_EQ(schema("estimate").complaint(json::parse(read_text(path("f/estimate.json")))), "");
  const JsonSchema model = schema("model");
  for (const char* file : {"d/model.toml", "f/model.toml"}) {
    EXPECT_EQ(model.complaint(json_of_toml(read_text(path(file)))), "") << file;
  }
}

TEST_F(DatasetExample, SchemaRefusesWhatTheReaderRefuses) {
  const JsonSchema dataset = schema("dataset");
  const json sound = json_of_toml(read_text(kExample + "/dataset.toml"));
  const auto complaint = [&](const std::string& place, const json& value) {
    json damaged = sound;
    damaged[json::json_pointer(place)] = value;
    return dataset.complaint(damaged);
  };
  EXPECT_EQ(complaint("/rig", "lockd"),
            "$/rig is none of [\"locked\",\"free\",\"specimen\",\"servo\"]");
  EXPECT_EQ(complaint("/constants/gear_ratio", 0), "$/constants/gear_ratio is at its open minimum");
  EXPECT_EQ(complaint("/constants/motor_inertia_kgm2", -1),
            "$/constants/motor_inertia_kgm2 is below its minimum");
  EXPECT_THAT(complaint("/channels/tau/sign", 2), HasSubstr("$/channels/tau/sign is none of"));
  EXPECT_THAT(complaint("/channels/tau/scael", 2), HasSubstr("has an unknown key scael"));
  EXPECT_EQ(complaint("/recording", json::array()), "$/recording has too few items");
  EXPECT_EQ(complaint("/recording/0/id", 7), "$/recording/0/id is of type number");
}

TEST_F(DatasetExample, RigsSayWhichChannelsTheirRecordingsNeed) {
  const Finished done = call("list rigs");
  for (const char* part :
       {"recordings need    time, motor_angle, transmitted_torque",
        "one of torsion, angle, displacement, one of transmitted_torque, torque, force",
        "one of motor_torque, or current, or duty_cycle with supply_voltage"}) {
    EXPECT_THAT(done.result, HasSubstr(part));
  }
}

}  // namespace
}  // namespace flexspline::studies
