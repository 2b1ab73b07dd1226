"""A random sensor reads a fuzzy mood of a fuzzy age: sums and maxima in one network."""

import sys

import matplotlib.pyplot as plt
import sigmax as sx

age = sx.FuzzyVariable("age", ["young", "middle", "old"])
mood = sx.FuzzyVariable("mood", ["calm", "wild"])
speed = sx.RandomVariable("speed", ["slow", "fast"])

network = sx.RelationNetwork()
network.declare(sx.uninformative(age))
network.declare(sx.Relation(mood, age, [[0.3, 1.0], [1.0, 0.6], [1.0, 0.2]]))  # a row per age, maximum 1
network.declare(sx.Relation(speed, mood, [[0.9, 0.1], [0.3, 0.7]]))  # a row per mood, sum 1

figure, axes = plt.subplots(1, 3, figsize=(9, 3), sharey=True)
for chart, evidence in zip(axes, [{}, {"speed": "fast"}, {"speed": "slow"}]):
    answer = sx.query(network, ["age"], evidence).distribution()
    chart.bar(age.labels, answer.values)
    chart.set_title(", ".join(f"{name} = {value}" for name, value in evidence.items()) or "nothing seen")
axes[0].set_ylabel("possibility of the age")
figure.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

best, degree = sx.most_likely_explanation(network, evidence={"speed": "fast"})
print(f"fast: most likely {best['age']} and {best['mood']}")
