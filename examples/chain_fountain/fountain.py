#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Force with which the plate pushes the chain, at several speeds, with moments in the links and without.

    fountain.py [--program grainfrac] [--out folder] [--speeds 20 40 60 80] [--figure picture.png]

R_x: force of the plate less the weight of the spheres that press on it, in the mean while the end rises from 60 to 190 m.
The table needs Python's own library, the picture matplotlib (python3-matplotlib). Runs that the folder has are not made
again.
"""
import argparse, math, pathlib, subprocess, sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from compare import draw, line_fit, table

RADIUS, DENSITY, G = 1.0, 1000.0, 9.81
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
LAMBDA = MASS / (2 * RADIUS)
FROM, TO = 60.0, 190.0  # height of the end [m]


def walls_of(args, example, speed):
    out = pathlib.Path(args.out) / f"{example}_{speed:g}"
    if not (out / "summary.json").exists():
        lift = f'stages.lift.move=[{{wall="hand",velocity=[0,0,{speed:g}]}}]'
        subprocess.run([args.program, "run", str(HERE / f"{example}.toml"), "--out", str(out), "--force", "-q",
                        "--threads", "1", "--set", lift], check=True, stdout=subprocess.DEVNULL)
    return table(out / "walls.csv")


def excess(walls):
    """Force of the plate less what rests on it, row by row."""
    return [-f - n * MASS * G for f, n in zip(walls["plate_force_z_N"], walls["plate_contacts"])]


def mean_while_rising(walls, values):
    used = [v for z, v in zip(walls["hand_position_z_m"], values) if FROM <= z <= TO]
    return sum(used) / len(used)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="grainfrac")
    parser.add_argument("--out", default="chain_fountain.speeds")
    parser.add_argument("--speeds", type=float, nargs="+", default=[20.0, 40.0, 60.0, 80.0])
    parser.add_argument("--figure", help="picture to write (.png or .svg)")
    args = parser.parse_args()
    if len(args.speeds) < 2:
        parser.error("--speeds: a slope needs two")
    pathlib.Path(args.out).mkdir(parents=True, exist_ok=True)
    names = {"chain_fountain": "with moments", "chain_string": "without"}
    runs = {example: [walls_of(args, example, v) for v in args.speeds] for example in names}
    force = {example: [mean_while_rising(w, excess(w)) for w in walls] for example, walls in runs.items()}
    momentum = [LAMBDA * v * v for v in args.speeds]
    print("| speed (m/s) | lambda v^2 (MN) | " + " | ".join(f"R_x {n} (MN)" for n in names.values()) + " |")
    print("|---|---|---|---|")
    for k, v in enumerate(args.speeds):
        print(f"| {v:g} | {momentum[k] / 1e6:.2f} | " + " | ".join(f"{force[e][k] / 1e6:.2f}" for e in names) + " |")
    fits = {e: line_fit(momentum, force[e]) for e in names}
    print("| slope over lambda v^2 | | " + " | ".join(f"{fits[e][0]:.3f}" for e in names) + " |")
    print("| at rest, by the line (MN) | | " + " | ".join(f"{fits[e][1] / 1e6:.2f}" for e in names) + " |")
    last = [0, max(momentum)]
    lines = []
    for e, style in zip(names, "os"):
        lines += [(names[e], [m / 1e6 for m in momentum], [f / 1e6 for f in force[e]], "C%d%s" % (len(lines) // 2, style)),
                  (f"slope {fits[e][0]:.3f}", [m / 1e6 for m in last], [(fits[e][1] + fits[e][0] * m) / 1e6 for m in last],
                   "C%d-" % (len(lines) // 2))]
    fastest = {e: runs[e][-1] for e in names}
    draw(args.figure, [("Push of the plate", "λ v² [MN]", "R_x [MN]", lines),
                       (f"At {args.speeds[-1]:g} m/s", "height of the end [m]", "R_x over λ v², mean of 20 m",
                        [(names[e], *smooth(w, excess(w), momentum[-1]), "C%d-" % k)
                         for k, (e, w) in enumerate(fastest.items())])])


def smooth(walls, values, unit, window=20.0):
    """Heights, and the mean of the values within half of `window` of each."""
    z = walls["hand_position_z_m"]
    heights = [FROM + k for k in range(int(TO - FROM) + 1)]
    near = [[v for h, v in zip(z, values) if abs(h - at) <= window / 2] for at in heights]
    return heights, [sum(n) / len(n) / unit for n in near]


main()
