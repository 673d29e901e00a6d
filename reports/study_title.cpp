#include "study_title.hpp"

#include <toml++/toml.h>

namespace flexspline::reports {

std::string study_title(const std::string& lock) {
  try {
    const toml::table table = toml::parse(lock);
    for (const char* path : {"title", "study.title", "name", "study.name"}) {
      const auto title = table.at_path(path).value<std::string>();
      if (title && !title->empty()) return *title;
    }
  } catch (const toml::parse_error&) {
    // A lock that cannot be read is shown as it stands; the report then has a general title.
  }
  return "Harmonic drive hysteresis: what the fits are worth";
}

}  // namespace flexspline::reports
