#include "results/findings_json.hpp"

namespace flexspline::studies {

using nlohmann::ordered_json;

ordered_json findings_json(const std::vector<data::SanityFinding>& findings) {
  ordered_json list = ordered_json::array();
  for (const data::SanityFinding& one : findings) {
    list.push_back({{"code", one.code},
                    {"says", one.message()},
                    {"check", one.check},
                    {"severity", data::name_of(one.severity)},
                    {"recording",
                     one.recording.empty() ? ordered_json(nullptr) : ordered_json(one.recording)}});
  }
  return list;
}

}  // namespace flexspline::studies
