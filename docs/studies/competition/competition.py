#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundary or grain: share of broken area that runs through grains, over the ratio of the fracture energies.

    docs/studies/competition/competition.py run PROGRAM    runs competition.toml, writes competition.csv and the figure
    docs/studies/competition/competition.py draw           draws the figure from competition.csv

PROGRAM is grainfrac, e.g. build/release/bin/grainfrac. Nothing beyond Python's own library is needed.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TABLE = HERE / "competition.csv"
FIGURE = HERE.parents[1] / "images" / "competition.svg"
RATIOS = (0.3, 0.4, 0.5, 0.56, 0.65, 0.8, 1.0, 1.2)
SEEDS = (1, 2, 3)
# Of the grain's plane, as in competition.toml.
ENERGY, STRENGTH = 60.0, 165e6
THEORY = math.cos(math.radians(30)) ** 4
# A straight crack passes an upright boundary of edge r after each grain of height 2 r.
STRAIGHT = 2 / 3


def run_one(program, folder, ratio, seed):
    strength, energy = STRENGTH * math.sqrt(ratio), ENERGY * ratio
    values = {"simulation.seed": seed, "bonds[0].tensile_strength": strength, "bonds[0].cohesion": strength,
              "bonds[0].fracture_energy_I": energy, "bonds[0].fracture_energy_II": energy}
    out = folder / f"{ratio}_{seed}"
    settings = [part for key, value in values.items() for part in ("--set", f"{key}={value}")]
    subprocess.run([program, "run", HERE / "competition.toml", "--out", out, "-q", "--no-report", "--threads", "1"] + settings,
                   check=True)
    summary = json.loads((out / "summary.json").read_text())
    cracks = summary["cracks"]
    through = cracks["transgranular"]["area_m2"]
    between = sum(kind["area_m2"] for name, kind in cracks.items() if name.startswith("intergranular"))
    return {"ratio": ratio, "seed": seed, "transgranular_m2": f"{through:.6g}", "intergranular_m2": f"{between:.6g}",
            "share": f"{through / (through + between):.4f}", "splits": summary["splits"]["number"],
            "peak_load_N": f"{summary['test']['peak_load_N']:.5g}",
            "energy_error": f"{summary['energy']['largest_relative_error']:.2g}"}


def run(program):
    program = pathlib.Path(program).resolve()
    with tempfile.TemporaryDirectory() as folder, open(TABLE, "w", newline="") as out:
        writer = None
        for ratio in RATIOS:
            for seed in SEEDS:
                row = run_one(program, pathlib.Path(folder), ratio, seed)
                if writer is None:
                    writer = csv.DictWriter(out, row.keys(), lineterminator="\n")
                    writer.writeheader()
                writer.writerow(row)
                out.flush()
                print(*row.values(), flush=True)


def draw():
    with open(TABLE) as table:
        rows = [(float(row["ratio"]), float(row["share"])) for row in csv.DictReader(table)]
    left, top, width, height, last = 70, 20, 460, 260, 1.3

    def x(ratio):
        return left + width * (ratio - 0.2) / (last - 0.2)

    def y(share):
        return top + height * (1 - share / 0.8)

    def line(x0, y0, x1, y1, style):
        return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" {style}/>'

    def text(at_x, at_y, what, anchor="middle", more=""):
        return f'<text x="{at_x:.1f}" y="{at_y:.1f}" text-anchor="{anchor}" {more}>{what}</text>'

    svg = ['<svg xmlns="http://www.w3.org/2000/svg" width="560" height="340" font-family="DejaVu Sans, sans-serif" '
           'font-size="12">', '<rect width="560" height="340" fill="white"/>',
           f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="black"/>']
    for tick in (0.2, 0.4, 0.6, 0.8, 1.0, 1.2):
        svg += [line(x(tick), top + height, x(tick), top + height + 5, 'stroke="black"'),
                text(x(tick), top + height + 19, f"{tick:g}")]
    for tick in (0, 0.2, 0.4, 0.6, 0.8):
        svg += [line(left - 5, y(tick), left, y(tick), 'stroke="black"'), text(left - 9, y(tick) + 4, f"{tick:g}", "end")]
    dashed = 'stroke="#b03030" stroke-dasharray="6 4"'
    svg += [line(x(THEORY), top, x(THEORY), top + height, dashed),
            text(x(THEORY) + 6, top + height - 10, f"cos⁴ 30° = {THEORY:.4f}", "start", 'fill="#b03030"'),
            line(left, y(STRAIGHT), left + width, y(STRAIGHT), 'stroke="grey" stroke-dasharray="2 3"'),
            text(left + 8, y(STRAIGHT) - 6, "straight path: 2/3", "start", 'fill="grey"')]
    ratios = sorted({ratio for ratio, _ in rows})
    means = [sum(s for q, s in rows if q == ratio) / sum(q == ratio for q, _ in rows) for ratio in ratios]
    path = " ".join(f"{x(q):.1f},{y(m):.1f}" for q, m in zip(ratios, means))
    svg.append(f'<polyline points="{path}" fill="none" stroke="#2050a0" stroke-width="1.5"/>')
    svg += [f'<circle cx="{x(q):.1f}" cy="{y(s):.1f}" r="4" fill="none" stroke="#2050a0"/>' for q, s in rows]
    svg += [text(left + width / 2, top + height + 42, "fracture energy of the boundaries over that of the grain's plane"),
            text(0, 0, "share of broken area through grains", "middle", f'transform="translate(22 {top + height / 2}) rotate(-90)"'),
            "</svg>"]
    FIGURE.write_text("\n".join(svg) + "\n")


def main():
    if sys.argv[1:] == ["draw"]:
        draw()
    elif len(sys.argv) == 3 and sys.argv[1] == "run":
        run(sys.argv[2])
        draw()
    else:
        sys.exit(__doc__)


main()
