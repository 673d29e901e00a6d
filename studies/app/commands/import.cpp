#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/import.hpp"
#include "flexspline/data/sanity.hpp"
#include "import_wish.hpp"
#include "output_folder.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

ordered_json plan_json(const data::ImportPlan& plan) {
  ordered_json inferred = ordered_json::array();
  for (const data::Inference& one : plan.inferred) {
    inferred.push_back({{"what", one.what},
                        {"certainty", data::name_of(one.certainty)},
                        {"evidence", one.evidence}});
  }
  ordered_json open = ordered_json::array();
  for (const data::OpenQuestion& one : plan.open) {
    open.push_back({{"problem", one.problem}, {"remedy", one.remedy}});
  }
  return {{"rig", plan.rig ? ordered_json(name_of(*plan.rig)) : ordered_json(nullptr)},
          {"constants", plan.constants},
          {"inferred", inferred},
          {"notes", plan.notes},
          {"open", open}};
}

void print_plan(const data::ImportPlan& plan, Console& console) {
  for (const data::Inference& one : plan.inferred) {
    console.result(
        fmt::format("{}  ({}: {})", one.what, data::name_of(one.certainty), one.evidence));
  }
  for (const std::string& note : plan.notes) console.result("note: " + note);
  for (const data::OpenQuestion& one : plan.open) {
    console.result(fmt::format("open: {}; {}", one.problem, one.remedy));
  }
}

/// Of every file, by its content: the same files under other names are the same input.
Result<std::string> sha256_of(const std::vector<fs::path>& files) {
  data::Sha256 sum;
  for (const fs::path& file : files) {
    if (auto added = sum.add_file(file); !added) return tl::unexpected(added.error());
  }
  return sum.hex();
}

/// What an earlier import left in the folder; nothing where it holds something else.
std::optional<data::Manifest> earlier_import(const fs::path& folder) {
  const auto manifest = data::read_manifest(folder);
  if (!manifest || !manifest->finished || manifest->command != "import") return std::nullopt;
  return *manifest;
}

/// What a person mended in the folder is theirs.
Result<void> refuse_mended(const fs::path& folder, const data::Manifest& earlier) {
  for (const data::ChangedFile& one : data::changed_files(folder, earlier)) {
    if (one.missing) continue;
    return failure(
        ErrorCode::cannot_write,
        fmt::format("{} was changed since it was imported", (folder / one.file).string()),
        "import to another folder, or add --force to lose the change");
  }
  return {};
}

/// Recordings of an earlier import that this one does not write.
void remove_left_over(const fs::path& folder, const data::Manifest& earlier,
                      const std::vector<std::string>& written) {
  for (const auto& [name, sum] : earlier.files) {
    if (std::ranges::find(written, name) != written.end() || !name.ends_with(".csv")) continue;
    std::error_code ignored;
    fs::remove(folder / name, ignored);
  }
}

bool may_write(const data::ImportPlan& plan, const Arguments& arguments, const Console& console) {
  const bool open_guess = std::ranges::any_of(plan.inferred, [](const data::Inference& one) {
    return one.certainty == data::Certainty::likely;
  });
  if (!open_guess || arguments.has("yes") || console.json || isatty(STDIN_FILENO) == 0 ||
      isatty(STDERR_FILENO) == 0) {
    return true;
  }
  std::cerr << "Some of this is likely, not sure. Write it? [Y/n] " << std::flush;
  std::string answer;
  std::getline(std::cin, answer);
  return answer.empty() || answer[0] == 'y' || answer[0] == 'Y';
}

/// What read_dataset and the sanity checks find in what was written.
struct Looked {
  std::vector<std::string> errors;
  std::vector<std::string> notes;
};

Looked look_at(const fs::path& folder) {
  Looked looked;
  const data::DatasetReading reading = data::read_dataset(folder);
  for (const auto& one : reading.errors) looked.errors.push_back(one.message());
  for (const auto& one : reading.notes) looked.notes.push_back(one.message());
  if (!reading.set) return looked;
  for (const data::SanityFinding& one : data::sanity_of(*reading.set)) {
    const bool error = one.severity == data::Severity::error;
    std::string message = one.message();
    if (error) message += fmt::format("; if it is no mistake: --accept {}", one.check);
    (error ? looked.errors : looked.notes).push_back(std::move(message));
  }
  return looked;
}

