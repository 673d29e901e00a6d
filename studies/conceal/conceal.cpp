#include <algorithm>

#include <fmt/format.h>

#include "conceal/generator.hpp"
#include "conceal/lot.hpp"

namespace flexspline::studies {

const GeneratorRow* find_generator(std::string_view id) {
  const auto rows = generators();
  const auto found = std::ranges::find(rows, id, &GeneratorRow::id);
  return found == rows.end() ? nullptr : &*found;
}

RecordingSet disguised(RecordingSet set, std::uint64_t seed) {
  set.name = "case";
  std::ranges::sort(set.recordings, {}, &Recording::id);
  set.recordings = shuffled(std::move(set.recordings), seed, "order");
  set.sha256 = data::content_hash(set);
  return set;
}

Result<ConcealedCase> conceal(const ConcealPlan& plan) {
  const GeneratorRow* generator = find_generator(plan.generator);
  if (generator == nullptr) {
    return failure(ErrorCode::usage, fmt::format("there is no generator '{}'", plan.generator),
                   "flexspline schema bench lists them");
  }
  auto made = generator->make(plan);
  if (!made) return tl::unexpected(made.error());
  made->answer.generator = plan.generator;
  made->recordings = disguised(std::move(made->recordings), plan.seed);
  made->answer.dataset_sha256 = made->recordings.sha256;
  return made;
}

}  // namespace flexspline::studies
