"""Wrong settings are fitted to recordings: the noise of the motions, the transition, the accuracy of the sensor."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import sigmax as sx

generator = np.random.default_rng(5)
times = np.arange(300.0)
recordings = []
for _ in range(3):
    acceleration = 0.5 * generator.normal(size=(300, 2))
    acceleration[100:130] += generator.choice([-4.0, 4.0], 2)  # a manoeuvre in each
    z = np.cumsum(np.cumsum(acceleration, axis=0), axis=0) + 12.0 * generator.normal(size=(300, 2))
    recordings.append(sx.Detections(times, z, np.diag([25.0, 25.0])))  # believed: 5 m, true: 12 m

start = {"filter": "imm", "models": [sx.models.dwna(2, sigma=5.0), sx.models.dwpa(2, sigma=5.0)]}
tuned = sx.tune(recordings, **start)

names = list(tuned.numbers)
values = np.array([tuned.numbers[name] for name in names])
known = np.isfinite(values[:, 1])
plt.figure(figsize=(7, 3.5), layout="constrained")
plt.errorbar(values[known, 0], np.flatnonzero(known), xerr=values[known, 1], fmt="o")
plt.plot(values[~known, 0], np.flatnonzero(~known), "x", color="grey", label="not identifiable")
plt.yticks(range(len(names)), names)
plt.xscale("log")
plt.legend()
plt.xlabel("value and standard error")
plt.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

print(f"the sensor's standard deviations are to be multiplied by {tuned.noise:.1f}")
print(f"minus log-score: {tuned.loss_before:.2f} before, {tuned.loss:.2f} after")
