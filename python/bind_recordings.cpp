#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/data/dataset.hpp"

namespace py = pybind11;

namespace flexspline::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

Array array_of(const std::vector<double>& values) {
  return Array(static_cast<py::ssize_t>(values.size()), values.data());
}

std::vector<double> values_of(const Array& array) {
  return {array.data(), array.data() + array.size()};
}

py::dict channels_of(const Recording& recording) {
  py::dict channels;
  for (const auto& [quantity, values] : recording.channels) {
    channels[py::str(std::string(name_of(quantity)))] = array_of(values);
  }
  return channels;
}

Quantity quantity_of(const std::string& name) {
  if (const auto quantity = find_quantity(name)) return *quantity;
  raise(failure(ErrorCode::bad_data, "there is no quantity '" + name + "'",
                "give one that docs/dataset.md names")
            .value());
}

std::string split_name(Split split) {
  if (split == Split::train) return "train";
  return split == Split::holdout ? "holdout" : "";
}

Split split_of(const std::string& name) {
  if (name == "train") return Split::train;
  if (name == "holdout") return Split::holdout;
  if (name.empty()) return Split::unassigned;
  raise(failure(ErrorCode::bad_data, "there is no split '" + name + "'", "give train or holdout")
            .value());
}

Recording make_recording(const std::string& id, const Array& time,
                         const std::map<std::string, Array>& channels, const std::string& split,
                         const std::string& excitation, double start_s) {
  Recording recording;
  recording.id = id;
  recording.time = values_of(time);
  recording.split = split_of(split);
  recording.excitation = excitation;
  recording.start_s = start_s;
  for (const auto& [name, values] : channels) {
    if (values.size() != time.size()) {
      raise(failure(ErrorCode::bad_data,
                    "channel '" + name + "' has " + std::to_string(values.size()) +
                        " samples, time has " + std::to_string(time.size()),
                    "give every channel as many samples as time")
                .value());
    }
    recording.channels[quantity_of(name)] = values_of(values);
  }
  return recording;
}

RecordingSet make_set(const std::string& name, const std::string& rig,
                      const std::map<std::string, double>& constants,
                      std::vector<Recording> recordings) {
  const auto found = find_rig(rig);
  if (!found) {
    raise(failure(ErrorCode::bad_data, "there is no rig '" + rig + "'",
                  "give locked, free, specimen or servo")
              .value());
  }
  RecordingSet set;
  set.name = name;
  set.rig = *found;
  set.constants = constants;
  set.recordings = std::move(recordings);
  return set;
}

}  // namespace

void bind_recordings(py::module_& module) {
  py::class_<Recording>(module, "Recording")
      .def(py::init(&make_recording), py::arg("id"), py::arg("time"), py::arg("channels"),
           py::arg("split") = "", py::arg("excitation") = "", py::arg("start_s") = 0.0)
      .def_readonly("id", &Recording::id)
      .def_readonly("excitation", &Recording::excitation)
      .def_readonly("amplitude", &Recording::amplitude)
      .def_readonly("frequency_hz", &Recording::frequency_hz)
      .def_readonly("start_s", &Recording::start_s)
      .def_property_readonly("split", [](const Recording& r) { return split_name(r.split); })
      .def_property_readonly("time", [](const Recording& r) { return array_of(r.time); })
      .def_property_readonly("channels", &channels_of);
  py::class_<RecordingSet>(module, "RecordingSet")
      .def(py::init(&make_set), py::arg("name"), py::arg("rig"), py::arg("constants"),
           py::arg("recordings"))
      .def_readonly("name", &RecordingSet::name)
      .def_property_readonly("rig", [](const RecordingSet& s) { return name_of(s.rig); })
      .def_readonly("license", &RecordingSet::license)
      .def_readonly("source", &RecordingSet::source)
      .def_readonly("note", &RecordingSet::note)
      .def_readonly("sha256", &RecordingSet::sha256)
      .def_readonly("constants", &RecordingSet::constants)
      .def_readonly("notes", &RecordingSet::notes)
      .def_readonly("recordings", &RecordingSet::recordings);
  module.def("read_dataset",
             [](const std::string& folder) { return value_of(data::load_dataset(folder)); });
  module.def("write_dataset", [](const std::string& folder, const RecordingSet& set) {
    value_of(data::write_dataset(folder, set));
  });
}

}  // namespace flexspline::python
