// poolhall._core: what of the Python package is written in C++. docs/python.md is its manual.
#include "clients/python/core/referee.hpp"
#include "clients/python/core/simulation.hpp"
#include "clients/python/core/table.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "Physics and referee of Poolhall; use it through the package poolhall.";
  poolhall::python::bind_table(module);
  poolhall::python::bind_simulation(module);
  poolhall::python::bind_evaluation(module);
  poolhall::python::bind_referee(module);
  poolhall::python::bind_timing(module);
}
