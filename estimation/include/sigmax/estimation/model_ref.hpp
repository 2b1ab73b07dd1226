#pragma once

#include <concepts>
#include <string>
#include <type_traits>

#include <sigmax/estimation/independent_axes.hpp>
#include <sigmax/estimation/nonlinear_motion.hpp>
#include <sigmax/estimation/view.hpp>

/// How compiled code asks a model of any type.
namespace sigmax::detail {

/// The numbers of a matrix of this type, written where they are to go.
template <class Matrix, class Values>
void write(const Values& values, double* numbers) {
  const Matrix matrix = values;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) numbers[i] = matrix.data()[i];
}

/// A vector of so many numbers.
template <class State>
State read(const double* numbers, Eigen::Index n) {
  State state(n);
  for (Eigen::Index i = 0; i < n; ++i) state(i) = numbers[i];
  return state;
}

template <class Motion>
struct AxisMotion : std::false_type {};
template <int Axes, class Law>
struct AxisMotion<IndependentAxes<Axes, Law>> : std::true_type {};

/// The functions of a type, which see its motion behind the pointer; ∂f/∂x only if it is wanted.
template <class Moves, bool Differentiates>
struct FunctionsOf {
  static const Moves& motion(const void* pointer) { return *static_cast<const Moves*>(pointer); }
  static int size(const void* pointer) { return static_cast<int>(motion(pointer).size()); }
  static std::string name(const void* pointer) { return std::string(motion(pointer).name()); }

  static void law(const void* pointer, double dt, AxisLaw& law) {
    const auto& own = motion(pointer);
    law.order = Moves::order;
    double gain[3];
    if constexpr (ComputesItself<std::remove_cvref_t<decltype(own.law())>>) {
      own.law().compute(dt, law.F, law.Q, gain);
    } else {
      write<SquareMatrix<Moves::order>>(own.law().transition(dt), law.F);
      write<SquareMatrix<Moves::order>>(own.law().process_covariance(dt), law.Q);
      write<Vector<Moves::order>>(own.law().input_gain(dt), gain);
    }
    for (int i = 0; i < Moves::order * Moves::axes; ++i)
      law.input[i] = gain[i / Moves::axes] * own.input()(i % Moves::axes);
  }

  static void tangent(const void* pointer, const double* x, double dt, double* image, double* F, double* Q) {
    const auto& own = motion(pointer);
    if constexpr (AxisMotion<Moves>::value) {
      AxisLaw one;
      law(pointer, dt, one);
      spread_over_axes(one.F, one.order, Moves::axes, F);
      spread_over_axes(one.Q, one.order, Moves::axes, Q);
      for (int i = 0; i < Moves::state_size; ++i) image[i] = one.input[i];
    } else if constexpr (ComputesItself<Moves> && LinearMotion<Moves>) {
      own.compute(dt, F, Q);
      for (int i = 0; i < Moves::state_size; ++i) image[i] = 0.0;
    } else if constexpr (ComputesItself<Moves>) {
      own.compute(x, dt, image, F, Q);
    } else if constexpr (LinearMotion<Moves>) {
      write<StateMatrixOf<Moves>>(own.transition(dt), F);
      write<StateMatrixOf<Moves>>(own.process_covariance(dt), Q);
      write<StateOf<Moves>>(own.known_input(dt), image);
    } else {
      const auto state = read<StateOf<Moves>>(x, own.size());
      write<StateOf<Moves>>(own.propagate(state, dt), image);
      if constexpr (Differentiates)
        if (F) write<StateMatrixOf<Moves>>(slope_of(own, state, dt), F);
      if (Q) write<StateMatrixOf<Moves>>(own.process_covariance(dt), Q);
    }
  }
};

template <class Moves, bool Differentiates>
inline constexpr MotionTable motion_table = [] {
  using Functions = FunctionsOf<Moves, Differentiates>;
  MotionTable table{axes_of<Moves>, LinearMotion<Moves>, Functions::size, Functions::name, Functions::tangent};
  if constexpr (AxisMotion<Moves>::value) table.law = Functions::law;
  return table;
}();

/// A member of the Kalman family that uses sigma points, and so wants no Jacobian.
template <class Model>
concept UsesPoints = requires(const Model& model) {
  model.weights();
};

/// A model as compiled code sees it: a motion by itself, in a member of the Kalman family, or one that knows its own.
template <class Model>
ModelRef model_ref(const Model& model) {
  if constexpr (requires { model.ref(); }) {
    return model.ref();
  } else if constexpr (requires { typename Model::MotionType; }) {
    ModelRef result{&model.motion(), &motion_table<typename Model::MotionType, !UsesPoints<Model>>};
    if constexpr (UsesPoints<Model>) result.points = model.weights();
    return result;
  } else {
    return {&model, &motion_table<Model, false>};
  }
}

}  // namespace sigmax::detail
