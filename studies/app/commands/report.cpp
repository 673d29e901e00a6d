#include "flexspline/reports/report.hpp"

#include <nlohmann/json.hpp>

#include "command.hpp"
#include "output_folder.hpp"

namespace flexspline::app {
namespace {

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto page = reports::write_report(arguments.text("dir"));
  if (!page) return tl::unexpected(page.error());
  const std::vector<std::string> drawn = {"report", "tables", "index.html", "summary.html"};
  if (auto done = refresh_manifest(arguments.text("dir"), drawn); !done) {
    return tl::unexpected(done.error());
  }
  for (const std::string& one : page->left_out) console.error("not read: " + one);
  const std::string path = page->page.string();
  console.result(
      console.json ? nlohmann::ordered_json{{"report", path}, {"left_out", page->left_out}}.dump(2)
                   : path);
  return page->left_out.empty() ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_report() {
  return {.id = "report",
          .group = "Fit and diagnose",
          .summary = "Draws the report again from the artefacts alone",
          .arguments = {{.name = "dir",
                         .meaning = "folder of a run, fit, comparison, diagnosis or trial",
                         .value = "DIR",
                         .required = true}},
          .example = "flexspline report out/paper",
          .run = run};
}

}  // namespace flexspline::app
