#include <algorithm>

#include <fmt/format.h>

#include "command.hpp"
#include "embedded_text.hpp"
#include "flexspline/core/nearest_name.hpp"

namespace flexspline::app {
namespace {

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const std::string name = arguments.text("name");
  const auto found = std::ranges::find(schemas(), name, &EmbeddedText::name);
  if (found != schemas().end()) {
    console.result(found->text.substr(0, found->text.find_last_not_of('\n') + 1));
    return kDone;
  }
  std::vector<std::string_view> names;
  for (const EmbeddedText& schema : schemas()) names.push_back(schema.name);
  return failure(ErrorCode::usage, fmt::format("there is no schema '{}'", name),
                 suggestion(name, names));
}

}  // namespace

CommandRow describe_schema() {
  return {.id = "schema",
          .group = "Models",
          .summary = "Prints the JSON schema of a file format, for editors and checks",
          .arguments = {{.name = "name", .meaning = "study, …", .value = "NAME", .required = true}},
          .example = "flexspline schema study > study.schema.json",
          .run = run};
}

}  // namespace flexspline::app
