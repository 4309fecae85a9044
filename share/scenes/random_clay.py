#!/usr/bin/env python3
"""Writes random_clay.asc, one realisation of a random undrained strength, as an ESRI ASCII grid.

    python3 share/scenes/random_clay.py > share/scenes/random_clay.asc

Lognormal with a mean of 25 kPa and a coefficient of variation of 0.3; its logarithm is a sum of
cosines whose wave vectors are those of a Gaussian correlation exp(-pi (dx/Lx)^2 - pi (dy/Ly)^2), with
scales of fluctuation of Lx = 10 m along and Ly = 2 m across the layers. Needs nothing but Python.
"""
import math
import random

MEAN, VARIATION, LX, LY = 25.0, 0.3, 10.0, 2.0
WAVES, SEED = 2000, 16
X0, Y0, STEP, COLUMNS, ROWS = -5.0, -4.0, 0.5, 39, 21   # middles of the cells


def main():
    draw = random.Random(SEED)
    waves = [(draw.gauss(0.0, 1.0) * math.sqrt(2.0 * math.pi) / LX,
              draw.gauss(0.0, 1.0) * math.sqrt(2.0 * math.pi) / LY,
              draw.uniform(0.0, 2.0 * math.pi)) for _ in range(WAVES)]
    variance = math.log(1.0 + VARIATION ** 2)
    print(f"ncols {COLUMNS}\nnrows {ROWS}\nxllcenter {X0}\nyllcenter {Y0}\ncellsize {STEP}")
    for row in reversed(range(ROWS)):
        values = []
        for column in range(COLUMNS):
            x, y = X0 + STEP * column, Y0 + STEP * row
            normal = math.sqrt(2.0 / WAVES) * sum(math.cos(a * x + b * y + c) for a, b, c in waves)
            values.append(MEAN * math.exp(math.sqrt(variance) * normal - variance / 2.0))
        print(" ".join(f"{value:.2f}" for value in values))


if __name__ == "__main__":
    main()
