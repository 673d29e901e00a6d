#pragma once

#include <map>
#include <random>
#include <set>

#include "command_specs.hpp"
#include "program_fixture.hpp"

namespace flexspline::studies {

namespace fs = std::filesystem;

/// Inputs, what every command makes of them, and the program tried on all of it, spoilt or not.
/// Whatever it is given: its exit code is one of the contract and no defect, no signal ends it, it
/// stops when asked, and of all that it was not told to write nothing changes.
class SpoiltInputs {
 public:
  SpoiltInputs() : commands_(all_commands()) {
    write_inputs();
    make_outputs();
    fs::copy(world(), folder_.path() / "pristine", fs::copy_options::recursive);
    before_ = hashes(world());
    std::set<std::pair<fs::path, fs::path>> kinds;
    for (const auto& [file, sum] : before_) {
      const fs::path path = file;
      if (kinds.emplace(path.parent_path(), path.extension()).second) files_.push_back(file);
    }
    for (const auto& entry : fs::recursive_directory_iterator(world())) {
      if (entry.is_directory()) folders_.push_back(entry.path().string());
    }
    std::ranges::sort(folders_);
  }

  /// Every command with each of its inputs, and its output, being each file and folder there is.
  std::vector<std::vector<std::string>> crossed() const {
    std::vector<std::vector<std::string>> calls;
    for (const CommandSpec& command : commands_) {
      for (const ArgumentSpec& argument : command.arguments) {
        if (!argument.is_input() && !argument.is_output()) continue;
        for (const auto* paths : {&files_, &folders_}) {
          for (const std::string& path : *paths) {
            calls.push_back(call_of(command, {{argument.name, path}}));
          }
        }
      }
    }
    return calls;
  }

  /// Every command with each of its options having each of some values, sensible and not.
  std::vector<std::vector<std::string>> with_options() const {
    std::vector<std::vector<std::string>> calls;
    for (const CommandSpec& command : commands_) {
      calls.push_back({command.id});
      calls.push_back({command.id, "--help"});
      for (const ArgumentSpec& argument : command.arguments) {
        for (const std::string& value : values_of(argument)) {
          calls.push_back(call_of(command, {{argument.name, value}}));
        }
      }
    }
    return calls;
  }

  /// A command on an input of which a file was cut, doubled, emptied or had bits flipped.
  std::vector<std::string> spoilt_call(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    while (true) {
      const CommandSpec& command = pick(commands_, random);
      std::vector<const ArgumentSpec*> inputs;
      for (const ArgumentSpec& one : command.arguments) {
        if (one.is_input()) inputs.push_back(&one);
      }
      if (inputs.empty()) continue;
      const ArgumentSpec& argument = *pick(inputs, random);
      const std::string path = input_for(command, argument, random);
      return call_of(command, {{argument.name, spoil(path, random)}});
    }
  }

  /// Runs it, checks what is promised of every run, and counts.
  void attempt(const std::vector<std::string>& words) {
    Call call{words};
    call.limit = kLimit;
    call.folder = scratch() / "here";
    fs::create_directories(call.folder);
    const auto inputs = fs::exists(spoilt()) ? hashes(spoilt()) : decltype(before_){};
    const Ended ended = run_program(call);
    ++counts_[words.front()][ended.code];
    longest_ = std::max(longest_, ended.seconds);
    check(words, ended);
    if (fs::exists(spoilt()) && !writes_into(words, spoilt())) {
      EXPECT_EQ(hashes(spoilt()), inputs) << shown(words);
    }
    check_world(words);
    fs::remove_all(scratch());
    fs::remove_all(spoilt());
  }

  /// Tries by command and exit code.
  void print_counts() const {
    std::size_t all = 0;
    for (const auto& [command, codes] : counts_) {
      std::string line = command;
      for (const auto& [code, count] : codes) {
        line += "  " + std::to_string(code) + ": " + std::to_string(count);
        all += count;
      }
      std::printf("%s\n", line.c_str());
    }
    std::printf("%zu tries, the longest %.1f s\n", all, longest_);
  }

