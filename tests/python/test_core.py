"""Core: kinds, tables and verbs, against restatements in NumPy and by enumeration."""

import gc
import itertools
import threading

import numpy as np
import pytest

import sigmax as sx

age = sx.FuzzyVariable("age", ["young", "middle", "old"])
mood = sx.FuzzyVariable("mood", ["calm", "wild"])
speed = sx.RandomVariable("speed", ["slow", "fast"])
rank = sx.OrdinalVariable("rank", ["low", "high"])
mood_given_age = sx.Relation(mood, age, [[0.3, 1.0], [1.0, 0.6], [1.0, 0.2]])
speed_given_mood = sx.Relation(speed, mood, [[0.9, 0.1], [0.3, 0.7]])
looks = sx.Distribution(age, [0.5, 1.0, 0.4])
weather = sx.Distribution(sx.RandomVariable("weather", ["dry", "rain", "snow"]), [0.6, 0.3, 0.1])

variable_of = {"random": sx.RandomVariable, "fuzzy": sx.FuzzyVariable, "ordinal": sx.OrdinalVariable}
plus = {"random": np.sum, "fuzzy": np.max, "ordinal": np.max}
times = {"random": np.multiply, "fuzzy": np.multiply, "ordinal": np.minimum}
mixable = [("random", "random"), ("random", "fuzzy"), ("fuzzy", "random"), ("fuzzy", "fuzzy"), ("ordinal", "ordinal")]


def drawn(kind, *shape, seed=1):
    """Distributions of this kind along the last axis."""
    numbers = np.random.default_rng(seed).random(shape)
    return numbers / (numbers.sum if kind == "random" else numbers.max)(axis=-1, keepdims=True)


@pytest.mark.parametrize("to, middle", mixable)
def test_compose_eliminates_by_the_kind_of_the_variable_between(to, middle):
    t, m, f = variable_of[to]("t", 3), variable_of[middle]("m", 4), variable_of[middle]("f", 5)
    left, right = sx.Relation(t, m, drawn(to, 4, 3)), sx.Relation(m, f, drawn(middle, 5, 4, seed=2))
    result, induced = sx.compose(left, right), to != middle
    expected = plus[middle](times[middle](right.table[:, :, None], left.table[None]), axis=1)
    np.testing.assert_allclose(result.table, expected, rtol=1e-13)
    assert isinstance(result, sx.InducedRelation if induced else sx.Relation)

    prior = sx.Distribution(m, drawn(middle, 4, seed=3))
    marginal = sx.compose(left, prior)
    expected = plus[middle](times[middle](prior.values[:, None], left.table), axis=0)
    np.testing.assert_allclose(marginal.values, expected, rtol=1e-13)
    if induced:
        np.testing.assert_allclose(result.betas, plus[to](result.table, axis=1), rtol=1e-13)
        np.testing.assert_allclose(marginal.normalized().values, expected / plus[to](expected), rtol=1e-13)

    evidence = sx.Likelihood(t, [1.0, 0.0, 0.5])
    carried = plus[to](times[to](evidence.values, left.table), axis=1)
    np.testing.assert_allclose(sx.compose(evidence, left).values, carried, rtol=1e-13)


@pytest.mark.parametrize("to, middle", mixable[:4])
def test_update_and_invert_divide_by_the_kind_of_the_prior(to, middle):
    t, m = variable_of[to]("t", 3), variable_of[middle]("m", 4)
    relation, prior = sx.Relation(t, m, drawn(to, 4, 3)), sx.Distribution(m, drawn(middle, 4, seed=3))
    joint = (relation.table * prior.values[:, None]).T
    inverse, unreachable = sx.invert(relation, prior)
    np.testing.assert_allclose(inverse.table, joint / plus[middle](joint, axis=1, keepdims=True), rtol=1e-13)
    assert unreachable == []
    np.testing.assert_allclose(sx.update(prior, relation.likelihood(2)).values, inverse.given(2).values, rtol=1e-13)


def test_logarithms_of_likelihoods_do_not_underflow():
    evidence = sx.Likelihood(age, logs=[-5000.0, -5001.0, -np.inf])
    np.testing.assert_allclose(sx.update(sx.uninformative(age), evidence).values, [1, np.exp(-1), 0])
    np.testing.assert_array_equal(evidence.logs, [-5000, -5001, -np.inf])


