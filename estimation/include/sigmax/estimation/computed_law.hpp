#pragma once

#include <sigmax/estimation/model.hpp>
#include <sigmax/estimation/motion_numbers.hpp>

namespace sigmax::detail {

/// What a law along one axis shows of the numbers that `Law::compute(dt, F, Q, gain)` gives.
template <class Law, int Order>
class ComputedLaw {
  static_assert(Order >= 1 && Order <= 3, "position, and at most two derivatives");

 public:
  using ComputedBy = Law;
  static constexpr int order = Order;

  SquareMatrix<Order> transition(double dt) const { return numbers(dt).F; }
  SquareMatrix<Order> process_covariance(double dt) const { return numbers(dt).Q; }
  Vector<Order> input_gain(double dt) const { return numbers(dt).gain; }

 private:
  struct Numbers {
    SquareMatrix<Order> F, Q;
    Vector<Order> gain;
  };
  Numbers numbers(double dt) const {
    Numbers result;
    static_cast<const Law&>(*this).compute(dt, result.F.data(), result.Q.data(), result.gain.data());
    return result;
  }
};

}  // namespace sigmax::detail
