#include "support/core.hpp"

/// Every line of code in docs/algebra.md, in its order, and the values that it claims.
namespace algebra_walk_test {

const FuzzyVariable age{"age", {"young", "middle", "old"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};
const RandomVariable speed{"speed", {"slow", "fast"}};

const RandomVariable x{"x", 3};
const FuzzyVariable y{"y", 2};
const Relation x_given_y{x, y, {{0.6, 0.3, 0.1}, {0.1, 0.3, 0.6}}};
const Distribution y_prior{y, {1.0, 0.5}};

const Distribution age_prior{age, {0.5, 1.0, 0.4}};
const Relation mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};
const Relation speed_given_mood{speed, mood, {{0.9, 0.1}, {0.3, 0.7}}};

TEST(AlgebraWalk, Equation1) {
  const std::set<std::string> man{"dark hair", "runs daily", "reading glasses", "two children"};
  const std::set<std::string> young{"dark hair", "runs daily", "student"};
  const std::set<std::string> middle{"dark hair", "reading glasses", "two children"};
  const std::set<std::string> old{"grey hair", "reading glasses", "retired"};

  const std::vector degrees{compatibility(man, young), compatibility(man, middle), compatibility(man, old)};
  EXPECT_EQ(degrees, (std::vector{0.5, 0.75, 0.25}));

  const Distribution looks = normalized(age, degrees);
  EXPECT_CLOSE(looks.values(), (std::vector{2.0 / 3.0, 1.0, 1.0 / 3.0}), 1e-15);
}

TEST(AlgebraWalk, Definition2Point4AndEquations2And3) {
  const Distribution possible{age, {0.5, 1.0, 0.4}};
  const Distribution probable{speed, {0.25, 0.75}};
  EXPECT_THROW((Distribution{age, {0.5, 0.9, 0.4}}), std::invalid_argument);
  EXPECT_THROW((Distribution{speed, {0.25, 0.65}}), std::invalid_argument);
  EXPECT_EQ(probable["fast"], 0.75);

  const Event not_old = ~Event{age, {"old"}};
  const double how_possible = possibility(possible, not_old);
  const double how_necessary = necessity(possible, not_old);
  const double how_probable = probability(probable, Event{speed, {"fast"}});
  EXPECT_EQ(how_possible, 1.0);
  EXPECT_CLOSE(how_necessary, 0.6, 1e-15);
  EXPECT_EQ(how_probable, 0.75);

  const Distribution grown = given(possible, Event{age, {"middle", "old"}});
  EXPECT_EQ(possibility(grown, Event{age, {"old"}}), 0.4);
}

TEST(AlgebraWalk, Equations4And5) {
  const HybridDistribution age_and_mood{mood_given_age, age_prior};
  EXPECT_CLOSE(age_and_mood.table().values(), (std::vector{0.15, 0.5, 1.0, 0.6, 0.4, 0.08}), 1e-15);

  const Distribution age_again = age_and_mood.outer_marginal();
  const Distribution mood_prior = age_and_mood.inner_marginal();
  EXPECT_CLOSE(age_again.values(), (std::vector{0.5, 1.0, 0.4}), 1e-15);
  EXPECT_CLOSE(mood_prior.values(), (std::vector{1.0, 0.6}), 1e-15);

  const Distribution mood_directly = compose(mood_given_age, age_prior);
  EXPECT_CLOSE(mood_directly.values(), mood_prior.values(), 1e-15);
}

TEST(AlgebraWalk, Equation6) {
  const FuzzyVariable risk{"risk", {"low", "high"}};
  const Relation risk_given_mood{risk, mood, {{1.0, 0.2}, {0.5, 1.0}}};
  const Relation risk_given_age = compose(risk_given_mood, mood_given_age);
  EXPECT_CLOSE(risk_given_age.table().values(), (std::vector{0.5, 1.0, 1.0, 0.6, 1.0, 0.2}), 1e-15);
}

TEST(AlgebraWalk, Equation7) {
  const RandomVariable road{"road", {"dry", "wet"}};
  const RandomVariable weather{"weather", {"sun", "rain"}};
  const Relation speed_given_road{speed, road, {{0.25, 0.75}, {0.75, 0.25}}};
  const Relation road_given_weather{road, weather, {{0.9, 0.1}, {0.2, 0.8}}};
  const Relation speed_given_weather = compose(speed_given_road, road_given_weather);
  EXPECT_CLOSE(speed_given_weather.table().values(), (std::vector{0.3, 0.7, 0.65, 0.35}), 1e-15);

  const Distribution weather_prior{weather, {0.75, 0.25}};
  const Distribution bayes = update(weather_prior, speed_given_weather.likelihood("slow"));
  EXPECT_CLOSE(bayes.values(), (std::vector{18.0 / 31.0, 13.0 / 31.0}), 1e-14);
}

TEST(AlgebraWalk, Equation8) {
  const Distribution who_is_wild = update(age_prior, mood_given_age.likelihood("wild"));
  EXPECT_CLOSE(who_is_wild.values(), (std::vector{5.0 / 6.0, 1.0, 2.0 / 15.0}), 1e-14);

  const auto [age_given_mood, unreachable] = invert(mood_given_age, age_prior);
  EXPECT_CLOSE(age_given_mood.row(1), who_is_wild.values(), 1e-14);
  EXPECT_TRUE(unreachable.empty());
}

TEST(AlgebraWalk, Equations9To13) {
  const HybridDistribution joint{x_given_y, y_prior};
  static_assert(std::same_as<decltype(joint), const HybridDistribution<Fuzzy, Random>>);
  EXPECT_CLOSE(joint.table().values(), (std::vector{0.6, 0.3, 0.1, 0.05, 0.15, 0.3}), 1e-15);

  const double max_of_sums = joint.total();
  const double sum_of_maxima = joint.beta();
  EXPECT_CLOSE(max_of_sums, 1.0, 1e-15);
  EXPECT_CLOSE(sum_of_maxima, 6.0 / 5.0, 1e-15);

  const Relation y_given_x{y, x, {{1.0, 0.4}, {0.5, 1.0}, {0.3, 1.0}}};
  const HybridDistribution other_joint{y_given_x, Distribution{x, {0.5, 0.3, 0.2}}};
  static_assert(std::same_as<decltype(other_joint), const HybridDistribution<Random, Fuzzy>>);
  EXPECT_CLOSE(other_joint.total(), 1.0, 1e-15);
  EXPECT_CLOSE(other_joint.beta(), 0.71, 1e-15);

  const Induced pi_induced = other_joint.inner_marginal();
  EXPECT_CLOSE(pi_induced.values(), (std::vector{0.71, 0.70}), 1e-15);
  const Relation x_given_y_again = other_joint.outer_given_inner().relation;
  EXPECT_CLOSE(x_given_y_again.row(0), (std::vector{50.0 / 71.0, 15.0 / 71.0, 6.0 / 71.0}), 1e-15);
  EXPECT_CLOSE(x_given_y_again.row(1), (std::vector{2.0 / 7.0, 3.0 / 7.0, 2.0 / 7.0}), 1e-15);
}

TEST(AlgebraWalk, Equations14To16) {
  const HybridDistribution joint{x_given_y, y_prior};

  const Relation y_given_x = joint.outer_given_inner().relation;
  EXPECT_CLOSE(y_given_x.table().values(), (std::vector{1.0, 1.0 / 12.0, 1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0}), 1e-15);

  const Induced p_induced = joint.inner_marginal();
  EXPECT_CLOSE(p_induced.values(), (std::vector{0.6, 0.3, 0.3}), 1e-15);

  const double beta = p_induced.beta();
  const Distribution p = p_induced.normalized();
  EXPECT_CLOSE(beta, 6.0 / 5.0, 1e-15);
  EXPECT_CLOSE(p.values(), (std::vector{0.5, 0.25, 0.25}), 1e-15);

  const HybridDistribution joint_again{y_given_x, p_induced};
  EXPECT_CLOSE(joint_again.table().values(), joint.table().values(), 1e-15);

  const Induced p_directly = compose(x_given_y, y_prior);
  EXPECT_CLOSE(p_directly.values(), p_induced.values(), 1e-15);
}

TEST(AlgebraWalk, Equation17) {
  const Induced speed_given_age = compose(speed_given_mood, mood_given_age);
  EXPECT_CLOSE(speed_given_age.table().values(), (std::vector{0.3, 0.7, 0.9, 0.42, 0.9, 0.14}), 1e-15);

  const std::vector betas = speed_given_age.betas();
  EXPECT_CLOSE(betas, (std::vector{1.0, 1.32, 1.04}), 1e-15);

  const Distribution of_the_young = speed_given_age.normalized().given("young");
  const Likelihood of_being_fast = speed_given_age.likelihood("fast");
  EXPECT_CLOSE(of_the_young.values(), (std::vector{0.3, 0.7}), 1e-15);
  EXPECT_CLOSE(of_being_fast["middle"], 0.42, 1e-15);
}

TEST(AlgebraWalk, Equation18) {
  const RandomVariable road{"road", {"dry", "wet"}};
  const Relation speed_given_road{speed, road, {{0.25, 0.75}, {0.75, 0.25}}};
  const Relation mood_given_speed{mood, speed, {{1.0, 0.2}, {0.4, 1.0}}};
  const Induced mood_given_road = compose(mood_given_speed, speed_given_road);
  EXPECT_CLOSE(mood_given_road.table().values(), (std::vector{0.55, 0.8, 0.85, 0.4}), 1e-15);
  EXPECT_CLOSE(mood_given_road.betas(), (std::vector{0.8, 0.85}), 1e-15);

  // Equation 20.
  const Distribution road_prior{road, {0.5, 0.5}};
  const Distribution road_if_wild = update(road_prior, mood_given_road.likelihood("wild"));
  EXPECT_CLOSE(road_if_wild.values(), (std::vector{2.0 / 3.0, 1.0 / 3.0}), 1e-14);
}

TEST(AlgebraWalk, Equation19) {
  const Induced speed_given_age = compose(speed_given_mood, mood_given_age);
  const Distribution who_is_slow = update(age_prior, speed_given_age.likelihood("slow"));
  EXPECT_CLOSE(who_is_slow.values(), (std::vector{1.0 / 6.0, 1.0, 0.4}), 1e-14);

  const Likelihood report = compose(Likelihood{speed, {1.0, 0.0}}, speed_given_mood);
  const Distribution who_reports = update(age_prior, compose(report, mood_given_age));
  EXPECT_CLOSE(who_reports.values(), who_is_slow.values(), 1e-14);
}

TEST(AlgebraWalk, Transforms) {
  const RandomVariable weather{"weather", {"dry", "wet", "snow"}};
  const Distribution forecast{weather, {0.5, 0.3, 0.2}};
  const Distribution by_ratio = to_possibility(forecast, RatioScale{});
  const Distribution optimal = to_possibility(forecast, DuboisPrade{});
  const Distribution symmetric = to_possibility(forecast, DuboisPradeSandri{});
  const Distribution pignistic = to_probability(symmetric, DuboisPradeSandri{});
  EXPECT_CLOSE(by_ratio.values(), (std::vector{1.0, 0.6, 0.4}), 1e-15);
  EXPECT_CLOSE(optimal.values(), (std::vector{1.0, 0.5, 0.2}), 1e-15);
  EXPECT_CLOSE(symmetric.values(), (std::vector{1.0, 0.8, 0.6}), 1e-15);
  EXPECT_CLOSE(pignistic.values(), forecast.values(), 1e-15);
}

}  // namespace algebra_walk_test
