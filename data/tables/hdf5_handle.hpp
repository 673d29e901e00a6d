#pragma once

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace flexspline::data {

/// An object of HDF5, closed at its end.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A text attribute of an object; empty where it has none.
std::string hdf5_text(hid_t object, const char* name);
/// The first number of an attribute, or the fallback.
double hdf5_number(hid_t object, const char* name, double fallback);

}  // namespace flexspline::data
