#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/commitment.hpp"
#include "flexspline/studies/conceal.hpp"
#include "output_folder.hpp"

namespace flexspline::app {
namespace {

/// That of an earlier answer in the folder, so that a commitment that was shown still holds.
Result<std::string> kept_salt(const std::filesystem::path& folder) {
  const auto sealed = data::read_artefact(folder / "answer.sealed.json", data::kSealedSchema);
  const std::string salt = sealed ? sealed->value("salt", "") : "";
  return salt.empty() ? data::fresh_salt() : salt;
}

/// A salt that can be guessed seals nothing; short ones are a slip.
Result<std::string> salt_of(const Arguments& arguments) {
  constexpr std::size_t kShortest = 8;
  if (!arguments.has("salt")) return kept_salt(arguments.text("out"));
  const std::string salt = arguments.text("salt");
  if (salt.size() >= kShortest) return salt;
  return failure(ErrorCode::usage, fmt::format("--salt '{}' is too short", salt),
                 fmt::format("give at least {} letters, or leave it out", kShortest));
}

/// An edited bench is another one: what was committed to is not replaced.
Result<OutputFolder> claim_for(const Arguments& arguments) {
  const std::filesystem::path bench = arguments.text("bench");
  const auto text = read_file(bench);
  if (!text) return tl::unexpected(text.error());
  return OutputFolder::claim({"conceal",
                              arguments.text("out"),
                              bench.filename().string(),
                              data::sha256_hex(*text),
                              {},
                              {bench},
                              arguments.has("force")});
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto salt = salt_of(arguments);
  if (!salt) return tl::unexpected(salt.error());
  const auto plan = studies::load_conceal_plan(arguments.text("bench"));
  if (!plan) return tl::unexpected(plan.error());
  auto output = claim_for(arguments);
  if (!output) return tl::unexpected(output.error());
  auto concealed = studies::conceal(*plan);
  if (!concealed) return tl::unexpected(concealed.error());
  const std::size_t recordings = concealed->recordings.recordings.size();
  const std::filesystem::path folder = arguments.text("out");
  const auto written = studies::write_concealed(folder, *std::move(concealed), *salt);
  if (!written) return tl::unexpected(written.error());
  const std::vector<std::string> files = {"dataset", "commitment.json", "answer.sealed.json"};
  if (auto done = output->finish(files); !done) return tl::unexpected(done.error());
  const std::string dataset = (folder / "dataset").string();
  const std::string commitment = (folder / "commitment.json").string();
  const std::string answer = (folder / "answer.sealed.json").string();
  if (console.json) {
    console.result(nlohmann::ordered_json{
        {"dataset", dataset},
        {"commitment", commitment},
        {"answer", answer},
        {"recordings",
         recordings}}.dump(2));
  } else {
    console.say(fmt::format("{} recordings; the answer is in {}, committed to in {}", recordings,
                            answer, commitment));
    console.result(dataset);
  }
  return kDone;
}

}  // namespace

CommandRow describe_conceal() {
  return {
      .id = "conceal",
      .group = "Simulated test cases",
      .summary = "Makes recordings on the virtual bench with a hidden effect, the answer sealed",
      .arguments = {{.name = "bench",
                     .meaning = "bench description",
                     .value = "BENCH.toml",
                     .required = true},
                    {.name = "--out",
                     .meaning = "folder for data set, commitment and sealed answer",
                     .value = "DIR",
                     .required = true},
                    kForce,
                    {.name = "--salt",
                     .meaning = "of the commitment, for tests; default: that of the folder's "
                                "answer, else from the system's randomness",
                     .value = "TEXT"}},
      .example = "flexspline conceal bench.toml --out out/hidden",
      .run = run};
}

}  // namespace flexspline::app
