#pragma once

#include <dlfcn.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/rig.hpp"
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

inline LawSpec law_spec(std::string law, double scale, std::vector<double> coefficients) {
  return {std::move(law), scale, {}, std::move(coefficients)};
}

inline Signal constant(double value) {
  return {[=](double) { return value; }, [](double) { return 0.0; }};
}

inline std::unique_ptr<RigSystem> made_rig(const RigModel& model, const RigInputs& inputs,
                                           std::string_view form) {
  auto system = make_rig(model.rig, model.drive, inputs, form);
  EXPECT_TRUE(system) << (system ? "" : system.error().message());
  return system ? std::move(*system) : nullptr;
}

/// The states at a later instant, by CVODES.
inline std::vector<double> later(const RigSystem& system, double from, double to,
                                 const std::vector<double>& y, double tolerance) {
  SystemSettings settings;
  settings.relative_tolerance = tolerance;
  settings.absolute_tolerance.assign(system.states(), 1e-2 * tolerance);
  const std::vector<double> times = {from, to};
  const auto run = integrate_system(system, system.parameter_vector(), times, y, settings);
  EXPECT_TRUE(run) << (run ? "" : run.error().message());
  if (!run) return std::vector<double>(y.size(), std::nan(""));
  return {run->state.end() - static_cast<long>(y.size()), run->state.end()};
}

/// A stiff 226 Nm gear of ratio 50 with its motor and a load.
inline RigModel example_model(Rig rig) {
  RigModel model{rig, {}};
  DriveSpec& drive = model.drive;
  drive.torsion.f = law_spec("odd_polynomial", 2e-3, {24.0, 6.0});
  drive.torsion.g_inverse = law_spec("odd_polynomial", 0.05, {3.0, 1.0});
  drive.torsion.h = law_spec("bounded_modulation", 2e-3, {0.1, 0.2});
  drive.gear_ratio = 50.0;
  drive.motor_inertia = 7.26e-4;
  drive.motor_viscous = 6e-4;
  drive.motor_coulomb = 0.03;
  drive.coulomb_width = 2.0;
  drive.load_inertia = 2.9;
  drive.load_viscous = 0.8;
  drive.load_mass = 5.0;
  drive.arm_length = 0.3;
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
