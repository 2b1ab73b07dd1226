"""Two targets cross among false detections; nothing says whose a detection is."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import sigmax as sx

generator = np.random.default_rng(4)
R = np.diag([100.0, 100.0])
# (scans, targets, 2)
truth = np.array([[[30.0 * t, side * (600.0 - 20.0 * t)] for side in (-1, 1)] for t in range(60)])

scans = []
for t, positions in enumerate(truth):
    seen = (positions + 10.0 * generator.normal(size=(2, 2)))[generator.random(2) < 0.9]
    false = generator.uniform([-200, -800], [2000, 800], (generator.poisson(3), 2))
    z = np.concatenate([seen, false])
    plt.plot(z[:, 0], z[:, 1], ".", color="silver")
    scans.append(sx.Detections(np.full(len(z), float(t)), z, R))

models = [sx.models.dwna(2, sigma=1.0)]
tracks, owners = sx.associate(scans, models, filter="imm", detection_probability=0.9, clutter_density=3 / (2200 * 1600))

for number, track in tracks.items():
    plt.plot(track.x[:, 0], track.x[:, 1], label=f"track {number}")
plt.xlabel("x in m")
plt.ylabel("y in m")
plt.legend()
plt.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

owned = sum(np.isin(numbers, list(tracks)).sum() for numbers in owners)
print(f"{len(tracks)} confirmed tracks own {owned} of {sum(map(len, scans))} detections")
