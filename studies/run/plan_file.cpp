#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "config/differing_keys.hpp"
#include "config/locked_json.hpp"
#include "config/toml_root.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/trial.hpp"
#include "flexspline/studies/verify.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kTrialSchema = "flexspline-trial/1";

Result<bool> is_trial(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  bool trial = false;
  // What else is wrong with the file, its own reader says.
  static_cast<void>(read_toml_text(
      *text, file, [&](TomlSection& root) { trial = root.text("schema") == kTrialSchema; }));
  return trial;
}

PlannedStudyPtr planned(TrialConfig trial, const std::string& build_id,
                        std::map<std::string, std::string> diagnosis = {}) {
  TrialSettings settings;
  settings.run.build_id = build_id;
  settings.diagnosis = std::move(diagnosis);
  return plan_trial_study(std::move(trial), std::move(settings));
}

Result<PlannedStudyPtr> locked_trial(const nlohmann::json& lock,
                                     const std::filesystem::path& data_root,
                                     const std::string& build_id) {
  const nlohmann::json& source = lock.at("source");
  const std::filesystem::path written = source.at("data_root").get<std::string>();
  auto reading = read_trial_text(source.at("text"), source.at("file").get<std::string>(),
                                 data_root.empty() ? written : data_root);
  if (!reading.trial) return tl::unexpected(as_error(reading.errors));
  return planned(*std::move(reading.trial), build_id,
                 lock.value("diagnosis", std::map<std::string, std::string>{}));
}

}  // namespace

std::optional<std::vector<std::string>> differences_from(const std::filesystem::path& folder,
                                                         const PlannedStudy& study) {
  const auto lock = read_lock_json(folder / "study.lock.toml");
  if (!lock || study.text().empty()) return std::nullopt;
  const auto source = lock->find("source");
  if (source == lock->end() || !source->contains("text")) return std::nullopt;
  const nlohmann::json& text = source->at("text");
  if (!text.is_string()) return std::nullopt;
  return differing_keys(text.get<std::string>(), study.text());
}

std::vector<std::string> changed_data(const std::filesystem::path& folder,
                                      const PlannedStudy& study) {
  std::vector<std::string> changed;
  const auto lock = read_lock_json(folder / "study.lock.toml");
  if (!lock) return changed;
  const nlohmann::json known = lock->value("datasets", nlohmann::json::object());
  for (const auto& [id, sum] : study.data()) {
    const auto one = known.find(id);
    if (one == known.end() || !one->is_object()) continue;
    if (one->value("sha256", sum) != sum) changed.push_back(id);
  }
  return changed;
}

Result<PlannedStudyPtr> plan_file(const std::filesystem::path& file,
                                  const std::filesystem::path& data_root,
                                  const std::string& build_id) {
  const auto trial = is_trial(file);
  if (!trial) return tl::unexpected(trial.error());
  if (*trial) {
    return load_trial(file, data_root).map([&](TrialConfig one) {
      return planned(std::move(one), build_id);
    });
  }
  return load_study(file, data_root).and_then([&](StudyConfig study) {
    return plan_fits(std::move(study), build_id);
  });
}

Result<PlannedStudyPtr> plan_locked(const std::filesystem::path& lock,
                                    const std::filesystem::path& data_root,
                                    const std::string& build_id) {
  const auto locked = read_lock_json(lock);
  if (!locked) return tl::unexpected(locked.error());
  const bool trial = locked->value("/study/kind"_json_pointer, "") == "trial";
  try {
    if (trial) return locked_trial(*locked, data_root, build_id);
  } catch (const nlohmann::json::exception& error) {
    return failure(ErrorCode::bad_data, fmt::format("{}: {}", lock.string(), error.what()),
                   "give the trial file itself");
  }
  return read_locked_study(lock, data_root).and_then([&](StudyConfig study) {
    return plan_fits(std::move(study), build_id);
  });
}

}  // namespace flexspline::studies
