#include "flexspline/reports/artefacts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>

#include <nlohmann/json.hpp>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/core/write_file.hpp"
#include "lock_file.hpp"
#include "parse_artefacts.hpp"
#include "read_checked.hpp"

namespace flexspline::reports {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kReaders = 16;  // threads

std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// An artefact with the schema it should have, parsed; or a line in `unreadable`.
template <class Parse>
auto read_one(const fs::path& path, std::string_view schema, Parse parse,
              std::vector<std::string>& unreadable)
    -> std::optional<decltype(parse(std::declval<const json&>()))> {
  const auto refuse = [&](const std::string& reason) {
    const fs::path shown = path.parent_path().filename() / path.filename();
    unreadable.push_back(shown.generic_string() + ": " + reason);
    return std::nullopt;
  };
  const auto artefact = read_checked(path, schema);
  if (!artefact) return refuse(artefact.error().problem);
  try {
    return parse(*artefact);
  } catch (const json::exception&) {
    return refuse(kOtherKind);
  }
}

/// The same of many files, several at once; in the order of the files.
template <class Parse>
auto read_all(const std::vector<fs::path>& files, std::string_view schema, Parse parse,
              std::vector<std::string>& unreadable) {
  using One = decltype(read_one(files.front(), schema, parse, unreadable));
  std::vector<One> read(files.size());
  std::vector<std::vector<std::string>> refused(files.size());
  in_parallel(files.size(), std::min(threads_for(0), kReaders),
              [&](std::size_t i) { read[i] = read_one(files[i], schema, parse, refused[i]); });
  std::vector<typename One::value_type> whole;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (read[i]) whole.push_back(std::move(*read[i]));
    std::ranges::move(refused[i], std::back_inserter(unreadable));
  }
  return whole;
}

void keep_first_of_each_id(std::vector<Input>& inputs) {
  std::vector<Input> kept;
  for (Input& input : inputs) {
    const bool known = std::any_of(kept.begin(), kept.end(),
                                   [&](const Input& other) { return other.id == input.id; });
    if (!known) kept.push_back(std::move(input));
  }
  inputs = std::move(kept);
}

void name_missing(const fs::path& folder, const std::vector<std::string>& keys,
                  std::vector<std::string>& unreadable) {
  for (const std::string& key : keys) {
    const fs::path file = fs::path("cases") / (key + ".json");
    if (!file_exists(folder / file)) {
      unreadable.push_back(file.generic_string() + ": it is missing");
    }
  }
}

}  // namespace

double CaseRecording::error_percent() const {
  return std::isfinite(rmse_true_percent) ? rmse_true_percent : rmse_percent;
}

const Band* Case::band(const std::string& function) const {
  const auto found = std::find_if(bands.begin(), bands.end(),
                                  [&](const Band& band) { return band.function == function; });
  return found == bands.end() ? nullptr : &*found;
}

const CaseRecording* Case::recording(const std::string& id) const {
  const auto found = std::find_if(recordings.begin(), recordings.end(),
                                  [&](const CaseRecording& item) { return item.id == id; });
  return found == recordings.end() ? nullptr : &*found;
}

std::vector<const CaseRecording*> Case::trained() const {
  std::vector<const CaseRecording*> found;
  for (const CaseRecording& item : recordings) {
    if (item.trained) found.push_back(&item);
  }
  return found;
}

Result<Artefacts> read_artefacts(const fs::path& folder) {
  Artefacts artefacts;
  auto& unreadable = artefacts.unreadable;
  artefacts.inputs =
      read_all(json_files(folder / "inputs"), "flexspline-input/1", parse_input, unreadable);
  keep_first_of_each_id(artefacts.inputs);
  artefacts.cases =
      read_all(json_files(folder / "cases"), "flexspline-case/1", parse_case, unreadable);
  if (const fs::path path = folder / "paper.json"; file_exists(path)) {
    artefacts.paper = read_one(path, "flexspline-paper/1", parse_paper, unreadable);
  }
  if (auto lock = read_file(folder / "study.lock.toml")) artefacts.lock = std::move(*lock);
  name_missing(folder, parse_lock(artefacts.lock).cases, unreadable);
  const bool nothing = artefacts.inputs.empty() && artefacts.cases.empty() && !artefacts.paper &&
                       unreadable.empty() && artefacts.lock.empty();
  if (nothing) {
    return failure(ErrorCode::input_missing,
                   folder.string() + " holds no artefact to draw a report from",
                   "give the folder that run, fit, compare, diagnose or trial wrote");
  }
  return artefacts;
}

}  // namespace flexspline::reports
