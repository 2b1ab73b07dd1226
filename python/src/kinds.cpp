#include "kinds.hpp"

#include <algorithm>
#include <cctype>

#include <pybind11/stl.h>

namespace sigmax::python {

std::string capital(std::string_view kind) {
  std::string name(kind);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

std::string class_name(py::handle object) { return py::str(py::type::handle_of(object).attr("__name__")); }

void refuse(const std::string& verb, std::string_view kind, const std::string& argument, std::string_view other_kind,
            const std::string& other_argument) {
  const auto named = [](std::string_view name) { return (name == Ordinal::name ? "an " : "a ") + std::string(name); };
  throw py::type_error(verb + ": " + named(kind) + " " + argument + " and " + named(other_kind) + " " + other_argument);
}

py::object inverse(py::object relation, const std::vector<std::size_t>& unreachable) {
  return py::module_::import("sigmax._sigmax").attr("Inverse")(std::move(relation), unreachable);
}

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
  base_.attr("__new__") = py::cpp_function([make, base = base_, members = members_, expected](
                                               const py::object& type, const py::args& args, const py::kwargs&) {
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
  });
}

}  // namespace sigmax::python
