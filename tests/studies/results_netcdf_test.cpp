#include <cmath>

#include <gtest/gtest.h>
#include <netcdf.h>

#include "flexspline/studies/results.hpp"
#include "flexspline/studies/run.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

/// results.nc of a small study, open.
class ResultsFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto study = load_study(folder_.write(
        "study.toml", kHead +
                          "title = \"A title\"\nreplicates = 2\n[bench]\n"
                          "torque_noise_white = { value = 0.5, unit = \"%\" }\ncycles = 3\n"
                          "samples_per_cycle = 100\n" +
                          kGrid + kInput + kEstimator));
    ASSERT_TRUE(study) << study.error().message();
    const auto plan = plan_study(*study, "build");
    ASSERT_TRUE(plan);
    RunSettings settings;
    settings.folder = folder_.path() / "out";
    const auto summary = run_study(*plan, settings);
    ASSERT_TRUE(summary);
    const auto rows = StudyRows::open(*plan, settings.folder);
    ASSERT_TRUE(rows);
    rows->each([&](const CasePlan&, const CaseRow& row) { rows_.push_back(row); });
    ASSERT_TRUE(write_results(*rows, {{"flexspline", "1.2.3"}}, settings.folder));
    ASSERT_EQ(nc_open((settings.folder / "results.nc").c_str(), NC_NOWRITE, &file_), NC_NOERR);
  }
  void TearDown() override { nc_close(file_); }

  int id_of(const char* name) const {
    int id = -1;
    EXPECT_EQ(nc_inq_varid(file_, name, &id), NC_NOERR) << name;
    return id;
  }
  std::string text(int variable, const char* key) const {
    std::size_t size = 0;
    if (nc_inq_attlen(file_, variable, key, &size) != NC_NOERR) return {};
    std::string value(size, ' ');
    nc_get_att_text(file_, variable, key, value.data());
    return value;
  }

  ScratchFolder folder_;
  std::vector<CaseRow> rows_;
  int file_ = -1;
};

TEST_F(ResultsFile, SaysWhereItComesFrom) {
  EXPECT_EQ(text(NC_GLOBAL, "Conventions"), "CF-1.8");
  EXPECT_EQ(text(NC_GLOBAL, "title"), "A title");
  EXPECT_NE(text(NC_GLOBAL, "source").find("flexspline 1.2.3"), std::string::npos);
  EXPECT_FALSE(text(NC_GLOBAL, "history").empty());
  EXPECT_EQ(text(NC_GLOBAL, "study_sha256").size(), 64U);
}

TEST_F(ResultsFile, DescribesEveryVariable) {
  int count = 0;
  ASSERT_EQ(nc_inq_nvars(file_, &count), NC_NOERR);
  ASSERT_GT(count, 10);
  for (int id = 0; id < count; ++id) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    int dimensions[NC_MAX_VAR_DIMS] = {};
    int rank = 0;
    nc_inq_var(file_, id, name, &type, &rank, dimensions, nullptr);
    EXPECT_FALSE(text(id, "long_name").empty()) << name;
    char dimension[NC_MAX_NAME + 1] = {};
    nc_inq_dimname(file_, dimensions[0], dimension);
    const bool coordinate = rank == 1 && std::string(dimension) == name;
    double fill = 0.0;
    const bool filled = nc_get_att_double(file_, id, "_FillValue", &fill) == NC_NOERR;
    EXPECT_EQ(filled, type == NC_DOUBLE && !coordinate) << name;
    EXPECT_EQ(std::isnan(fill), filled) << name;
  }
  for (const char* name : {"replicate", "row"}) {
    nc_type type = NC_NAT;
    nc_inq_vartype(file_, id_of(name), &type);
    EXPECT_EQ(type, NC_INT) << name;
  }
  EXPECT_EQ(text(id_of("error"), "units"), "N m");
  EXPECT_EQ(text(id_of("error_percent"), "units"), "percent");
}

// Both errors are those of the artefacts, and every parameter has the unit that its case says.
TEST_F(ResultsFile, HoldsErrorsInNmAndUnitsOfParameters) {
  ASSERT_EQ(rows_.size(), 2U);
  double error[2] = {};
  double percent[2] = {};
  ASSERT_EQ(nc_get_var_double(file_, id_of("error"), error), NC_NOERR);
  ASSERT_EQ(nc_get_var_double(file_, id_of("error_percent"), percent), NC_NOERR);
  for (std::size_t r = 0; r < 2; ++r) {
    EXPECT_EQ(error[r], rows_[r].recordings[1].error);
    EXPECT_EQ(percent[r], rows_[r].recordings[1].error_percent);
    EXPECT_GT(error[r], 0.0);
  }
  const std::size_t count = rows_[0].parameters.size();
  std::vector<char*> units(count);
  ASSERT_EQ(nc_get_var_string(file_, id_of("parameter_unit"), units.data()), NC_NOERR);
  for (std::size_t p = 0; p < count; ++p) EXPECT_EQ(units[p], rows_[0].parameters[p].unit);
  nc_free_string(count, units.data());
}

}  // namespace
}  // namespace flexspline::studies
