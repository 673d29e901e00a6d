#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/data/model_toml.hpp"

namespace py = pybind11;

namespace flexspline::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> values_of(const Array& array) {
  return {array.data(), array.data() + array.size()};
}

Array simulated(std::function<Result<std::vector<double>>()> simulate) {
  const auto result = std::make_shared<Result<std::vector<double>>>();
  interruptible([result, simulate = std::move(simulate)] { *result = simulate(); });
  const std::vector<double> values = value_of(std::move(*result));
  return Array(static_cast<py::ssize_t>(values.size()), values.data());
}

Array torque_of(const RigModel& model, const Array& time, const Array& position,
                const Array& velocity, const Array& acceleration) {
  return simulated(
      [torsion = model.drive.torsion,
       motion = Motion{values_of(time), values_of(position), values_of(velocity),
                       values_of(acceleration)}] { return simulate_torque(torsion, motion); });
}

Array torsion_of(const RigModel& model, const Array& time, const Array& torque, double initial) {
  return simulated([torsion = model.drive.torsion, instants = values_of(time),
                    torques = values_of(torque),
                    initial] { return simulate_torsion(torsion, instants, torques, initial); });
}

}  // namespace

void bind_models(py::module_& module) {
  py::class_<RigModel>(module, "Model")
      .def_property_readonly("toml", [](const RigModel& model) { return data::model_toml(model); })
      .def_property_readonly("rig", [](const RigModel& model) { return name_of(model.rig); })
      .def_property_readonly(
          "effects",
          [](const RigModel& model) {
            std::map<std::string, std::map<std::string, double>> effects;
            for (const EffectSpec& one : model.drive.torsion.effects) {
              effects[one.effect] = {one.parameters.begin(), one.parameters.end()};
            }
            return effects;
          })
      .def("torque", &torque_of, py::arg("time"), py::arg("position"), py::arg("velocity"),
           py::arg("acceleration"))
      .def("torsion", &torsion_of, py::arg("time"), py::arg("torque"), py::arg("initial") = 0.0);
  module.def("read_model",
             [](const std::string& file) { return value_of(data::read_rig_model(file)); });
  module.def("parse_model",
             [](const std::string& text) { return value_of(data::parse_rig_model(text, "text")); });
  module.def("write_model", [](const std::string& file, const RigModel& model) {
    value_of(data::write_model(file, model));
  });
}

}  // namespace flexspline::python
