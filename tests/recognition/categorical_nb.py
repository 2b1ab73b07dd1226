"""Posteriors of scikit-learn's CategoricalNB, for comparison.

usage: categorical_nb.py DATA.csv LABEL POSTERIORS

Trains with Laplace smoothing on the rows whose number (from 0) is not a multiple of three and writes the posteriors of
all rows as doubles, row by row. Labels, and the values of every column, are numbered in the order of their first
appearance in the whole file. Exits with 77 if scikit-learn is not there.
"""

import csv
import sys

try:
    import numpy
    from sklearn.naive_bayes import CategoricalNB
except ImportError:
    sys.exit(77)


def numbered(values):
    numbers = {}
    return [numbers.setdefault(value, len(numbers)) for value in values], len(numbers)


def main(path, label, output):
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    columns = dict(zip(header, zip(*rows)))
    labels, _ = numbered(columns.pop(label))
    features, sizes = zip(*(numbered(column) for column in columns.values()))
    X, y = numpy.array(features).T, numpy.array(labels)
    train = numpy.arange(len(y)) % 3 != 0
    classifier = CategoricalNB(alpha=1.0, min_categories=list(sizes)).fit(X[train], y[train])
    assert list(classifier.classes_) == list(range(max(y) + 1))
    classifier.predict_proba(X).astype("<f8").tofile(output)


if __name__ == "__main__":
    main(*sys.argv[1:])
