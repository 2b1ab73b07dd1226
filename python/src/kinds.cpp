#include "kinds.hpp"

namespace sigmax::python {

std::string capital(std::string_view kind) {
  return py::str(std::string(kind)).attr("capitalize")().cast<std::string>();
}

std::string class_name(py::handle object) { return py::str(py::type::handle_of(object).attr("__name__")); }

void refuse(const std::string& verb, std::string_view kind, const std::string& argument, std::string_view other_kind,
            const std::string& other_argument) {
  throw py::type_error(verb + ": a " + std::string(kind) + " " + argument + " and a " + std::string(other_kind) + " " +
                       other_argument);
}

void refuse(const std::string& name, const py::args& arguments) {
  std::string found;
  for (const py::handle each : arguments) found += (found.empty() ? "" : ", ") + class_name(each);
  throw py::type_error(name + ": expected arguments whose kinds fit, found (" + found + ")");
}

std::size_t index_of(const Outcomes& variable, const Key& key) {
  if (const auto* const label = std::get_if<std::string>(&key)) return variable.index_of(*label);
  const auto index = static_cast<std::size_t>(std::get<py::ssize_t>(key));
  if (index < variable.size()) return index;
  throw py::index_error("variable '" + variable.name() + "' has no outcome " +
                        std::to_string(std::get<py::ssize_t>(key)));
}

py::dict members_of(const py::object& abstract) {
  const py::dict members;
  const py::object make = abstract.attr("__base__").attr("__new__");
  abstract.attr("__new__") =
      py::cpp_function([=](const py::object& type, const py::args& arguments, const py::kwargs&) -> py::object {
        if (!type.is(abstract)) return make(type);
        py::tuple variables;
        for (const py::handle each : arguments)
          if (py::isinstance<Outcomes>(each)) variables = variables + py::make_tuple(py::type::handle_of(each));
        if (!members.contains(variables)) refuse(py::str(abstract.attr("__name__")), arguments);
        return make(members[variables]);
      });
  return members;
}

}  // namespace sigmax::python
