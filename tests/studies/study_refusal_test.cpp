#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/studies/study_config.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;

struct Refusal {
  std::string name;
  std::string text;
  std::string place;  ///< ":line:column:" of the first finding
  std::string problem;
  std::string remedy;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

class StudyRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(StudyRefusal, NamesPlaceProblemAndRemedy) {
  const ScratchFolder folder;
  const auto file = folder.write("study.toml", GetParam().text);
  const auto reading = read_study(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_FALSE(reading->study.has_value());
  ASSERT_FALSE(reading->errors.empty());
  const std::string message = reading->errors.front().message();
  EXPECT_THAT(message, HasSubstr("study.toml" + GetParam().place));
  EXPECT_THAT(message, HasSubstr(GetParam().problem));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

INSTANTIATE_TEST_SUITE_P(
    All, StudyRefusal,
    testing::Values(
        Refusal{"not_toml", "schema = \n", ":1:", "", "not TOML"},
        Refusal{"unknown_key", kHead + "replicats = 2\n" + kGrid + kInput + kEstimator,
                ":3:1:", "unknown key 'replicats'", "did you mean 'replicates'?"},
        Refusal{"unknown_bench_key",
                kHead + "[bench]\nangle_nois = { value = 1, unit = \"%\" }\n" + kGrid + kInput +
                    kEstimator,
                ":4:1:", "unknown key 'bench.angle_nois'", "did you mean 'angle_noise'?"},
        Refusal{"unknown_input_key", kHead + kGrid + kInput + "hold = \"point\"\n" + kEstimator,
                ":11:1:", "unknown key 'input[1].hold'", ""},
        Refusal{"wrong_schema",
                "schema = \"flexspline-study/2\"\nname = \"x\"\n" + kGrid + kInput + kEstimator,
                ":1:10:", "flexspline-study/2", "flexspline-study/1"},
        Refusal{"wrong_dimension",
                kHead + "[bench]\nangle_noise = { value = 1, unit = \"deg\" }\n" + kGrid + kInput +
                    kEstimator,
                ":4:", "is a unit of angle, not of dimensionless", "%"},
        Refusal{"no_such_unit",
                kHead + "[bench]\nencoder_step = { value = 1, unit = \"degree\" }\n" + kGrid +
                    kInput + kEstimator,
                ":4:", "\"degree\" is not a unit", "deg"},
        Refusal{"no_unit", kHead + "[bench]\nencoder_step = 0.1\n" + kGrid + kInput + kEstimator,
                ":4:16:", "'bench.encoder_step' has no unit", "{ value = …"},
        Refusal{"negative",
                kHead + "[bench]\nencoder_step = { value = -1, unit = \"deg\" }\n" + kGrid +
                    kInput + kEstimator,
                ":4:", "too small", "at least 0"},
        Refusal{"empty_grid",
                kHead +
                    "[[grid]]\nid = \"point\"\namplitude = { values = [], unit = \"deg\" }\n"
                    "frequency = { values = [0.005], unit = \"Hz\" }\n" +
                    kInput + kEstimator,
                ":5:", "'grid[1].amplitude.values' is empty", "at least one"},
        Refusal{"grid_without_loops", kHead + "[[grid]]\nid = \"point\"\n" + kInput + kEstimator,
                ":4:", "grid 'point' is empty", "amplitude and frequency"},
        Refusal{"negative_amplitude",
                kHead +
                    "[[grid]]\nid = \"point\"\nloops = { values = [[-0.2, 0.005]], units = "
                    "[\"deg\", \"Hz\"] }\n" +
                    kInput + kEstimator,
                ":5:", "not a positive amplitude", "[0.2, 0.005]"},
        Refusal{"swapped_units",
                kHead +
                    "[[grid]]\nid = \"point\"\nloops = { values = [[0.2, 0.005]], units = [\"Hz\", "
                    "\"deg\"] }\n" +
                    kInput + kEstimator,
                ":5:", "not a unit of angle and one of frequency", "deg"},
        Refusal{"repeated_loop",
                kHead +
                    "[[grid]]\nid = \"point\"\nloops = { values = [[0.2, 0.005], [0.2, 0.005]], "
                    "units = [\"deg\", "
                    "\"Hz\"] }\n" +
                    kInput + kEstimator,
                ":4:", "twice", "once"},
        Refusal{"duplicate_grid", kHead + kGrid + kGrid + kInput + kEstimator,
                ":8:6:", "was given before", "unique"},
        Refusal{"duplicate_input", kHead + kGrid + kInput + kInput + kEstimator,
                ":12:6:", "was given before", "unique"},
        Refusal{"id_with_slash",
                kHead + kGrid + "[[input]]\nid = \"a/b\"\ntruth = \"unity\"\n" + kEstimator,
                ":8:6:", "cannot name a file", "letters"},
        Refusal{"no_such_truth",
                kHead + kGrid + "[[input]]\nid = \"a\"\ntruth = \"unitty\"\n" + kEstimator,
                ":9:9:", "there is no truth 'unitty'", "did you mean 'unity'?"},
        Refusal{"truth_and_dataset",
                kHead + kGrid + "[[input]]\nid = \"a\"\ntruth = \"unity\"\ndataset = \"b\"\n" +
                    kEstimator,
                ":8:", "either a truth or a dataset", "one of"},
        Refusal{"no_such_holdout",
                kHead + kGrid + "[[input]]\nid = \"a\"\ntruth = \"unity\"\nholdout = \"pont\"\n" +
                    kEstimator,
                ":10:11:", "is not a grid", "did you mean 'point'?"},
        Refusal{"no_such_method",
                kHead + kGrid + kInput +
                    "[[estimator]]\nid = \"p\"\nmethod = \"midpoint\"\ntrain = \"point\"\n",
                ":13:10:", "there is no estimator method 'midpoint'", "midpoint_polynomial"},
        Refusal{
            "no_such_train",
            kHead + kGrid + kInput +
                "[[estimator]]\nid = \"p\"\nmethod = \"midpoint_polynomial\"\ntrain = \"pint\"\n",
            ":14:9:", "is not a grid", "did you mean 'point'?"},
        Refusal{"no_train_for_bench",
                kHead + kGrid + kInput +
                    "[[estimator]]\nid = \"p\"\nmethod = \"midpoint_polynomial\"\n",
                ":", "names no grid to train on", "train ="},
        Refusal{"model_that_nobody_takes",
                kHead + kGrid + kInput + kEstimator + "model = \"a.toml\"\n", ":", "takes no model",
                "model_file"},
        Refusal{"no_model",
                kHead + kGrid + kInput +
                    "[[estimator]]\nid = \"p\"\nmethod = \"model_file\"\ntrain = \"point\"\n",
                ":", "fits a model and is given none", "add model"},
        Refusal{"held_out_of_a_truth",
                kHead + kGrid + "[[input]]\nid = \"a\"\ntruth = \"unity\"\nheld_out = [\"b\"]\n" +
                    kEstimator,
                ":10:", "is no data set", "holdout"},
        Refusal{"unknown_option", kHead + kGrid + kInput + kEstimator + "options = { speed = 3 }\n",
                ":15:", "speed", ""},
        Refusal{"unknown_input_of_estimator",
                kHead + kGrid + kInput + kEstimator + "inputs = [\"unit\"]\n",
                ":15:", "names no input 'unit'", "did you mean 'unity'?"},
        Refusal{"no_estimator", kHead + kGrid + kInput, ":", "no estimator", "[[estimator]]"},
        Refusal{"fractional_seed", kHead + "seed = 1.5\n" + kGrid + kInput + kEstimator,
                ":3:8:", "'seed' is not a whole number", ""}),
    [](const auto& row) { return row.param.name; });

TEST(StudyReading, SaysEverythingWrongAtOnceInOrder) {
  const ScratchFolder folder;
  const auto file = folder.write("study.toml", kHead + "sed = 1\n" + kGrid + kInput +
                                                   "colour = 1\n" + kEstimator + "trian = 1\n");
  const auto reading = read_study(file);
  ASSERT_TRUE(reading.has_value());
  ASSERT_EQ(reading->errors.size(), 3U);
  EXPECT_LT(reading->errors[0].line, reading->errors[1].line);
  EXPECT_LT(reading->errors[1].line, reading->errors[2].line);
}

TEST(StudyReading, TakesUnitsToSi) {
  const ScratchFolder folder;
  const auto study = load_study(folder.write("study.toml", kHead + kGrid + kInput + kEstimator));
  ASSERT_TRUE(study.has_value());
  ASSERT_EQ(study->grids.size(), 1U);
  EXPECT_NEAR(study->grids[0].loops[0].amplitude, 0.2 * 3.14159265358979 / 180.0, 1e-15);
  EXPECT_EQ(recording_id(study->grids[0].loops[0]), "a0.2000-f0.00500");
}

TEST(StudyReading, MissingFileIsAMissingInput) {
  const auto reading = read_study("/nowhere/study.toml");
  ASSERT_FALSE(reading.has_value());
  EXPECT_EQ(reading.error().code, ErrorCode::input_missing);
}

}  // namespace
}  // namespace flexspline::studies
