#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catalogue_text.hpp"
#include "command.hpp"
#include "effect_json.hpp"
#include "effect_pages.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/data/exporter.hpp"
#include "flexspline/data/rig_channels.hpp"
#include "flexspline/data/sanity_check.hpp"
#include "flexspline/data/table_reader.hpp"
#include "flexspline/estimators/method.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/metric.hpp"
#include "output_folder.hpp"
#include "reference_pages.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

ordered_json list_effects() {
  ordered_json list = ordered_json::array();
  for (const EffectRow& row : effects()) list.push_back(effect_json(row));
  return list;
}

ordered_json list_laws() {
  ordered_json list = ordered_json::array();
  for (const LawRow& row : laws()) {
    list.push_back(
        {{"id", row.id}, {"says", row.equation}, {"range", row.range}, {"source", row.source}});
  }
  return list;
}

/// What a data set of a rig has to have and may have.
ordered_json channels_of(Rig rig) {
  const data::RigChannels& channels = data::rig_channels(rig);
  ordered_json needs = ordered_json::array({name_of(Quantity::time)});
  for (const data::ChannelChoice& choice : channels.needs) {
    needs.push_back((choice.alternatives.size() > 1 ? "one of " : "") + data::words_of(choice));
  }
  ordered_json may_have = ordered_json::array();
  for (const Quantity one : channels.may_have) may_have.push_back(name_of(one));
  return {{"needs", needs}, {"may_have", may_have}};
}

ordered_json list_rigs() {
  ordered_json list = ordered_json::array();
  for (const RigRow& row : rigs()) {
    ordered_json forms = ordered_json::array();
    for (const RigForm& form : row.forms) {
      ordered_json states = ordered_json::array();
      for (const RigVariable& one : form.states) {
        states.push_back({{"name", one.name}, {"unit", one.unit}, {"says", one.says}});
      }
      ordered_json inputs = ordered_json::array();
      for (const Quantity one : form.inputs) inputs.push_back(name_of(one));
      forms.push_back(
          {{"id", form.id}, {"says", form.says}, {"states", states}, {"inputs", inputs}});
    }
    ordered_json constants = ordered_json::array();
    for (const DriveConstant& one : row.constants) {
      constants.push_back({{"name", one.name}, {"unit", one.unit}, {"says", one.says}});
    }
    ordered_json outputs = ordered_json::array();
    for (const Quantity one : row.outputs) outputs.push_back(name_of(one));
    list.push_back({{"id", row.id},
                    {"says", row.says},
                    {"equations", row.equations},
                    {"not_modelled", row.not_modelled},
                    {"forms", forms},
                    {"constants", constants},
                    {"outputs", outputs},
                    {"residuals", row.residuals},
                    {"channels", channels_of(row.rig)}});
  }
  return list;
}

ordered_json list_estimators() {
  ordered_json list = ordered_json::array();
  for (const estimators::MethodRow& row : estimators::methods()) {
    ordered_json options = ordered_json::array();
    for (const estimators::OptionInfo& one : row.options) {
      ordered_json option = {{"name", one.name}, {"says", one.meaning}};
      if (one.choices.empty()) {
        option["default"] = one.value;
        option["from"] = one.lower;
        option["to"] = one.upper;
      } else {
        option["choices"] = one.choices;
      }
      options.push_back(option);
    }
    list.push_back(
        {{"id", row.id}, {"says", row.summary}, {"source", row.source}, {"options", options}});
  }
  return list;
}

ordered_json list_kinds() {
  ordered_json list = ordered_json::array();
  for (const studies::KindRow& row : studies::kinds()) {
    list.push_back({{"id", row.id}, {"says", row.summary}, {"cases", row.cases}});
  }
  return list;
}

ordered_json list_metrics() {
  ordered_json list = ordered_json::array();
  for (const studies::MetricRow& row : studies::metrics()) {
    const bool effort = row.unit == studies::MetricUnit::effort;
    list.push_back(
        {{"id", row.id}, {"says", row.meaning}, {"unit", effort ? "torque (force)" : "%"}});
  }
  return list;
}

ordered_json list_truths() {
  ordered_json list = ordered_json::array();
  for (const data::TruthRow& row : data::truths()) {
    list.push_back({{"id", row.id}, {"says", row.summary}, {"source", row.source}});
  }
  return list;
}