def test_a_hybrid_distribution_is_one_in_one_order_only():
    joint = sx.HybridDistribution(speed_given_mood, sx.uninformative(mood))  # (12)
    np.testing.assert_array_equal(joint.table, [[0.9, 0.1], [0.3, 0.7]])
    assert joint.inner_marginal().beta == pytest.approx(0.9 + 0.7)
    np.testing.assert_allclose(joint.inner_marginal().values, [0.9, 0.7])
    back, unreachable = joint.outer_given_inner()
    np.testing.assert_allclose(back.table, [[1, 1 / 3], [1 / 7, 1]])
    np.testing.assert_allclose(back.table * joint.inner_marginal().values[:, None], joint.table.T)  # (14)
    assert unreachable == []
    assert type(sx.HybridDistribution(mood_given_age, looks).inner_marginal()) is sx.FuzzyDistribution


def test_transforms():
    np.testing.assert_allclose(sx.to_possibility(weather, sx.RatioScale()).values, [1, 0.5, 1 / 6])
    np.testing.assert_allclose(sx.to_possibility(weather, sx.DuboisPrade()).values, [1, 0.4, 0.1])
    possible = sx.to_possibility(weather, sx.DuboisPradeSandri())
    np.testing.assert_allclose(possible.values, [1, 0.3 + 0.3 + 0.1, 0.3])
    np.testing.assert_allclose(sx.to_probability(possible, sx.DuboisPradeSandri()).values, weather.values)
    fuzzy = sx.to_possibility(sx.Relation(speed, speed, [[0.8, 0.2], [0.1, 0.9]]), sx.RatioScale())
    np.testing.assert_allclose(fuzzy.table, [[1, 0.25], [1 / 9, 1]])
    assert type(fuzzy) is sx.FuzzyGivenRandom and fuzzy.to == sx.FuzzyVariable("speed", speed.labels) != speed


def test_measures_of_every_event():
    for chosen in itertools.product([False, True], repeat=3):
        event, others = np.flatnonzero(chosen), np.flatnonzero(np.logical_not(chosen))
        possible = max(looks.values[event], default=0.0)
        assert sx.possibility(looks, event) == possible == pytest.approx(1 - sx.necessity(looks, others))
        assert sx.probability(weather, event) == pytest.approx(weather.values[event].sum())
    assert sx.possibility(looks, ["young", "old"]) == 0.5


def patterns_of(none, weights):
    """Every event with its weight, by its pattern: the rows that are detected and the columns that are used."""
    patterns = {}
    for event in itertools.product(range(-1, weights.shape[1]), repeat=len(none)):
        used = [c for c in event if c >= 0]
        if len(set(used)) == len(used):
            weight = np.prod([none[r] if c < 0 else weights[r, c] for r, c in enumerate(event)])
            patterns.setdefault((tuple(c >= 0 for c in event), frozenset(used)), {})[event] = weight
    return list(patterns.values())


@pytest.mark.parametrize("pattern, permutation", itertools.product(["random", "fuzzy"], repeat=2))
def test_matching_eliminates_the_permutation_then_the_pattern(pattern, permutation):
    none, weights = np.array([0.2, 0.5, 0.1]), np.array([[2.0, 0.7, 0.0], [1.5, 3.0, 0.4], [0.3, 0.6, 1.1]])

    patterns = patterns_of(none, weights)
    best, weight = max((pair for events in patterns for pair in events.items()), key=lambda pair: pair[1])
    if (pattern, permutation) == ("random", "fuzzy"):  # JPDA*: of each pattern only the best event counts
        patterns = [dict([max(events.items(), key=lambda pair: pair[1])]) for events in patterns]

    def total(chosen):
        of_patterns = [[w for event, w in events.items() if chosen(event)] for events in patterns]
        return plus[pattern]([plus[permutation](of_one) for of_one in of_patterns if of_one])

    with np.errstate(divide="ignore"):
        matching = sx.match(np.log(none), np.log(weights), pattern, permutation)
    marginals = [[total(lambda event: event[r] == c) for c in range(-1, 3)] for r in range(3)]
    marginals /= plus[pattern](marginals, axis=1, keepdims=True)
    np.testing.assert_allclose(np.exp(matching.log_marginals), marginals[:, 1:], rtol=1e-12, atol=1e-300)
    np.testing.assert_allclose(np.exp(matching.log_none), marginals[:, 0], rtol=1e-12)
    assert matching.log_total == pytest.approx(np.log(total(lambda event: True)))
    assert (tuple(matching.best), matching.log_best) == (best, pytest.approx(np.log(weight))) and matching.exact


def test_values_are_views_that_outlive_their_owner():
    relation = sx.Relation(speed, sx.RandomVariable("many", 1000), np.tile([0.25, 0.75], (1000, 1)))
    view, address = relation.table, relation.table.__array_interface__["data"]
    assert view.__array_interface__["data"] == address and not view.flags.writeable and not view.flags.owndata
    values, rows = sx.Distribution(sx.RandomVariable("big", 5000), np.full(5000, 1 / 5000)).values, relation.table[7]
    del relation
    gc.collect()
    junk = [np.zeros(5000) for _ in range(20)]
    assert len(junk) == 20 and (values == 1 / 5000).all() and rows.tolist() == [0.25, 0.75]


