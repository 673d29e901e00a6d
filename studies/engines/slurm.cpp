#include "flexspline/studies/slurm.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conceal/run_program.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::studies {
namespace {

constexpr int kWarningSeconds = 60;  // before the time limit

/// A word as a shell takes it literally.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char letter : word) {
    if (letter == '\'')
      text += "'\\''";
    else
      text += letter;
  }
  return text + "'";
}

std::string command_of(const SlurmJob& job) {
  std::vector<std::string> words;
  for (const std::string& word : job.run) words.push_back(quoted(word));
  return fmt::format("{}", fmt::join(words, " "));
}

std::string head_of(const SlurmJob& job, const std::string& name, const std::string& output) {
  std::string text = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n", name,
      (job.folder / "slurm" / output).string());
  for (const std::string& option : job.options) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

Result<std::string> submitted(const std::filesystem::path& script,
                              const std::vector<std::string>& options) {
  std::vector<std::string> words = {"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(script.string());
  auto id = run_program(words);
  if (!id) return id;
  return id->substr(0, id->find_first_of(";\n"));
}

}  // namespace

std::string slurm_array_script(const SlurmJob& job) {
  return head_of(job, job.name, "%A_%a.out") +
         fmt::format(R"(#SBATCH --array=1-{}
#SBATCH --cpus-per-task={}
#SBATCH --requeue
#SBATCH --signal=B:TERM@{}
{} --shard "$SLURM_ARRAY_TASK_ID/{}" --pull &
trap 'kill -TERM $!' TERM
wait $!; status=$?
while kill -0 $! 2>/dev/null; do wait $!; status=$?; done
if [ "$status" = 75 ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}"
fi
exit "$status"
)",
                     job.elements, job.processors, kWarningSeconds, command_of(job), job.elements);
}

std::string slurm_gather_script(const SlurmJob& job) {
  return head_of(job, job.name + "-gather", "gather_%j.out") +
         fmt::format("exec {} --gather\n", command_of(job));
}

Result<SlurmIds> submit(const SlurmJob& job) {
  const std::filesystem::path array = job.folder / "slurm" / "array.sbatch";
  const std::filesystem::path gather = job.folder / "slurm" / "gather.sbatch";
  const auto written = write_file(array, slurm_array_script(job)).and_then([&] {
    return write_file(gather, slurm_gather_script(job));
  });
  if (!written) return tl::unexpected(written.error());
  SlurmIds ids;
  auto first = submitted(array, {});
  if (!first) return tl::unexpected(first.error());
  ids.array = std::move(*first);
  auto last = submitted(gather, {"--dependency=afterany:" + ids.array});
  if (!last) return tl::unexpected(last.error());
  ids.gather = std::move(*last);
  return ids;
}

Result<bool> in_queue(const SlurmIds& ids) {
  const auto listed = run_program({"squeue", "-h", "-o", "%A", "-j", ids.array + "," + ids.gather});
  if (listed) return !listed->empty();
  // Of jobs that are long over, squeue says that their ids are not valid.
  if (listed.error().problem.find("Invalid job id") != std::string::npos) return false;
  return tl::unexpected(listed.error());
}

}  // namespace flexspline::studies
