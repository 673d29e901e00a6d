#include <cstdlib>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tables/mat_tables.hpp"

namespace flexspline::data {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Owned = std::unique_ptr<matvar_t, FreeVariable>;

/// A struct of two elements with one field x, a vector of three.
Owned two_elements() {
  std::size_t dims[] = {2, 1};
  const char* fields[] = {"x"};
  Owned made(Mat_VarCreateStruct("s", 2, dims, fields, 1));
  std::size_t size[] = {3, 1};
  double values[] = {1.0, 2.0, 3.0};
  for (std::size_t e = 0; e < 2; ++e) {
    Mat_VarSetStructFieldByName(made.get(), "x", e,
                                Mat_VarCreate("x", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, values, 0));
  }
  return made;
}

TEST(MatVariable, IsReadByFieldAndElement) {
  const Owned made = two_elements();
  const MatVariable one(made.get());
  EXPECT_EQ(one.elements(), 2u);
  EXPECT_THAT(one.fields(), ElementsAre("x"));
  EXPECT_THAT(one.field("x", 1).values(), ElementsAre(1.0, 2.0, 3.0));
  EXPECT_FALSE(one.field("x", 2));
  EXPECT_FALSE(one.field("y"));
}

TEST(MatVariable, ADamagedStructWithoutItsElementsHasNoTable) {
  Owned made = two_elements();
  const Owned first(Mat_VarGetStructFieldByName(made.get(), "x", 0));
  const Owned second(Mat_VarGetStructFieldByName(made.get(), "x", 1));
  std::free(made->data);
  made->data = nullptr;
  MatTables tables(TableLimits{});
  tables.take(MatVariable(made.get()));
  EXPECT_THAT(std::move(tables).tables(), IsEmpty());
}

}  // namespace
}  // namespace flexspline::data
