#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "program_fixture.hpp"

namespace flexspline::studies {

/// An argument as the catalogue of commands has it.
struct ArgumentSpec {
  std::string name;
  std::string takes;  ///< "DIR"; a flag: empty
  bool required = false;

  bool is_option() const { return name.starts_with("--"); }
  bool is_output() const { return name == "--out" || name == "--pages" || name == "--recordings"; }
  /// Whether it is a file or folder that is read.
  bool is_input() const {
    if (is_output()) return false;
    for (const char* word : {"toml", "FILE", "DATASET", "DIR", "OTHER", "CSV", "PATH"}) {
      if (takes.find(word) != std::string::npos) return true;
    }
    return false;
  }
};

struct CommandSpec {
  std::string id;
  std::vector<ArgumentSpec> arguments;

  bool has(const std::string& name) const {
    return std::ranges::find(arguments, name, &ArgumentSpec::name) != arguments.end();
  }
};

/// The catalogue, from the program itself: a command that is added is tried without an edit here.
inline std::vector<CommandSpec> all_commands() {
  std::vector<CommandSpec> commands;
  const auto rows = nlohmann::json::parse(run_program({"list", "commands", "--json"}).result);
  for (const auto& row : rows) {
    CommandSpec& command = commands.emplace_back(CommandSpec{row.at("id"), {}});
    for (const auto& one : row.at("arguments")) {
      command.arguments.push_back({one.at("name"), one.at("takes"), one.at("required")});
    }
  }
  return commands;
}

}  // namespace flexspline::studies
