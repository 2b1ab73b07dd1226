"""Emitters are recognised though the believed prior is wrong: a probability insists, a possibility gives in."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import sigmax as sx

emitters = ["search", "tracking", "jammer"]
kinds = {"random": sx.RandomVariable("emitter", emitters), "fuzzy": sx.FuzzyVariable("emitter", emitters)}
mode = sx.RandomVariable("mode", ["scan", "lock", "noise"])
rows = [[0.8, 0.1, 0.1], [0.2, 0.7, 0.1], [0.1, 0.2, 0.7]]  # p(mode | emitter)

# Experts saw a thousand search radars and one jammer. That others are possible is all they know.
priors = {"random": [0.979, 0.02, 0.001], "fuzzy": [1.0, 1.0, 1.0]}
beliefs = {kind: sx.normalized(kinds[kind], prior) for kind, prior in priors.items()}
reports = np.random.default_rng(3).choice(mode.labels, 12, p=rows[2])  # a jammer is there

history = {kind: [] for kind in kinds}
for report in reports:
    for kind, emitter in kinds.items():
        beliefs[kind] = sx.update(beliefs[kind], sx.Relation(mode, emitter, rows).likelihood(report))
        history[kind].append(beliefs[kind]["jammer"])

for kind, values in history.items():
    plt.plot(range(1, len(values) + 1), values, "o-", label=f"{kind} emitter")
plt.xlabel("reports")
plt.ylabel("belief in the jammer")
plt.legend()
plt.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

first = {kind: next(k for k, value in enumerate(values, 1) if value > 0.5) for kind, values in history.items()}
print(f"jammer believed more than 0.5 from report {first['fuzzy']} (fuzzy) and {first['random']} (random)")
