#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
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

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto direction = direction_of(arguments);
  if (!direction) return tl::unexpected(direction.error());
  const auto model = data::read_model(arguments.text("model"));
  if (!model) return tl::unexpected(model.error());
  DisplayUnits units;
  Result<std::vector<Excitation>> excitations = std::vector<Excitation>{};
  if (arguments.has("like")) {
    const auto set = data::load_dataset(arguments.text("like"), data::kAllRows);
    if (!set) return tl::unexpected(set.error());
    units = set->display;
    excitations = excitations_like(*set);
  } else {
    excitations = sine(arguments, *direction);
  }
  if (!excitations) return tl::unexpected(excitations.error());
  const auto set = simulate_set(*model, *excitations, *direction, units);
  if (!set) return tl::unexpected(set.error());
  const std::string folder = arguments.text("out");
  const auto written = data::write_dataset(folder, *set);
  if (!written) return tl::unexpected(written.error());
  console.result(console.json ? nlohmann::ordered_json{{"dataset", folder},
                                                       {"recordings", set->recordings.size()}}
                                    .dump(2)
                              : folder);
  return kDone;
}

}  // namespace

CommandRow describe_simulate() {
  return {.id = "simulate",
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
               {.name = "--out",
                .meaning = "folder of the data set",
                .value = "DIR",
                .required = true}},
          .example =
              "flexspline simulate model.toml --excitation sine --amplitude 0.2deg --frequency "
              "0.005Hz --out out/sine",
          .run = run};
}

}  // namespace flexspline::app
