#include <nlohmann/json.hpp>

#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/results.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json reference(const std::string& id) { return {{"@id", id}}; }

ordered_json file(const std::string& id, const std::string& name, const std::string& format) {
  return {{"@id", id}, {"@type", "File"}, {"name", name}, {"encodingFormat", format}};
}

ordered_json program(const std::map<std::string, std::string>& versions) {
  const auto version = versions.find("flexspline");
  return {{"@id", "#flexspline"},
          {"@type", "SoftwareApplication"},
          {"name", "flexspline"},
          {"version", version == versions.end() ? "" : version->second},
          {"softwareRequirements", versions}};
}

}  // namespace

Result<void> write_ro_crate(const StudyPlan& plan,
                            const std::map<std::string, std::string>& versions,
                            const std::filesystem::path& folder) {
  ordered_json graph = ordered_json::array();
  graph.push_back({{"@id", "ro-crate-metadata.json"},
                   {"@type", "CreativeWork"},
                   {"conformsTo", reference("https://w3id.org/ro/crate/1.1")},
                   {"about", reference("./")}});
  ordered_json root = {{"@id", "./"}, {"@type", "Dataset"}, {"name", plan.study->title}};
  ordered_json action = {{"@id", "#run"},
                         {"@type", "CreateAction"},
                         {"name", "flexspline run"},
                         {"instrument", reference("#flexspline")}};
  const auto add = [&](const char* role, ordered_json entity) {
    action[role].push_back(reference(entity["@id"]));
    root["hasPart"].push_back(reference(entity["@id"]));
    graph.push_back(std::move(entity));
  };
  add("object", file("study.lock.toml", "The study as understood, with seeds, hashes and versions",
                     "application/toml"));
  for (const auto& [id, set] : plan.datasets) {
    add("object", {{"@id", "#dataset-" + id},
                   {"@type", "Dataset"},
                   {"name", set.name},
                   {"license", set.license},
                   {"description", set.source},
                   {"sha256", set.sha256}});
  }
  for (const std::filesystem::path& one : journals_in(folder / "journals")) {
    add("result", file("journals/" + one.filename().string(),
                       "Results of cases, a line each (flexspline-journal/1)", "text/plain"));
  }
  add("result", file("results.nc", "Errors and parameters", "application/netcdf"));
  add("result", file("report/index.html", "Report", "text/html"));
  graph.push_back(root);
  graph.push_back(program(versions));
  graph.push_back(action);
  const ordered_json crate = {{"@context", "https://w3id.org/ro/crate/1.1/context"},
                              {"@graph", graph}};
  return write_file(folder / "ro-crate-metadata.json", crate.dump(2) + "\n");
}

}  // namespace flexspline::studies
