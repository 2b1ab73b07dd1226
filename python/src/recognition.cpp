#include "rooms.hpp"

namespace sigmax::python {

void bind_recognition(pybind11::module_&) {}

}  // namespace sigmax::python
