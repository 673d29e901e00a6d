#pragma once

#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace flexspline::studies {

/// The name of a parametrised test: what << says of its parameter.
struct PrintedName {
  template <class Param>
  std::string operator()(const testing::TestParamInfo<Param>& info) const {
    std::ostringstream name;
    name << info.param;
    return name.str();
  }
};

}  // namespace flexspline::studies
