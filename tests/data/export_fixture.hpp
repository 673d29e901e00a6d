#pragma once

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include <fmt/format.h>

#include "../core/rig_examples.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

/// A folder of its own under the system's, gone at the end.
class ExportFolder {
 public:
  ExportFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "flexspline-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~ExportFolder() { std::filesystem::remove_all(path_); }
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

  void write(const std::vector<ExportedFile>& files) const {
    for (const ExportedFile& file : files) {
      const auto written = write_file(path_ / file.path, file.content);
      ASSERT_TRUE(written) << written.error().message();
    }
  }
  /// The exit code of a command in the folder.
  int run(const std::string& command) const {
    return std::system(fmt::format("cd {} && {}", path_.string(), command).c_str());
  }

 private:
  std::filesystem::path path_;
};

inline bool there_is(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

inline Carried carried(std::string_view exporter, const RigModel& model) {
  const auto row = find_exporter(exporter);
  EXPECT_TRUE(row);
  auto result = (*row)->carry(model);
  EXPECT_TRUE(result) << (result ? "" : result.error().message());
  return result ? std::move(*result) : Carried{};
}

inline void write_export(std::string_view exporter, const RigModel& model,
                         const ExportFolder& folder) {
  const auto files = (*find_exporter(exporter))->write(model, {"drive", {"remark"}});
  ASSERT_TRUE(files) << files.error().message();
  folder.write(*files);
}

inline RigModel example_model(Rig rig) {
  RigModel model{rig, example_drive()};
  if (rig == Rig::locked) model.drive.load_inertia = 0.0;
  if (rig == Rig::specimen) model.drive.gear_ratio = 1.0;
  return model;
}

/// A function of a shared library.
template <class Function>
Function* symbol_of(void* library, const char* name) {
  Function* found = nullptr;
  void* address = dlsym(library, name);
  std::memcpy(&found, &address, sizeof found);
  return found;
}

}  // namespace flexspline::data
