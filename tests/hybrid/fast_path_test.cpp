// The fast path against textbook matrices: each law alone is their Kalman filter, and two together are the restated
// filter, along one to three axes, by each instruction set.

#include "hybrid/banks.hpp"
#include "hybrid/instruction_sets.hpp"

namespace fast_path_test {

using restatement::Matrix;

/// A motion by its name, and the F_s and Q_s of docs/models.md.
struct Textbook {
  const char* name;
  std::size_t derivatives;
  std::function<Matrix(double)> F, Q;
};

constexpr double sigma = 2.0, tau = 4.0, theta = 1.0 / tau;

/// The highest derivative forgets at the rate θ: the last states of Singer's model.
Matrix singer_F(double T) {
  const double u = theta * T, e = std::exp(-u);
  return Matrix(3, 3, {1, T, (u - 1 + e) / (theta * theta), 0, 1, (1 - e) / theta, 0, 0, e});
}
Matrix singer_Q(double T) {
  const long double t = theta, u = t * static_cast<long double>(T), e = std::exp(-u);
  const long double q11 = 1 - e * e + 2 * u + 2 * u * u * u / 3 - 2 * u * u - 4 * u * e;
  const long double q12 = e * e + 1 - 2 * e + 2 * u * e - 2 * u + u * u, q13 = 1 - e * e - 2 * u * e;
  const long double q22 = 4 * e - 3 - e * e + 2 * u, q23 = e * e + 1 - 2 * e, q33 = 1 - e * e;
  const auto of = [&](long double q, int power) { return static_cast<double>(q / std::pow(t, power)); };
  return sigma * sigma *
         Matrix(3, 3,
                {of(q11, 4), of(q12, 3), of(q13, 2), of(q12, 3), of(q22, 2), of(q23, 1), of(q13, 2), of(q23, 1),
                 of(q33, 0)});
}
Matrix last(const Matrix& a, std::size_t n) {
  Matrix result(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) result(i, j) = a(a.rows - n + i, a.rows - n + j);
  return result;
}
Textbook forgetting(const char* name, std::size_t derivatives) {
  return {name, derivatives, [=](double T) { return last(singer_F(T), derivatives); },
          [=](double T) { return last(singer_Q(T), derivatives); }};
}

Matrix taylor(double T) { return Matrix(3, 3, {1, T, T * T / 2, 0, 1, T, 0, 0, 1}); }

const std::vector<Textbook> laws{
    {"dwna", 2, [](double T) { return last(taylor(T), 2); },
     [](double T) {
       return sigma * sigma * restatement::outer(std::vector{T * T / 2, T});
     }},
    {"dwpa", 3, taylor,
     [](double T) {
       return sigma * sigma * restatement::outer(std::vector{T * T / 2, T, 1.0});
     }},
    {"cwna", 2, [](double T) { return last(taylor(T), 2); },
     [](double T) {
       return sigma * sigma * Matrix(2, 2, {T * T * T / 3, T * T / 2, T * T / 2, T});
     }},
    {"cwpa", 3, taylor,
     [](double T) {
       const double T2 = T * T, T3 = T2 * T;
       return sigma * sigma *
              Matrix(3, 3, {T2 * T3 / 20, T2 * T2 / 8, T3 / 6, T2 * T2 / 8, T3 / 3, T2 / 2, T3 / 6, T2 / 2, T});
     }},
    forgetting("ou_position", 1),
    forgetting("ou_velocity", 2),
    forgetting("singer", 3)};

restatement::Model model_of(const Textbook& law, std::size_t axes) {
  return restatement::along_axes<double>(axes, law.derivatives, law.F, law.Q);
}

/// A choice of these laws along so many axes, of equal transitions.
TargetChoice choice_of(const std::vector<Textbook>& chosen_laws, int axes, bool fuzzy) {
  const std::size_t modes = chosen_laws.size();
  std::vector<MotionChoice> motions;
  for (const Textbook& law : chosen_laws) {
    motions.push_back(motion(law.name, sigma));
    motions.back()[MotionParameter::tau] = tau;
  }
  Rows rows(modes, std::vector<double>(modes, fuzzy ? 0.5 : 0.1));
  for (std::size_t i = 0; i < modes; ++i) rows[i][i] = fuzzy ? 1.0 : 1.0 - 0.1 * static_cast<double>(modes - 1);
  TargetChoice choice = with(chosen(fuzzy), motions, rows);
  choice.axes = axes;
  return choice;
}

void is_textbook(const std::vector<Textbook>& chosen_laws, int axes, bool fuzzy,
                 StateAugmentation augmentation = StateAugmentation::borrowed_variance) {
  const TargetChoice choice = with(choice_of(chosen_laws, axes, fuzzy), augmentation);
  const auto A = static_cast<std::size_t>(axes);
  Estimates start;
  std::vector<restatement::Model> models;
  for (const Textbook& law : chosen_laws) {
    const int n = axes * static_cast<int>(law.derivatives);
    start.add(n);
    auto own = start[start.size() - 1];
    for (int i = 0; i < n; ++i) {
      own.mean(i) = 10.0 / (1.0 + i);
      for (int k = 0; k < n; ++k) own.covariance(i, k) = (i == k ? 60.0 : 4.0) / (1.0 + i + k);
    }
    models.push_back(model_of(law, A));
  }
  AnyFilter filter(choice, start);
  restatement::Filter expected{models, restate(choice.transition), restate(start),
                               restatement::Vector(start.size(), 1.0), restate(choice)};
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 24; ++k) {
    const double dt = std::initializer_list<double>{0.5, 0.1, 2.0, 0.0}.begin()[k % 4];
    if (k % 7 == 5) {
      filter.step(dt);
      expected.step(dt);
    } else {
      Gaussian<Eigen::Dynamic, 3> z;
      z.mean.resize(axes);
      z.covariance = SquareMatrix<Eigen::Dynamic, 3>::Constant(axes, axes, 3.0);
      z.covariance.diagonal().setConstant(25.0 + k);
      for (double& each : z.mean) each = 5.0 * k + 5.0 * normal(generator);
      filter.do_with([&](auto& one) { one.step(dt, z); });
      expected.step(dt, entries(z.mean), dense(z.covariance));
    }
    ASSERT_TRUE(agrees(filter, expected)) << chosen_laws[0].name << ", axes: " << axes << ", step " << k;
  }
}

