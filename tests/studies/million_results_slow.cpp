#include <chrono>
#include <cstdlib>

#include <gtest/gtest.h>
#include <netcdf.h>
#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include "flexspline/studies/engine.hpp"
#include "flexspline/studies/results.hpp"
#include "results/row_json.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kVariants = 1000;
constexpr std::size_t kReplicates = 1000;

/// What case (variant, replicate) says: a parameter and an error that are told from its place.
double told(std::size_t variant, std::size_t replicate) {
  return static_cast<double>(variant) + 1e-3 * static_cast<double>(replicate);
}

/// The cases of a plan, computed by nobody.
class ToldCases : public CaseSource {
 public:
  explicit ToldCases(const StudyPlan& plan) : plan_(&plan) {}
  std::size_t size() const override { return plan_->size(); }
  CaseName name(std::size_t number) const override {
    CasePlan one = plan_->at(number);
    return {std::move(one.key), std::move(one.depends_on)};
  }
  CaseResult compute(std::size_t number) override {
    const CasePlan one = plan_->at(number);
    const double value = told(one.variant, static_cast<std::size_t>(one.replicate));
    CaseRow row;
    row.parameters.push_back({"f[0]", value, 0.1, "Nm"});
    row.recordings.push_back({one.holdout.front(), "holdout", 0.2, 0.005, 2.0 * value, value});
    row.numbers["cost"] = value;
    return {{}, 0.0, row_json(row).dump(), "{}"};
  }
  CaseResult give_up(std::size_t, const Error& why) override { return {why.problem}; }

 private:
  const StudyPlan* plan_;
};

double peak_gb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e6;
}

double value_at(const std::filesystem::path& file, const char* name, std::size_t variant,
                std::size_t replicate) {
  int id = -1;
  int variable = -1;
  EXPECT_EQ(nc_open(file.c_str(), NC_NOWRITE, &id), NC_NOERR);
  EXPECT_EQ(nc_inq_varid(id, name, &variable), NC_NOERR) << name;
  const std::size_t at[] = {variant, 0, 0, replicate};
  double value = 0.0;
  EXPECT_EQ(nc_get_var1_double(id, variable, at, &value), NC_NOERR) << name;
  nc_close(id);
  return value;
}

bool has_xarray() {
  return std::system("/usr/bin/python3 -c 'import xarray, netCDF4' > /dev/null 2>&1") == 0;
}

TEST(MillionResults, AreWrittenInPiecesAndOpenInXarray) {
  const ScratchFolder folder;
  const auto study = load_study(folder.write(
      "study.toml", kHead + "replicates = " + std::to_string(kReplicates) +
                        "\n[bench]\ncycles = 3\nsamples_per_cycle = 100\n[[sweep]]\nkey = "
                        "\"bench.torque_noise_white\"\nunit = \"%\"\nlinspace = { from = 0.1, to = "
                        "1.0, count = " +
                        std::to_string(kVariants) + " }\n" + kGrid + kInput + kEstimator));
  ASSERT_TRUE(study) << study.error().message();
  const auto begun = std::chrono::steady_clock::now();
  const auto plan = plan_study(*study, "build");
  ASSERT_TRUE(plan) << plan.error().message();
  ASSERT_EQ(plan->size(), kVariants * kReplicates);
  const std::chrono::duration<double> planning = std::chrono::steady_clock::now() - begun;
  EXPECT_LE(planning.count(), 5.0);
  EXPECT_LE(peak_gb(), 1.05);

  ToldCases cases(*plan);
  EngineSettings settings;
  settings.folder = folder.path() / "out";
  settings.jobs = 2;
  const auto ran = run_cases(cases, settings);
  ASSERT_TRUE(ran) << ran.error().message();
  ASSERT_EQ(ran->computed, kVariants * kReplicates);
  const auto rows = StudyRows::open(*plan, settings.folder);
  ASSERT_TRUE(rows) << rows.error().message();
  const auto written = write_results(*rows, {}, settings.folder);
  ASSERT_TRUE(written) << written.error().message();
  EXPECT_LE(peak_gb(), 1.05);

  const auto file = settings.folder / "results.nc";
  for (const auto& [v, r] : {std::pair<std::size_t, std::size_t>{0, 0}, {499, 3}, {999, 999}}) {
    EXPECT_EQ(value_at(file, "case_cost", v, r), told(v, r));
  }
  if (!has_xarray()) GTEST_SKIP() << "xarray is not installed: not opened in it";
  const std::string script =
      "import sys, xarray\n"
      "d = xarray.open_dataset(sys.argv[1], chunks=None)\n"
      "assert d.sizes['variant'] == 1000 and d.sizes['replicate'] == 1000, d.sizes\n"
      "e = d['error'].isel(variant=499, replicate=3).squeeze()\n"
      "assert float(e) == 499.003 and e.attrs['units'] == 'N m', e\n"
      "assert all('long_name' in d[v].attrs for v in d.variables)\n";
  const auto python = folder.write("open.py", script);
  EXPECT_EQ(std::system(("/usr/bin/python3 '" + python.string() + "' '" + file.string() + "' 2> '" +
                         (folder.path() / "said").string() + "'")
                            .c_str()),
            0)
      << read_text(folder.path() / "said");
  std::printf("plan %.1f s, %.2f GB at most\n", planning.count(), peak_gb());
}

}  // namespace
}  // namespace flexspline::studies