 private:
  using Values = std::map<std::string, std::string>;
  static constexpr double kLimit = 10.0;  // s, then it is asked to stop

  fs::path world() const { return folder_.path() / "world"; }
  fs::path scratch() const { return folder_.path() / "scratch"; }
  fs::path spoilt() const { return folder_.path() / "spoilt"; }
  std::string in_world(const std::string& name) const { return (world() / name).string(); }

  template <class T>
  static const T& pick(const std::vector<T>& list, std::mt19937_64& random) {
    return list[random() % list.size()];
  }

  void write_inputs() {
    fs::create_directories(world());
    folder_.write("world/model.toml", read_text(std::string(FLEXSPLINE_SOURCE_DIR) +
                                                "/tests/studies/cubic_model.toml"));
    folder_.write("world/study.toml", kSmallStudy + "[[input]]\nid = \"set\"\ndataset = \"set\"\n");
    folder_.write("world/bench.toml", kSmallBench);
    folder_.write("world/trial.toml",
                  "schema = \"flexspline-trial/1\"\nname = \"t\"\nseed = 1\n"
                  "rigs = [\"specimen\"]\ncases = 1\n[draw]\none = 1\n");
    folder_.write("world/bench.csv", read_text(std::string(FLEXSPLINE_SOURCE_DIR) +
                                               "/tests/data/corpus/files/unit_row.csv"));
    ASSERT_EQ(run_program({"simulate", in_world("model.toml"), "--excitation", "sine",
                           "--amplitude", "0.2deg", "--frequency", "0.005Hz", "--samples", "200",
                           "--out", in_world("set")})
                  .code,
              0);
  }

  /// Of every command that writes a folder, one that it wrote.
  void make_outputs() {
    for (const CommandSpec& command : commands_) {
      if (!command.has("--out") || command.id == "verify") continue;
      Values values = {{"--out", in_world("made/" + command.id)}};
      const Ended ended = run_program(call_of(command, values));
      EXPECT_TRUE(ended.code == 0 || ended.code == 1) << command.id << ": " << ended.said;
    }
    static_cast<void>(run_program({"verify", in_world("made/run"), "--jobs", "1"}));
  }

  /// What a command cannot do without, where its placeholders do not say it.
  Values defaults_of(const CommandSpec& command) const {
    Values values;
    for (const ArgumentSpec& one : command.arguments) {
      if (!one.required) continue;
      const auto holds = [&](const char* word) {
        return one.takes.find(word) != std::string::npos;
      };
      values[one.name] = one.is_output()    ? (scratch() / "out").string()
                         : holds("STUDY")   ? in_world("study.toml")
                         : holds("BENCH")   ? in_world("bench.toml")
                         : holds("MODEL")   ? in_world("model.toml")
                         : holds("DATASET") ? in_world("set")
                         : holds("DIR")     ? in_world("made/run")
                         : holds("FILE")    ? in_world("set/sine.csv")
                         : one.takes.find('|') < one.takes.size()
                             ? one.takes.substr(0, one.takes.find('|'))
                             : "x";
    }
    const std::map<std::string, Values> known = {
        {"simulate",
         {{"--excitation", "sine"},
          {"--amplitude", "0.2deg"},
          {"--frequency", "1Hz"},
          {"--samples", "100"}}},
        {"fit", {{"--estimator", "midpoint_polynomial"}, {"--jobs", "1"}}},
        {"compare", {{"--estimators", "midpoint_polynomial,midpoint_pooled"}, {"--jobs", "1"}}},
        {"diagnose", {{"dataset", in_world("set")}}},
        {"trial", {{"study", in_world("trial.toml")}, {"--jobs", "1"}}},
        {"run", {{"--jobs", "1"}}},
        {"verify", {{"--jobs", "1"}, {"--out", (scratch() / "out").string()}}},
        {"selftest", {{"--collection", "nist"}, {"--backend", "ceres"}}},
        {"completion", {{"shell", "bash"}}},
        {"schema", {{"name", "study"}}},
        {"list", {{"catalogue", "effects"}}},
        {"explain", {{"effect", "backlash"}}},
        {"export", {{"--to", "c99"}}},
        {"import", {{"files", in_world("bench.csv")}, {"--ratio", "100"}}}};
    if (const auto found = known.find(command.id); found != known.end()) {
      for (const auto& [name, value] : found->second) values[name] = value;
    }
    return values;
  }

