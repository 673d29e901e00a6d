#include "flexspline/studies/planned_study.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

constexpr double kPilotSeconds = 2.0;
constexpr std::size_t kMostListed = 10'000;  // cases, where nobody asks for more

std::string as_json(const studies::PlannedStudy& study, const studies::Pilot& pilot, bool list) {
  ordered_json text = {{"study", study.name()}, {"kind", study.kind()}, {"count", study.size()}};
  text.update(study.summary());
  text.update({{"measured_cases", pilot.measured},
               {"estimated_seconds_one_worker", pilot.seconds},
               {"estimated_bytes", pilot.bytes}});
  if (list || study.size() <= kMostListed) {
    text["cases"] = ordered_json::array();
    for (std::size_t i = 0; i < study.size(); ++i) text["cases"].push_back(study.case_summary(i));
  }
  return text.dump(2);
}

std::string duration_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

/// "unique_fits 4, seeds 1": what is one word or number long.
std::string short_facts(const ordered_json& facts) {
  std::vector<std::string> words;
  for (const auto& [key, value] : facts.items()) {
    if (value.is_structured()) continue;
    words.push_back(
        fmt::format("{} {}", key, value.is_string() ? std::string(value) : value.dump()));
  }
  std::string text = fmt::format("{}", fmt::join(words, ", "));
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::string summary_text(const studies::PlannedStudy& study, const studies::Pilot& pilot) {
  ordered_json summary = study.summary();
  std::string text = fmt::format("{} ({}): {} cases", study.name(), study.kind(), study.size());
  if (const auto fits = summary.find("unique_fits"); fits != summary.end()) {
    text += fmt::format(", {} different fits", fits->dump());
    summary.erase(fits);
  }
  text += fmt::format("\nabout {} on one worker and {:.3g} MB, from {} case{} measured now\n{}",
                      duration_text(pilot.seconds), pilot.bytes / 1e6, pilot.measured,
                      pilot.measured == 1 ? "" : "s",
                      short_facts(summary.contains("design") ? summary["design"] : summary));
  for (const ordered_json& sweep : summary.value("sweeps", ordered_json::array())) {
    text += fmt::format("\nsweep of {}: {} points",
                        fmt::join(sweep["keys"].get<std::vector<std::string>>(), ", "),
                        sweep["points"].get<std::size_t>());
  }
  for (const auto& [input, note] : study.notes()) text += fmt::format("\n{}: {}", input, note);
  return text;
}

void print_list(const studies::PlannedStudy& study, Console& console) {
  for (std::size_t i = 0; i < study.size(); ++i) {
    const ordered_json one = study.case_summary(i);
    std::string line =
        fmt::format("{:<52} {:>6}", one["key"].get<std::string>(), one["seed"].dump());
    for (const char* key : {"generator", "rig"}) {
      if (one.contains(key)) line += "  " + one[key].get<std::string>();
    }
    if (one.contains("train")) {
      line += fmt::format("  {:>3} held out, trained on {}", one["holdout"].size(),
                          fmt::join(one["train"].get<std::vector<std::string>>(), " "));
    }
    console.result(line);
  }
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto study =
      studies::plan_file(arguments.text("study"), arguments.text("data-root"), build_id());
  if (!study) return tl::unexpected(study.error());
  const studies::Pilot pilot = (*study)->pilot(kPilotSeconds);
  const bool list = arguments.has("list");
  console.result(console.json ? as_json(**study, pilot, list) : summary_text(**study, pilot));
  if (list && !console.json) print_list(**study, console);
  return kDone;
}

}  // namespace

CommandRow describe_plan() {
  return {
      .id = "plan",
      .group = "Studies",
      .summary =
          "What run would do: cases, seeds, time and disk as measured on a few of them; "
          "writes nothing",
      .arguments = {{.name = "study",
                     .meaning = "study or trial file",
                     .value = "STUDY.toml",
                     .required = true},
                    {.name = "--list", .meaning = "every case, too", .value = {}},
                    {.name = "--data-root",
                     .meaning =
                         "where relative data-set paths start; default: the study file's folder",
                     .value = "DIR"}},
      .example = "flexspline plan studies/paper.toml",
      .run = run};
}

}  // namespace flexspline::app
