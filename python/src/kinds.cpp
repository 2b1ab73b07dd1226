#include "kinds.hpp"

#include <algorithm>

namespace sigmax::python {

std::size_t index_of(const Outcomes& variable, py::handle key) {
  if (py::isinstance<py::str>(key)) return variable.index_of(py::cast<std::string>(key));
  if (PyIndex_Check(key.ptr()) == 0) throw py::type_error("expected a label or an index, found " + class_name(key));
  const py::ssize_t index = PyNumber_AsSsize_t(key.ptr(), PyExc_IndexError);
  if (index == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (index < 0 || static_cast<std::size_t>(index) >= variable.size())
    throw py::index_error("variable '" + variable.name() + "' has no outcome " + std::to_string(index));
  return static_cast<std::size_t>(index);
}

Family::Family(py::module_& module, py::object base, const std::string& expected)
    : module_(module), base_(std::move(base)) {
  const py::object make = base_.attr("__base__").attr("__new__");
  const auto choose = [make, base = base_, members = members_, expected](const py::object& type, const py::args& args,
                                                                         const py::kwargs&) -> py::object {
    if (!type.is(base)) return make(type);
    std::string found;
    py::tuple key;
    for (std::size_t i = 0; i < std::min<std::size_t>(2, args.size()); ++i) {
      found += (i == 0 ? "" : ", ") + class_name(args[i]);
      key = key + py::make_tuple(py::type::handle_of(args[i]));
      if (members.contains(key)) return make(members[key]);
    }
    throw py::type_error(std::string(py::str(base.attr("__name__"))) + ": expected " + expected + ", found (" + found +
                         ")");
  };
  base_.attr("__new__") = py::cpp_function(choose);
}

}  // namespace sigmax::python
