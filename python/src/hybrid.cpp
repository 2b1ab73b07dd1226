#include "rooms.hpp"

namespace sigmax::python {

void bind_hybrid(pybind11::module_&) {}

}  // namespace sigmax::python
