"""Recognition by the conventions of scikit-learn, which only this module needs."""
from collections import namedtuple

import numpy as np
from sklearn.base import BaseEstimator, ClassifierMixin
from sklearn.utils import multiclass, validation

from . import _sigmax

# Why a row is of the class `pattern` rather than `rival`: logarithms of ratios, which add up.
Explanation = namedtuple("Explanation", "pattern rival log_prior_ratio contributions")
Contribution = namedtuple("Contribution", "feature reading log_ratio equation")


class SigmaMaxClassifier(ClassifierMixin, BaseEstimator):
    """Classes and features of either kind, "random" or "fuzzy": (17)-(20), (41)-(46). Both random is naive Bayes.

    Numbers become at most `bins` bins, words values; NaN, None and words that are new in `predict` are missing.
    `transformation`, "ratio" or "dubois_prade", makes possibilities of counts, to each of which `smoothing` is added.
    Without `fit_prior` nothing is known of the class before a row is seen."""

    def __init__(self, pattern="random", features="random", *, transformation="ratio", bins=8, smoothing=1.0,
                 fit_prior=True):
        self.pattern, self.features, self.transformation = pattern, features, transformation
        self.bins, self.smoothing, self.fit_prior = bins, smoothing, fit_prior

    def fit(self, X, y, sample_weight=None):
        """Learns rows X (N, n) of classes y (N,), and forgets all other rows."""
        X, y = self._validated(X, y=y, reset=True)
        multiclass.check_classification_targets(y)
        self.classes_ = np.unique(y)
        return self._learn(X, y, sample_weight, True)

    def partial_fit(self, X, y, classes=None, sample_weight=None):
        """Learns more rows. The first call needs all classes, and its rows fix the bins and words."""
        first = multiclass._check_partial_fit_first_call(self, classes)
        return self._learn(*self._validated(X, y=y, reset=first), sample_weight, first)

    def predict(self, X):
        """Returns the most likely class of each row, (N,); of several, the first."""
        best = self._log_degrees(X).argmax(axis=1)
        return self.classes_[best]

    def predict_proba(self, X):
        """Returns probabilities (N, classes). Possibilities are divided by their sum: the ratio scale, (35)."""
        possible = self.possibility(X)
        return possible / possible.sum(axis=1, keepdims=True)

    def possibility(self, X):
        """Returns the possibility of each class, (N, classes). Probabilities are divided by their maximum, (34)."""
        return np.exp(self._log_degrees(X))

    def necessity(self, X):
        """Returns one less the greatest possibility of the other classes, (N, classes)."""
        possible = self.possibility(X)
        ascending = np.pad(np.sort(possible, axis=1), ((0, 0), (1, 0)))
        return 1.0 - np.where(possible == 1.0, ascending[:, [-2]], 1.0)

    def explain(self, x):
        """Returns the Explanation of one row, (n,) or (1, n)."""
        x, contributions = [x] if np.ndim(x) == 1 else x, []
        best = np.argsort(-self._log_degrees(x)[0], kind="stable")[[0, min(1, len(self.classes_) - 1)]]
        symbol = "p" if self.features == "random" else "π"
        for (name, labels, _), cuts, logs, cell in zip(self._features, self._cuts, self._logs, self._cells(x)[0]):
            if not np.isnan(cell):
                found = np.searchsorted(cuts, cell, side="right")
                log, rival = logs[found, best]
                equation = f"{symbol}({name} = {labels[found]}|class = {self.classes_[best[0]]}) = {np.exp(log):.4g}"
                contributions.append(Contribution(name, labels[found], _log_ratio(log, rival), equation))
        return Explanation(*self.classes_[best], _log_ratio(*self._log_prior[best]), contributions)

    def _validated(self, X, **options):
        options["dtype"] = None
        if hasattr(validation, "validate_data"):  # scikit-learn 1.6
            return validation.validate_data(self, X, ensure_all_finite="allow-nan", **options)
        return self._validate_data(X, force_all_finite="allow-nan", **options)

    def _log_degrees(self, X):
        cells = self._cells(X)
        return _sigmax._log_degrees(self._log_prior, self._logs, self._cuts, cells)

    def _cells(self, X):
        validation.check_is_fitted(self)
        return self._numbers(self._validated(X, reset=False))

    def _numbers(self, X):
        if X.dtype.kind not in "OUS":
            return X
        cells = np.full(X.shape, np.nan)
        for i, (_, labels, words) in enumerate(self._features):
            column = X[:, i].astype(str if words else float)
            if words:
                found = np.minimum(np.searchsorted(labels, column), len(labels) - 1)
                column = np.where(np.asarray(labels)[found] == column, found, np.nan)
            cells[:, i] = column
        return cells

    def _learn(self, X, y, weights, first):
        weights = validation._check_sample_weight(weights, X)
        X, y, weights = (X, y, weights) if weights.all() else (each[weights != 0] for each in (X, y, weights))
        labels = np.minimum(np.searchsorted(self.classes_, y), len(self.classes_) - 1)
        if np.any(self.classes_[labels] != y):
            raise ValueError(f"y has classes that are not in {self.classes_}")
        if first:
            names = getattr(self, "feature_names_in_", [f"x{i}" for i in range(X.shape[1])])
            self._cuts, *labels_and_words = zip(*[_bins(column, self.bins) for column in X.T])
            self._features = list(zip(names, *labels_and_words))
            self.counts_ = 0.0
        readings = max(map(len, self._cuts)) + 2  # the last if one is missing
        self.counts_ = self.counts_ + _sigmax._count_rows(
            len(self.classes_), readings, self._cuts, labels, self._numbers(X), weights)
        self._make_logs()
        return self

    def _make_logs(self):
        """Logarithms of the prior (classes,), and of each reading (columns, readings, classes): 0 if missing."""
        kinds = ["random", "fuzzy"]
        for name, words in ("pattern", kinds), ("features", kinds), ("transformation", ["ratio", "dubois_prade"]):
            if getattr(self, name) not in words:
                raise ValueError(f"{name}: expected {' or '.join(map(repr, words))}, found {getattr(self, name)!r}")
        transform = _sigmax.RatioScale() if self.transformation == "ratio" else _sigmax.DuboisPrade()
        if not self.smoothing >= 0:
            raise ValueError(f"smoothing: expected a number that is not negative, found {self.smoothing}")

        def learned(kind, *variables_and_weights):
            by_sums = _sigmax.normalized(*variables_and_weights)
            return by_sums if kind == "random" else _sigmax.to_possibility(by_sums, transform)

        pattern = _sigmax.RandomVariable("class", [str(label) for label in self.classes_])
        rows = self.counts_[0].sum(axis=1) if self.fit_prior else np.ones(len(pattern))
        self._logs = np.zeros(self.counts_.transpose(0, 2, 1).shape)
        with np.errstate(divide="ignore"):
            self._log_prior = np.log(learned(self.pattern, pattern, rows).values)
            for (name, labels, _), counts, logs in zip(self._features, self.counts_, self._logs):
                feature, weights = _sigmax.RandomVariable(name, labels), counts[:, : len(labels)] + self.smoothing
                logs[: len(labels)] = np.log(learned(self.features, feature, pattern, weights).table.T)

    def _more_tags(self):
        return {"allow_nan": True, "X_types": ["2darray", "string"]}

    def __sklearn_tags__(self):
        tags = super().__sklearn_tags__()
        tags.input_tags.allow_nan = tags.input_tags.string = True
        return tags


def _log_ratio(log, other):
    return 0.0 if log == other else log - other


def _bins(column, bins):
    """The cuts of a column, the labels of its readings, and whether they are words."""
    try:
        return *_sigmax._bins(column.astype(float), bins), False
    except (ValueError, TypeError):
        if column.dtype.kind not in "OUS":
            raise
    words = sorted({*np.unique(column.astype(str)).tolist()} - {"", "nan", "None", "<NA>"}) or ["missing"]
    return [float(i) for i in range(1, len(words))], words, True
