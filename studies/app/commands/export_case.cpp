#include <fmt/format.h>

#include "command.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/write_file.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"

namespace flexspline::app {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> no_case(const CaseStore& store, const std::string& key) {
  const auto keys = store.keys();
  const std::vector<std::string_view> names(keys.begin(), keys.end());
  return failure(ErrorCode::input_missing, fmt::format("there is no case '{}'", key),
                 suggestion(key, names));
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const fs::path folder = arguments.text("dir");
  const auto store = CaseStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  auto keys = arguments.texts("key");
  if (keys.empty() && !arguments.has("out")) {
    return failure(ErrorCode::usage, "neither a case nor --out is given",
                   "name a case, or a folder for all of them");
  }
  if (keys.empty()) keys = store->keys();
  for (const std::string& key : keys) {
    const auto one = store->read(key);
    if (!one && one.error().code == ErrorCode::input_missing) return no_case(*store, key);
    if (!one) return tl::unexpected(one.error());
    if (!arguments.has("out")) {
      console.result(one->artefact);
      continue;
    }
    const fs::path file = fs::path(arguments.text("out")) / (key + ".json");
    if (file_exists(file) && !arguments.has("force")) {
      return failure(ErrorCode::cannot_write, file.string() + " is there already",
                     "choose another folder, or add --force to replace it");
    }
    if (auto written = write_file(file, one->artefact + "\n"); !written) {
      return tl::unexpected(written.error());
    }
  }
  return kDone;
}

}  // namespace

CommandRow describe_export_case() {
  return {
      .id = "export-case",
      .group = "Studies",
      .summary =
          "Cases of a study as JSON (flexspline-case/1): one on the terminal, or all as files",
      .arguments = {{.name = "dir", .meaning = "folder of a run", .value = "DIR", .required = true},
                    {.name = "key",
                     .meaning = "of the case, see flexspline plan --list",
                     .value = "KEY"},
                    {.name = "--out", .meaning = "folder for <key>.json", .value = "FOLDER"},
                    kForce},
      .example = "flexspline export-case out/paper h_even--paper--r0",
      .run = run};
}

}  // namespace flexspline::app
