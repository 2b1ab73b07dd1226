#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include <sigmax/core.hpp>

namespace sigmax::python {

namespace py = pybind11;

/// A list of types: the bindings of one generic text are made for each, and an argument is looked up among them.
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

using Variables = Types<Variable<Random>, Variable<Fuzzy>, Variable<Ordinal>>;
using Distributions = Types<Distribution<Random>, Distribution<Fuzzy>, Distribution<Ordinal>>;
using InducedDistributions =
    Types<Induced<Distribution<Random>>, Induced<Distribution<Fuzzy>>, Induced<Distribution<Ordinal>>>;
using Likelihoods = Types<Likelihood<Random>, Likelihood<Fuzzy>, Likelihood<Ordinal>>;
using Events = Types<Event<Random>, Event<Fuzzy>, Event<Ordinal>>;

/// Relations of a random and a fuzzy variable, in any order; and all that there are.
using MixedRelations =
    Types<Relation<Random, Random>, Relation<Random, Fuzzy>, Relation<Fuzzy, Random>, Relation<Fuzzy, Fuzzy>>;
using Relations = decltype(MixedRelations{} + Types<Relation<Ordinal, Ordinal>>{});
using InducedRelations =
    Types<Induced<Relation<Random, Random>>, Induced<Relation<Random, Fuzzy>>, Induced<Relation<Fuzzy, Random>>,
          Induced<Relation<Fuzzy, Fuzzy>>, Induced<Relation<Ordinal, Ordinal>>>;

/// "Random", as the names of Python's classes begin.
std::string capital(std::string_view kind);

/// The name of an object's class.
std::string class_name(py::handle object);

/// Calls `action` with the object as the one of these types that it is, and returns the result as an object of Python.
/// Throws TypeError, which begins with `expected`, if it is none.
template <class... T, class Action>
py::object visit(Types<T...>, py::handle object, const std::string& expected, const Action& action) {
  py::object result;
  const auto is_this = [&]<class Each>() {
    if (!py::isinstance<Each>(object)) return false;
    if constexpr (std::same_as<decltype(action(std::declval<const Each&>())), py::object>)
      result = action(py::cast<const Each&>(object));
    else
      result = py::cast(action(py::cast<const Each&>(object)));
    return true;
  };
  if (!(is_this.template operator()<T>() || ...)) throw py::type_error(expected + ", found " + class_name(object));
  return result;
}

/// Throws TypeError about arguments whose kinds do not meet: "update: a random prior and a fuzzy likelihood".
[[noreturn]] void refuse(const std::string& verb, std::string_view kind, const std::string& argument,
                         std::string_view other_kind, const std::string& other_argument);

/// Computes while other threads of Python run.
template <class Action>
auto unlocked(const Action& action) {
  const py::gil_scoped_release release;
  return action();
}

/// Which outcome is meant by a label or an index. Throws IndexError for an index that the variable has not.
std::size_t index_of(const Outcomes& variable, py::handle key);

/// What reading backwards gives, as Python's namedtuple Inverse(relation, unreachable).
py::object inverse(py::object relation, const std::vector<std::size_t>& unreachable);
template <class I>
py::object inverse_of(I result) {
  return inverse(py::cast(std::move(result.relation)), result.unreachable);
}

/// Adds a property, a method, a constructor, or a function of the signature "name(argument, …)", which Python's help
/// shows.
template <class T, class Get>
void property(py::class_<T>& type, const char* name, const char* doc, const Get& get) {
  type.def_property_readonly(name, get, doc);
}
template <class T, class Call>
void method(py::class_<T>& type, const char* name, const char* doc, const Call& call) {
  type.def(name, call, doc);
}
template <class T, class Make>
void constructor(py::class_<T>& type, const char* doc, const Make& make) {
  type.def(py::init(make), doc);
}
template <class... Extra, class Call>
void function(py::module_& module, const std::string& signature, const std::string& doc, const Call& call,
              const Extra&... extra) {
  const std::string text = signature + "\n--\n\n" + doc;
  module.def(signature.substr(0, signature.find('(')).c_str(), call, text.c_str(), extra...);
}

/// An abstract class of Python. A call of it makes an object of the class that fits the types of the first arguments:
/// Distribution(age, …) is a FuzzyDistribution if `age` is fuzzy.
class Family {
 public:
  /// `expected` completes the message for arguments that fit no class; `Tag` is any of the classes.
  template <class Tag>
  static Family make(py::module_& module, const char* name, const std::string& expected, const char* doc) {
    struct Base {};
    return {module, py::class_<Base>(module, name, doc), expected};
  }

  template <class T>
  py::class_<T> add(const std::string& name) const {
    return {module_, name.c_str(), base_};
  }

  /// `T` is made of these arguments.
  template <class T, class... Arguments>
  void accept() const {
    members_[py::make_tuple(py::type::of<Arguments>()...)] = py::type::of<T>();
  }

 private:
  Family(py::module_& module, py::object base, const std::string& expected);

  py::module_ module_;
  py::object base_;
  py::dict members_;
};

}  // namespace sigmax::python
