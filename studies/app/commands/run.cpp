#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"
#include "slurm_run.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

/// "i/n". Errors: usage.
Result<studies::Shard> shard_of(const std::string& text) {
  std::size_t index = 0;
  std::size_t count = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, count) : first;
  if (!slash || second.ec != std::errc{} || second.ptr != end || index < 1 || index > count) {
    return failure(ErrorCode::usage, fmt::format("--shard = '{}' is no part of a whole", text),
                   "give i/n with 1 <= i <= n, e.g. --shard 2/8");
  }
  return studies::Shard{index, count};
}

Result<double> positive(const Arguments& arguments, const std::string& name) {
  if (!arguments.has(name)) return 0.0;
  const std::string text = arguments.text(name);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec == std::errc{} && read.ptr == text.data() + text.size() && value > 0.0) return value;
  return failure(ErrorCode::usage, fmt::format("--{} = '{}' is no positive number", name, text),
                 "give one, e.g. 60");
}

/// Which part of the study is computed, and how.
Result<void> read_parts(const Arguments& arguments, FolderRun& run) {
  if (arguments.has("shard")) {
    const auto shard = shard_of(arguments.text("shard"));
    if (!shard) return tl::unexpected(shard.error());
    run.shard = *shard;
  }
  if (arguments.has("pull") && !arguments.has("shard")) {
    return failure(ErrorCode::usage, "--pull is for several runs in one folder",
                   "add --shard i/n, n of them");
  }
  run.pulls = arguments.has("pull") && !run.shard.whole();
  const auto seconds = positive(arguments, "case-seconds");
  const auto memory = positive(arguments, "case-memory");
  if (!seconds || !memory) return tl::unexpected(seconds ? memory.error() : seconds.error());
  run.limits = {*seconds, *memory};
  run.gather = arguments.has("gather");
  run.yes_many = arguments.has("yes-many");
  return {};
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  auto where = folder_run(arguments, "run");
  if (!where) return tl::unexpected(where.error());
  if (const auto read = read_parts(arguments, *where); !read) return tl::unexpected(read.error());
  const auto study =
      studies::plan_file(arguments.text("study"), arguments.text("data-root"), build_id());
  if (!study) return tl::unexpected(study.error());
  const std::string engine = arguments.text("engine", "local");
  if (engine == "slurm") return run_on_slurm(arguments, **study, *where, console);
  if (engine != "local") {
    return failure(ErrorCode::usage, fmt::format("there is no engine '{}'", engine),
                   "use local, or slurm");
  }
  std::filesystem::path report;
  const auto summary = run_in_folder(**study, *where, console, report);
  if (!summary) return tl::unexpected(summary.error());
  if (console.json) {
    const nlohmann::ordered_json text = {
        {"report", report.string()},     {"cases", summary->cases},
        {"computed", summary->computed}, {"reused", summary->reused},
        {"failed", summary->failed},     {"seconds", summary->seconds},
        {"failures", summary->failures}};
    console.result(text.dump(2));
  } else {
    console.result(where->shard.whole() ? report.string()
                                        : fmt::format("shard {}/{}: {} cases", where->shard.index,
                                                      where->shard.count, summary->cases));
  }
  return summary->failed.empty() && summary->failures == 0 ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_run() {
  return {
      .id = "run",
      .group = "Studies",
      .summary = "Runs a study: plan, cases, comparison, report; goes on where it stopped",
      .arguments =
          {{.name = "study",
            .meaning = "study or trial file",
            .value = "STUDY.toml",
            .required = true},
           {.name = "--out",
            .meaning = "folder for artefacts and report",
            .value = "DIR",
            .required = true},
           kForce,
           {.name = "--jobs", .meaning = "cases at once; default: all processors", .value = "N"},
           {.name = "--shard",
            .meaning = "part i of n of the cases alone; results and report by a run without it",
            .value = "i/n"},
           {.name = "--pull",
            .meaning = "with --shard, in a folder that all shards see: take packs of cases from "
                       "what is left, instead of the own part",
            .value = {}},
           {.name = "--gather",
            .meaning = "compute nothing: results and report of the cases that are there",
            .value = {}},
           {.name = "--case-seconds",
            .meaning = "a case that takes longer has failed",
            .value = "S"},
           {.name = "--case-memory",
            .meaning = "a case that needs more has failed, MB",
            .value = "MB"},
           {.name = "--engine",
            .meaning = "threads of this machine, or a job array of Slurm",
            .value = "local|slurm"},
           {.name = "--elements",
            .meaning = "of the job array; default: so that each takes ten seconds or more",
            .value = "N"},
           {.name = "--sbatch",
            .meaning = "further option of the job array, e.g. --sbatch=--time=01:00:00",
            .value = "OPTION",
            .repeats = true},
           {.name = "--yes-many", .meaning = "also more than 100 000 cases", .value = {}},
           {.name = "--data-root",
            .meaning = "where relative data-set paths start; default: the study file's folder",
            .value = "DIR"}},
      .example = "flexspline run studies/paper.toml --out out/paper",
      .run = run};
}

}  // namespace flexspline::app
