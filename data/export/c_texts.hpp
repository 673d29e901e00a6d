#pragma once

#include <string_view>

namespace flexspline::data {

// Parts of the C source that are the same for every model; @x@ is replaced by what c_model knows.

/// A rig's equations: how many states of its own, and in C
///   static void rates(double t, const double *y, const <name>_input *u, double torque_rate,
///                     double *dy, <name>_output *out).
struct CRigText {
  int states = 0;
  std::string_view input;      ///< members of the input
  std::string_view state;      ///< what the first states are
  std::string_view equations;  ///< C
  std::string_view feed_forward;
  std::string_view feed_forward_says;
};

extern const CRigText kCFree;
extern const CRigText kCLocked;
extern const CRigText kCServo;
extern const CRigText kCSpecimen;

extern const std::string_view kCHeader;
extern const std::string_view kCStep;

}  // namespace flexspline::data
