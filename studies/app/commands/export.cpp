#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/exporter.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/studies/export_error.hpp"
#include "output_folder.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using data::Carried;
using nlohmann::ordered_json;

/// An error as words; why there is none, where it could not be computed.
std::string measured(const RigModel& model, const RigModel& exported) {
  const auto error = studies::export_error(model, exported);
  if (!error) return "not measured: " + error.error().message();
  return fmt::format("{} off by {:.2g} % rms, {:.2g} % at most, of half its range", error->output,
                     100.0 * error->rms, 100.0 * error->largest);
}

std::vector<std::string> remarks_on(const RigModel& model, const Carried& carried,
                                    Console& console) {
  std::vector<std::string> remarks;
  for (const data::Lost& one : carried.lost) {
    console.progress(
        static_cast<double>(remarks.size()) / static_cast<double>(carried.lost.size() + 1),
        "simulating without " + one.what);
    remarks.push_back(
        fmt::format("not carried: {}: {}{}", one.what, one.why,
                    one.instrument ? "" : " (alone: " + measured(model, one.without) + ")"));
  }
  remarks.push_back(carried.lost.empty() ? "everything of the model is carried"
                                         : "all together, over 10 s within the model's domain: " +
                                               measured(model, carried.model));
  return remarks;
}

Result<std::vector<std::string>> held_out_remarks(const RigModel& model, const Carried& carried,
                                                  const std::string& folder) {
  const auto set = data::load_dataset(folder);
  if (!set) return tl::unexpected(set.error());
  const auto errors = studies::held_out_errors(model, carried.model, *set);
  if (!errors) return tl::unexpected(errors.error());
  std::vector<std::string> remarks;
  for (const studies::HeldOutError& one : *errors) {
    remarks.push_back(fmt::format("held-out {} of {}: rms error {:.4g} Nm, of the model {:.4g} Nm",
                                  name_of(one.torque), set->name, one.exported, one.model));
  }
  return remarks;
}

Result<std::string> identifier(const Arguments& arguments) {
  const std::string name = arguments.text("name", "drive");
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  for (char c : name) good = good && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_');
  if (good) return name;
  return failure(ErrorCode::usage, fmt::format("--name '{}' is no identifier", name),
                 "letters, digits and _, a letter first: it names C functions and files");
}

/// A folder for one form of one model, neither of which it writes to.
Result<OutputFolder> claim_for(const Arguments& arguments) {
  const std::filesystem::path model = arguments.text("model");
  const auto text = read_file(model);
  if (!text) return tl::unexpected(text.error());
  OutputWish wish{"export --to " + arguments.text("to"),
                  arguments.text("out"),
                  model.filename().string(),
                  data::sha256_hex(*text),
                  model,
                  {model},
                  arguments.has("force")};
  if (arguments.has("like")) wish.read.emplace_back(arguments.text("like"));
  return OutputFolder::claim(wish);
}

Result<void> write_files(const std::vector<data::ExportedFile>& files, OutputFolder& output,
                         const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const data::ExportedFile& file : files) {
    if (auto written = write_file(folder / file.path, file.content); !written) return written;
    names.push_back(file.path);
  }
  return output.finish(names);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto exporter = data::find_exporter(arguments.text("to"));
  if (!exporter) return tl::unexpected(exporter.error());
  const auto name = identifier(arguments);
  if (!name) return tl::unexpected(name.error());
  const auto model = data::read_rig_model(arguments.text("model"));
  if (!model) return tl::unexpected(model.error());
  const auto carried = (*exporter)->carry(*model);
  if (!carried) return tl::unexpected(carried.error());
  auto remarks = remarks_on(*model, *carried, console);
  if (arguments.has("like")) {
    const auto held_out = held_out_remarks(*model, *carried, arguments.text("like"));
    if (!held_out) return tl::unexpected(held_out.error());
    remarks.insert(remarks.end(), held_out->begin(), held_out->end());
  }
  data::ExportHead head{*name, remarks};
  head.remarks.insert(head.remarks.begin(),
                      fmt::format("from {}, rig {}", arguments.text("model"), name_of(model->rig)));
  const auto files = (*exporter)->write(carried->model, head);
  if (!files) return tl::unexpected(files.error());
  const std::filesystem::path folder = arguments.text("out");
  auto output = claim_for(arguments);
  if (!output) return tl::unexpected(output.error());
  if (auto written = write_files(*files, *output, folder); !written) {
    return tl::unexpected(written.error());
  }
  ordered_json paths = ordered_json::array();
  for (const auto& file : *files) paths.push_back((folder / file.path).string());
  console.result(console.json
                     ? ordered_json{{"files", paths}, {"remarks", remarks}}.dump(2)
                     : fmt::format("{}\n{}", fmt::join(remarks, "\n"),
                                   fmt::join(paths.get<std::vector<std::string>>(), "\n")));
  return kDone;
}

}  // namespace

CommandRow describe_export() {
  return {
      .id = "export",
      .group = "Models",
      .summary =
          "A model for other programs (MuJoCo, C, FMI, URDF, SDF, Simulink), with what "
          "the form could not carry and by how much",
      .arguments =
          {{.name = "model",
            .meaning = "model file, of diagnose or fit",
            .value = "MODEL.toml",
            .required = true},
           {.name = "--to",
            .meaning = "form, see flexspline list exporters",
            .value = "FORM",
            .required = true},
           {.name = "--out", .meaning = "folder for the files", .value = "DIR", .required = true},
           {.name = "--name", .meaning = "identifier in the files; default drive", .value = "NAME"},
           {.name = "--like",
            .meaning = "also compare the torques along this data set's held-out "
                       "recordings",
            .value = "DATASET"},
           kForce},
      .example = "flexspline export out/diagnosis/model.toml --to mjcf --out out/mujoco",
      .run = run};
}

}  // namespace flexspline::app
