#include "laws/generate.hpp"

namespace ordinal_test {

/// The laws of the discrete calculus that do not need scaling. No ordinal operation rounds, so all of them are exact.
/// Restated with plain loops: (6) with the minimum in place of the product.
Rows max_min(const Rows& left, const Rows& right) {
  Rows result;
  for (const Numbers& weights : right) {
    Numbers row(left.front().size(), 0.0);
    for (std::size_t x = 0; x < row.size(); ++x)
      for (std::size_t m = 0; m < left.size(); ++m) row[x] = std::max(row[x], std::min(left[m][x], weights[m]));
    result.push_back(row);
  }
  return result;
}

/// The residuum of a joint: one where it is its own maximum.
Numbers residuum(Numbers joint) {
  const double greatest = *std::max_element(joint.begin(), joint.end());
  for (double& value : joint)
    if (value == greatest) value = 1.0;
  return joint;
}

Numbers minima(const Numbers& a, const Numbers& b) {
  Numbers result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(std::min(a[i], b[i]));
  return result;
}

bool possible(const Numbers& joint) { return *std::max_element(joint.begin(), joint.end()) > 0.0; }

struct Prior {
  OrdinalVariable x = any_variable<Ordinal>("x");
  Distribution<Ordinal> prior = any_distribution(x);
  Numbers values = numbers_of(prior.values());
};

PROPERTY(OrdinalLaws, CompositionIsItsRestatement) {
  const auto [x, m, y, left, right] = AnyRelations<Ordinal, Ordinal, Ordinal>{};
  const auto prior = any_distribution(m);
  RC_ASSERT(rows_of(compose(left, right).table()) == max_min(rows_of(left.table()), rows_of(right.table())));
  RC_ASSERT(numbers_of(compose(left, prior).values()) ==
            max_min(rows_of(left.table()), {numbers_of(prior.values())}).front());
}

PROPERTY(OrdinalLaws, CompositionIsExactlyAssociativeAndKeepsNormalization) {
  const auto x = any_variable<Ordinal>("x"), m = any_variable<Ordinal>("m"), l = any_variable<Ordinal>("l"),
             y = any_variable<Ordinal>("y");
  const auto a = any_relation(x, m);
  const auto b = any_relation(m, l);
  const auto c = any_relation(l, y);
  const auto composed = compose(compose(a, b), c);
  RC_ASSERT(rows_of(composed.table()) == rows_of(compose(a, compose(b, c)).table()));
  for (std::size_t i = 0; i < y.size(); ++i) RC_ASSERT(total<Ordinal>(composed.row(i)) == 1.0);
  RC_ASSERT(total<Ordinal>(compose(composed, any_distribution(y)).values()) == 1.0);
}

PROPERTY(OrdinalLaws, UpdateIsItsRestatementAndKeepsNormalization) {
  const Prior p;
  const Numbers evidence = any_unit_numbers(p.x.size()), joint = minima(p.values, evidence);
  RC_PRE(possible(joint));
  const auto posterior = update(p.prior, Likelihood{p.x, evidence});
  RC_ASSERT(numbers_of(posterior.values()) == residuum(joint));
  RC_ASSERT(total<Ordinal>(posterior.values()) == 1.0);
}

TEST(OrdinalLaws, UpdateByOtherEvidenceMayDecideATieTheSecondTime) {  // the residuum, not the minimum, is to blame
  const OrdinalVariable x{"x", {"a", "b"}};
  const Likelihood likelihood{x, {1.0, 0.5}};
  const auto once = update(Distribution{x, {0.5, 1.0}}, likelihood), twice = update(once, likelihood);
  EXPECT_EQ(numbers_of(once.values()), (Numbers{1.0, 1.0}));
  EXPECT_EQ(numbers_of(twice.values()), (Numbers{1.0, 0.5}));
}

PROPERTY(OrdinalLaws, ALikelihoodIsCarriedBackAsItsRestatement) {
  const auto x = any_variable<Ordinal>("x"), y = any_variable<Ordinal>("y");
  const auto relation = any_relation(x, y);
  const Numbers values = any_unit_numbers(x.size());
  const auto carried = compose(Likelihood{x, values}, relation);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const Numbers joint = minima(numbers_of(relation.row(i)), values);
    RC_ASSERT(carried[i] == *std::max_element(joint.begin(), joint.end()));
  }
}

PROPERTY(OrdinalLaws, TheJointIsRebuiltFromMarginalAndConditional) {
  const auto [x, y, relation, prior] = AnyJoint<Ordinal, Ordinal>{};
  const auto marginal = compose(relation, prior);
  const auto inverse = invert(relation, prior);
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k)
      RC_ASSERT(std::min(inverse.relation(k, i), marginal[k]) == std::min(relation(i, k), prior[i]));
  for (const std::size_t k : inverse.unreachable) RC_ASSERT(marginal[k] == 0.0);
}

}  // namespace ordinal_test
