#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "bindings.hpp"

namespace flexspline::python {

void interruptible(std::function<void()> work) {
  using namespace std::chrono_literals;
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> future = done->get_future();
  std::thread([work = std::move(work), done] {
    try {
      work();
      done->set_value();
    } catch (...) {
      done->set_exception(std::current_exception());
    }
  }).detach();
  const pybind11::gil_scoped_release unlocked;
  while (future.wait_for(100ms) != std::future_status::ready) {
    const pybind11::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }
  future.get();
}

}  // namespace flexspline::python
