// What must not compile, and what the compiler's words match then; case 0 is right. check.cmake compiles each.
#include <sigmax/sigmax.hpp>

using namespace sigmax;

int main() {
  const RandomVariable mode{"mode", {"straight", "turn"}};
  const Relation transition{mode, mode, {{0.9, 0.1}, {0.1, 0.9}}};
  const Gaussian<5> start{Vector<5>(1000.0, 1000.0, 0.0, 0.0, 0.0), 1e4 * SquareMatrix<5>::Identity()};
  const CoordinatedTurn<2> turn{0.1, 1e-5};
  const Gaussian<2> z{Vector<2>(1010.0, 1010.0), 100.0 * SquareMatrix<2>::Identity()};
#if CASE == 1  // a model of a bank is a linear motion, or Extended{motion}, Unscented{motion}, Cubature{motion}
  InteractingMultipleModel filter{std::tuple{cwna<2>(0.1), turn}, transition, start};
#elif CASE == 2  // Extended
  InteractingMultipleModel filter{std::tuple{cwna<2>(0.1), Extended{7}}, transition, start};
#else
  InteractingMultipleModel filter{std::tuple{cwna<2>(0.1), Extended{turn}}, transition, start};
#endif

#if CASE == 3  // Angle|Polar
  filter.step(1.0, PolarSensor<2>{}.measurement({1414.0, 0.7854}, {10.0, 0.001}));
#elif CASE == 4  // Angle
  filter.step(1.0, BearingSensor{}.measurement(45.0, 0.1));
#elif CASE == 5  // this sensor does not measure the states of the bank
  filter.step(1.0, PolarSensor<3>{}.measurement({1414.0, degrees(45)}, {10.0, degrees(0.1)}));
#elif CASE == 6  // a Gaussian is a position along the bank's axes
  filter.step(1.0, Gaussian<3>{Vector<3>(1.0, 2.0, 3.0), SquareMatrix<3>::Identity()});
#elif CASE == 7  // step
  filter.step(1.0, z, 0.999);
#else
  filter.step(1.0, PolarSensor<2>{}.measurement({1414.0, degrees(45)}, {10.0, degrees(0.1)}), Gate::probability(0.999));
  filter.step(1.0, z);
#endif

  const RandomVariable legs{"legs", {"2", "4"}};
  const Classifier classifier{uninformative(mode), Relation{legs, mode, {{0.9, 0.1}, {0.1, 0.9}}}};
#if CASE == 8  // a report lists findings, and each names its variable
  classifier.posterior(std::vector<std::size_t>{1});
#else
  classifier.posterior(Reading{legs, "4"});
#endif
}
