#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "source_dir.hpp"
#include "source_tree.hpp"

namespace flexspline::house {
namespace {

using ::testing::IsEmpty;

TEST(House, LayersIncludeOnlyWhatTheyMay) {
  std::vector<std::string> offenders;
  int includes = 0;
  for (const auto& line : lines_of_code()) {
    const std::string header = included(line.text);
    if (header.empty()) continue;
    ++includes;
    if (!may_include(line.file, header)) offenders.push_back(line.place());
  }
  EXPECT_THAT(offenders, IsEmpty());
  EXPECT_GT(includes, 100) << "the walk over " << FLEXSPLINE_SOURCE_DIR << " found no code";
}

TEST(House, OnlyTheirLayersLinkTheSolvers) {
  std::vector<std::string> offenders;
  for (const auto& line : lines_of_cmake()) {
    const auto names = [&](const char* target) {
      return line.text.find(target) != std::string::npos;
    };
    if (names("SUNDIALS::") && line.file != "core/CMakeLists.txt")
      offenders.push_back(line.place());
    if ((names("Ceres::") || names("PkgConfig::ipopt")) &&
        line.file != "estimators/CMakeLists.txt") {
      offenders.push_back(line.place());
    }
  }
  EXPECT_THAT(offenders, IsEmpty());
}

TEST(House, NoFileNamesAPrivateFolder) {
  std::vector<std::string> offenders;
  for (const auto& line : lines_of_text()) {
    if (!line.file.starts_with("tests/house/") && names_a_private_path(line.text)) {
      offenders.push_back(line.place());
    }
  }
  EXPECT_THAT(offenders, IsEmpty());
}

TEST(HouseRules, RefuseWhatTheyAreFor) {
  EXPECT_FALSE(may_include("reports/page.cpp", "flexspline/estimators/method.hpp"));
  EXPECT_FALSE(may_include("data/dataset.cpp", "flexspline/studies/study.hpp"));
  EXPECT_FALSE(may_include("core/model.cpp", "flexspline/data/dataset.hpp"));
  EXPECT_FALSE(may_include("studies/run.cpp", "flexspline/reports/report.hpp"));
  EXPECT_FALSE(may_include("studies/run.cpp", "app/commands/run.hpp"));
  EXPECT_FALSE(may_include("core/model.cpp", "../tests/core/fixture.hpp"));
  EXPECT_FALSE(may_include("studies/diagnosis/model/noise.cpp", "diagnosis/search/search.hpp"));
  EXPECT_FALSE(may_include("studies/diagnosis/names/confirm.cpp", "diagnosis/decision.hpp"));
  EXPECT_FALSE(may_include("core/rigs/locked.cpp", "cvodes/cvodes.h"));
  EXPECT_FALSE(may_include("estimators/methods/trajectory_ceres.cpp", "ceres/ceres.h"));
  EXPECT_FALSE(may_include("studies/run.cpp", "IpTNLP.hpp"));
}

TEST(HouseRules, AllowWhatTheHouseIsBuiltOf) {
  EXPECT_TRUE(may_include("data/dataset.cpp", "flexspline/core/recording.hpp"));
  EXPECT_TRUE(may_include("studies/run.cpp", "flexspline/estimators/method.hpp"));
  EXPECT_TRUE(may_include("studies/app/main.cpp", "flexspline/reports/report.hpp"));
  EXPECT_TRUE(may_include("core/integrators/cvodes.cpp", "cvodes/cvodes.h"));
  EXPECT_TRUE(may_include("estimators/solvers/ceres.cpp", "ceres/ceres.h"));
  EXPECT_TRUE(may_include("studies/diagnosis/search/search.cpp", "diagnosis/model/noise.hpp"));
  EXPECT_TRUE(may_include("studies/diagnosis/decision.cpp", "diagnosis/names/finding.hpp"));
}

TEST(HouseRules, ReadIncludeLines) {
  EXPECT_EQ(included("#include \"flexspline/core/law.hpp\""), "flexspline/core/law.hpp");
  EXPECT_EQ(included("  #  include <vector>  // growth"), "vector");
  EXPECT_EQ(included("// see law.hpp"), "");
}

TEST(HouseRules, KnowAPrivatePath) {
  EXPECT_TRUE(names_a_private_path("see /home/ada/gears"));
  EXPECT_TRUE(names_a_private_path("\"/Users/ada/gears\""));
  EXPECT_FALSE(names_a_private_path("/usr/include/coin"));
  EXPECT_FALSE(names_a_private_path("tests/home/x and frame/work/x"));
}

}  // namespace
}  // namespace flexspline::house
