#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the pull-out studies and compares them with references. Python's own library only.

    study.py [--program grainfrac] [--out folder] [--threads N] [STUDY] [case ...]

elastic: shear of the interface and stress of the fibre before it yields, for each stiffness ratio, length, interface and
sphere size; root mean square difference over the range of the reference, at equal load. path: the whole path with spheres
of 1 and 0.5 m. lengths: the whole path of fibres of 5 to 50 m, a case is "length" (spheres of 1 m) or "length/diameter".
speed: peak at four speeds of the grip. friction: the path with friction of what is broken, and sliding to the end under
constant friction and under pressure. bonds: spring-dashpots against parallel bonds, a case is "diameter", "diameter/shear
ratio of the matrix" or "dressler": a fibre of spheres of the lattice and the bonds of Dressler (2020), table 4-1.
With --keep what a folder has is not run again. Tables go to standard output and to the folder.
"""
import argparse, json, math, pathlib, subprocess, sys, time

from references import (DATA, K0, closed_tail, elastic_turns, farthest, interpolated, nrmse, shear_lag_profile, table,
                        work_of)

HERE = pathlib.Path(__file__).resolve().parent

# name: E_m [Pa], L [m], K0 [Pa/m], d [m], Dressler (2020): tau, sigma_f
ELASTIC = {
    "1:10": (5e9, 30, K0, 0.5, "0.055", "0.036"), "10:1": (500e9, 30, K0, 0.5, "0.0048", "0.0733"),
    "1:1": (50e9, 30, K0, 0.5, "0.047", "0.0733"), "1:100": (0.5e9, 30, K0, 0.5, "0.111", "0.159"),
    "L=10": (5e9, 10, K0, 0.5, "", ""), "L=15": (5e9, 15, K0, 0.5, "0.05", "0.032"),
    "L=20": (5e9, 20, K0, 0.5, "0.05", "0.020"), "L=25": (5e9, 25, K0, 0.5, "0.045", "0.026"),
    "L=35": (5e9, 35, K0, 0.5, "", "0.038"), "L=40": (5e9, 40, K0, 0.5, "", "0.046"),
    "K0=1e7": (5e9, 30, 1e7, 0.5, "0.003", "0.004"), "K0=1e10": (5e9, 30, 1e10, 0.5, "0.108", "0.197"),
    "d=0.7": (5e9, 30, K0, 0.7, "0.0711", ""), "d=1": (5e9, 30, K0, 1.0, "0.0512", ""),
}
REFERENCE = {"1:10": "1:10 d=0.5", "d=0.7": "1:10 d=0.7", "d=1": "1:10 d=1"}  # names in elastic_cases.csv
LENGTHS = ("5/0.5", "8/0.5", "9/0.5", "10/0.5", "11/0.5", "12/0.5", "15", "20", "25", "30", "35", "40", "50")
# Of the input, where --set has no name for them: bonds have none.
INTERFACE, MORE_OF_INTERFACE, INSTEAD = "shear stiffness of the interface", "more of the interface", "texts for others"
PATH_SPHERES = (1.0, 0.5)
BOND_CASES = {"1": 0.01, "0.5": 0.08, "0.5/0.01": 0.08, "dressler": 0.08}  # damage_step
LAWS = ['between = ["matrix", "matrix"]\nlaw     = "parallel"', 'between = ["fibre", "fibre"]\nlaw     = "parallel"']
CHAIN = ('generator = "chain"', 'fibre     = { from = [0, 0, "-15 m"], to = [0, 0, "15 m"], radius = "1 m" }')
# Table 4-1, spheres of 0.5 m; patches along the lines of centres, all of one area; surface of a cylinder of 2 m.
DRESSLER_MATRIX, DRESSLER_FIBRE, DRESSLER_RATIO = 7.40e9, 7.40e10, 0.01
TAKEN = ('generator = "taken"', 'region    = { shape = "cylinder", diameter = "2 m", height = "40 m", axis = "z" }')
TURNS = (("peak_stress_Pa", 1e6), ("largest_exit_slip_m", 1e-3), ("stress_at_largest_slip_Pa", 1e6),
         ("largest_end_displacement_m", 1e-3), ("stress_at_largest_displacement_Pa", 1e6))
EXACT_TURNS = ("max_stress_Pa", "max_slip_m", "stress_at_max_slip_Pa", "max_displacement_m",
               "stress_at_max_displacement_Pa")
SPEEDS = (1.0, 0.1, 0.01, 0.001)
RESIDUAL, PRESSURE, FRICTION, CONTRACTION = 0.1e6, 1e6, 0.1, 0.0144928  # contraction: of the moduli, wide matrix
STATE = ("end_slip_m", "end_displacement_m", "end_stress_Pa", "mean_damage")


def run(args, name, settings):
    """Results of the input with these settings, and the time it took."""
    name = name.replace(":", "_").replace("=", "_")
    out, case = pathlib.Path(args.out) / name, pathlib.Path(args.out) / f"{name}.toml"
    text = (HERE / "pull_out_studies.toml").read_text()
    text = text.replace('"1e9 Pa/m"', f'"{settings.pop(INTERFACE)} Pa/m"' + settings.pop(MORE_OF_INTERFACE, ""))
    for old, new in settings.pop(INSTEAD, []):
        if text.count(old) == 0:
            sys.exit(f"pull_out_studies.toml has no {old}")
        text = text.replace(old, new, 1)
    case.write_text(text)
    command = [args.program, "run", str(case), "--out", str(out), "--force", "-q", "--threads", str(args.threads)]
    for key, value in settings.items():
        command += ["--set", f"{key}={json.dumps(value)}"]
    start = time.time()
    if not (args.keep and (out / "summary.json").exists()):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return out, time.time() - start


def settings_of(E_m, L, k, d):
    layer = math.sqrt(2 / 3) * d
    end = 0.5 * round(L / layer) * layer + 0.1 * d  # where the layers of the matrix end, and a little
    return {"materials.soft.young_modulus": E_m, "parts.matrix.region.height": L, "parts.matrix.diameter": d,
            "parts.fibre.diameter": 0.8 * d, "parts.fibre.fibre.from": [0, 0, -end], "parts.fibre.fibre.to": [0, 0, end],
            INTERFACE: k}


def elastic(args, say):
    references = {}
    for row in table(DATA / "elastic_cases.csv"):
        references.setdefault(row["case"], []).append([float(row[c]) for c in ("z_m", "tau_Pa", "sigma_f_Pa")])
    say("| case | bonds tau | levels tau | over its maximum | sigma_f | shear-lag: levels tau | sigma_f | its own error: tau "
        "| sigma_f | Dressler tau | sigma_f | s |")
    say("|" + 12 * "---|")
    for name in args.cases or ELASTIC:
        E_m, L, k, d, theirs_tau, theirs_sigma = ELASTIC[name]
        out, seconds = run(args, name, settings_of(E_m, L, k, d))
        test = json.loads((out / "summary.json").read_text())["test"]
        load, length = test["peak_stress_Pa"], test["embedded_length_m"]
        z, tau, sigma = zip(*references[REFERENCE.get(name, name)])
        if abs(length - z[-1]) > 1e-4 * length:
            sys.exit(f"{name}: the run has {length} m, the reference {z[-1]} m")
        scale = load / sigma[-1]
        rows = [[float(r[c]) for c in ("z_m", "tau_Pa", "sigma_f_Pa", "tau_spread_Pa")]
                for r in table(out / "profiles.csv") if float(r["mean_damage"]) == 0]
        range_tau = scale * (max(tau) - min(tau))
        sums = dict.fromkeys(("bond", "level", "sigma", "lag_tau", "lag_sigma", "own_tau", "own_sigma"), 0.0)
        lag_all = [shear_lag_profile(E_m, length, k, load, x) for x in z]
        range_lag = max(t for t, _ in lag_all) - min(t for t, _ in lag_all)
        for x, t, s, spread in rows:
            t_ref, s_ref = scale * interpolated(z, tau, x), scale * interpolated(z, sigma, x)
            t_lag, s_lag = shear_lag_profile(E_m, length, k, load, x)
            sums["bond"] += (t - t_ref)**2 + spread**2
            sums["level"] += (t - t_ref)**2
            sums["sigma"] += (s - s_ref)**2
            sums["lag_tau"] += (t - t_lag)**2 * (range_tau / range_lag)**2
            sums["lag_sigma"] += (s - s_lag)**2
            sums["own_tau"] += (t_lag - t_ref)**2
            sums["own_sigma"] += (s_lag - s_ref)**2
        over = {key: math.sqrt(v / len(rows)) / (load if key.endswith("sigma") else range_tau) for key, v in sums.items()}
        over_most = over["level"] * range_tau / (scale * max(tau))
        say(f"| {name} | {over['bond']:.4f} | {over['level']:.4f} | {over_most:.4f} | {over['sigma']:.4f} | {over['lag_tau']:.4f} | "
            f"{over['lag_sigma']:.4f} | {over['own_tau']:.4f} | {over['own_sigma']:.4f} | {theirs_tau} | {theirs_sigma} | "
            f"{seconds:.0f} |")


def states(file):
    return [[float(r[c]) for c in STATE] for r in table(file)]


def path(args, say):
    say("| d (m) | L (m) | peak (MPa) | largest slip (mm) | at (MPa) | largest displacement (mm) | at (MPa) | work over 2 G_c "
        "L/a | farthest from elasticity: slip | displacement | from mean damage 0.9 on | last stress over peak | states | s |")
    say("|" + 14 * "---|")
    for d in [float(c) for c in args.cases] or PATH_SPHERES:
        settings = settings_of(5e9, 30, K0, d)
        settings.update({"test.stop.time": 100000, "test.damage_step": 0.01})
        out, seconds = run(args, f"path_{d:g}", settings)
        test = json.loads((out / "summary.json").read_text())["test"]
        L = test["embedded_length_m"]
        rows, exact = states(out / "pull_out.csv"), states(DATA / f"elastic_path_{L:.2f}m.csv")
        slip, displacement = (farthest(rows, exact, k) for k in (0, 1))
        tail = farthest([r for r in rows if r[3] > 0.9], exact, 0)
        say(f"| {d:g} | {L:.3f} | " + " | ".join(f"{test[key] / unit:.4f}" for key, unit in TURNS)
            + f" | {test['work_J_per_m2'] / work_of(L):.5f} | {slip:.4f} | {displacement:.4f} | {tail:.4f} | "
            f"{rows[-1][2] / test['peak_stress_Pa']:.3f} | {len(rows)} | {seconds:.0f} |")
        own = elastic_turns(L)
        say(f"| elasticity | {L:.3f} | " + " | ".join(f"{own[key] / unit:.4f}" for key, (_, unit) in zip(EXACT_TURNS, TURNS))
            + " | 1" + 6 * " | " + " |")


def lengths(args, say):
    known = table(DATA / "max_stress_vs_length.csv")
    lag_lengths, lag_peaks = ([float(r[c]) for r in known] for c in ("L_m", "max_stress_Pa"))
    say("| L (m) | d (m) | in the run | peak (MPa) | over elasticity | over shear-lag, 1-D | largest slip (mm) | over elasticity "
        "| at the end (mm) | turns back | largest displacement (mm) | over elasticity | work over 2 G_c L/a | s |")
    say("|" + 14 * "---|")
    layer = math.sqrt(2 / 3)  # of spheres of 1 m: the references are for whole ones
    for case in args.cases or LENGTHS:
        L, _, d = case.partition("/")
        settings = settings_of(5e9, round(float(L) / layer) * layer, K0, float(d or 1))
        settings.update({"test.stop.time": 100000, "test.damage_step": 0.01})
        out, seconds = run(args, f"length_{L}" + (f"_{d}" if d else ""), settings)
        test = json.loads((out / "summary.json").read_text())["test"]
        # what hardly holds any more is not found exactly
        slips = [float(r["end_slip_m"]) for r in table(out / "pull_out.csv")
                 if float(r["end_stress_Pa"]) > 0.02 * test["peak_stress_Pa"]]
        most, last = max(slips), slips[-1]
        peak, length, shift = test["peak_stress_Pa"], test["embedded_length_m"], test["largest_end_displacement_m"]
        lag, own = interpolated(lag_lengths, lag_peaks, length), elastic_turns(length)
        say(f"| {L} | {d or 1} | {length:.3f} | {peak / 1e6:.3f} | {peak / own['max_stress_Pa']:.4f} | {peak / lag:.4f} | "
            f"{1e3 * most:.3f} | {most / own['max_slip_m']:.4f} | {1e3 * last:.3f} | "
            f"{'yes' if most > 1.005 * last else 'no'} | {1e3 * shift:.3f} | "
            f"{shift / own['max_displacement_m']:.4f} | {test['work_J_per_m2'] / work_of(length):.5f} | {seconds:.0f} |")


def speed(args, say):
    say("| speed (m/s) | peak (MPa) | inertia, rho c v (MPa) | imbalance, most to the peak | at the peak | kinetic over "
        "elastic | quasi-static | s |")
    say("|---|---|---|---|---|---|---|---|")
    for v in [float(c) for c in args.cases] or SPEEDS:
        settings = settings_of(5e9, 30, K0, 1.0)
        settings.update({"test.control": "speed", "test.platen_speed": v, "test.stop.time": 0.02 / v + 0.1,
                         "test.stop.load_drop": 0.005})
        out, seconds = run(args, f"speed_{v:g}", settings)
        summary = json.loads((out / "summary.json").read_text())
        test, rest = summary["test"], summary["quasi_static"]
        say(f"| {v:g} | {test['peak_stress_Pa'] / 1e6:.4f} | {test['inertia_stress_Pa'] / 1e6:.4f} | "
            f"{test['largest_imbalance_to_peak']:.4f} | {rest['platen_imbalance_at_peak']:.4f} | "
            f"{rest['kinetic_over_elastic_to_peak']:.2g} | {'yes' if rest['fulfilled'] else 'no'} | "
            f"{seconds:.0f} |")


def friction(args, say):
    cases = args.cases or ["path", "constant", "pressure"]
    if "path" in cases:
        friction_path(args, say)
    tails = {"constant": f"residual_shear = {RESIDUAL}",
             "pressure": f"radial_pressure = {PRESSURE}\nfriction = {FRICTION}\nresidual_friction = {FRICTION}\n"
                         f"contraction = {CONTRACTION}"}
    say("\n| sliding | L (m) | states | stress at a slip of 1 m (MPa) | closed form | root mean square difference over the "
        "largest | s |")
    say("|" + 7 * "---|")
    for name in [c for c in cases if c in tails]:
        settings = settings_of(5e9, 30, K0, 1.0)
        settings.update({"test.stop.time": 100000, "test.damage_step": 0.2, "test.stop.slip": 29, "test.slide_step": 0.5,
                         MORE_OF_INTERFACE: "\nnormal_stiffness = 1e9\n" + tails[name]})
        out, seconds = run(args, f"friction_{name}", settings)
        L = json.loads((out / "summary.json").read_text())["test"]["embedded_length_m"]
        law = (RESIDUAL,) if name == "constant" else (0.0, PRESSURE, FRICTION, CONTRACTION)
        rows = [(float(r["embedded_slip_m"]), float(r["end_stress_Pa"])) for r in table(out / "pull_out.csv")]
        tail = [(s, stress, closed_tail(L, s, *law)) for s, stress in rows if s > 0.5]
        off = nrmse(((found, exact) for _, found, exact in tail), closed_tail(L, 0.0, *law))
        s, found, exact = min(tail, key=lambda r: abs(r[0] - 1))
        say(f"| {name} | {L:.3f} | {len(tail)} | {found / 1e6:.4f} | {exact / 1e6:.4f} | {off:.4f} | {seconds:.0f} |")


def friction_path(args, say):
    """At equal mean damage, over the range of the reference."""
    settings = settings_of(5e9, 30, K0, 1.0)
    settings.update({"test.stop.time": 100000, "test.damage_step": 0.01,
                     MORE_OF_INTERFACE: f"\nresidual_shear = {RESIDUAL}"})
    out, seconds = run(args, "friction_path", settings)
    L = json.loads((out / "summary.json").read_text())["test"]["embedded_length_m"]
    rows = states(out / "pull_out.csv")
    say(f"| against, L = {L:.3f} m | peak (MPa) | largest slip (mm) | largest displacement (mm) | stress | slip | displacement "
        "| farthest: slip | displacement | s |")
    say("|" + 10 * "---|")
    turns = [max(r[k] for r in rows) for k in (2, 0, 1)]
    say(f"| the run | {turns[0] / 1e6:.3f} | {1e3 * turns[1]:.3f} | {1e3 * turns[2]:.3f} | | | | | | {seconds:.0f} |")
    for name, file in (("elasticity", "elastic"), ("shear-lag", "shear_lag")):
        exact = states(DATA / f"{file}_path_friction_{L:.2f}m.csv")
        damage = [r[3] for r in exact]
        differences = []
        for k in (2, 0, 1):
            column = [r[k] for r in exact]
            differences.append(nrmse(((r[k], interpolated(damage, column, r[3])) for r in rows
                                      if 0 < r[3] < damage[-1]), max(column) - min(column)))
        own = [max(r[k] for r in exact) for k in (2, 0, 1)]
        far = [farthest([r for r in rows if r[3] < damage[-1]], exact, k) for k in (0, 1)]
        say(f"| {name} | {own[0] / 1e6:.3f} ({turns[0] / own[0] - 1:+.1%}) | {1e3 * own[1]:.3f} ({turns[1] / own[1] - 1:+.1%}) | "
            f"{1e3 * own[2]:.3f} ({turns[2] / own[2] - 1:+.1%}) | " + " | ".join(f"{x:.4f}" for x in differences + far) + " | |")


def bond_settings(case, law):
    """With this law in the matrix; of Dressler in the fibre too."""
    d, _, ratio = case.replace("dressler", "0.5").partition("/")
    settings = settings_of(5e9, 30, K0, float(d))
    told = [text.replace('"parallel"', f'"{law}"') for text in LAWS]
    settings[INSTEAD] = [(LAWS[0], told[0] + (f"\nshear_ratio = {ratio}" if ratio else ""))]
    if case == "dressler":
        for key in [k for k in settings if k.startswith("parts.fibre.")]:
            settings.pop(key)
        own = [f"{text}\nnormal_stiffness = {k}\nshear_ratio = {DRESSLER_RATIO}"
               for text, k in zip(told, (DRESSLER_MATRIX, DRESSLER_FIBRE))]
        settings[INSTEAD] = [*zip(LAWS, own), *zip(CHAIN, TAKEN), ('diameter  = "0.4 m"\n', "")]
        settings[MORE_OF_INTERFACE] = '\nframe = "branch"\nreach = "all"'
    return settings


def bonds(args, say):
    """Profiles of spring-dashpots over the range and the largest value of those of parallel bonds; without damage at equal load."""
    say("| case | mean damage: parallel | spring-dashpot | tau, over the range | over the largest | sigma_f, over the range | over "
        "the largest | tau without the outermost layers, over the range | s |")
    say("|" + 9 * "---|")
    tests = []
    for case in args.cases or BOND_CASES:
        found, took = [], 0.0
        for law in ("parallel", "spring"):
            settings = bond_settings(case, law)
            settings.update({"test.stop.time": 100000, "test.damage_step": BOND_CASES.get(case, 0.08)})
            if case != "1":
                settings["test.stop.damage"] = 0.82  # where Dressler stops
            out, seconds = run(args, f"bonds_{law}_{case}".replace("/", "_"), settings)
            took += seconds
            profiles = {}
            for r in table(out / "profiles.csv"):
                profiles.setdefault(float(r["mean_damage"]), []).append((float(r["tau_Pa"]), float(r["sigma_f_Pa"])))
            found.append(profiles)
            tests.append((case, law, json.loads((out / "summary.json").read_text())["test"]))
        for (damage, ours), (other_damage, theirs) in zip(found[0].items(), found[1].items()):
            scale = ours[-1][1] / theirs[-1][1] if damage == 0 else 1.0
            columns = [([r[k] for r in ours], [scale * r[k] for r in theirs]) for k in (0, 1)]
            spans = [(max(here) - min(here), max(here)) for here, _ in columns]
            cells = [nrmse(zip(there, here), span) for (here, there), both in zip(columns, spans) for span in both]
            cells.append(nrmse(list(zip(columns[0][1], columns[0][0]))[1:-1], spans[0][0]))
            say(f"| {case} | {damage:.3f} | {other_damage:.3f} | " + " | ".join(f"{x:.4f}" for x in cells) + f" | {took:.0f} |")
    say("\n| case | bonds | " + " | ".join(key for key, _ in TURNS) + " |")
    say("|" + 7 * "---|")
    for case, law, test in tests:
        say(f"| {case} | {law} | " + " | ".join(f"{test[key] / unit:.4f}" for key, unit in TURNS) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="grainfrac")
    parser.add_argument("--out", default="pull_out_studies.out")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--keep", action="store_true")
    studies = {"elastic": elastic, "path": path, "lengths": lengths, "speed": speed, "friction": friction, "bonds": bonds}
    parser.add_argument("study", nargs="?", choices=studies, default="elastic", metavar="STUDY",
                        help=", ".join(studies))
    parser.add_argument("cases", nargs="*")
    args = parser.parse_args()
    pathlib.Path(args.out).mkdir(parents=True, exist_ok=True)
    with open(pathlib.Path(args.out) / f"{args.study}.md", "a") as file:
        def say(line):
            print(line, flush=True)
            file.write(line + "\n")
            file.flush()
        studies[args.study](args, say)


main()
