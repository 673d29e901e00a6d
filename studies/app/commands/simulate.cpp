#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "output_folder.hpp"
#include "quantity_text.hpp"
#include "simulated_set.hpp"

namespace flexspline::app {
namespace {

Result<Direction> direction_of(const Arguments& arguments) {
  const std::string given = arguments.text("direction", "torque");
  if (given == "torque") return Direction::torque;
  if (given == "torsion") return Direction::torsion;
  return failure(ErrorCode::usage, fmt::format("--direction '{}' is not known", given),
                 "torque: from the motion, eq. (4); torsion: from the torque, eq. (3)");
}

Result<std::vector<Excitation>> sine(const Arguments& arguments, Direction direction) {
  if (arguments.text("excitation") != "sine") {
    return failure(ErrorCode::usage,
                   arguments.has("excitation")
                       ? fmt::format("--excitation '{}' is not known", arguments.text("excitation"))
                       : "nothing says what drives the simulation",
                   "give --excitation sine, or --like DATASET");
  }
  const auto amplitude =
      parse_quantity("amplitude", arguments.text("amplitude"),
                     direction == Direction::torque ? Dimension::angle : Dimension::torque);
  if (!amplitude) return tl::unexpected(amplitude.error());
  const auto frequency =
      parse_quantity("frequency", arguments.text("frequency"), Dimension::frequency);
  if (!frequency) return tl::unexpected(frequency.error());
  if (!(*amplitude > 0.0) || !(*frequency > 0.0)) {
    return failure(ErrorCode::usage, "--amplitude and --frequency have to be positive");
  }
  const auto cycles = arguments.integer("cycles", 3, 1, 10000);
  if (!cycles) return tl::unexpected(cycles.error());
  const auto samples = arguments.integer("samples", 500, 16, 1000000);
  if (!samples) return tl::unexpected(samples.error());
  return std::vector{sine_excitation(*amplitude, *frequency, *cycles, *samples, direction)};
}

/// A model with a table [rig] simulates that rig; one without, the torsion law.
Result<RecordingSet> simulated(const RigModel& model, const Arguments& arguments,
                               Direction direction) {
  const ModelSpec& torsion = model.drive.torsion;
  if (!arguments.has("like")) {
    const auto excitations = sine(arguments, direction);
    if (!excitations) return tl::unexpected(excitations.error());
    return simulate_set(torsion, *excitations, direction, {});
  }
  const auto set = data::load_dataset(arguments.text("like"), data::kAllRows);
  if (!set) return tl::unexpected(set.error());
  if (model.rig != Rig::specimen) return simulate_rig_set(model, *set, direction);
  const auto excitations = excitations_like(*set);
  if (!excitations) return tl::unexpected(excitations.error());
  return simulate_set(torsion, *excitations, direction, set->display);
}

/// A folder for what the model gives; neither it nor the data set it follows is written to.
Result<OutputFolder> claim_for(const Arguments& arguments) {
  const std::filesystem::path model = arguments.text("model");
  const auto text = read_file(model);
  if (!text) return tl::unexpected(text.error());
  OutputWish wish{
      "simulate", arguments.text("out"), model.filename().string(), data::sha256_hex(*text), model,
      {model},    arguments.has("force")};
  if (arguments.has("like")) wish.read.emplace_back(arguments.text("like"));
  return OutputFolder::claim(wish);
}

std::vector<std::string> tables_in(const std::filesystem::path& folder) {
  std::vector<std::string> names = {"dataset.toml"};
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() == ".csv") names.push_back(entry.path().filename().string());
  }
  return names;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto direction = direction_of(arguments);
  if (!direction) return tl::unexpected(direction.error());
  const auto model = data::read_rig_model(arguments.text("model"));
  if (!model) return tl::unexpected(model.error());
  auto set = simulated(*model, arguments, *direction);
  if (!set) return tl::unexpected(set.error());
  const auto beyond = extrapolation(model->drive.torsion, *set);
  if (!beyond) return tl::unexpected(beyond.error());
  if (beyond->far && !arguments.has("extrapolate")) {
    return failure(ErrorCode::bad_data, beyond->says,
                   "stay within the ranges (valid_to in the model file), or add --extrapolate");
  }
  if (!beyond->says.empty()) console.say(beyond->says);
  set->note = beyond->says;
  const std::string folder = arguments.text("out");
  auto output = claim_for(arguments);
  if (!output) return tl::unexpected(output.error());
  const auto written = data::write_dataset(folder, *set);
  if (!written) return tl::unexpected(written.error());
  if (auto done = output->finish(tables_in(folder)); !done) return tl::unexpected(done.error());
  console.result(console.json ? nlohmann::ordered_json{{"dataset", folder},
                                                       {"recordings", set->recordings.size()}}
                                    .dump(2)
                              : folder);
  return kDone;
}

}  // namespace

CommandRow describe_simulate() {
  return {
      .id = "simulate",
      .group = "Models",
      .summary = "A trajectory of a model, as a data set",
      .arguments =
          {{.name = "model", .meaning = "model file", .value = "MODEL.toml", .required = true},
           {.name = "--like",
            .meaning = "take the excitation of this data set",
            .value = "DATASET"},
           {.name = "--excitation", .meaning = "sine", .value = "KIND"},
           {.name = "--amplitude",
            .meaning = "e.g. 0.2deg; for --direction torsion e.g. 16Nm",
            .value = "VALUE"},
           {.name = "--frequency", .meaning = "e.g. 0.005Hz", .value = "VALUE"},
           {.name = "--cycles", .meaning = "default 3", .value = "N"},
           {.name = "--samples", .meaning = "a cycle; default 500", .value = "N"},
           {.name = "--direction",
            .meaning = "torque from motion (default), or torsion from torque",
            .value = "torque|torsion"},
           {.name = "--extrapolate",
            .meaning = "also where no recording supports the model; the data set says so",
            .value = {}},
           {.name = "--out", .meaning = "folder of the data set", .value = "DIR", .required = true},
           kForce},
      .example =
          "flexspline simulate model.toml --excitation sine --amplitude 0.2deg --frequency "
          "0.005Hz --out out/sine",
      .run = run};
}

}  // namespace flexspline::app
