#include "export/c_model.hpp"

namespace flexspline::data {
namespace {

Result<std::vector<ExportedFile>> write(const RigModel& model, const ExportHead& head) {
  auto c = c_model(model, head);
  if (!c) return tl::unexpected(c.error());
  return std::vector<ExportedFile>{{head.name + ".h", std::move(c->header)},
                                   {head.name + ".c", std::move(c->source)}};
}

}  // namespace

ExporterRow describe_c99() {
  return {.id = "c99",
          .says = "one header and one source in C99: state step, outputs and feed-forward",
          .carries =
              "the rig's equations, every law, every effect of motor, load, transmission and "
              "kinematics, with its memory",
          .not_carried =
              "effects on instruments; effects of a whole signal; compliance in series "
              "with the torsion law; servo: its electric side (the input is a torque)",
          .carry = carry_in_c,
          .write = write};
}

}  // namespace flexspline::data
