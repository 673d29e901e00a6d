#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "command.hpp"
#include "embedded_text.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::app {
namespace {

namespace fs = std::filesystem;

/// What kind of template: rig stands for a data set of the rig that --rig names.
Result<const EmbeddedText*> template_of(const Arguments& arguments) {
  const std::string kind = arguments.text("kind");
  const std::string name = kind == "rig" ? arguments.text("rig", "locked") : kind;
  const auto found = std::ranges::find(templates(), name, &EmbeddedText::name);
  if (found != templates().end()) return &*found;
  std::vector<std::string_view> names{"rig"};
  for (const EmbeddedText& one : templates()) names.push_back(one.name);
  return failure(ErrorCode::usage, fmt::format("there is no template '{}'", name),
                 suggestion(name, names));
}

bool is_rig(std::string_view name) {
  return std::ranges::any_of(rigs(), [&](const RigRow& row) { return row.id == name; });
}

/// A data set is a folder, anything else one file.
fs::path target_of(const EmbeddedText& text, const std::string& name) {
  if (is_rig(text.name)) return fs::path(name) / "dataset.toml";
  return name.ends_with(".toml") ? fs::path(name) : fs::path(name + ".toml");
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto text = template_of(arguments);
  if (!text) return tl::unexpected(text.error());
  if (arguments.text("name").empty()) {
    return failure(ErrorCode::usage, "the name is empty", "give the file or folder to write");
  }
  const fs::path path = target_of(**text, arguments.text("name"));
  std::error_code ignored;
  if (fs::exists(path, ignored)) {
    return failure(ErrorCode::cannot_write, path.string() + " is there already",
                   "choose another name, or move it away");
  }
  if (auto written = write_file(path, (*text)->text); !written) {
    return tl::unexpected(written.error());
  }
  console.result(path.string());
  return kDone;
}

}  // namespace

CommandRow describe_init() {
  return {.id = "init",
          .group = "Start",
          .summary = "Writes a commented template: a data set for a rig, a study, or a bench",
          .arguments = {{.name = "kind",
                         .meaning = "rig (a data set), study, or bench (hides an effect)",
                         .value = "rig|study|bench",
                         .required = true},
                        {.name = "name",
                         .meaning = "file, or folder of a data set, that is written",
                         .value = "NAME",
                         .required = true},
                        {.name = "--rig",
                         .meaning = "the rig of the data set; see flexspline list rigs",
                         .value = "locked|free|specimen|servo"}},
          .example = "flexspline init rig my-gear --rig locked",
          .run = run};
}

}  // namespace flexspline::app
