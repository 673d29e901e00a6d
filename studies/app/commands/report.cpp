#include "flexspline/reports/report.hpp"

#include <nlohmann/json.hpp>

#include "command.hpp"

namespace flexspline::app {
namespace {

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto page = reports::write_report(arguments.text("dir"));
  if (!page) return tl::unexpected(page.error());
  console.result(console.json ? nlohmann::ordered_json{{"report", page->string()}}.dump(2)
                              : page->string());
  return kDone;
}

}  // namespace

CommandRow describe_report() {
  return {.id = "report",
          .summary = "Draws the report again from the artefacts alone",
          .arguments = {{.name = "dir",
                         .meaning = "folder of a run, fit, comparison, diagnosis or trial",
                         .value = "DIR",
                         .required = true}},
          .example = "flexspline report out/paper",
          .run = run};
}

}  // namespace flexspline::app