def test_threads_compose_at_once():
    m = sx.RandomVariable("m", 200)
    relation = sx.Relation(m, m, drawn("random", 200, 200))
    expected, found = sx.compose(relation, relation), [None] * 8

    def work(i):
        for _ in range(5):
            found[i] = sx.compose(relation, relation)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(one == expected for one in found)


def test_rows_are_sequences():
    assert len(looks) == 3 and list(looks) == [0.5, 1.0, 0.4] and looks["old"] == looks[2] == 0.4
    np.testing.assert_array_equal(np.asarray(looks), looks.values)
    assert repr(looks) == "<FuzzyDistribution age [0.5, 1.0, 0.4]>"
    assert (age.kind, len(age), age.labels) == ("fuzzy", 3, ["young", "middle", "old"])
    np.testing.assert_allclose(sx.normalized(mood, age, [[3, 1], [2, 2], [0, 7]]).table, [[1, 1 / 3], [1, 1], [0, 1]])
    np.testing.assert_allclose(sx.normalized(weather.variable, [6, 3, 1]).values, weather.values)
    assert sx.most_likely(weather) == "dry"


refusals = [
    (TypeError, r"update: .*found \(RandomDistribution, FuzzyLikelihood\)",
     lambda: sx.update(weather, mood_given_age.likelihood(0))),
    (TypeError, r"update: .*found \(FuzzyDistribution, OrdinalLikelihood\)",
     lambda: sx.update(looks, sx.Likelihood(rank, [1, 0]))),
    (TypeError, r"compose: .*found \(FuzzyGivenFuzzy, RandomGivenFuzzy\)",
     lambda: sx.compose(mood_given_age, speed_given_mood)),
    (TypeError, r"invert: .*found \(FuzzyGivenFuzzy, RandomDistribution\)", lambda: sx.invert(mood_given_age, weather)),
    (TypeError, r"compose: .*found \(FuzzyGivenFuzzy, RandomDistribution\)",
     lambda: sx.HybridDistribution(mood_given_age, weather)),
    (TypeError, r"probability: .*found \(FuzzyDistribution, list\)", lambda: sx.probability(looks, [0])),
    (TypeError, r"Relation: .*found \(FuzzyVariable, OrdinalVariable, list\)",
     lambda: sx.Relation(mood, rank, [[1, 1]])),
    (TypeError, "FuzzyVariable(.|\n)*RandomVariable", lambda: sx.FuzzyDistribution(speed, [1, 1])),
    (TypeError, r"to_possibility: .*found \(FuzzyDistribution, RatioScale\)",
     lambda: sx.to_possibility(looks, sx.RatioScale())),
    (TypeError, r"update: .*found \(int, FuzzyDistribution\)", lambda: sx.update(3, looks)),
    (TypeError, "1.5", lambda: looks[1.5]),
    (ValueError, "'mood' given age = 'old' is 0.9, not 1",
     lambda: sx.Relation(mood, age, [[0.3, 1], [1, 0.6], [0.9, 0.2]])),
    (ValueError, "'age' at outcome 'middle' is nan", lambda: sx.Distribution(age, [1, np.nan, 0])),
    (ValueError, "needs 3 rows, but 2", lambda: sx.Relation(mood, age, [[0.3, 1], [1, 0.6]])),
    (ValueError, r"expected shape \(any, any\), found \(2,\)", lambda: sx.Relation(mood, age, [0.3, 1])),
    (ValueError, r"expected shape \(any,\), found \(1, 3\)", lambda: sx.Distribution(age, [[1, 1, 1]])),
    (ValueError, "no outcome 'ancient'; its outcomes are young", lambda: looks["ancient"]),
    (ValueError, "expected variable 'mood', found 'age'",
     lambda: sx.compose(speed_given_mood, sx.Relation(age, mood, [[1] * 3] * 2))),
    (ValueError, "excludes every outcome|no outcome",
     lambda: sx.update(sx.Distribution(age, [1, 0, 0]), sx.Likelihood(age, [0, 1, 1]))),
    (ValueError, "expected 'random' or 'fuzzy', found 'ordinal'",
     lambda: sx.match([0.0], [[0.0]], "ordinal", "random")),
    (IndexError, "'age' has no outcome 3", lambda: looks[3]),
    (IndexError, "'age' has no outcome -1", lambda: mood_given_age[-1, 0]),
]


@pytest.mark.parametrize("error, words, call", refusals, ids=[words for _, words, _ in refusals])
def test_refusals(error, words, call):
    with pytest.raises(error, match=words):
        call()
