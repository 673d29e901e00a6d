#include "flexspline/studies/status.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "run_folder.hpp"

namespace flexspline::app {
namespace {

std::string as_text(const studies::StudyStatus& status) {
  std::string text = fmt::format("{}: {} of {} cases done, {} failed, {} running", status.name,
                                 status.done, status.cases, status.failed, status.running.size());
  if (!std::isnan(status.left_seconds)) {
    text += fmt::format(", about {:.0f} s left", status.left_seconds);
  } else if (!status.complete()) {
    text += "; nobody works on it: the same command that began it goes on";
  }
  for (const studies::RunningShard& one : status.running) {
    text += fmt::format("\n  {} shard {}/{}: {}", one.who, one.shard.index, one.shard.count,
                        text_of(one.state));
    if (one.silent_for > 10.0) text += fmt::format(" (silent for {:.0f} s)", one.silent_for);
  }
  for (const std::string& failed : status.failures) text += "\n  failed: " + failed;
  for (const std::string& lost : status.damaged) {
    text += fmt::format("\n  {}: their cases are computed again", lost);
  }
  return text;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto status = studies::status_of(arguments.text("dir"));
  if (!status) return tl::unexpected(status.error());
  console.result(console.json ? to_json(*status).dump(2) : as_text(*status));
  return kDone;
}

}  // namespace

CommandRow describe_status() {
  return {.id = "status",
          .group = "Studies",
          .summary = "How far a study is, from any machine: done, running, failed, time left",
          .arguments =
              {{.name = "dir", .meaning = "folder of a run", .value = "DIR", .required = true}},
          .example = "flexspline status out/paper",
          .run = run};
}

}  // namespace flexspline::app
