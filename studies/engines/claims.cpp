#include "engines/claims.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include <fmt/format.h>

#include "engines/running_note.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/engine.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> not_taken(const fs::path& path, int code) {
  return failure(ErrorCode::cannot_write,
                 "cannot write " + path.string() + ": " + std::generic_category().message(code),
                 "choose a folder that can be written to and has room");
}

/// "000017.0" and its content "170 180 host-123-ab"; nothing of a file that is none.
std::optional<Pack> pack_of(const fs::path& file) {
  Pack pack;
  std::istringstream name(file.filename().string());
  char dot = 0;
  if (!(name >> pack.number >> dot >> pack.taken) || dot != '.' || !name.eof()) return {};
  std::istringstream text(read_file(file).value_or(""));
  if (!(text >> pack.from >> pack.to >> pack.who)) return {};
  return pack;
}

}  // namespace

Claims::Claims(const fs::path& folder, const std::string& study, std::string who,
               double lease_seconds)
    : study_folder_(folder),
      place_(folder / "claims" / study),
      who_(std::move(who)),
      lease_(lease_seconds) {}

std::vector<Pack> Claims::packs() const {
  std::map<std::size_t, Pack> last;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(place_, ignored)) {
    auto pack = pack_of(entry.path());
    if (!pack) continue;
    Pack& known = last.try_emplace(pack->number, *pack).first->second;
    if (pack->taken > known.taken) known = *std::move(pack);
  }
  std::vector<Pack> packs;
  for (auto& [number, pack] : last) packs.push_back(std::move(pack));
  return packs;
}

/// The file has its content from the moment it has its name.
Result<bool> Claims::take(const Pack& pack) const {
  const fs::path name = place_ / fmt::format("{:06}.{}", pack.number, pack.taken);
  std::error_code error;
  fs::create_directories(place_, error);
  const UnfinishedFile file(name);
  std::ofstream out(file.path());
  out << fmt::format("{} {} {}\n", pack.from, pack.to, who_);
  out.close();
  if (!out) return not_taken(name, errno);
  if (::link(file.path().c_str(), name.c_str()) == 0) return true;
  if (errno == EEXIST) return false;
  return not_taken(name, errno);
}

std::optional<bool> Claims::alive(const std::string& who) {
  const auto now = std::chrono::steady_clock::now();
  std::string note = note_of(study_folder_, who);
  if (note.empty()) return false;
  const auto [at, first] = seen_.try_emplace(who, Seen{note, now, false});
  Seen& seen = at->second;
  if (note != seen.note) seen = {std::move(note), now, true};
  if (std::chrono::duration<double>(now - seen.since).count() > lease_) return false;
  return seen.changed ? std::optional<bool>(true) : std::nullopt;
}

void remove_claims(const fs::path& folder) {
  remove_old_notes(folder);
  if (!running_in(folder).empty()) return;
  std::error_code ignored;
  fs::remove_all(folder / "claims", ignored);
}

}  // namespace flexspline::studies
