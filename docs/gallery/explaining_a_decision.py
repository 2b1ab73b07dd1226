"""Why is this fruit taken for a plum? The logarithms of ratios, feature by feature, add up."""

import pathlib
import sys

import matplotlib.pyplot as plt
import pandas as pd
from sigmax.sklearn import SigmaMaxClassifier

data = pathlib.Path(__file__).parents[2] / "apps/examples/data"
fruit = pd.read_csv(data / "fruit.csv")
model = SigmaMaxClassifier(pattern="fuzzy", features="fuzzy", bins=4)
model.fit(fruit.drop(columns="fruit"), fruit["fruit"])

row = fruit.drop(columns="fruit").iloc[[0]]
why = model.explain(row)
names = [f"{each.feature} = {each.reading}" for each in why.contributions]
plt.barh(["prior"] + names, [why.log_prior_ratio] + [each.log_ratio for each in why.contributions])
plt.gca().invert_yaxis()
plt.axvline(0, color="black", linewidth=0.8)
plt.xlabel(f"speaks for {why.rival} ← log ratio → speaks for {why.pattern}")
plt.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80, bbox_inches="tight")

necessity = model.necessity(row).max()
print(f"{why.pattern} rather than {why.rival}, necessary to {necessity:.2f}")
