#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <variant>

#include <pybind11/pybind11.h>

#include <sigmax/core.hpp>

namespace sigmax::python {

namespace py = pybind11;

/// A list of types: the bindings of one generic text are made for each.
template <class... T>
struct Types {
  template <class Action>
  static void for_each(const Action& action) {
    (action.template operator()<T>(), ...);
  }
};
template <class... A, class... B>
constexpr Types<A..., B...> operator+(Types<A...>, Types<B...>) {
  return {};
}
template <class... T>
constexpr Types<Induced<T>...> induced(Types<T...>) {
  return {};
}

using Kinds = Types<Random, Fuzzy, Ordinal>;
using Distributions = Types<Distribution<Random>, Distribution<Fuzzy>, Distribution<Ordinal>>;
using Likelihoods = Types<Likelihood<Random>, Likelihood<Fuzzy>, Likelihood<Ordinal>>;

/// Relations of a random and a fuzzy variable, in any order; and all that there are.
using MixedRelations =
    Types<Relation<Random, Random>, Relation<Random, Fuzzy>, Relation<Fuzzy, Random>, Relation<Fuzzy, Fuzzy>>;
using Relations = decltype(MixedRelations{} + Types<Relation<Ordinal, Ordinal>>{});

/// "Random", as the names of Python's classes begin.
std::string capital(std::string_view kind);

/// The name of an object's class.
std::string class_name(py::handle object);

/// Throws TypeError about arguments whose kinds do not meet: "update: a random prior and a fuzzy likelihood".
[[noreturn]] void refuse(const std::string& verb, std::string_view kind, const std::string& argument,
                         std::string_view other_kind, const std::string& other_argument);

/// The same of any arguments, by the names of their classes.
[[noreturn]] void refuse(const std::string& name, const py::args& arguments);

/// An outcome is meant by its label or its index. Throws IndexError for an index that the variable has not.
using Key = std::variant<std::string, py::ssize_t>;
std::size_t index_of(const Outcomes& variable, const Key& key);

/// Computes while other threads of Python run.
template <class Action>
auto unlocked(const Action& action) {
  const py::gil_scoped_release release;
  return action();
}

/// Adds a property, a method, or a function of the signature "name(argument, …)", which Python's help shows.
template <class T, class Get>
void property(py::class_<T>& type, const char* name, const char* doc, const Get& get) {
  type.def_property_readonly(name, get, doc);
}
template <class T, class Call>
void method(py::class_<T>& type, const char* name, const char* doc, const Call& call) {
  type.def(name, call, doc);
}
template <class... Extra, class Call>
void function(py::module_& module, const std::string& signature, const std::string& doc, const Call& call,
              const Extra&... extra) {
  const std::string name = signature.substr(0, signature.find('('));
  const std::string text = py::hasattr(module, name.c_str()) ? "" : signature + "\n--\n\n" + doc;
  module.def(name.c_str(), call, text.c_str(), extra...);
}

/// An abstract class of Python, here of all classes that are like `T`.
template <class T>
struct Abstract {};

/// A call of an abstract class makes an object of the class that the result has for the types of the variables among
/// the arguments: Distribution(age, …) is a FuzzyDistribution if `age` is fuzzy.
py::dict members_of(const py::object& abstract);

void bind_verbs(py::module_& module);

}  // namespace sigmax::python
