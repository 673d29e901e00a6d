#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace flexspline::studies {

/// A folder of a test's own, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "flexspline-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Parts of a study that takes a moment: one input, the paper's fit.
inline const std::string kHead = "schema = \"flexspline-study/1\"\nname = \"small\"\n";
inline const std::string kGrid =
    "[[grid]]\nid = \"point\"\namplitude = { values = [0.2], unit = \"deg\" }\n"
    "frequency = { values = [0.005], unit = \"Hz\" }\n";
inline const std::string kInput =
    "[[input]]\nid = \"unity\"\ntruth = \"unity\"\nholdout = \"point\"\n";
inline const std::string kEstimator =
    "[[estimator]]\nid = \"paper\"\nmethod = \"midpoint_polynomial\"\ntrain = \"point\"\n";

}  // namespace flexspline::studies
