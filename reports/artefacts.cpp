#include "flexspline/reports/artefacts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>

#include <nlohmann/json.hpp>

#include "flexspline/core/case_store.hpp"
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

constexpr std::size_t kMostCases = 2000;  // that a page can say anything about one by one

/// An artefact with the schema it should have, parsed; or a line in `unreadable`.
template <class Parse>
auto parse_one(const std::string& shown, const Result<std::string>& text, std::string_view schema,
               Parse parse, std::vector<std::string>& unreadable)
    -> std::optional<decltype(parse(std::declval<const json&>()))> {
  const auto refuse = [&](const std::string& reason) {
    unreadable.push_back(shown + ": " + reason);
    return std::nullopt;
  };
  const auto artefact =
      text.and_then([&](const std::string& whole) { return check_text(whole, schema); });
  if (!artefact) return refuse(artefact.error().problem);
  try {
    return parse(*artefact);
  } catch (const json::exception&) {
    return refuse(kOtherKind);
  }
}

template <class Parse>
auto read_one(const fs::path& path, std::string_view schema, Parse parse,
              std::vector<std::string>& unreadable) {
  const fs::path shown = path.parent_path().filename() / path.filename();
  return parse_one(shown.generic_string(), read_file(path), schema, parse, unreadable);
}

/// Many of them, several at once; in their order.
template <class Read>
auto read_all(std::size_t count, Read read_at, std::vector<std::string>& unreadable) {
  using One = decltype(read_at(std::size_t{0}, unreadable));
  std::vector<One> read(count);
  std::vector<std::vector<std::string>> refused(count);
  in_parallel(count, std::min(threads_for(0), kReaders),
              [&](std::size_t i) { read[i] = read_at(i, refused[i]); });
  std::vector<typename One::value_type> whole;
  for (std::size_t i = 0; i < count; ++i) {
    if (read[i]) whole.push_back(std::move(*read[i]));
    std::ranges::move(refused[i], std::back_inserter(unreadable));
  }
  return whole;
}

std::vector<Input> read_inputs(const fs::path& folder, std::vector<std::string>& unreadable) {
  const auto files = json_files(folder / "inputs");
  return read_all(
      files.size(),
      [&](std::size_t i, std::vector<std::string>& refused) {
        return read_one(files[i], "flexspline-input/1", parse_input, refused);
      },
      unreadable);
}

/// Of a study that is swept, or of very many cases, those at the beginning of every sweep.
std::vector<std::string> shown_keys(const CaseStore& store) {
  std::vector<std::string> keys = store.keys();
  std::erase_if(keys, [](const std::string& key) {
    return key.find("--v") != std::string::npos && key.find("--v0--") == std::string::npos;
  });
  if (keys.size() > kMostCases) {
    std::erase_if(keys, [](const std::string& key) { return !key.ends_with("--r0"); });
  }
  keys.resize(std::min(keys.size(), kMostCases));
  return keys;
}

std::vector<Case> read_cases(const CaseStore& store, std::vector<std::string>& unreadable) {
  const std::vector<std::string> keys = shown_keys(store);
  return read_all(
      keys.size(),
      [&](std::size_t i, std::vector<std::string>& refused) {
        const auto text =
            store.read(keys[i]).map([](const StoredCase& one) { return one.artefact; });
        return parse_one("cases/" + keys[i] + ".json", text, "flexspline-case/1", parse_case,
                         refused);
      },
      unreadable);
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

void name_missing(const CaseStore& store, const std::vector<std::string>& keys,
                  std::vector<std::string>& unreadable) {
  const std::vector<std::string> there = store.keys();
  for (const std::string& key : keys) {
    if (!std::ranges::binary_search(there, key)) {
      unreadable.push_back("cases/" + key + ".json: it is missing");
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
  const auto store = CaseStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  unreadable = store->damaged();
  if (const fs::path path = folder / "kind.json"; file_exists(path)) {
    artefacts.kind = read_one(path, "flexspline-kind/1", parse_kind, unreadable);
  }
  // A study of another kind than a grid is its answer, not its cases one by one.
  if (!artefacts.kind || artefacts.kind->kind == "grid") {
    artefacts.inputs = read_inputs(folder, unreadable);
    keep_first_of_each_id(artefacts.inputs);
    artefacts.cases = read_cases(*store, unreadable);
  }
  if (const fs::path path = folder / "paper.json"; file_exists(path)) {
    artefacts.paper = read_one(path, "flexspline-paper/1", parse_paper, unreadable);
  }
  if (auto lock = read_file(folder / "study.lock.toml")) artefacts.lock = std::move(*lock);
  name_missing(*store, parse_lock(artefacts.lock).cases, unreadable);
  const bool nothing = !artefacts.kind && artefacts.inputs.empty() && artefacts.cases.empty() &&
                       !artefacts.paper && unreadable.empty() && artefacts.lock.empty();
  if (nothing) {
    return failure(ErrorCode::input_missing,
                   folder.string() + " holds no artefact to draw a report from",
                   "give the folder that run, fit, compare, diagnose or trial wrote");
  }
  return artefacts;
}

}  // namespace flexspline::reports
