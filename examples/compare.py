#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the result folder of an example with its closed form: a table to standard output, and a picture.

    compare.py pair   damped_pair.out     [--figure picture.png]
    compare.py beam   chain_beam.out      [--figure picture.png]
    compare.py string chain_catenary.out  [--figure picture.png]
    compare.py sphere sphere_on_plane.out [--figure picture.png]

pair: force on the held sphere against a damped oscillator. beam: sag of every node against the bonded chain. string:
shape and pull against the equilibrium of the links. sphere: force, displacement and radius of the contact against Hertz.
Tables need Python's own library, pictures matplotlib (python3-matplotlib).
"""
import argparse, csv, math, pathlib, sys


def table(path):
    """Columns by name."""
    with open(path) as f:
        rows = list(csv.reader(line for line in f if not line.startswith("#")))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def line_fit(x, y):
    """Slope, ordinate at 0, largest distance of y from the line of least squares."""
    n, mx, my = len(x), sum(x) / len(x), sum(y) / len(y)
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx)**2 for a in x)
    start = my - slope * mx
    return slope, start, max(abs(start + slope * a - b) for a, b in zip(x, y))


def draw(path, panels):
    """A panel: title, x label, y label, and curves of (label, x, y, style)."""
    if not path:
        return
    try:
        import matplotlib
    except ImportError:
        sys.exit("compare.py: --figure needs matplotlib (python3-matplotlib)")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, len(panels), figsize=(5.6 * len(panels), 4.2), squeeze=False)
    for ax, (title, x_label, y_label, curves) in zip(axes[0], panels):
        for label, x, y, style in curves:
            ax.plot(x, y, style, label=label, markersize=3.5, linewidth=1.6)
        ax.set(title=title, xlabel=x_label, ylabel=y_label)
        ax.grid(color="0.9")
        ax.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def pair(folder, figure):
    walls = table(folder / "walls.csv")
    K, m, zeta, x0, v0, release = 1e7, 1000.0, 0.3, 2e-3, 0.1, 0.02
    omega, c = math.sqrt(K / m), 2 * zeta * math.sqrt(K * m)
    w = omega * math.sqrt(1 - zeta * zeta)
    B = (v0 + zeta * omega * x0) / w

    def exact(t):
        e = math.exp(-zeta * omega * t)
        x = e * (x0 * math.cos(w * t) + B * math.sin(w * t))
        v = e * (B * w * math.cos(w * t) - x0 * w * math.sin(w * t)) - zeta * omega * x
        return K * x + c * v

    rows = [(t, f) for t, f in zip(walls["time_s"], walls["held_force_x_N"]) if t - release > 1e-4]
    times, forces = [r[0] for r in rows], [r[1] for r in rows]
    closed = [exact(t - release) for t in times]
    print("| | run | damped oscillator |\n|---|---|---|")
    print(f"| largest force (kN) | {max(walls['held_force_x_N']) / 1e3:.2f} | {exact(0) / 1e3:.2f} |")
    print(f"| most negative force (kN) | {min(forces) / 1e3:.3f} | {min(closed) / 1e3:.3f} |")
    print(f"| farthest, over K x0 | {max(abs(a - b) for a, b in zip(forces, closed)) / (K * x0):.2g} | |")
    draw(figure, [("Force on the held sphere", "time [s]", "force [kN]",
                   [("run", walls["time_s"], [f / 1e3 for f in walls["held_force_x_N"]], "C0-"),
                    ("damped oscillator", times[::8], [f / 1e3 for f in closed[::8]], "k.")])])


def beam(folder, figure):
    bodies = table(folder / "fragments.csv")
    E, h, L, q, r = 1e9, 2.0, 98.0, 1.0, 1.0
    EI, K_s = E * math.pi * r**4 / 4, E / h * math.pi * r * r
    nodes = sorted(zip((b - b0 for b, b0 in zip(bodies["id"], [min(bodies["id"])] * 50)), bodies["position_z_m"]))
    x, sag = [h * k for k, _ in nodes], [-z for _, z in nodes]
    euler = [q * s * (L**3 - 2 * L * s * s + s**3) / (24 * EI) for s in x]
    chain = [w - q * h * h * s * (L - s) / (12 * EI) + q * s * (L - s) / (2 * h * K_s) for w, s in zip(euler, x)]
    print("| | run | bonded chain | Euler and Bernoulli |\n|---|---|---|---|")
    print(f"| largest sag of a node (mm) | {1e3 * max(sag):.6f} | {1e3 * max(chain):.6f} | {1e3 * max(euler):.6f} |")
    print(f"| worst node, over the sag | {max(abs(a - b) for a, b in zip(sag, chain)) / max(chain):.2g} | | |")
    draw(figure, [("Beam", "x [m]", "deflection [mm]",
                   [("bonded chain, closed form", x, [-1e3 * w for w in chain], "k-"),
                    ("run", x, [-1e3 * w for w in sag], "C0o")]),
                  ("Difference from Euler and Bernoulli", "x [m]", "deflection less that of the beam [nm]",
                   [("bonded chain, closed form", x, [1e9 * (e - c) for e, c in zip(euler, chain)], "k-"),
                    ("run", x, [1e9 * (e - w) for e, w in zip(euler, sag)], "C0o")])])


def string(folder, figure):
    bodies, walls = table(folder / "fragments.csv"), table(folder / "walls.csv")
    n, P, h, K = 50, 2.0, 2.0, 5e5 * math.pi
    span = walls["right_position_x_m"][-1] - walls["left_position_x_m"][-1]
    across = [P * ((n - 2) / 2 - i) for i in range(n - 1)]  # of the links; n - 2 spheres hang

    def links(H):
        pulls = [math.hypot(H, V) for V in across]
        return [((h + T / K) * H / T, (h + T / K) * V / T) for T, V in zip(pulls, across)]

    low, high = 1e-3, 1e6
    for _ in range(200):
        H = math.sqrt(low * high)
        low, high = (H, high) if sum(dx for dx, _ in links(H)) < span else (low, H)
    x, z = [0.0], [0.0]
    for dx, dz in links(H):
        x.append(x[-1] + dx)
        z.append(z[-1] - dz)
    order = sorted(range(n), key=lambda k: bodies["id"][k])
    found_x, found_z = ([bodies[c][k] for k in order] for c in ("position_x_m", "position_z_m"))
    worst = max(math.hypot(a - c, b - d) for a, b, c, d in zip(found_x, found_z, x, z))
    print("| | run | equilibrium of the links |\n|---|---|---|")
    print(f"| pull along x (N) | {walls['left_force_x_N'][-1]:.6f} | {H:.6f} |")
    print(f"| force across (N) | {-walls['left_force_z_N'][-1]:.6f} | {across[0]:.6f} |")
    print(f"| sag (m) | {-min(found_z):.6f} | {-min(z):.6f} |")
    print(f"| worst node, over the span | {worst / span:.2g} | |")
    draw(figure, [("String", "x [m]", "z [m]", [("equilibrium of the links", x, z, "k-"), ("run", found_x, found_z, "C0o")])])


def sphere(folder, figure):
    walls = table(folder / "walls.csv")
    R, E, d, K_n = 20.0, 2 * math.sqrt(2) * 1e9, 1.0, 1e9
    start = [walls[f"top_position_{a}_m"][0] for a in "xyz"]
    way = [math.hypot(*(walls[f"top_position_{a}_m"][k] - s for a, s in zip("xyz", start)))
           for k in range(len(walls["time_s"]))]
    force = [math.hypot(*(walls[f"top_force_{a}_N"][k] for a in "xyz")) for k in range(len(way))]
    depth = [(3 * F / (4 * E * math.sqrt(R)))**(2 / 3) for F in force]
    radius = [math.sqrt(R * u) for u in depth]
    found = [a / math.sqrt(0.8) for a in walls["top_contact_radius_m"]]  # weighted by the pressure of Hertz
    used = [k for k in range(len(way)) if radius[k] >= 3 * d]
    load = [F**(2 / 3) for F in force]
    slope, at_0, off = line_fit([way[k] for k in used], [load[k] for k in used])
    begin, hertz = -at_0 / slope, (4 / 3 * E * math.sqrt(R))**(2 / 3)
    exponent = line_fit([math.log(way[k] - begin) for k in used], [math.log(force[k]) for k in used])[0]
    print("| displacement of a plate (m) | force (GN) | depth of Hertz (m) | a (m) | radius found (m) | contacts |")
    print("|---|---|---|---|---|---|")
    for wanted in (0.40, 0.755, 1.022, 1.289, 1.568):
        k = min(range(len(way)), key=lambda k: abs(way[k] - wanted))
        print(f"| {way[k]:.3f} | {force[k] / 1e9:.3g} | {depth[k]:.3f} | {radius[k]:.2f} | {found[k]:.2f} | "
              f"{walls['top_contacts'][k]:.0f} |")
    print("\n| from a = 3 d on | run | Hertz |\n|---|---|---|")
    print(f"| force^(2/3) over displacement (N^(2/3)/m) | {slope:.4g} | {hertz:.4g} ({slope / hertz - 1:+.1%}) |")
    print(f"| farthest from a straight line, over the largest | {off / max(load):.4f} | 0 |")
    print(f"| exponent of the force | {exponent:.3f} | 1.5 |")
    print(f"| beginning of the line (m) | {begin:.3f} | 0 |")
    for least in (3, 4, 5):
        errors = [found[k] / radius[k] - 1 for k in range(len(way)) if radius[k] >= least * d]
        print(f"| radius, from a = {least} d on | {min(errors):+.3f} to {max(errors):+.3f} | 0 |")
    last = max(way)
    draw(figure, [("Depth", "displacement of a plate [m]", "(force/largest)^(2/3)",
                   [("run", way, [f / max(load) for f in load], "C0-"),
                    ("slope of Hertz", [begin, last], [0, hertz * (last - begin) / max(load)], "k--")]),
                  ("Radius of the contact", "force [GN]", "radius [m]",
                   [("run", [f / 1e9 for f in force], found, "C0-"),
                    ("Hertz", [f / 1e9 for f in force], radius, "k--")])])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    examples = {"pair": pair, "beam": beam, "string": string, "sphere": sphere}
    parser.add_argument("example", choices=examples)
    parser.add_argument("result", type=pathlib.Path)
    parser.add_argument("--figure", help="picture to write (.png or .svg)")
    args = parser.parse_args()
    examples[args.example](args.result, args.figure)


if __name__ == "__main__":
    main()
