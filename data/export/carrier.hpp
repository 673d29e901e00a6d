#pragma once

#include <functional>
#include <string>

#include "flexspline/core/effect.hpp"
#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

/// Takes out of a model what a target cannot hold, and remembers each loss on its own.
class Carrier {
 public:
  explicit Carrier(const RigModel& whole) : whole_(whole), carried_{whole, {}} {}

  /// Leaves out every effect for which there is a reason; empty: none.
  void drop_effects(const std::function<std::string(const EffectRow&, const EffectSpec&)>& reason);

  /// Leaves out what only instruments see: it is no property of the machine.
  void drop_instruments();

  /// Changes the model, as a loss where it changes anything.
  void change(const std::string& what, const std::string& why,
              const std::function<void(RigModel&)>& by,
              const std::function<bool(const RigModel&)>& needed);

  const RigModel& model() const { return carried_.model; }
  Carried done() && { return std::move(carried_); }

 private:
  const RigModel& whole_;
  Carried carried_;
};

/// An effect in words: its id and parameters.
std::string in_words(const EffectSpec& effect);

}  // namespace flexspline::data
