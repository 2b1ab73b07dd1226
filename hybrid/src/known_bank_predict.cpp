#include "known_bank.hpp"

namespace sigmax {

template void predict(const detail::KnownModel&, const EstimateOf<detail::KnownModel>&, double,
                      EstimateOf<detail::KnownModel>&);
namespace detail {

KnownBank known_bank(const TargetChoice& choice) {
  KnownBank bank;
  for (const auto& motion : choice.motions) {
    const AnyKnownMotion moves = made(motion, choice.axes);
    if (choice.member == MemberType::ukf)
      bank.push_back(Unscented{moves});
    else if (choice.member == MemberType::ckf)
      bank.push_back(Cubature{moves});
    else
      bank.push_back(Extended{moves});  // the Kalman filter, where motion and sensor are linear
  }
  return bank;
}

}  // namespace detail
}  // namespace sigmax