ordered_json list_exporters() {
  ordered_json list = ordered_json::array();
  for (const data::ExporterRow& row : data::exporters()) {
    list.push_back({{"id", row.id},
                    {"says", fmt::format("{}; carries {}; not carried: {}", row.says, row.carries,
                                         row.not_carried)}});
  }
  return list;
}

ordered_json list_readers() {
  ordered_json list = ordered_json::array();
  for (const data::TableReaderRow& row : data::table_readers()) {
    list.push_back({{"id", row.id}, {"says", row.says}, {"own_process", row.by_others}});
  }
  return list;
}

ordered_json list_checks() {
  ordered_json list = ordered_json::array();
  for (const data::SanityRow& row : data::sanity_checks()) {
    ordered_json verdicts = ordered_json::array();
    for (const data::SanityVerdict& one : row.verdicts) {
      verdicts.push_back(
          {{"code", one.code}, {"severity", data::name_of(one.severity)}, {"remedy", one.remedy}});
    }
    list.push_back({{"id", row.id}, {"says", row.says}, {"verdicts", verdicts}});
  }
  return list;
}

ordered_json list_commands() {
  ordered_json list = ordered_json::array();
  for (const CommandRow& row : commands()) {
    ordered_json arguments = ordered_json::array();
    for (const ArgumentInfo& one : row.arguments) {
      arguments.push_back({{"name", one.name},
                           {"takes", one.value},
                           {"required", one.required},
                           {"repeats", one.repeats},
                           {"says", one.meaning}});
    }
    list.push_back({{"id", row.id},
                    {"says", row.summary},
                    {"example", row.example},
                    {"arguments", arguments}});
  }
  return list;
}

struct Catalogue {
  std::string_view name;
  ordered_json (*rows)();
};

constexpr Catalogue kCatalogues[] = {
    {"effects", list_effects},       {"laws", list_laws},           {"rigs", list_rigs},
    {"estimators", list_estimators}, {"kinds", list_kinds},         {"metrics", list_metrics},
    {"truths", list_truths},         {"exporters", list_exporters}, {"readers", list_readers},
    {"checks", list_checks},         {"commands", list_commands}};

constexpr std::string_view kReference = "reference";  // all catalogues, as pages

Result<void> write_all(const std::string& folder, bool force) {
  std::map<std::string, ordered_json> rows;
  for (const Catalogue& one : kCatalogues) {
    if (one.name != "effects") rows.emplace(one.name, one.rows());
  }
  return write_reference(folder, rows, force);
}

Result<ExitCode> write_pages(const std::string& catalogue, const std::string& folder, bool force,
                             Console& console) {
  if (catalogue != "effects" && catalogue != kReference) {
    return failure(ErrorCode::usage, fmt::format("--pages: '{}' has no pages", catalogue),
                   "effects has, and reference, which is all other catalogues");
  }
  if (catalogue == "effects" && !force) {
    if (auto checked = check_effect_pages(folder); !checked) return tl::unexpected(checked.error());
  }
  const auto done = catalogue == "effects" ? write_effect_pages(folder) : write_all(folder, force);
  if (!done) return tl::unexpected(done.error());
  console.result(folder);
  return kDone;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const std::string name = arguments.text("catalogue");
  if (arguments.has("pages")) {
    return write_pages(name, arguments.text("pages"), arguments.has("force"), console);
  }
  const auto found = std::ranges::find(kCatalogues, name, &Catalogue::name);
  if (found == std::end(kCatalogues)) {
    std::vector<std::string_view> names;
    for (const Catalogue& one : kCatalogues) names.push_back(one.name);
    return failure(ErrorCode::usage, fmt::format("there is no catalogue '{}'", name),
                   suggestion(name, names));
  }
  const ordered_json rows = found->rows();
  console.result(console.json ? rows.dump(2) : catalogue_text(rows));
  return kDone;
}

}  // namespace

CommandRow describe_list() {
  return {.id = "list",
          .group = "Models",
          .summary =
              "The catalogues: effects, laws, rigs, estimators, kinds, metrics, truths, exporters, "
              "readers, checks, commands",
          .arguments = {{.name = "catalogue",
                         .meaning = "effects, laws, rigs, estimators, kinds, metrics, truths, "
                                    "exporters, readers, checks or commands",
                         .value = "CATALOGUE",
                         .required = true},
                        {.name = "--pages",
                         .meaning = "writes a page for every effect to this folder instead; of "
                                    "reference, a page for every other catalogue",
                         .value = "DIR"},
                        kForce},
          .example = "flexspline list estimators",
          .run = run};
}

}  // namespace flexspline::app
