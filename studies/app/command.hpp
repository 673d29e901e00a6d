#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "console.hpp"
#include "flexspline/core/error.hpp"

namespace flexspline::app {

/// One argument of a command. Names that begin with - are options, others positions; each takes a
/// value but flags, which have none.
struct ArgumentInfo {
  std::string_view name;  ///< "study", "--out"
  std::string_view meaning;
  std::string_view value;  ///< what it takes, e.g. "DIR"; a flag: empty
  bool required = false;
  bool repeats = false;  ///< may be given more than once

  bool is_flag() const { return value.empty(); }
};

/// What was given, by the name of the argument without its dashes.
class Arguments {
 public:
  void set(const std::string& name, std::vector<std::string> values);

  bool has(const std::string& name) const { return values_.contains(name); }
  /// The last value given; the fallback where there is none.
  std::string text(const std::string& name, const std::string& fallback = {}) const;
  std::vector<std::string> texts(const std::string& name) const;
  /// Errors: usage, naming the option, where the value is not a whole number in [low, high].
  Result<long> integer(const std::string& name, long fallback, long low, long high) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
};

/// The program's exit code where a command did what it could.
using ExitCode = int;
inline constexpr ExitCode kDone = 0;
inline constexpr ExitCode kSomethingFailed = 1;

/// A row of the catalogue of commands.
struct CommandRow {
  std::string_view id;
  std::string_view group;  ///< under which --help lists it
  std::string_view summary;
  std::vector<ArgumentInfo> arguments;
  std::string_view example;
  Result<ExitCode> (*run)(const Arguments&, Console&);
};

/// Every command, one file each in studies/app/commands.
std::span<const CommandRow> commands();

}  // namespace flexspline::app
