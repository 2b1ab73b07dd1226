#!/usr/bin/env python3
"""Makes drone.csv: a made-up flight, measured each second to 3 m across and 5 m up. make_drone.py > drone.csv"""
import math
import random

random.seed(1)
x, y, z, speed, heading, climb = 0.0, 0.0, 2.0, 0.0, 30.0, 0.0
print("time_s,x_m,y_m,z_m,true_x_m,true_y_m,true_z_m")
for t in range(300):
    # Take-off, a straight leg, a wide turn, a stop in the air, a dash home with sharp turns, landing.
    climb = 3.0 if 5 <= t < 25 else -2.0 if 260 <= t < 290 else 0.0
    target = 0.0 if t < 15 else 12.0 if t < 130 else 0.0 if t < 160 else 16.0 if t < 255 else 0.0
    speed += max(-3.0, min(3.0, target - speed))
    rate = 9.0 if 70 <= t < 95 else 20.0 if 185 <= t < 191 or 220 <= t < 226 else 0.0
    heading += rate
    x += speed * math.cos(math.radians(heading))
    y += speed * math.sin(math.radians(heading))
    z = max(2.0, z + climb)
    seen = [x + random.gauss(0.0, 3.0), y + random.gauss(0.0, 3.0), z + random.gauss(0.0, 5.0)]
    print(f"{t}," + ",".join(f"{value:.2f}" for value in [*seen, x, y, z]))
