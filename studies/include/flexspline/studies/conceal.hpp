#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::studies {

/// What is hidden when it is drawn. The probabilities are relative to their sum.
struct ConcealDraw {
  double none = 0.3;
  double one = 0.5;
  double two = 0.1;
  double unknown = 0.1;    ///< one effect that no catalogue has
  double contained = 0.0;  ///< one effect that the rig's baseline contains
  double variant = 0.0;    ///< one catalogued effect in another form than the catalogue's
  double incident = 0.0;   ///< a burst, step or glitch inside one recording
  double disturbed = 0.0;  ///< share of the cases with a disturbance, whatever they hide
  double smallest = 0.02;  ///< size, share of peak torque
  double largest = 0.10;
  /// To draw one or two from; empty: all that the rig can conceal and its baseline does not
  /// contain.
  std::vector<std::string> effects;
};

/// A bench with something to conceal, as read. SI.
struct ConcealPlan {
  std::filesystem::path file;
  std::string generator = "bench";  ///< id of a row of studies/generators
  std::filesystem::path source;     ///< what it works upon: a script, a data set
  std::string change = "none";      ///< of spliced recordings: an id of data::splice_changes()
  data::BenchKind rig;
  std::uint64_t seed = 1;
  std::vector<std::string> disturbances;       ///< ids of data::disturbances(), in their order
  std::vector<data::HiddenEffect> effects;     ///< empty: nothing is hidden
  std::optional<ConcealDraw> draw;             ///< instead of effects
  std::vector<data::HiddenExcitation> design;  ///< empty: drawn
  std::map<std::string, double> nuisances;     ///< what is to differ from the drawn, SI
};

/// A bench description as far as it could be read: everything wrong at once.
struct ConcealReading {
  std::optional<ConcealPlan> plan;  ///< present only when there are no errors
  std::vector<data::Finding> errors;
};

/// Reads a bench of format "flexspline-bench/1" (docs/trials.md).
/// Errors: input_missing when the file cannot be read. What is wrong in it is in the reading.
Result<ConcealReading> read_conceal_plan(const std::filesystem::path& file);

/// The same for callers that go no further on a failure.
/// Errors: input_missing, or bad_data with every finding.
Result<ConcealPlan> load_conceal_plan(const std::filesystem::path& file);

/// Two effects that leave the same signal on a rig, whatever is recorded of it.
struct StructuralTwin {
  std::string_view effect;
  std::string_view twin;
  std::vector<Rig> rigs;
  std::string_view reason;
};

std::span<const StructuralTwin> structural_twins();
std::vector<std::string> twins_of(std::string_view effect, data::BenchKind rig);

/// An effect that a rig's baseline contains: what the fitted laws leave of it is less than a
/// twentieth of its size (in the median of drawn benches). With it nothing was left out.
struct ContainedEffect {
  std::string_view effect;
  std::vector<Rig> rigs;
  std::string_view reason;
};

std::span<const ContainedEffect> contained_effects();
std::vector<std::string> contained_on(data::BenchKind rig);

/// Ids of a class that a rig can conceal, and the disturbances that it can have.
std::vector<std::string> concealable(data::BenchKind rig, data::HiddenClass of);
std::vector<std::string> disturbances_on(data::BenchKind rig);

/// What made a case different without leaving anything out.
struct AppliedDisturbance {
  std::string id;
  std::vector<data::HiddenParameter> parameters;
};

/// The truth of a concealed case. Torques in Nm.
struct ConcealedAnswer {
  std::string generator = "bench";
  std::string source;           ///< of spliced recordings: the name of their data set
  std::string change = "none";  ///< and what was done to them
  data::BenchKind rig;
  std::uint64_t seed = 0;
  std::vector<data::HiddenFinding> effects;  ///< by id; empty: nothing
  std::vector<std::string> twins;
  std::vector<AppliedDisturbance> disturbances;
  double noise_std = 0.0;    ///< of the torque that is the rig's effort
  double peak_torque = 0.0;  ///< of the same
  double best_rmse = 0.0;    ///< what the true drive leaves of it: noise as it fell
  double at_output = 1.0;    ///< of a servo, whose effort is the motor's: its gear ratio, if stated
  std::string dataset_sha256;
};

/// The key of a parameter in an answer: name and unit, "stiffness_Nm_rad".
std::string key_of(const data::HiddenParameter& parameter);

/// Keys as those of practice cases: rig, effects, size, coordinate, info, noise_std_nm, twins,
/// tau_max; and generator, source, change, seed, equation, names, place, disturbances,
/// best_rmse_nm, at_output, dataset_sha256.
nlohmann::ordered_json to_json(const ConcealedAnswer& answer);

/// What scoring needs of an answer. Errors: bad_data, naming the key.
Result<ConcealedAnswer> answer_from_json(const nlohmann::ordered_json& answer);

/// Recordings that say nothing of what is hidden: the set is called "case", recordings are named by
/// their excitation and stand in an order drawn from the seed alone.
struct ConcealedCase {
  RecordingSet recordings;
  ConcealedAnswer answer;
};

/// Runs the virtual bench. Deterministic by the plan.
/// Errors: those of data::run_hidden_bench.
Result<ConcealedCase> conceal(const ConcealPlan& plan);

/// Writes DIR/dataset, DIR/commitment.json and DIR/answer.sealed.json, the answer last.
/// Errors: cannot_write; bad_data where the data set does not read back.
Result<void> write_concealed(const std::filesystem::path& folder, ConcealedCase concealed,
                             const std::string& salt);

}  // namespace flexspline::studies
