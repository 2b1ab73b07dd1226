#include "rooms.hpp"

#include <string>

namespace py = pybind11;

PYBIND11_MODULE(_sigmax, module) {
  // pybind11 before 2.12 reads the memory of an array as NumPy 1 lays it out; with NumPy 2 that would crash.
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (PYBIND11_VERSION_HEX < 0x020C0000 && std::stoi(version) >= 2)
    throw py::import_error("sigmax was built with pybind11 " + std::to_string(PYBIND11_VERSION_MAJOR) + "." +
                           std::to_string(PYBIND11_VERSION_MINOR) + ", which needs NumPy 1, but found NumPy " +
                           version + "; install 'numpy<2', or build sigmax with pybind11 2.12 or later");
  py::options options;
  options.disable_function_signatures();  // they are in _sigmax.pyi
  module.doc() = "sigma-max inference: probability and possibility as one calculus";
  sigmax::python::bind_core(module);
  sigmax::python::bind_network(module);
  sigmax::python::bind_recognition(module);
  sigmax::python::bind_estimation(module);
  sigmax::python::bind_hybrid(module);
}
