#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <thread>

#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/estimators/certified.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

constexpr double kSelfCheckSeconds = 5.0;

enum class Health { good, limited, broken };

/// One thing that was looked at.
struct Check {
  std::string name;
  Health health = Health::good;
  std::string found;
  std::string remedy{};
};

std::string_view name_of(Health health) {
  switch (health) {
    case Health::good:
      return "good";
    case Health::limited:
      return "limited";
    case Health::broken:
      break;
  }
  return "broken";
}

Check versions_found() {
  std::string list;
  for (const auto& [name, value] : versions()) {
    if (name != "build") list += fmt::format("{}{} {}", list.empty() ? "" : ", ", name, value);
  }
  return {"program", Health::good, list};
}

Check processors() {
  const unsigned count = std::max(1U, std::thread::hardware_concurrency());
  return {"processors", Health::good, fmt::format("{}: --jobs is {} by default", count, count)};
}

constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;

/// The largest resident set of a job, measured; how is in docs/performance.md.
struct Need {
  std::string_view job;
  double gibibytes;
};

constexpr Need kNeeds[] = {{"a diagnosis", 0.4}, {"the study of the paper", 0.4}};

/// What can be had without swapping: what is free, and what caches give back.
double available_gibibytes() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  double kibibytes = 0.0;
  while (file >> key >> kibibytes) {
    if (key == "MemAvailable:") return kibibytes * 1024.0 / kGibibyte;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGESIZE)) / kGibibyte;
}

Check memory() {
  const double all = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                     static_cast<double>(sysconf(_SC_PAGESIZE)) / kGibibyte;
  const double available = available_gibibytes();
  Check check{"memory", Health::good,
              fmt::format("{:.1f} GiB, of which {:.1f} can be had", all, available)};
  std::string too_large;
  for (const Need& need : kNeeds) {
    check.found += fmt::format("; {} takes {:.2g}", need.job, need.gibibytes);
    if (need.gibibytes > available) too_large = need.job;
  }
  if (too_large.empty()) return check;
  check.health = Health::limited;
  check.remedy =
      fmt::format("{} would not fit: close other programs, or give fewer --jobs", too_large);
  return check;
}

Check folder_for_output() {
  const auto path =
      std::filesystem::current_path() / fmt::format(".flexspline-doctor-{}", ::getpid());
  const auto written = write_file(path, "");
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  if (written) return {"current folder", Health::good, "can be written to"};
  return {"current folder", Health::limited, written.error().message(),
          "give --out a folder elsewhere"};
}

/// Only building the program needs it: reports are complete without a network or another program.
Check found_on_path(const std::string& program, const std::string& purpose) {
  const std::string path = std::getenv("PATH") == nullptr ? "" : std::getenv("PATH");
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find(':', at), path.size());
    const std::filesystem::path file = std::filesystem::path(path.substr(at, end - at)) / program;
    if (::access(file.c_str(), X_OK) == 0) return {program, Health::good, file.string()};
    at = end + 1;
  }
  return {program, Health::limited, "not found", "needed only " + purpose};
}

/// The quick one of the certified collections, for as long as the check may take.
Check self_check(Console& console) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::size_t passed = 0;
  std::vector<std::string> failed;
  for (const auto* problem : estimators::certified_problems()) {
    if (problem->collection != "mgh") continue;
    for (std::size_t s = 0; s < problem->starts.size() && seconds() < kSelfCheckSeconds; ++s) {
      for (const auto backend : {estimators::Backend::ceres, estimators::Backend::ipopt}) {
        console.live(fmt::format("self-check: {} by {}", problem->id, name_of(backend)));
        if (estimators::run_certified(*problem, s, backend).passed()) {
          ++passed;
        } else {
          failed.push_back(fmt::format("{} by {}", problem->id, name_of(backend)));
        }
      }
    }
  }
  Check check{"solvers", Health::good,
              fmt::format("{} certified fits have their digits, {:.1f} s", passed, seconds())};
  if (failed.empty()) return check;
  check.health = Health::broken;
  check.found += fmt::format("; {} have not: {}", failed.size(), failed.front());
  check.remedy =
      "flexspline selftest shows all; the libraries may differ from those it was built with";
  return check;
}

std::string as_text(const std::vector<Check>& checks) {
  std::string text;
  for (const Check& check : checks) {
    text += fmt::format("{}{:<8} {:<15} {}", text.empty() ? "" : "\n", name_of(check.health),
                        check.name, check.found);
    if (!check.remedy.empty()) text += fmt::format("\n{:<24} -> {}", "", check.remedy);
  }
  return text;
}

std::string as_json(const std::vector<Check>& checks) {
  ordered_json rows = ordered_json::array();
  for (const Check& check : checks) {
    rows.push_back({{"check", check.name},
                    {"health", name_of(check.health)},
                    {"found", check.found},
                    {"remedy", check.remedy}});
  }
  return rows.dump(2);
}

Result<ExitCode> run(const Arguments&, Console& console) {
  const std::vector<Check> checks = {
      versions_found(),
      processors(),
      memory(),
      folder_for_output(),
      found_on_path("node", "to build the program and to write a report's figures as SVG files"),
      found_on_path("chromium", "for the tests that open a report in a browser"),
      self_check(console)};
  console.result(console.json ? as_json(checks) : as_text(checks));
  const bool broken = std::ranges::any_of(
      checks, [](const Check& check) { return check.health == Health::broken; });
  return broken ? kSomethingFailed : kDone;
}

}  // namespace

CommandRow describe_doctor() {
  return {.id = "doctor",
          .group = "Start",
          .summary =
              "Checks the installation: versions, processors, memory, and the solvers on "
              "certified problems (5 s)",
          .arguments = {},
          .example = "flexspline doctor",
          .run = run};
}

}  // namespace flexspline::app
