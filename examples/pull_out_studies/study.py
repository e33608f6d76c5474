#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the pull-out studies and compares them with references. Python's own library only.

    study.py [--program grainfrac] [--out folder] [--threads N] [elastic | path | lengths | speed] [case ...]

elastic: shear of the interface and stress of the fibre before it yields, for each stiffness ratio, length, interface and
sphere size; root mean square difference over the range of the reference, at equal load. path: the whole path with spheres
of 1 and 0.5 m. lengths: the whole path of fibres of 5 to 50 m with spheres of 1 m. speed: peak at four speeds of the grip.
With --keep what a folder has is not run again. Tables go to standard output and to the folder.
"""
import argparse, bisect, csv, json, math, pathlib, subprocess, sys, time

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parent.parent / "tests" / "data" / "fibre"
A, B, E_F, NU_F, NU_M, K0, YIELD, FAILURE = 1.0, 6.0, 50e9, 0.2, 0.3, 1e9, 1e-3, 3e-3

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
LENGTHS = (5, 8, 9, 10, 11, 12, 15, 20, 25, 30, 35, 40, 50)
INTERFACE = "shear stiffness of the interface"
PATH_SPHERES = (1.0, 0.5)
TURNS = (("peak_stress_Pa", 1e6), ("largest_exit_slip_m", 1e-3), ("stress_at_largest_slip_Pa", 1e6),
         ("largest_end_displacement_m", 1e-3), ("stress_at_largest_displacement_Pa", 1e6))
EXACT_TURNS = ("max_stress_Pa", "max_slip_m", "stress_at_max_slip_Pa", "max_displacement_m",
               "stress_at_max_displacement_Pa")
SPEEDS = (1.0, 0.1, 0.01, 0.001)


def shear_lag(E_m, L, k):
    """alpha, gamma of the closed form with the interface in series; Nairn (1997), as in Dressler (2020)."""
    V = A * A / (B * B - A * A)
    G_f, G_m = E_F / (2 * (1 + NU_F)), E_m / (2 * (1 + NU_M))
    c_m = A / (B * B - A * A) * (B**4 * math.log(B / A) / (B * B - A * A) - (3 * B * B - A * A) / 4)
    C = 1 / k + A / 4 / G_f + c_m / G_m
    c = 2 / A * (1 / E_F + V / E_m)
    return math.sqrt(A * A * c / C), V * E_F / (E_m + V * E_F)


def shear_lag_profile(E_m, L, k, load, z):
    """tau, sigma_f [Pa] at z from the embedded end, free there, under `load` [Pa]."""
    alpha, gamma = shear_lag(E_m, L, k)
    q, S = alpha / A, math.sinh(alpha * L / A)
    tau = load * alpha / 2 * (gamma * math.cosh(q * (L - z)) + (1 - gamma) * math.cosh(q * z)) / S
    sigma = load * (gamma + ((1 - gamma) * math.sinh(q * z) - gamma * math.sinh(q * (L - z))) / S)
    return tau, sigma


def table(path):
    with open(path) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def interpolated(x, y, at):
    k = min(max(bisect.bisect_right(x, at), 1), len(x) - 1)
    return y[k - 1] + (at - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1])


def run(args, name, settings):
    """Results of the input with these settings, and the time it took; bonds have no name that --set could use."""
    name = name.replace(":", "_").replace("=", "_")
    out, case = pathlib.Path(args.out) / name, pathlib.Path(args.out) / f"{name}.toml"
    text = (HERE / "pull_out_studies.toml").read_text()
    case.write_text(text.replace('"1e9 Pa/m"', f'"{settings.pop(INTERFACE)} Pa/m"'))
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
    say("| case | bonds tau | levels tau | sigma_f | shear-lag: levels tau | sigma_f | its own error: tau | sigma_f "
        "| Dressler tau | sigma_f | s |")
    say("|---|---|---|---|---|---|---|---|---|---|---|")
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
        say(f"| {name} | {over['bond']:.4f} | {over['level']:.4f} | {over['sigma']:.4f} | {over['lag_tau']:.4f} | "
            f"{over['lag_sigma']:.4f} | {over['own_tau']:.4f} | {over['own_sigma']:.4f} | {theirs_tau} | {theirs_sigma} | "
            f"{seconds:.0f} |")


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
        columns = ("end_slip_m", "end_displacement_m", "end_stress_Pa", "mean_damage")
        rows = [[float(r[c]) for c in columns] for r in table(out / "pull_out.csv")]
        exact = [[float(r[c]) for c in columns] for r in table(DATA / f"elastic_path_{L:.2f}m.csv")]
        slip, displacement = (farthest(rows, exact, k) for k in (0, 1))
        tail = farthest([r for r in rows if r[3] > 0.9], exact, 0)
        say(f"| {d:g} | {L:.3f} | " + " | ".join(f"{test[key] / unit:.4f}" for key, unit in TURNS)
            + f" | {test['work_J_per_m2'] / work_of(L):.5f} | {slip:.4f} | {displacement:.4f} | {tail:.4f} | "
            f"{rows[-1][2] / test['peak_stress_Pa']:.3f} | {len(rows)} | {seconds:.0f} |")
        own = elastic_turns(L)
        say(f"| elasticity | {L:.3f} | " + " | ".join(f"{own[key] / unit:.4f}" for key, (_, unit) in zip(EXACT_TURNS, TURNS))
            + " | 1" + 6 * " | " + " |")


def work_of(L):
    return 2 * 0.5 * K0 * YIELD * FAILURE * L / A


def elastic_turns(L):
    """Turning points of elasticity at the length nearest to L."""
    rows = [{k: float(v) for k, v in r.items()} for r in table(DATA / "elastic_lengths.csv")]
    return min(rows, key=lambda r: abs(r["L_m"] - L))


def farthest(rows, exact, k):
    """Of the states from the curve in (column k, stress), each over its largest value."""
    x, y = max(r[k] for r in exact), max(r[2] for r in exact)
    return max(min(to_segment(r[k] / x, r[2] / y, p[k] / x, p[2] / y, q[k] / x, q[2] / y)
                   for p, q in zip(exact, exact[1:])) for r in rows)


def to_segment(x, y, x0, y0, x1, y1):
    n = (x1 - x0)**2 + (y1 - y0)**2
    t = min(1.0, max(0.0, ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / n)) if n > 0 else 0.0
    return math.hypot(x - x0 - t * (x1 - x0), y - y0 - t * (y1 - y0))


def lengths(args, say):
    known = table(DATA / "max_stress_vs_length.csv")
    lag_lengths, lag_peaks = ([float(r[c]) for r in known] for c in ("L_m", "max_stress_Pa"))
    say("| L (m) | in the run | peak (MPa) | over elasticity | over shear-lag, 1-D | largest slip (mm) | over elasticity "
        "| at the end (mm) | turns back | largest displacement (mm) | over elasticity | work over 2 G_c L/a | s |")
    say("|" + 13 * "---|")
    for L in [int(c) for c in args.cases] or LENGTHS:
        settings = settings_of(5e9, L, K0, 1.0)
        settings.update({"test.stop.time": 100000, "test.damage_step": 0.01})
        out, seconds = run(args, f"length_{L}", settings)
        test = json.loads((out / "summary.json").read_text())["test"]
        # what hardly holds any more is not found exactly
        slips = [float(r["end_slip_m"]) for r in table(out / "pull_out.csv")
                 if float(r["end_stress_Pa"]) > 0.02 * test["peak_stress_Pa"]]
        most, last = max(slips), slips[-1]
        peak, length, shift = test["peak_stress_Pa"], test["embedded_length_m"], test["largest_end_displacement_m"]
        lag, own = interpolated(lag_lengths, lag_peaks, length), elastic_turns(length)
        say(f"| {L} | {length:.3f} | {peak / 1e6:.3f} | {peak / own['max_stress_Pa']:.4f} | {peak / lag:.4f} | "
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="grainfrac")
    parser.add_argument("--out", default="pull_out_studies.out")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--keep", action="store_true")
    studies = {"elastic": elastic, "path": path, "lengths": lengths, "speed": speed}
    parser.add_argument("study", nargs="?", choices=studies, default="elastic")
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
