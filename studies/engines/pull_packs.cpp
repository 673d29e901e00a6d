#include "engines/pull_packs.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::studies {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostPacks = 2000;  // of a study, so that there are few files
constexpr std::size_t kShare = 8;         // of what is left, so that the last packs are small
constexpr auto kFresh = 2s;

}  // namespace

PackPuller::PackPuller(std::size_t total, Claims claims, const Pulling& pulling,
                       std::vector<bool> done, Look look)
    : total_(total),
      claims_(std::move(claims)),
      pulling_(pulling),
      done_(std::move(done)),
      look_(std::move(look)),
      looked_(std::chrono::steady_clock::now()) {}

std::vector<std::size_t> PackPuller::undone(std::size_t from, std::size_t to) const {
  std::vector<std::size_t> cases;
  for (std::size_t i = from; i < to; ++i) {
    if (!done_[i]) cases.push_back(i);
  }
  return cases;
}

Result<std::optional<Taken>> PackPuller::take_new(double seconds) {
  while (true) {
    const std::vector<Pack> packs = claims_.packs();
    end_ = packs.empty() ? 0 : packs.back().to;
    if (end_ >= total_) return std::nullopt;
    // The first packs measure; then as many cases as fill the time, less towards the end.
    const double fitting = std::isnan(seconds) ? 1.0 : pulling_.pack_seconds / seconds;
    const double most = static_cast<double>(std::max(4 * last_, total_ / kMostPacks));
    const auto wanted = static_cast<std::size_t>(std::clamp(fitting, 1.0, std::max(1.0, most)));
    const std::size_t left = total_ - end_;
    const std::size_t size =
        std::max({std::min(wanted, left / kShare), total_ / kMostPacks, std::size_t{1}});
    Pack pack{packs.size(), end_, std::min(total_, end_ + size), 0, {}};
    const auto taken = claims_.take(pack);
    if (!taken) return tl::unexpected(taken.error());
    if (!*taken) continue;
    last_ = size;
    end_ = pack.to;
    auto cases = undone(pack.from, pack.to);
    if (!cases.empty()) return Taken{std::move(cases), false};
  }
}

Result<void> PackPuller::look() {
  auto done = look_();
  if (!done) return tl::unexpected(done.error());
  done_ = std::move(*done);
  looked_ = std::chrono::steady_clock::now();
  return {};
}

/// What somebody did before he went is only known by looking after he has gone.
Result<Taken> PackPuller::take_over() {
  if (std::chrono::steady_clock::now() - looked_ > kFresh) {
    if (const auto seen = look(); !seen) return tl::unexpected(seen.error());
  }
  Taken nothing;
  for (Pack pack : claims_.packs()) {
    if (pack.who == claims_.who() || undone(pack.from, pack.to).empty()) continue;
    const auto alive = claims_.alive(pack.who);
    nothing.later = nothing.later || !alive;
    if (!alive || *alive) continue;
    if (gone_.insert(pack.who).second) {
      if (const auto seen = look(); !seen) return tl::unexpected(seen.error());
    }
    auto cases = undone(pack.from, pack.to);
    if (cases.empty()) continue;
    ++pack.taken;
    const auto taken = claims_.take(pack);
    if (!taken) return tl::unexpected(taken.error());
    if (*taken) return Taken{std::move(cases), false};
  }
  return nothing;
}

Result<Taken> PackPuller::take(double seconds) {
  auto fresh = take_new(seconds);
  if (!fresh) return tl::unexpected(fresh.error());
  if (*fresh) return **std::move(fresh);
  return take_over();
}

}  // namespace flexspline::studies