  std::vector<std::string> call_of(const CommandSpec& command, const Values& given) const {
    Values values = defaults_of(command);
    for (const auto& [name, value] : given) values[name] = value;
    if (given.contains("--model")) values.erase("--estimator");
    if (given.contains("--like")) values.erase("--excitation");
    std::vector<std::string> words = {command.id};
    for (const ArgumentSpec& one : command.arguments) {
      const auto value = values.find(one.name);
      if (value == values.end()) continue;
      if (one.is_option()) words.push_back(one.name);
      if (!one.takes.empty()) words.push_back(value->second);
    }
    return words;
  }

  static std::vector<std::string> values_of(const ArgumentSpec& argument) {
    std::vector<std::string> values = {"", "x", "../x", "-1", "nan", std::string(5000, 'y')};
    for (std::size_t from = 0; argument.takes.find('|') < argument.takes.size();) {
      const std::size_t to = argument.takes.find('|', from);
      values.push_back(argument.takes.substr(from, to - from));
      if (to == std::string::npos) break;
      from = to + 1;
    }
    for (const char* value :
         {"0", "1", "2", "1000000", "99999999999999999999", "1e300Nm", "1e300deg", "0.1deg", "5Nm",
          "1e-300Hz", "0.01Hz", "samples=50", "x=1", "=", "none", "sine"}) {
      values.emplace_back(value);
    }
    return values;
  }

  /// The input that is meant, or any other there is.
  std::string input_for(const CommandSpec& command, const ArgumentSpec& argument,
                        std::mt19937_64& random) const {
    const Values values = defaults_of(command);
    const auto meant = values.find(argument.name);
    if (meant != values.end() && random() % 2 == 0) return meant->second;
    if (argument.takes.find("toml") != std::string::npos) {
      const std::vector<std::string> tomls = {in_world("study.toml"), in_world("trial.toml"),
                                              in_world("bench.toml"), in_world("model.toml"),
                                              in_world("set/dataset.toml")};
      return pick(tomls, random);
    }
    std::vector<std::string> whole = {in_world("set"), in_world("study.toml")};
    for (const auto& entry : fs::directory_iterator(world() / "made")) {
      whole.push_back(entry.path().string());
    }
    std::ranges::sort(whole);
    return pick(whole, random);
  }

