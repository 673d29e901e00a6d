#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// A study as a job array of Slurm: every element one shard, so that nodes pull them, and one job
/// more that gathers them after the last, however they ended.
struct SlurmJob {
  std::filesystem::path folder;  ///< of the study, which every node sees under this path
  std::string name;              ///< of the job
  std::vector<std::string> run;  ///< the program and its arguments, but for --shard and --gather
  std::size_t elements = 1;
  int processors = 1;                  ///< of an element
  std::vector<std::string> options{};  ///< further lines of #SBATCH, e.g. "--partition=long"
};

/// Identifiers of what was submitted.
struct SlurmIds {
  std::string array;
  std::string gather;
};

/// The scripts as they are submitted. Slurm's warning before the time limit is a checkpoint: the
/// element ends with 75 and is queued again. No accounting (sacct) is needed: the folder knows.
std::string slurm_array_script(const SlurmJob& job);
std::string slurm_gather_script(const SlurmJob& job);

/// Writes both scripts into folder/slurm and submits them.
/// Errors: cannot_write; input_missing without sbatch; numerics with what sbatch says.
Result<SlurmIds> submit(const SlurmJob& job);

/// Whether any of them is still queued or runs. Errors: of squeue.
Result<bool> in_queue(const SlurmIds& ids);

}  // namespace flexspline::studies
