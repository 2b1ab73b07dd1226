"""Is a man of 42 young or middle-aged? Concepts overlap, so his age group is fuzzy."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import sigmax as sx

group = sx.FuzzyVariable("age group", ["young", "middle-aged", "old"])
evening = sx.FuzzyVariable("evening", ["stays in", "goes out"])
evening_given_group = sx.Relation(evening, group, [[0.4, 1.0], [1.0, 0.5], [1.0, 0.1]])

looks = sx.normalized(group, [0.5, 0.75, 0.2])  # divided by the maximum
after = sx.update(looks, evening_given_group.likelihood("goes out"))

places = np.arange(len(group))
for shift, label, belief in (-0.2, "by his looks", looks), (0.2, "he goes out, too", after):
    bars = plt.bar(places + shift, belief.values, 0.36, alpha=0.5, label=f"possibility, {label}")
    necessity = [sx.necessity(belief, [name]) for name in group.labels]
    plt.bar(places + shift, necessity, 0.36, color=bars[0].get_facecolor(), alpha=1)
plt.xticks(places, group.labels)
plt.ylim(0, 1.35)
plt.legend(title="solid: necessity")
plt.savefig(sys.argv[-1].replace(".py", ".png"), dpi=80)

print(f"{sx.most_likely(after)}; middle-aged is possible to {after['middle-aged']:.2f}")
