#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline {

/// A scalar that writes down what is done with it: a law that is a template over the scalar becomes
/// a list of operations, from which code in another language is written. Constants are folded.
/// Laws must not look at its value; what they branch on they leave to the functions here.
class Traced {
 public:
  enum class Does {
    constant,
    variable,
    add,
    subtract,
    multiply,
    divide,
    negate,
    exp,
    log,
    sqrt,
    sin,
    cos,
    tanh,
    atan,
    if_negative,  ///< a < 0 ? b : c
  };
  /// An operation on results of earlier ones.
  struct Step {
    Does does = Does::constant;
    int a = -1;
    int b = -1;
    int c = -1;
    double value = 0.0;
    std::string name = {};  ///< of a variable
  };
  /// The steps in order; while one is in scope, every Traced of this thread belongs to it.
  class Tape {
   public:
    Tape() : before_(current()) { current() = this; }
    ~Tape() { current() = before_; }
    Tape(const Tape&) = delete;
    Tape& operator=(const Tape&) = delete;
    const std::vector<Step>& steps() const { return steps_; }
    int append(Step step) {
      steps_.push_back(std::move(step));
      return static_cast<int>(steps_.size()) - 1;
    }
    static Tape*& current() {
      thread_local Tape* tape = nullptr;
      return tape;
    }

   private:
    Tape* before_;
    std::vector<Step> steps_;
  };

  Traced(double constant = 0.0) : value_(constant) {}  // NOLINT: constants mix with traced ones
  static Traced variable(std::string name) {
    return written({.does = Does::variable, .name = std::move(name)});
  }
  /// The result of a step of the tape in scope.
  static Traced at_step(int step) {
    Traced result;
    result.step_ = step;
    return result;
  }
  /// The step that makes it.
  int step() const {
    return step_ >= 0 ? step_ : written({.does = Does::constant, .value = value_}).step_;
  }
  bool is_constant() const { return step_ < 0; }
  double constant() const { return value_; }

  friend Traced operator-(const Traced& a) {
    return a.is_constant() ? Traced(-a.value_) : written(Does::negate, a);
  }
  friend Traced operator+(const Traced& a, const Traced& b) {
    if (a.is(0.0)) return b;
    if (b.is(0.0)) return a;
    return folded(Does::add, a, b, a.value_ + b.value_);
  }
  friend Traced operator-(const Traced& a, const Traced& b) {
    if (b.is(0.0)) return a;
    if (a.is(0.0)) return -b;
    return folded(Does::subtract, a, b, a.value_ - b.value_);
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    if (a.is(0.0) || b.is(0.0)) return 0.0;
    if (a.is(1.0)) return b;
    if (b.is(1.0)) return a;
    return folded(Does::multiply, a, b, a.value_ * b.value_);
  }
  friend Traced operator/(const Traced& a, const Traced& b) {
    if (a.is(0.0)) return 0.0;
    if (b.is(1.0)) return a;
    return folded(Does::divide, a, b, a.value_ / b.value_);
  }
  Traced& operator+=(const Traced& b) { return *this = *this + b; }
  Traced& operator-=(const Traced& b) { return *this = *this - b; }
  Traced& operator*=(const Traced& b) { return *this = *this * b; }
  Traced& operator/=(const Traced& b) { return *this = *this / b; }

  friend Traced exp(const Traced& x) { return of(Does::exp, x, std::exp(x.value_)); }
  friend Traced log(const Traced& x) { return of(Does::log, x, std::log(x.value_)); }
  friend Traced sqrt(const Traced& x) { return of(Does::sqrt, x, std::sqrt(x.value_)); }
  friend Traced sin(const Traced& x) { return of(Does::sin, x, std::sin(x.value_)); }
  friend Traced cos(const Traced& x) { return of(Does::cos, x, std::cos(x.value_)); }
  friend Traced tanh(const Traced& x) { return of(Does::tanh, x, std::tanh(x.value_)); }
  friend Traced atan(const Traced& x) { return of(Does::atan, x, std::atan(x.value_)); }

  friend Traced where_negative(const Traced& x, const Traced& then, const Traced& otherwise) {
    if (x.is_constant()) return x.value_ < 0.0 ? then : otherwise;
    return written(
        {.does = Does::if_negative, .a = x.step(), .b = then.step(), .c = otherwise.step()});
  }

 private:
  bool is(double value) const { return is_constant() && value_ == value; }
  static Traced written(Step step) {
    expects(Tape::current() != nullptr, "a traced scalar is used while a tape is in scope");
    Traced result;
    result.step_ = Tape::current()->append(std::move(step));
    return result;
  }
  static Traced written(Does does, const Traced& a) {
    return written({.does = does, .a = a.step()});
  }
  static Traced of(Does does, const Traced& x, double constant) {
    return x.is_constant() ? Traced(constant) : written(does, x);
  }
  static Traced folded(Does does, const Traced& a, const Traced& b, double constant) {
    if (a.is_constant() && b.is_constant()) return constant;
    return written({.does = does, .a = a.step(), .b = b.step()});
  }

  double value_ = 0.0;
  int step_ = -1;  ///< -1: a constant
};

// What scalar.hpp decides by the sign of a number, left to the code that is written.

inline Traced magnitude(const Traced& x) { return where_negative(x, -x, x); }

inline Traced positive_power(const Traced& x, const Traced& n) {
  return where_negative(-x, exp(n * log(x)), 0.0);
}

inline Traced limited(const Traced& x, const Traced& bound) {
  return where_negative(bound - x, bound, where_negative(x + bound, -bound, x));
}

inline Traced stop_rate(const Traced& stop, const Traced& input_rate, const Traced& yield) {
  const Traced along = where_negative(input_rate, -stop, stop);
  return where_negative(along - yield, input_rate, 0.0);
}

inline Traced smooth_step(const Traced& x, const Traced& width) {
  const Traced root = sqrt(x * x + width * width);
  const Traced tail = width * width / (2.0 * root * (root + magnitude(x)));
  return where_negative(x, tail, 1.0 - tail);
}

}  // namespace flexspline
