#pragma once

#include <pybind11/pybind11.h>

namespace sigmax::python {

/// Each adds the classes and functions of one room to the module `sigmax._sigmax`. Later rooms use the classes of
/// earlier ones.
void bind_core(pybind11::module_& module);
void bind_network(pybind11::module_& module);
void bind_recognition(pybind11::module_& module);
void bind_estimation(pybind11::module_& module);
void bind_hybrid(pybind11::module_& module);

}  // namespace sigmax::python
