#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "effect_json.hpp"
#include "effect_pages.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::app {
namespace {

Result<const EffectRow*> effect_named(const std::string& name) {
  std::vector<std::string_view> names;
  for (const EffectRow& row : effects()) {
    if (row.id == name) return &row;
    names.push_back(row.id);
  }
  return failure(ErrorCode::usage, fmt::format("there is no effect '{}'", name),
                 suggestion(name, names));
}

/// A terminal shows the equation as the catalogue writes it.
std::string page_for_terminal(const EffectRow& row) {
  const std::string text = effect_text(row, fmt::format("    {}", row.equation));
  return text.substr(0, text.find_last_not_of('\n') + 1);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto row = effect_named(arguments.text("effect"));
  if (!row) return tl::unexpected(row.error());
  console.result(console.json ? effect_json(**row).dump(2) : page_for_terminal(**row));
  return kDone;
}

}  // namespace

CommandRow describe_explain() {
  return {.id = "explain",
          .group = "Models",
          .summary = "An effect's equation, parameters, range, source, and what it leaves out",
          .arguments = {{.name = "effect",
                         .meaning = "id, see flexspline list effects",
                         .value = "EFFECT",
                         .required = true}},
          .example = "flexspline explain backlash",
          .run = run};
}

}  // namespace flexspline::app
