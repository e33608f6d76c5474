#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Force with which the plate pushes the chain, at several speeds, with moments in the links and without.

    fountain.py [--program grainfrac] [--out folder] [--speeds 20 40 60 80] [--figure picture.png]

R_x: force of the plate less the weight of the spheres that have not yet left it for good, in the mean while the end rises from
60 to 190 m. Third column: without moments, and spheres that do not knock against each other. The table needs h5py
(python3-h5py), the picture matplotlib (python3-matplotlib). Runs that the folder has are not made again.
"""
import argparse, bisect, math, pathlib, subprocess, sys

import h5py

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from compare import draw, line_fit, table

RADIUS, DENSITY, G = 1.0, 1000.0, 9.81
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
LAMBDA = MASS / (2 * RADIUS)
FROM, TO = 60.0, 190.0  # height of the end [m]
ON_PLATE = 0.02 * RADIUS  # above its place a sphere has left the plate [m]
STRING, CONTACTS = "chain_string", "[[contacts]]\n"
NO_KNOCKS = CONTACTS + 'between = ["chain", "chain"]\nnormal_stiffness = "1 Pa/m"\nfriction = 0.0\ndissipation = "none"\n\n'
NAMES = {"chain_fountain": "with moments", STRING: "without", "no_knocks": "without, no knocks"}


def run(args, example, speed):
    """Columns of walls.csv, and when each sphere leaves the plate for good."""
    out, case = pathlib.Path(args.out) / f"{example}_{speed:g}", pathlib.Path(args.out) / f"{example}.toml"
    text = (HERE / f"{example if example in ('chain_fountain', STRING) else STRING}.toml").read_text()
    case.write_text(text.replace(CONTACTS, NO_KNOCKS + CONTACTS) if example == "no_knocks" else text)
    if not (out / "summary.json").exists():
        lift = f'stages.lift.move=[{{wall="hand",velocity=[0,0,{speed:g}]}}]'
        subprocess.run([args.program, "run", str(case), "--out", str(out), "--force", "-q", "--no-report", "--threads", "1",
                        "--set", lift, "--set", 'output.every="20 ms"'], check=True, stdout=subprocess.DEVNULL)
    with h5py.File(out / "results.h5", "r") as results:
        times, height = results["snapshots/time"][:], results["snapshots/position"][:, :, 2]
    between = 0.5 * (times[2] - times[1])  # in the mean it leaves half-way to the next snapshot
    left = [max(t for t, z in zip(times, column) if z - column[0] < ON_PLATE) + between for column in height.T]
    return table(out / "walls.csv"), sorted(left)


def excess(walls, left):
    """Force of the plate less what rests on it, row by row."""
    return [-f - (len(left) - bisect.bisect_right(left, t)) * MASS * G
            for t, f in zip(walls["time_s"], walls["plate_force_z_N"])]


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
    runs = {example: [run(args, example, v) for v in args.speeds] for example in NAMES}
    force = {example: [mean_while_rising(w, excess(w, left)) for w, left in found] for example, found in runs.items()}
    momentum = [LAMBDA * v * v for v in args.speeds]
    print("| speed (m/s) | lambda v^2 (MN) | " + " | ".join(f"R_x {n} (MN)" for n in NAMES.values()) + " | " +
          " | ".join(f"{n}, over lambda v^2" for n in list(NAMES.values())[1:]) + " |")
    print("|" + 7 * "---|")
    for k, v in enumerate(args.speeds):
        print(f"| {v:g} | {momentum[k] / 1e6:.2f} | " + " | ".join(f"{force[e][k] / 1e6:.2f}" for e in NAMES) + " | "
              + " | ".join(f"{force[e][k] / momentum[k]:.3f}" for e in list(NAMES)[1:]) + " |")
    fits = {e: line_fit(momentum, force[e]) for e in NAMES}
    print("| slope over lambda v^2 | | " + " | ".join(f"{fits[e][0]:.3f}" for e in NAMES) + " | | |")
    print("| at rest, by the line (MN) | | " + " | ".join(f"{fits[e][1] / 1e6:.2f}" for e in NAMES) + " | | |")
    last = [0, max(momentum)]
    lines = []
    for e, style in zip(list(NAMES)[:2], "os"):
        lines += [(NAMES[e], [m / 1e6 for m in momentum], [f / 1e6 for f in force[e]], "C%d%s" % (len(lines) // 2, style)),
                  (f"slope {fits[e][0]:.3f}", [m / 1e6 for m in last], [(fits[e][1] + fits[e][0] * m) / 1e6 for m in last],
                   "C%d-" % (len(lines) // 2))]
    fastest = {e: runs[e][-1] for e in list(NAMES)[:2]}
    draw(args.figure, [("Push of the plate", "λ v² [MN]", "R_x [MN]", lines),
                       (f"At {args.speeds[-1]:g} m/s", "height of the end [m]", "R_x over λ v², mean of 20 m",
                        [(NAMES[e], *smooth(w, excess(w, left), momentum[-1]), "C%d-" % k)
                         for k, (e, (w, left)) in enumerate(fastest.items())])])


def smooth(walls, values, unit, window=20.0):
    """Heights, and the mean of the values within half of `window` of each."""
    z = walls["hand_position_z_m"]
    heights = [FROM + k for k in range(int(TO - FROM) + 1)]
    near = [[v for h, v in zip(z, values) if abs(h - at) <= window / 2] for at in heights]
    return heights, [sum(n) / len(n) / unit for n in near]


main()
