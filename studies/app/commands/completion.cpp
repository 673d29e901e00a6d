#include <fmt/format.h>

#include "command.hpp"

namespace flexspline::app {
namespace {

std::string options_of(const CommandRow& row) {
  std::string options = "--json --quiet -v --help";
  for (const ArgumentInfo& argument : row.arguments) {
    if (!argument.name.starts_with('-')) continue;
    options += ' ';
    options += argument.name;
  }
  return options;
}

std::string ids() {
  std::string list;
  for (const CommandRow& row : commands()) {
    if (!list.empty()) list += ' ';
    list += row.id;
  }
  return list;
}

/// zsh reads bash's completions through bashcompinit.
std::string for_bash(bool zsh) {
  std::string cases;
  for (const CommandRow& row : commands()) {
    cases += fmt::format("    {}) words=\"{}\" ;;\n", row.id, options_of(row));
  }
  return fmt::format(
      "{}_flexspline() {{\n"
      "  local words=\"{}\"\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  ((COMP_CWORD == 1)) && words=\"{} --help --version\"\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"${{COMP_WORDS[COMP_CWORD]}}\"))\n"
      "}}\n"
      "complete -o default -F _flexspline flexspline",
      zsh ? "autoload -U +X bashcompinit && bashcompinit\n" : "", ids(), cases, ids());
}

std::string for_fish() {
  std::string text;
  for (const CommandRow& row : commands()) {
    text += fmt::format("complete -c flexspline -n __fish_use_subcommand -a {} -d \"{}\"\n", row.id,
                        row.summary);
    for (const ArgumentInfo& argument : row.arguments) {
      if (!argument.name.starts_with("--")) continue;
      text += fmt::format(
          "complete -c flexspline -n \"__fish_seen_subcommand_from {}\" -l {}{} -d \"{}\"\n",
          row.id, argument.name.substr(2), argument.is_flag() ? "" : " -r", argument.meaning);
    }
  }
  text.pop_back();
  return text;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const std::string shell = arguments.text("shell");
  if (shell == "bash" || shell == "zsh")
    console.result(for_bash(shell == "zsh"));
  else if (shell == "fish")
    console.result(for_fish());
  else
    return failure(ErrorCode::usage, fmt::format("no completion for '{}'", shell),
                   "bash, zsh or fish");
  return kDone;
}

}  // namespace

CommandRow describe_completion() {
  return {.id = "completion",
          .group = "The program",
          .summary = "Prints a completion script for bash, zsh or fish",
          .arguments = {{.name = "shell",
                         .meaning = "bash, zsh or fish",
                         .value = "SHELL",
                         .required = true}},
          .example = "flexspline completion bash > /etc/bash_completion.d/flexspline",
          .run = run};
}

}  // namespace flexspline::app
