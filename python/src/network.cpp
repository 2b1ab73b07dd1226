#include "rooms.hpp"

namespace sigmax::python {

void bind_network(pybind11::module_&) {}

}  // namespace sigmax::python
