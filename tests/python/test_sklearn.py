"""Recognition by the conventions of scikit-learn."""

import itertools
import pickle

import numpy as np
import pandas as pd
import pytest
import sigmax as sx
from sigmax.sklearn import SigmaMaxClassifier
from sklearn.model_selection import GridSearchCV
from sklearn.naive_bayes import CategoricalNB
from sklearn.utils.estimator_checks import parametrize_with_checks

kinds = list(itertools.product(["random", "fuzzy"], repeat=2))


@parametrize_with_checks([SigmaMaxClassifier(pattern, features) for pattern, features in kinds])
def test_scikit_learn_accepts_it(estimator, check):
    check(estimator)


def table(rows=500, seed=0):
    generator = np.random.default_rng(seed)
    y = generator.choice([3, 5, 7], rows, p=[0.5, 0.3, 0.2])
    return generator.binomial(5, (y / 10)[:, None], (rows, 4)), y


def test_random_kinds_are_categorical_naive_bayes():
    X, y = table()
    weights = np.random.default_rng(1).uniform(0, 2, len(y))
    ours = SigmaMaxClassifier(smoothing=0.5).fit(X, y, weights)
    theirs = CategoricalNB(alpha=0.5).fit(X, y, weights)
    np.testing.assert_allclose(ours.predict_proba(X), theirs.predict_proba(X), rtol=1e-11)
    assert (ours.predict(X) == theirs.predict(X)).all()


def in_loops(X, y, row, pattern, features):
    """Possibilities of the classes by the equations, with the ratio scale."""
    scaled = {"random": lambda p: p / p.sum(), "fuzzy": lambda p: p / p.max()}
    classes = np.unique(y)
    belief = scaled[pattern](np.array([(y == c).sum() for c in classes], float))
    for i, c in itertools.product(range(X.shape[1]), range(len(classes))):
        values = np.unique(X[:, i])
        counts = np.array([((y == classes[c]) & (X[:, i] == v)).sum() + 1.0 for v in values])
        belief[c] *= scaled[features](counts)[list(values).index(row[i])]
    return belief / belief.max()


@pytest.mark.parametrize("pattern, features", kinds)
def test_each_kind_is_its_equations(pattern, features):
    X, y = table(60)
    model = SigmaMaxClassifier(pattern, features).fit(X, y)
    expected = np.array([in_loops(X, y, row, pattern, features) for row in X])
    np.testing.assert_allclose(model.possibility(X), expected, rtol=1e-12)
    np.testing.assert_allclose(model.predict_proba(X), expected / expected.sum(axis=1, keepdims=True), rtol=1e-12)
    others = [np.delete(expected, c, axis=1).max(axis=1) for c in range(3)]
    np.testing.assert_allclose(model.necessity(X), 1 - np.transpose(others), atol=1e-12)


@pytest.mark.parametrize("pattern, features", kinds)
def test_an_explanation_adds_up(pattern, features):
    X, y = table()
    model = SigmaMaxClassifier(pattern, features, transformation="dubois_prade").fit(X, y)
    why = model.explain(X[0])
    assert why.pattern == model.predict(X[:1])[0]
    of = [list(model.classes_).index(label) for label in (why.pattern, why.rival)]
    degrees = model.possibility(X[:1])[0][of]
    total = why.log_prior_ratio + sum(each.log_ratio for each in why.contributions)
    assert total == pytest.approx(np.log(degrees[0] / degrees[1]))
    assert why.contributions[1].feature == "x1" and "x1 = " in why.contributions[1].equation


frame = pd.DataFrame({"height": [12.0, 31, 9, 28, np.nan], "leaf": ["broad", "needle", "broad", "needle", None]})
trees = ["oak", "pine", "oak", "pine", "pine"]


def test_words_and_missing_cells():
    model = SigmaMaxClassifier(fit_prior=False).fit(frame, trees)
    assert list(model.feature_names_in_) == ["height", "leaf"]
    new = pd.DataFrame({"height": [30.0, np.nan], "leaf": ["needle", "palm"]})
    assert model.predict(new)[0] == "pine"
    np.testing.assert_allclose(model.predict_proba(new)[1], [0.5, 0.5])  # nothing is known
    assert model.explain(new[:1]).contributions[1].equation == "p(leaf = needle|class = pine) = 0.75"
    with pytest.warns(UserWarning, match="feature names"):
        assert [each.feature for each in model.explain([np.nan, "broad"]).contributions] == ["leaf"]
    with pytest.raises(ValueError, match="could not convert string to float: 'tall'"):
        model.predict(pd.DataFrame({"height": ["tall"], "leaf": ["broad"]}))


def test_batches_are_the_whole():
    X, y = table()
    whole = SigmaMaxClassifier("fuzzy").fit(X, y)
    parts = SigmaMaxClassifier("fuzzy").partial_fit(X[:400], y[:400], classes=[3, 5, 7]).partial_fit(X[400:], y[400:])
    np.testing.assert_array_equal(whole.counts_, parts.counts_)
    np.testing.assert_array_equal(whole.predict_proba(X), pickle.loads(pickle.dumps(parts)).predict_proba(X))
    with pytest.raises(ValueError, match="y has classes that are not in"):
        parts.partial_fit(X[:1], [4])


def test_parameters_are_searched_and_refused():
    X, y = table()
    grid = {"pattern": ["random", "fuzzy"], "transformation": ["ratio", "dubois_prade"]}
    assert GridSearchCV(SigmaMaxClassifier(features="fuzzy"), grid, cv=3).fit(X, y).best_score_ > 0.5
    with pytest.raises(ValueError, match="pattern: expected 'random' or 'fuzzy', found 'vague'"):
        SigmaMaxClassifier("vague").fit(X, y)
    with pytest.raises(ValueError, match="smoothing: expected a number that is not negative, found -1.0"):
        SigmaMaxClassifier(smoothing=-1.0).fit(X, y)
    with pytest.raises(ValueError, match="at least one bin"):
        SigmaMaxClassifier(bins=0).fit(X, y)
    with pytest.raises(ValueError, match="infinity"):
        SigmaMaxClassifier().fit([[1.0], [np.inf]], [0, 1])


def test_ties_and_excluded_rows():
    model = SigmaMaxClassifier(smoothing=0.0).fit([[0], [1]], ["a", "b"])
    assert list(model.predict([[0], [1], [np.nan]])) == ["a", "b", "a"]
    assert model.necessity([[np.nan]]).tolist() == [[0.0, 0.0]]
    never = SigmaMaxClassifier(smoothing=0.0).fit([[0, 0], [0, 0], [1, 1]], ["a", "a", "b"])
    np.testing.assert_allclose(never.predict_proba([[0, 1]]), [[2 / 3, 1 / 3]])  # the prior is left


def test_many_values_are_in_the_right_bins():
    values = np.random.default_rng(2).normal(size=1000)
    model = SigmaMaxClassifier(bins=40).fit(values[:, None], np.zeros(1000))
    cuts = np.sort(values)[[j * 1000 // 40 for j in range(1, 40)]]
    expected = np.bincount(np.searchsorted(cuts, values, side="right")).tolist() + [0.0]
    assert model.counts_[0].tolist() == [expected]
