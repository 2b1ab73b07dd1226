"""IMM and HIMM on scenario 1 of the paper: 100 runs of a target that turns from sample 81 to 130, seen by a radar."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import sigmax as sx

T, steps, runs = 0.2, 200, 100
sigma = np.array([10.0, np.radians(0.1), np.radians(0.1)])  # range in m, azimuth, elevation
models = [sx.models.dwna(3, sigma=3.0), sx.models.dwpa(3, sigma=3.0)]
generator = np.random.default_rng(1)


def fly():
    """True positions (N, 3) in m."""
    noise = 3.0 * generator.normal(size=(steps, 3))
    manoeuvre = (np.arange(steps) >= 80) & (np.arange(steps) < 130)
    acceleration = noise + manoeuvre[:, None] * [-30.0, -50.0, 0.0]
    velocity = [-100.0, -100.0, 0.0] + T * np.cumsum(np.vstack([np.zeros(3), acceleration[:-1]]), axis=0)
    moves = T * velocity + T**2 / 2 * acceleration
    return [12e3, 8e3, 1e3] + np.cumsum(np.vstack([np.zeros(3), moves[:-1]]), axis=0)


def see(truth):
    """Measured positions (N, 3) and their covariances (N, 3, 3)."""
    ground = np.hypot(truth[:, 0], truth[:, 1])
    azimuth, elevation = np.arctan2(truth[:, 1], truth[:, 0]), np.arctan2(truth[:, 2], ground)
    polar = np.stack([np.linalg.norm(truth, axis=1), azimuth, elevation], 1)
    r, azimuth, elevation = (polar + sigma * generator.normal(size=polar.shape)).T
    across, up, away = np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)
    z = r[:, None] * np.stack([across, up, away], 1)
    by_azimuth = np.stack([-z[:, 1], z[:, 0], 0 * r], 1)
    by_elevation = r[:, None] * np.stack([-np.cos(azimuth) * away, -np.sin(azimuth) * away, np.cos(elevation)], 1)
    J = np.stack([z / r[:, None], by_azimuth, by_elevation], 2)
    return z, J @ np.diag(sigma**2) @ J.transpose(0, 2, 1)


squares = {"measured": np.zeros(steps), "imm": np.zeros(steps), "himm": np.zeros(steps)}
weights = {"imm": np.zeros(steps), "himm": np.zeros(steps)}
for _ in range(runs):
    truth = fly()
    z, R = see(truth)
    squares["measured"] += ((z - truth) ** 2).sum(axis=1) / runs
    for name in weights:
        track = sx.track(T * np.arange(steps), z, R, filter=name, models=models)
        squares[name] += ((track.x[:, :3] - truth) ** 2).sum(axis=1) / runs
        weights[name] += track.weights[:, 1] / runs

colours = {"measured": "silver", "imm": "C0", "himm": "C1"}
figure, (errors, modes) = plt.subplots(2, 1, sharex=True, figsize=(7, 6))
for name, square in squares.items():
    errors.plot(np.arange(steps)[10:], np.sqrt(square[10:]), color=colours[name], label=name)
errors.set_ylabel("RMS position error in m")
errors.legend()
for name, weight in weights.items():
    modes.plot(np.arange(steps)[10:], weight[10:], color=colours[name])
modes.set_ylabel("mean weight of acceleration")
modes.set_xlabel("sample")
figure.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

rms = {name: np.sqrt(square[10:].mean()) for name, square in squares.items()}
print(", ".join(f"{name} {value:.1f} m" for name, value in rms.items()))
