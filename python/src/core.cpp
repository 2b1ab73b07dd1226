#include "rooms.hpp"

namespace sigmax::python {

void bind_core(pybind11::module_&) {}

}  // namespace sigmax::python
