"""Times of the Python package as ratios within one run, beside C++, scikit-learn and NumPy.

Usage: PYTHONPATH=build/release/python python3 bench/python/ratios.py [build/release/bench/sigmax_hybrid_bench]
"""

import json
import subprocess
import sys
import time

import numpy as np
import sigmax as sx
from sigmax.sklearn import SigmaMaxClassifier
from sklearn.naive_bayes import CategoricalNB


def seconds(action, repetitions=5):
    """The least of several times, in s."""
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        action()
        times.append(time.perf_counter() - begin)
    return min(times)


def show(what, ours, theirs, units, unit="ns"):
    scale = {"ns": 1e9, "µs": 1e6, "ms": 1e3}[unit] / units
    print(f"{what:<44} {ours * scale:9.2f} {theirs * scale:9.2f} {unit}   {ours / theirs:5.2f}")


def measurements(rows=1000, T=0.2):
    """Times, positions and covariances of a target that turns now and then."""
    generator = np.random.default_rng(1)
    turns = {1: [-30.0, -50.0, 0.0], 3: [30.0, 50.0, 0.0]}
    acceleration = np.array([turns.get(k // 50 % 4, [0.0, 0.0, 0.0]) for k in range(rows)])
    velocity = [-100.0, -100.0, 0.0] + T * np.cumsum(acceleration, axis=0)
    z = [12e3, 8e3, 1e3] + T * np.cumsum(velocity, axis=0) + 10.0 * generator.normal(size=(rows, 3))
    return T * np.arange(rows), z, np.array([[100.0, 20.0, 0.0], [20.0, 100.0, 0.0], [0.0, 0.0, 100.0]])


def filters(benchmark):
    """Steps of an IMM, and a recording, beside the same of the C++ benchmarks."""
    command = [benchmark, "--benchmark_filter=^(ImmStep/vector|FollowRecording)$", "--benchmark_format=json"]
    found = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)["benchmarks"]
    of_cpp = {each["name"]: 1.0 / each["items_per_second"] for each in found}
    models = [sx.models.dwna(3, sigma=3.0), sx.models.dwpa(3, sigma=3.0)]
    times, z, R = measurements()
    rows = list(z)
    P = np.diag([100.0] * 3 + [400.0] * 3 + [100.0] * 3)
    start = {"x": [12e3, 8e3, 1e3, -100.0, -100.0, 0.0, 0.0, 0.0, 0.0], "P": P}
    imm = sx.IMM(models, [[0.95, 0.05], [0.05, 0.95]], **start)

    def steps():
        for row in rows:
            imm.step(0.2, row, R)

    def steps_with_output():
        for row in rows:
            imm.step(0.2, row, R)
            imm.x, imm.P

    for what, action in ("step", steps), ("step, x and P", steps_with_output):
        show(f"{what}: Python, C++ with output", seconds(action, 100) / len(rows), of_cpp["ImmStep/vector"], 1)
    followed = seconds(lambda: sx.track(times, z, R, filter="imm", models=models), 100)
    show("track, a row: Python, C++", followed / len(rows), of_cpp["FollowRecording"], 1)


def classifiers(rows=1_000_000, features=4, values=8, classes=5):
    generator = np.random.default_rng(1)
    y = generator.integers(classes, size=rows)
    X = (generator.integers(values, size=(rows, features)) + y[:, None]) % values
    naive_bayes = CategoricalNB().fit(X, y)
    fits = [seconds(lambda: each.fit(X, y), 3) for each in (SigmaMaxClassifier(), CategoricalNB())]
    show("fit, a row: ours, CategoricalNB", *fits, rows)
    for pattern in "random", "fuzzy":
        ours = SigmaMaxClassifier(pattern, pattern).fit(X, y)
        predictions = [seconds(lambda: each.predict(X)) for each in (ours, naive_bayes)]
        show(f"predict by {pattern} kinds: ours, CategoricalNB", *predictions, rows)


def compositions(size=1000):
    """By random kinds beside NumPy's product of the same tables."""
    generator = np.random.default_rng(1)
    left, right = (generator.random((size, size)) for _ in range(2))
    for kind, normal in (sx.RandomVariable, np.sum), (sx.FuzzyVariable, np.max):
        a, b, c = (kind(name, size) for name in "abc")
        tables = [table / normal(table, axis=1, keepdims=True) for table in (left, right)]
        first, second = sx.Relation(b, a, tables[0]), sx.Relation(c, b, tables[1])
        ours, product = seconds(lambda: sx.compose(second, first)), seconds(lambda: tables[0] @ tables[1])
        show(f"compose, {kind.kind}: ours, NumPy's product", ours, product, 1, "ms")


if __name__ == "__main__":
    print(f"{'':<44} {'first':>9} {'second':>9}      ratio")
    if len(sys.argv) > 1:
        filters(sys.argv[1])
    classifiers()
    compositions()
