#pragma once

#include <cctype>
#include <concepts>
#include <string>
#include <string_view>
#include <utility>

#include <pybind11/pybind11.h>

#include <sigmax/core.hpp>

namespace sigmax::python {

namespace py = pybind11;

/// A list of types, over which the bindings of one generic text are made, and among which an argument is looked up.
template <class... T>
struct Types {
  template <class Action>
  static void for_each(const Action& action) {
    (action.template operator()<T>(), ...);
  }
};
template <class... A, class... B>
Types<A..., B...> operator+(Types<A...>, Types<B...>) {
  return {};
}

/// A class template of one kind, or of each pair of kinds that may meet.
template <template <class> class T>
using ForKinds = Types<T<Random>, T<Fuzzy>, T<Ordinal>>;
template <template <class, class> class T>
using ForPairs = Types<T<Random, Random>, T<Random, Fuzzy>, T<Fuzzy, Random>, T<Fuzzy, Fuzzy>, T<Ordinal, Ordinal>>;

template <class Kind>
using VariableOf = Variable<Kind>;
template <class Kind>
using DistributionOf = Distribution<Kind>;
template <class Kind>
using InducedOf = Induced<Distribution<Kind>>;
template <class Kind>
using LikelihoodOf = Likelihood<Kind>;
template <class Kind>
using EventOf = Event<Kind>;
template <class To, class From>
using RelationOf = Relation<To, From>;
template <class To, class From>
using InducedRelationOf = Induced<Relation<To, From>>;

using Variables = ForKinds<VariableOf>;
using Distributions = ForKinds<DistributionOf>;
using InducedDistributions = ForKinds<InducedOf>;
using Beliefs = Types<Belief<Random>, Belief<Fuzzy>>;
using Likelihoods = ForKinds<LikelihoodOf>;
using Events = ForKinds<EventOf>;
using Relations = ForPairs<RelationOf>;
using InducedRelations = ForPairs<InducedRelationOf>;

/// "Random", as the names of Python's classes begin.
template <class Kind>
std::string kind_name() {
  std::string name(Kind::name);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

inline std::string class_name(py::handle object) { return py::str(py::type::handle_of(object).attr("__name__")); }

/// Calls `action` with the object as the one of these types that it is, and returns the result as an object of Python.
/// Throws TypeError if it is none.
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

/// Two arguments whose kinds do not meet: "update: a random prior and a fuzzy likelihood".
template <class A, class B>
[[noreturn]] void mixed(const std::string& verb, const std::string& a, const std::string& b) {
  const auto named = [](std::string_view kind) { return (kind == "ordinal" ? "an " : "a ") + std::string(kind) + " "; };
  throw py::type_error(verb + ": " + named(A::name) + a + " and " + named(B::name) + b);
}

/// Computes while other threads of Python run.
template <class Action>
auto unlocked(const Action& action) {
  const py::gil_scoped_release release;
  return action();
}

/// Which outcome is meant by a label or an index. Throws IndexError for an index that the variable has not.
std::size_t index_of(const Outcomes& variable, py::handle key);

/// An abstract class of Python. A call of it makes an object of the class that fits the types of the first arguments:
/// Distribution(age, …) is a FuzzyDistribution if `age` is fuzzy.
class Family {
 public:
  /// `expected` completes the message for arguments that fit no class.
  template <class Tag>
  static Family make(py::module_& module, const char* name, const std::string& expected, const char* doc) {
    struct Base {};
    return {module, py::class_<Base>(module, name, doc), expected};
  }

  template <class T>
  py::class_<T> add(const std::string& name) const {
    return {module_, name.c_str(), base_};
  }

  /// `T` is what is made of these arguments.
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
