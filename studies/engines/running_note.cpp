#include "engines/running_note.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/write_file.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kEvery = 2.0;   // s
constexpr double kGone = 120.0;  // s of silence after which nobody is there any more

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "host";
}

double age_of(const fs::path& file) {
  std::error_code error;
  const auto then = fs::last_write_time(file, error);
  const auto age = fs::file_time_type::clock::now() - then;
  return error ? 0.0 : std::max(0.0, std::chrono::duration<double>(age).count());
}

}  // namespace

RunningNote::RunningNote(const fs::path& folder, const Shard& shard)
    : who_(fmt::format("{}-{}-{:x}", host(), ::getpid(),
                       std::chrono::system_clock::now().time_since_epoch().count() & 0xffffff)),
      file_(folder / "journals" / (who_ + ".running")),
      shard_(shard) {}

void remove_old_notes(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "journals", ignored)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".running" && age_of(path) > kGone) fs::remove(path, ignored);
  }
}

std::string note_of(const fs::path& folder, const std::string& who) {
  return read_file(folder / "journals" / (who + ".running")).value_or("");
}

void RunningNote::write(const Progress& state) const {
  if (state.seconds < next_) return;
  next_ = state.seconds + kEvery;
  const json note = {{"shard", {shard_.index, shard_.count}},
                     {"done", state.done},
                     {"total", state.total},
                     {"failed", state.failed},
                     {"seconds", state.seconds},
                     {"per_second", state.per_second},
                     {"slowest", state.slowest},
                     {"slowest_for", state.slowest_for}};
  static_cast<void>(write_file(file_.path(), note.dump()));  // the cases say the same, later
}

std::vector<RunningShard> running_in(const fs::path& folder) {
  std::vector<RunningShard> running;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "journals", ignored)) {
    if (entry.path().extension() != ".running") continue;
    const auto text = read_file(entry.path());
    const json note = text ? json::parse(*text, nullptr, false) : json();
    if (!note.is_object()) continue;
    RunningShard one;
    one.who = entry.path().stem().string();
    one.silent_for = age_of(entry.path());
    if (one.silent_for > kGone) continue;
    const json shard = note.value("shard", json::array({1, 1}));
    one.shard = {shard.at(0), shard.at(1)};
    one.state.done = note.value("done", std::size_t{0});
    one.state.total = note.value("total", std::size_t{0});
    one.state.failed = note.value("failed", std::size_t{0});
    one.state.seconds = note.value("seconds", 0.0);
    one.state.per_second = note.value("per_second", 0.0);
    one.state.slowest = note.value("slowest", "");
    one.state.slowest_for = note.value("slowest_for", 0.0);
    running.push_back(std::move(one));
  }
  std::ranges::sort(running, {}, &RunningShard::who);
  return running;
}

}  // namespace flexspline::studies
