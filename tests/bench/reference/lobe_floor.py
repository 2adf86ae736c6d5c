#!/usr/bin/env python3
"""Mean illuminances of far wall and ceiling in examples/04-shine/lobe.zone.toml by quadrature, without DIM.

The spotlight's light meets the floor and goes on by k_s F D G / (4 cos(i) cos(r)), equation (11), F constant, Gaussian
facets, V-cavities; all else is black. Sums over equal parts of the floor for equal places on wall and ceiling, at the
exact angles; the opening counts as a point. What the spotlight sends there itself is not included: 2.91 and 1.12 lx.

Usage: lobe_floor.py [M ...]      roughnesses, 0.05 0.1 0.2 0.4 unless said; a minute each
"""
import math
import os
import sys

IES = os.path.join(os.path.dirname(__file__), "../../../db/fittings/track-spot-1200.ies")
SPOT, AIM = (2.0, 0.6, 2.6), (0.0, math.sqrt(0.5), -math.sqrt(0.5))
WIDTH, LENGTH, HEIGHT = 4.0, 5.0, 2.7
KS_F = 0.4


def candelas():
    """Intensities at gamma = 0, 1, ... 90 degrees."""
    words = open(IES).read().split("TILT=NONE")[1].split()
    values = [float(w) for w in words[13:]]
    gamma, cd = values[:91], values[92:183]
    assert gamma == [float(i) for i in range(91)] and len(cd) == 91
    return cd


def intensity(cd, cos_gamma):
    gamma = math.degrees(math.acos(max(-1.0, min(1.0, cos_gamma))))
    i = int(gamma)
    return 0.0 if i >= 90 else cd[i] + (gamma - i) * (cd[i + 1] - cd[i])


def normalised(m, n=20000):
    step = math.pi / 2 / n
    tilts = ((i + 0.5) * step for i in range(n))
    return 1.0 / sum(2 * math.pi * step * math.exp(-((d / m) ** 2)) * math.cos(d) * math.sin(d) for d in tilts)


def lit_floor(cd, n):
    """Parts of the floor: x, y, direction to the light, illuminance times area."""
    parts = []
    for i in range(n):
        for j in range(n):
            x, y = (i + 0.5) * WIDTH / n, (j + 0.5) * LENGTH / n
            to = (SPOT[0] - x, SPOT[1] - y, SPOT[2])
            r = math.sqrt(sum(c * c for c in to))
            to = tuple(c / r for c in to)
            cd_here = intensity(cd, -sum(a * b for a, b in zip(AIM, to)))
            parts.append((x, y, to, cd_here * to[2] / r**2 * WIDTH * LENGTH / n**2))
    return parts


def illuminance(parts, place, normal, m, c1):
    total = 0.0
    for x, y, to, lm in parts:
        out = (place[0] - x, place[1] - y, place[2])
        q = math.sqrt(sum(c * c for c in out))
        out = tuple(c / q for c in out)
        half = tuple(a + b for a, b in zip(to, out))
        length = math.sqrt(sum(c * c for c in half))
        cos_tilt, facing = half[2] / length, length / 2
        tilt = math.acos(min(1.0, cos_tilt))
        if tilt > 6 * m:
            continue
        cavity = min(1.0, 2 * cos_tilt * min(to[2], out[2]) / facing)
        lobe = KS_F * c1 * math.exp(-((tilt / m) ** 2)) * cavity / (4 * to[2] * out[2])
        total += lm * lobe * out[2] * -sum(a * b for a, b in zip(out, normal)) / q**2
    return total


def main():
    cd = candelas()
    wall = [((i + 0.5) * 0.2, LENGTH, (j + 0.5) * HEIGHT / 12) for i in range(10) for j in range(12)]
    ceiling = [((i + 0.5) * 0.25, (j + 0.5) * 0.25, HEIGHT) for i in range(8) for j in range(20)]
    for m in [float(a) for a in sys.argv[1:]] or [0.05, 0.1, 0.2, 0.4]:
        parts, c1 = lit_floor(cd, 220 if m < 0.2 else 120), normalised(m)
        means = [sum(illuminance(parts, p, n, m, c1) for p in places) / len(places)
                 for places, n in ((wall, (0, -1, 0)), (ceiling, (0, 0, -1)))]
        print(f"m {m}: far wall {means[0]:.3f} lx, ceiling {means[1]:.3f} lx")


main()
