"""From a CSV file of positions to a smoothed track."""

import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import sigmax as sx

data = pd.read_csv(pathlib.Path(__file__).parents[2] / "apps/examples/data/drone.csv")
z = data[["x_m", "y_m", "z_m"]].to_numpy()  # (N, 3); NaN is a missed detection
models = [sx.models.dwna(3, sigma=1.5), sx.models.dwpa(3, sigma=1.5)]
track = sx.track(data["time_s"], z, np.diag([9.0, 9.0, 25.0]), filter="imm", models=models)
smooth = track.smooth()

figure, (path, modes) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
path.plot(z[:, 0], z[:, 1], ".", color="silver", label="measured")
path.plot(track.x[:, 0], track.x[:, 1], label="filtered")
smooth.plot((path, modes))
path.lines[-1].set_label("smoothed")
path.set(xlim=(430, 610), ylim=(330, 480))  # the turn at the top
path.legend()
figure.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

truth = data[["true_x_m", "true_y_m", "true_z_m"]].to_numpy()
errors = [np.sqrt(np.nanmean(((x - truth) ** 2).sum(axis=1))) for x in (z, track.x[:, :3], smooth.x[:, :3])]
print("RMS error: measured {:.2f} m, filtered {:.2f} m, smoothed {:.2f} m".format(*errors))
print(smooth.to_pandas().shape, "rows and columns for a CSV file")
