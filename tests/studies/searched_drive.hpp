#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "diagnosis/search/selection.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {

/// A locked drive that was searched for causes, its baseline settled.
class SearchedDrive : public testing::Test {
 protected:
  static constexpr std::string_view kHidden = "presliding_hysteresis";

  /// With a clear effect.
  void search_hidden(Eigen::Index most_rows) { search({{std::string(kHidden), 0.06}}, most_rows); }

  void search(const std::vector<data::HiddenEffect>& hidden, Eigen::Index most_rows) {
    auto made = make_frame(drawn_case(Rig::locked, 201, hidden).recordings, most_rows);
    ASSERT_TRUE(made) << made.error().message();
    frame_ = std::move(*made);
    auto selection = select_causes(frame_, limits_, {});
    ASSERT_TRUE(selection) << selection.error().message();
    s_ = std::move(*selection);
    ASSERT_TRUE(settle_baseline(frame_, s_));
  }

  Frame frame_;
  Limits limits_;
  Selection s_;
};

}  // namespace flexspline::studies
