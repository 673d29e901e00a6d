#include <pybind11/pybind11.h>

#include "bindings.hpp"

namespace py = pybind11;

namespace flexspline::python {

void raise(const Error& error) {
  const py::object type = py::module_::import("flexspline.errors").attr("Error");
  const py::object raised =
      type(static_cast<int>(error.code), error.problem, error.remedy, error.message());
  PyErr_SetObject(type.ptr(), raised.ptr());
  throw py::error_already_set();
}

}  // namespace flexspline::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of flexspline; use the package flexspline.";
  flexspline::python::bind_recordings(module);
  flexspline::python::bind_models(module);
  flexspline::python::bind_fits(module);
}