  /// A copy of a file with those beside it, or of a folder, with one file spoilt.
  std::string spoil(const fs::path& path, std::mt19937_64& random) const {
    const fs::path copy = spoilt() / path.filename();
    fs::remove_all(spoilt());
    fs::create_directories(spoilt());
    fs::copy(path, copy, fs::copy_options::recursive);
    if (fs::exists(world() / "set") && !fs::exists(spoilt() / "set")) {
      fs::copy(world() / "set", spoilt() / "set", fs::copy_options::recursive);
    }
    std::vector<fs::path> files;
    if (fs::is_regular_file(copy)) files.push_back(copy);
    for (std::error_code none; const auto& entry : fs::recursive_directory_iterator(copy, none)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    if (files.empty()) return copy.string();
    const fs::path& file = pick(files, random);
    std::ofstream(file, std::ios::binary) << spoilt_text(read_text(file), random);
    return copy.string();
  }

  static std::string spoilt_text(std::string text, std::mt19937_64& random) {
    switch (random() % 4) {
      case 0:
        return text.substr(0, random() % (text.size() + 1));
      case 1:
        return text + text;
      case 2:
        return {};
      default:
        for (std::uint64_t flips = 1 + random() % 8; flips > 0 && !text.empty(); --flips) {
          char& letter = text[random() % text.size()];
          letter = static_cast<char>(letter ^ (1 << random() % 8));
        }
        return text;
    }
  }

  static std::string shown(const std::vector<std::string>& words) {
    std::string text = "flexspline";
    for (const std::string& word : words) text += " '" + word.substr(0, 200) + "'";
    return text;
  }

  static void check(const std::vector<std::string>& words, const Ended& ended) {
    SCOPED_TRACE(shown(words) + "\n" + ended.said.substr(0, 2000));
    EXPECT_EQ(ended.signal, 0);
    const std::vector<int> allowed = {0, 1, 2, 65, 66, 73};
    const bool done = std::ranges::find(allowed, ended.code) != allowed.end();
    EXPECT_TRUE(done || (ended.stopped && ended.code == 75)) << ended.code;
    if (ended.stopped) {
      EXPECT_LT(ended.stopping, 4.0);
    }
    EXPECT_EQ(ended.said.find("runtime error"), std::string::npos);
    EXPECT_EQ(ended.said.find("Sanitizer"), std::string::npos);
    EXPECT_EQ(ended.said.find("json.exception"), std::string::npos) << "a library's words";
  }

  /// Folders that a call may write to: what it names as output; report and verify draw in theirs.
  std::vector<fs::path> outputs_of(const std::vector<std::string>& words) const {
    std::vector<fs::path> outputs = {scratch()};
    for (std::size_t i = 1; i + 1 < words.size(); ++i) {
      if (ArgumentSpec{words[i], "", false}.is_output()) outputs.emplace_back(words[i + 1]);
    }
    if (words.size() > 1 && words.front() == "report") outputs.emplace_back(words[1]);
    return outputs;
  }
  bool writes_into(const std::vector<std::string>& words, const fs::path& folder) const {
    const auto outputs = outputs_of(words);
    return std::ranges::any_of(
        outputs, [&](const fs::path& one) { return one.string().starts_with(folder.string()); });
  }

  void check_world(const std::vector<std::string>& words) {
    for (const fs::path& place : {world(), scratch(), spoilt()}) {
      if (!fs::exists(place)) continue;
      for (const auto& entry : fs::recursive_directory_iterator(place)) {
        EXPECT_NE(entry.path().extension(), ".part") << entry.path() << shown(words);
      }
    }
    const auto after = hashes(world());
    if (after == before_) return;
    const auto outputs = outputs_of(words);
    const auto may_change = [&](const std::string& file) {
      return std::ranges::any_of(
          outputs, [&](const fs::path& one) { return file.starts_with(one.string() + "/"); });
    };
    for (const auto& [file, sum] : before_) {
      const auto now = after.find(file);
      if (now != after.end() && now->second == sum) continue;
      EXPECT_TRUE(may_change(file)) << file << " was changed by " << shown(words);
    }
    for (const auto& [file, sum] : after) {
      EXPECT_TRUE(before_.contains(file) || may_change(file)) << file << " by " << shown(words);
    }
    fs::remove_all(world());
    fs::copy(folder_.path() / "pristine", world(), fs::copy_options::recursive);
  }

  ScratchFolder folder_;
  std::vector<CommandSpec> commands_;
  std::map<std::string, std::string> before_;
  std::vector<std::string> files_;  ///< of every folder one of each kind
  std::vector<std::string> folders_;
  std::map<std::string, std::map<int, std::size_t>> counts_;
  double longest_ = 0.0;
};

}  // namespace flexspline::studies