TEST(FastPath, OfOneLawIsTheKalmanFilterOfItsTextbookMatrices) {
  under_each_instruction_set([] {
    for (const int axes : {1, 2, 3})
      for (const Textbook& law : laws)
        for (const bool fuzzy : {false, true}) is_textbook({law}, axes, fuzzy);
  });
}

TEST(FastPath, OfSeveralLawsIsTheRestatedFilterOfTheirs) {
  under_each_instruction_set([] {
    for (const int axes : {1, 2, 3})
      for (const bool fuzzy : {false, true})
        for (const StateAugmentation augmentation : augmentations) {
          is_textbook({laws[0], laws[1]}, axes, fuzzy, augmentation);
          is_textbook({laws[6], laws[4], laws[2]}, axes, fuzzy, augmentation);
          is_textbook({laws[5], laws[3], laws[0], laws[6]}, axes, fuzzy, augmentation);
        }
  });
}

/// What a known input adds, which no named motion has.
TEST(FastPath, AddsAKnownInput) {
  under_each_instruction_set([] {
    const RandomVariable mode{"mode", 1};
    const Vector<2> gravity(0.5, -9.81);
    const Gaussian<4> start{Vector<4>(0.0, 100.0, 30.0, 40.0), SquareMatrix<4>::Identity()};
    InteractingMultipleModel filter{std::tuple{dwna<2>(1.0, gravity)}, Relation{mode, mode, {{1.0}}}, start};
    filter.step(2.0);
    EXPECT_CLOSE(
        filter.estimates()[0].mean,
        (Vector<4>(60.0 + 0.5 * 2.0 * 2.0 * 0.5, 100.0 + 80.0 - 0.5 * 2.0 * 2.0 * 9.81, 30.0 + 1.0, 40.0 - 2.0 * 9.81)),
        1e-12);
  });
}

}  // namespace fast_path_test
