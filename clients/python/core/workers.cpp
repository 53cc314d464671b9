#include "clients/python/core/workers.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <sched.h>

namespace poolhall::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

// How long a Ctrl-C may wait.
constexpr std::chrono::milliseconds patience{50};

// Whether all threads have to leave off. Python's signal handlers run in its main thread only, so
// the caller looks for them; the others see what came of it.
class Interrupts {
 public:
  [[nodiscard]] bool stop() {
    if (is_stopped_) {
      return true;
    }
    if (std::this_thread::get_id() != caller_ || Clock::now() < next_look_) {
      return false;
    }
    next_look_ = Clock::now() + patience;
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) {
      has_error_ = true;
      is_stopped_ = true;
    }
    return is_stopped_;
  }
  void leave_off() { is_stopped_ = true; }
  [[nodiscard]] bool has_error() const { return has_error_; }

 private:
  const std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_look_ = Clock::now() + patience;
  std::atomic<bool> is_stopped_{false};
  bool has_error_ = false;
};

}  // namespace

unsigned thread_count(unsigned asked) {
  if (asked != 0) {
    return asked;
  }
  cpu_set_t mine;
  const bool is_known = sched_getaffinity(0, sizeof mine, &mine) == 0;
  return is_known ? static_cast<unsigned>(std::max(1, CPU_COUNT(&mine)))
                  : std::max(1U, std::thread::hardware_concurrency());
}

void for_each_index(std::size_t count, unsigned threads, const Job& job) {
  Interrupts interrupts;
  const Stop stop = [&] { return interrupts.stop(); };
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !stop(); i = next++) {
      try {
        job(i, stop);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = failure ? failure : std::current_exception();
        interrupts.leave_off();
      }
    }
  };
  {
    const py::gil_scoped_release unlocked;
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min<std::size_t>(threads, count); ++i) {
      helpers.emplace_back(work);
    }
    work();
    helpers.clear();
  }
  if (interrupts.has_error()) {
    throw py::error_already_set();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace poolhall::python
