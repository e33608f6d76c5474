# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms and computed curves that study.py compares with."""
import bisect, csv, math, pathlib

DATA = pathlib.Path(__file__).resolve().parent.parent.parent / "tests" / "data" / "fibre"
A, B, E_F, NU_F, NU_M, K0, YIELD, FAILURE = 1.0, 6.0, 50e9, 0.2, 0.3, 1e9, 1e-3, 3e-3


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


def nrmse(pairs, span):
    """Root mean square difference of pairs over `span`."""
    pairs = list(pairs)
    return math.sqrt(sum((a - b)**2 for a, b in pairs) / len(pairs)) / span


def closed_tail(L, s, residual, pressure=0.0, friction=0.0, contraction=0.0):
    """Stress of a fibre that slides all along and has come out by s; p = pressure - contraction sigma_f."""
    if friction == 0.0:
        return 2 * residual * (L - s) / A
    return pressure / contraction * (1 - math.exp(-2 * friction * contraction * (L - s) / A))
