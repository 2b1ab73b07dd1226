#!/usr/bin/env python3
"""Writes fruit.csv, to learn from, and fruit_new.csv, to be classified: invented fruit, drawn with a fixed seed."""

import pathlib
import random

FRUIT = {  # shares of colours, skins, and of having a stone; mean and deviation of weight (g) and sugar (%)
    "apple": ({"red": 0.5, "green": 0.3, "yellow": 0.2}, {"smooth": 0.95, "rough": 0.05}, {"no": 1}, (180, 35), (11, 2)),
    "plum": ({"blue": 0.6, "red": 0.25, "yellow": 0.15}, {"smooth": 1}, {"yes": 1}, (60, 15), (12, 2)),
    "kiwi": ({"brown": 0.8, "green": 0.2}, {"furry": 0.9, "rough": 0.1}, {"no": 1}, (85, 15), (10, 2)),
    "peach": ({"orange": 0.5, "red": 0.3, "yellow": 0.2}, {"furry": 0.8, "smooth": 0.2}, {"yes": 0.97, "no": 0.03},
              (150, 30), (10, 2)),
    "lemon": ({"yellow": 0.9, "green": 0.1}, {"rough": 0.8, "smooth": 0.2}, {"no": 1}, (110, 25), (3, 1)),
}
MISSING = 0.04


def row(draw):
    fruit = draw.choice(list(FRUIT))
    *shares, weight, sugar = FRUIT[fruit]
    words = [draw.choices(list(share), list(share.values()))[0] for share in shares]
    numbers = [f"{max(20, draw.gauss(*weight)):.0f}", f"{max(1, draw.gauss(*sugar)):.1f}"]
    cells = ["" if draw.random() < MISSING else word for word in words]
    cells += ["NA" if draw.random() < MISSING else number for number in numbers]
    return ",".join([*cells, fruit])


def main():
    draw = random.Random(20)
    folder = pathlib.Path(__file__).parent
    for name, rows in (("fruit.csv", 150), ("fruit_new.csv", 40)):
        lines = ["colour,skin,stone,weight_g,sugar_percent,fruit"] + [row(draw) for _ in range(rows)]
        (folder / name).write_text("\n".join(lines) + "\n")


main()
