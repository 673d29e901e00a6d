#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <exception>
#include <filesystem>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "command.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "heap.hpp"
#include "stop_signal.hpp"
#include "version.hpp"
#include "work_progress.hpp"

namespace flexspline::app {
namespace {

std::string bare(std::string_view name) {
  return std::string(name.substr(name.find_first_not_of('-')));
}

/// Values as CLI11 stores them, one slot an argument of a command.
struct Slot {
  const ArgumentInfo* info;
  std::vector<std::string> values;
  CLI::Option* option = nullptr;
};

void add_argument(CLI::App& sub, Slot& slot) {
  const ArgumentInfo& info = *slot.info;
  if (info.is_flag()) {
    const std::string meaning(info.meaning);
    slot.option = sub.add_flag(std::string(info.name), meaning);
    return;
  }
  slot.option = sub.add_option(std::string(info.name), slot.values, std::string(info.meaning));
  slot.option->type_name(std::string(info.value))->required(info.required);
  const bool is_list = info.repeats && !info.name.starts_with('-');
  slot.option->expected(1)->multi_option_policy(info.repeats ? CLI::MultiOptionPolicy::TakeAll
                                                             : CLI::MultiOptionPolicy::Throw);
  slot.option->allow_extra_args(is_list);  // else what follows is the next position's
}

/// A command with the parser that reads its arguments.
struct Parser {
  const CommandRow* row;
  CLI::App* sub = nullptr;
  std::vector<Slot> slots;
};

/// In the order in which a newcomer needs their groups.
std::vector<CommandRow> in_groups() {
  constexpr std::array<std::string_view, 6> kGroups = {
      "Start", "Fit and diagnose", "Models", "Studies", "Simulated test cases", "The program"};
  std::vector<CommandRow> rows(commands().begin(), commands().end());
  std::ranges::stable_sort(rows, {}, [&](const CommandRow& row) {
    return std::ranges::find(kGroups, row.group) - kGroups.begin();
  });
  return rows;
}

std::vector<Parser> add_commands(CLI::App& app, const std::vector<CommandRow>& rows) {
  std::vector<Parser> parsers;
  for (const CommandRow& row : rows) {
    Parser& parser = parsers.emplace_back(Parser{&row, nullptr, {}});
    parser.sub = app.add_subcommand(std::string(row.id), std::string(row.summary));
    parser.sub->group(std::string(row.group));
    parser.sub->footer(fmt::format("Example: {}", row.example));
    for (const ArgumentInfo& info : row.arguments) parser.slots.push_back({&info, {}, nullptr});
    for (Slot& slot : parser.slots) add_argument(*parser.sub, slot);
  }
  return parsers;
}

Arguments collect(const Parser& parser) {
  Arguments arguments;
  for (const Slot& slot : parser.slots) {
    if (slot.option->count() > 0) arguments.set(bare(slot.info->name), slot.values);
  }
  return arguments;
}

Result<void> refuse_empty(const Parser& parser) {
  for (const Slot& slot : parser.slots) {
    if (std::ranges::find(slot.values, "") == slot.values.end()) continue;
    return failure(
        ErrorCode::usage, fmt::format("{} is empty", slot.info->name),
        fmt::format("give {}{}", slot.info->value, slot.info->required ? "" : ", or leave it out"));
  }
  return {};
}

ExitCode run(const Parser& parser, Console& console) {
  const WorkProgress progress(console, std::string(parser.row->id));
  const auto given = refuse_empty(parser);
  const Result<ExitCode> done = given ? parser.row->run(collect(parser), console)
                                      : Result<ExitCode>(tl::unexpected(given.error()));
  if (!done) {
    console.error(done.error().message());
    return static_cast<ExitCode>(done.error().code);
  }
  return console.result_lost() ? static_cast<ExitCode>(ErrorCode::cannot_write) : *done;
}

std::string command_help(const std::string& given) {
  std::vector<std::string_view> names;
  for (const CommandRow& row : commands()) names.push_back(row.id);
  return fmt::format("there is no command '{}'; {}", given, suggestion(given, names));
}

/// Of what was given, the first that begins with dashes and is no option; empty: none.
std::string unknown_option(const CommandRow& row, std::span<char* const> given) {
  std::vector<std::string_view> known = {"--help",    "-h", "--json",    "--quiet",
                                         "--verbose", "-v", "--version", "--color"};
  for (const ArgumentInfo& info : row.arguments) {
    if (info.name.starts_with('-')) known.push_back(info.name);
  }
  for (const std::string_view one : given) {
    const std::string_view name = one.substr(0, one.find('='));
    if (!name.starts_with("--") || std::ranges::find(known, name) != known.end()) continue;
    return fmt::format("{} has no option '{}'; {}", row.id, name, suggestion(name, known));
  }
  return {};
}

/// What is wrong in words of ours where there are better ones than the parser's.
std::string reason_of(const CLI::ParseError& error, std::span<char* const> given) {
  if (given.empty()) return error.what();
  const std::string first = given.front();
  const auto row = std::ranges::find(commands(), first, &CommandRow::id);
  if (row == commands().end()) return first.starts_with('-') ? error.what() : command_help(first);
  const std::string unknown = unknown_option(*row, given.subspan(1));
  return unknown.empty() ? error.what() : unknown;
}

ExitCode refuse(const CLI::App& app, const CLI::ParseError& error, std::span<char* const> given,
                Console& console) {
  if (error.get_exit_code() == 0) {
    std::ostringstream text;
    app.exit(error, text, text);
    console.result(text.str().substr(0, text.str().find_last_not_of('\n') + 1));
    return console.result_lost() ? static_cast<ExitCode>(ErrorCode::cannot_write) : kDone;
  }
  console.error(reason_of(error, given));
  const bool known =
      !given.empty() && std::ranges::find(commands(), std::string_view(given.front()),
                                          &CommandRow::id) != commands().end();
  console.error(
      fmt::format("see flexspline {}--help", known ? given.front() + std::string(" ") : ""));
  return static_cast<ExitCode>(ErrorCode::usage);
}

constexpr const char* kExamples =
    "Examples:\n"
    "  flexspline import bench.csv --out my-gear          a data set of a bench's file\n"
    "  flexspline diagnose my-gear --out out/my-gear      what the model lacks, with a page\n"
    "  flexspline export out/my-gear/model.toml --to mjcf --out mujoco\n"
    "  flexspline run studies/paper.toml --out out/paper  the study of the paper\n\n"
    "flexspline COMMAND --help tells more; man flexspline has all of it on one page.";

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App app("Identification and diagnosis of harmonic drive hysteresis", "flexspline");
  app.footer(kExamples);
  app.get_formatter()->column_width(16);
  Console console;
  app.set_version_flag("--version", version_text());
  app.add_flag("--json", console.json, "Results as JSON");
  app.add_flag("--quiet", console.quiet, "Errors only on stderr");
  app.add_flag("-v,--verbose", console.verbosity, "More on stderr");
  app.add_option_function<std::string>(
         "--color", [&console](const std::string& when) { console.colour_messages(when); },
         "Colour of messages: auto (on a terminal, without NO_COLOR), always, never")
      ->type_name("WHEN")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  app.require_subcommand(1)->fallthrough();
  const std::vector<CommandRow> rows = in_groups();
  const std::vector<Parser> parsers = add_commands(app, rows);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const auto all = std::span<char* const>(argv, static_cast<std::size_t>(argc));
    return refuse(app, error, all.subspan(std::min<std::size_t>(1, all.size())), console);
  }
  for (const Parser& parser : parsers) {
    if (parser.sub->parsed()) return run(parser, console);
  }
  return static_cast<ExitCode>(ErrorCode::usage);
}

}  // namespace
}  // namespace flexspline::app

int main(int argc, char** argv) {
  flexspline::app::keep_freed_memory();
  flexspline::app::keep_standard_files_apart();
  std::signal(SIGPIPE, SIG_IGN);  // a write that fails says so
  flexspline::app::catch_stop_signals();
  try {
    return flexspline::app::parse_and_run(argc, argv);
  } catch (const std::filesystem::filesystem_error& error) {
    // A path that no file system can have, or one that went away.
    flexspline::app::Console().error(fmt::format("cannot use '{:.200}': {}; check the path",
                                                 error.path1().string(), error.code().message()));
    return static_cast<int>(flexspline::ErrorCode::input_missing);
  } catch (const std::exception& error) {
    flexspline::app::Console().error(fmt::format("a defect of ours: {}", error.what()));
    return static_cast<int>(flexspline::ErrorCode::defect);
  }
}
