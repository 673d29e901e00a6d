#include <algorithm>

#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conceal/generator.hpp"
#include "conceal/run_program.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

/// A folder of its own, gone at the end.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "flexspline-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~Scratch() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The script says itself what the engine can show. Without node, nothing.
std::vector<std::string> effects(const ConcealPlan& plan, data::HiddenClass of) {
  std::vector<std::string> ids;
  if (of != data::HiddenClass::named) return ids;
  const auto listed =
      run_program({"node", plan.source.string(), "--effects", std::string(name_of(plan.rig))});
  for (std::size_t at = 0; listed && at < listed->size();) {
    const std::size_t end = listed->find('\n', at);
    ids.push_back(listed->substr(at, end - at));
    at = end + 1;
  }
  return ids;
}

std::string spec_of(const ConcealPlan& plan) {
  ordered_json spec = {
      {"rig", name_of(plan.rig)}, {"seed", plan.seed}, {"effects", ordered_json::array()}};
  for (const data::HiddenEffect& effect : plan.effects) {
    spec["effects"].push_back({{"id", effect.id}, {"size_fraction", effect.size_fraction}});
  }
  return spec.dump();
}

Result<ConcealedCase> read_case(const std::filesystem::path& folder) {
  const auto text = read_file(folder / "answer.json");
  if (!text) return tl::unexpected(text.error());
  auto answer = answer_from_json(ordered_json::parse(*text, nullptr, false));
  if (!answer) return tl::unexpected(answer.error());
  auto set = data::load_dataset(folder / "dataset");
  if (!set) return tl::unexpected(set.error());
  return ConcealedCase{*std::move(set), *std::move(answer)};
}

Result<ConcealedCase> make(const ConcealPlan& plan) {
  const std::filesystem::path script = plan.source;
  if (!std::filesystem::exists(script)) {
    return failure(ErrorCode::input_missing,
                   fmt::format("MuJoCo's script '{}' is not there", script.string()),
                   "give [mujoco] script, or leave the generator out");
  }
  if (!std::filesystem::exists(script.parent_path() / "node_modules" / "@mujoco")) {
    return failure(ErrorCode::input_missing, "the package @mujoco/mujoco is not installed",
                   fmt::format("npm ci --prefix {}, or leave the generator out",
                               script.parent_path().string()));
  }
  const Scratch scratch;
  const auto made = run_program({"node", script.string(), spec_of(plan), scratch.path().string()});
  if (!made) return tl::unexpected(made.error());
  return read_case(scratch.path());
}

}  // namespace

GeneratorRow describe_mujoco() {
  return {
      .id = "mujoco",
      .summary = "a geared joint in the MuJoCo engine, under node: its own integrator and stiction",
      .rigs = {Rig::free, Rig::servo},
      .effects = effects,
      .make = make};
}

}  // namespace flexspline::studies
