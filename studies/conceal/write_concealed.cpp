#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/data/commitment.hpp"
#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

Result<void> write_concealed(const std::filesystem::path& folder, ConcealedCase concealed,
                             const std::string& salt) {
  const auto set = data::write_dataset(folder / "dataset", concealed.recordings);
  if (!set) return set;
  // The hash of what stands in the files, whose numbers are in display units.
  const auto read = data::load_dataset(folder / "dataset", data::kAllRows);
  if (!read) return tl::unexpected(read.error());
  concealed.answer.dataset_sha256 = read->sha256;
  const nlohmann::ordered_json answer = to_json(concealed.answer);
  const auto open = data::write_artefact(
      folder / "commitment.json",
      data::commitment_to(answer, salt, "what was concealed in the data set beside this file"));
  if (!open) return open;
  return data::write_artefact(folder / "answer.sealed.json", data::sealed(answer, salt));
}

}  // namespace flexspline::studies