ExitCode report(const fs::path& folder, const data::ImportPlan& plan,
                const data::Imported& imported, Console& console) {
  const Looked looked = look_at(folder);
  const bool sound = looked.errors.empty();
  if (console.json) {
    ordered_json said = plan_json(plan);
    said["dataset"] = folder.string();
    said["recordings"] = imported.recordings;
    said["done"] = imported.notes;
    said["errors"] = looked.errors;
    said["findings"] = looked.notes;
    console.result(said.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    return sound ? kDone : static_cast<ExitCode>(ErrorCode::bad_data);
  }
  for (const std::string& note : imported.notes) console.result("note: " + note);
  for (const std::string& note : looked.notes) console.result("note: " + note);
  for (const std::string& error : looked.errors) console.result("error: " + error);
  console.result(
      fmt::format("{}: {} recording{}{}", folder.string(), imported.recordings.size(),
                  imported.recordings.size() == 1 ? "" : "s",
                  sound ? "" : "; no physics is read out of it until the errors are mended"));
  return sound ? kDone : static_cast<ExitCode>(ErrorCode::bad_data);
}

Result<ExitCode> write(const data::ImportPlan& plan, const Arguments& arguments, Console& console) {
  const fs::path folder = arguments.text("out");
  const auto sum = sha256_of(plan.wish.files);
  if (!sum) return tl::unexpected(sum.error());
  OutputWish wish{"import",
                  folder,
                  plan.wish.files[0].filename().string(),
                  *sum,
                  plan.wish.files[0],
                  plan.wish.files,
                  arguments.has("force")};
  const auto earlier = earlier_import(folder);
  if (earlier && !wish.force) {
    if (auto kept = refuse_mended(folder, *earlier); !kept) return tl::unexpected(kept.error());
  }
  auto output = OutputFolder::claim(wish);
  if (!output) return tl::unexpected(output.error());
  const auto imported = data::write_import(plan, folder);
  if (!imported) return tl::unexpected(imported.error());
  if (earlier) remove_left_over(folder, *earlier, imported->files);
  if (auto done = output->finish(imported->files); !done) return tl::unexpected(done.error());
  return report(folder, plan, *imported, console);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto wish = import_wish(arguments);
  if (!wish) return tl::unexpected(wish.error());
  const auto plan = data::plan_import(*wish);
  if (!plan) return tl::unexpected(plan.error());
  const bool planned_only = arguments.has("dry-run") || !plan->open.empty();
  if (!console.json) print_plan(*plan, console);
  if (console.json && planned_only) {
    console.result(plan_json(*plan).dump(2, ' ', false, ordered_json::error_handler_t::replace));
  }
  if (!plan->open.empty()) {
    console.error(fmt::format("nothing is written: {} question{} above", plan->open.size(),
                              plan->open.size() == 1 ? " is open" : "s are open,"));
    return static_cast<ExitCode>(ErrorCode::bad_data);
  }
  if (planned_only) return kDone;
  if (!may_write(*plan, arguments, console)) return kSomethingFailed;
  return write(*plan, arguments, console);
}

}  // namespace

CommandRow describe_import() {
  return {
      .id = "import",
      .group = "Start",
      .summary =
          "Makes a data set from files as benches write them: says what it found out, how sure "
          "it is, and what it cannot know",
      .arguments =
          {{.name = "files",
            .meaning = "files of a bench; see flexspline list readers",
            .value = "FILE",
            .required = true,
            .repeats = true},
           {.name = "--out",
            .meaning = "folder of the data set",
            .value = "DATASET",
            .required = true},
           {.name = "--rig",
            .meaning = "which bench, where the columns do not tell",
            .value = "locked|free|specimen|servo"},
           {.name = "--ratio", .meaning = "gear ratio, motor turns per output turn", .value = "N"},
           {.name = "--motor-inertia", .meaning = "of motor and wave generator", .value = "KGM2"},
           {.name = "--load-inertia", .meaning = "at the output", .value = "KGM2"},
           {.name = "--map",
            .meaning = "what a column is: tau=col4:Nm, theta_m=Winkel:-deg (sign turned), "
                       "theta_l=q:counts/4096, tau_m=none",
            .value = "QUANTITY=COLUMN[:UNIT]",
            .repeats = true},
           {.name = "--table",
            .meaning = "the table inside the files, by its path; all that fit where absent",
            .value = "PATH",
            .repeats = true},
           {.name = "--join",
            .meaning = "the tables of a file are of one recording: at the instants of the slowest",
            .value = {}},
           {.name = "--split",
            .meaning = "rests and pauses of so many seconds end a recording",
            .value = "SECONDS"},
           {.name = "--accept",
            .meaning = "a finding that is no mistake here; kept in the data set",
            .value = "CODE",
            .repeats = true},
           {.name = "--delimiter", .meaning = "of a text: ; , | tab blank", .value = "MARK"},
           {.name = "--decimal", .meaning = "mark of a text's numbers: . or ,", .value = "MARK"},
           {.name = "--header-line", .meaning = "of a text, where its names stand", .value = "N"},
           {.name = "--name", .meaning = "of the data set; else the folder's", .value = "NAME"},
           {.name = "--license", .meaning = "SPDX id of the data set's license", .value = "ID"},
           {.name = "--dry-run", .meaning = "says what it would do; writes nothing", .value = {}},
           {.name = "--yes", .meaning = "asks nothing", .value = {}},
           kForce},
      .example = "flexspline import messung_03.csv --out my-gear --ratio 100",
      .run = run};
}

}  // namespace flexspline::app
