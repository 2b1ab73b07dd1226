#include "rooms.hpp"

namespace sigmax::python {

void bind_estimation(pybind11::module_&) {}

}  // namespace sigmax::python
