"""Core: kinds, tables and verbs, against restatements in NumPy and by enumeration."""

import copy
import gc
import itertools
import pickle
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

plus = {"random": np.sum, "fuzzy": np.max, "ordinal": np.max}
times = {"random": np.multiply, "fuzzy": np.multiply, "ordinal": np.minimum}
kinds = {"random": sx.RandomVariable, "fuzzy": sx.FuzzyVariable, "ordinal": sx.OrdinalVariable}
mixable = [("random", "random"), ("random", "fuzzy"), ("fuzzy", "random"), ("fuzzy", "fuzzy"), ("ordinal", "ordinal")]


def drawn(kind, *shape, seed=1):
    """Distributions of this kind along the last axis."""
    numbers = np.random.default_rng(seed).random(shape)
    return numbers / (plus[kind](numbers, axis=-1, keepdims=True) if kind != "ordinal" else 1) if kind != "ordinal" else np.where(
        numbers == numbers.max(axis=-1, keepdims=True), 1.0, numbers)


def composed(kind, left, right):
    """⊕ over the middle of right[f, m] ⊗ left[m, t]."""
    return plus[kind](times[kind](right[:, :, None], left[None, :, :]), axis=1)


@pytest.mark.parametrize("to, middle", mixable)
def test_compose_eliminates_by_the_kind_between(to, middle):
    m, t, f = kinds[middle]("m", 4), kinds[to]("t", 3), kinds[middle]("f", 5)
    left, right = sx.Relation(t, m, drawn(to, 4, 3)), sx.Relation(m, f, drawn(middle, 5, 4, seed=2))
    result = sx.compose(left, right)
    assert isinstance(result, sx.Relation if to == middle else sx.InducedRelation)
    np.testing.assert_allclose(result.table, composed(middle, left.table, right.table), rtol=1e-13)
    prior = sx.Distribution(m, drawn(middle, 4, seed=3))
    marginal = sx.compose(left, prior)
    np.testing.assert_allclose(marginal.values, composed(middle, left.table, prior.values[None])[0], rtol=1e-13)
    if to != middle:
        np.testing.assert_allclose(result.betas, plus[to](result.table, axis=1), rtol=1e-13)
        np.testing.assert_allclose(marginal.normalized().values, marginal.values / marginal.beta, rtol=1e-13)
    np.testing.assert_allclose(sx.compose(left.likelihood(1), right).values if False else
                               sx.compose(sx.Likelihood(t, [1, 0, 2 if to != "ordinal" else 1]), left).values,
                               composed(to, left.table.T * 0 + np.array([[1], [0], [2 if to != "ordinal" else 1]]), left.table)[:, 0],
                               rtol=1e-13)


def test_young_and_fast():
    fast_given_age = sx.compose(speed_given_mood, mood_given_age)
    assert fast_given_age.normalized().given("young")["fast"] == pytest.approx(0.7)
    who = sx.update(sx.uninformative(age), fast_given_age.likelihood("fast"))
    np.testing.assert_allclose(who.values, np.array([0.7, 0.42, 0.14]) / 0.7)
    assert sx.most_likely(who) == "young"
