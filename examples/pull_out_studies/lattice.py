#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The elastic pull-out as one linear system, without the program: bonds with moments against bonds without.

    lattice.py [--fibre chain|taken] [--diameter d] [--ratio K_s/K_n] [--no-arms]

Matrix hcp about a channel, radius 6 m, length 30 m, its far face under uniform stress. chain: the fibre is a bar, its patches at the centres
of the innermost ring. taken: the fibre is of spheres of the lattice, ten times as stiff, with patches midway along all lines of
centres across its surface, so that their force turns both spheres; with --no-arms it does not. Needs scipy (python3-scipy).
"""
import argparse

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree

A, B, L, E_M, E_F, K0 = 1.0, 6.0, 30.0, 5e9, 50e9, 1e9


def centres(d, taken):
    """Centres, their layers, and which are of the fibre (one that is taken stands out by three layers)."""
    layer, hollow = np.sqrt(2 / 3) * d, np.array([d / 2, d / (2 * np.sqrt(3))])
    n, most = round(L / layer), int(2 * B / d) + 4
    i, j = (x.ravel() for x in np.meshgrid(range(-most, most + 1), range(-most, most + 1)))
    flat = np.stack([(i + j / 2) * d, j * np.sqrt(3) / 2 * d], 1) + hollow
    found = []
    for k in range(n + (3 if taken else 0)):
        p = flat + (k % 2) * hollow
        r = np.hypot(*p.T)
        kept = (r > A) & (r <= B + 1e-9) & (k < n) | (r <= A) & taken
        found.append(np.column_stack([p[kept], np.full(kept.sum(), k * layer), np.full(kept.sum(), k), r[kept] <= A]))
    found = np.vstack(found)
    return found[:, :3], found[:, 3].astype(int), found[:, 4] > 0, n, layer


def kinematics(along, R, arm):
    """Jump at the contact and relative turn of each pair, from the displacements and turns of both (6 + 6)."""
    turn = np.zeros((len(along), 3, 3))  # x -> along cross x
    for (r, c), k, sign in (((0, 1), 2, -1), ((0, 2), 1, 1), ((1, 0), 2, 1), ((1, 2), 0, -1), ((2, 0), 1, -1), ((2, 1), 0, 1)):
        turn[:, r, c] = sign * along[:, k]
    jump = np.zeros((len(along), 6, 12))
    jump[:, :3, :3] = jump[:, 3:, 3:6] = -np.eye(3)
    jump[:, :3, 6:9] = jump[:, 3:, 9:] = np.eye(3)
    jump[:, :3, 3:6] = jump[:, :3, 9:] = R * arm[:, None, None] * turn
    return jump


def shear(fibre, d, ratio, moments, arms):
    """tau of each layer under a unit pull of the fibre, in equilibrium."""
    x, level, inside, n, layer = centres(d, fibre == "taken")
    m, R = len(x), d / 2
    a, b = cKDTree(x).query_pairs(1.001 * d, output_type="ndarray").T
    along, across = (x[b] - x[a]) / d, inside[a] != inside[b]
    K_n = np.full(len(a), E_M * (5 + ratio) / (6 * np.sqrt(2) / d * (1 + ratio))) * np.where(inside[a], E_F / E_M, 1.0)
    K_n[across] = 0.0
    K_s = ratio * K_n
    if across.any():
        K_s[across] = K0 * 2 * np.pi * A * L / across.sum()
    K_b, K_t = moments * K_n * R**2 / 4, moments * np.where(across, 0.0, K_s) * R**2 / 2  # round section of radius R
    N = along[:, :, None] * along[:, None, :]
    T = np.eye(3) - N
    jump = kinematics(along, R, np.where(across, arms, 1.0))
    C = np.zeros((len(a), 6, 6))
    C[:, :3, :3] = K_n[:, None, None] * N + K_s[:, None, None] * T
    C[:, 3:, 3:] = K_t[:, None, None] * N + K_b[:, None, None] * T
    own = np.concatenate([6 * a[:, None] + np.arange(6), 6 * b[:, None] + np.arange(6)], 1)
    K = np.einsum("pia,pij,pjb->pab", jump, C, jump)
    size = 6 * m + (n if fibre == "chain" else 0)
    parts = [(K.ravel(), np.repeat(own, 12, axis=1).ravel(), np.tile(own, (1, 12)).ravel())]

    def spring(dofs, weights, k):
        parts.append(((k * np.outer(weights, weights)).ravel(), np.repeat(dofs, len(dofs)), np.tile(dofs, len(dofs))))

    f, rings = np.zeros(size), []
    face = np.where((level == 0) & ~inside)[0]
    f[6 * face + 2] = -1.0 / len(face)
    if fibre == "chain":
        r = np.hypot(x[:, 0], x[:, 1])
        for k in range(n):
            ring = np.where((level == k) & (r < r[level == k].min() + 0.2 * d))[0]
            angle = np.arctan2(x[ring, 1], x[ring, 0])
            ring, angle = ring[np.argsort(angle)], np.sort(angle)
            gap = (np.roll(angle, -1) - angle) % (2 * np.pi)
            share = 0.5 * (gap + np.roll(gap, 1))
            rings.append((ring, share))
            for i, w, t in zip(ring, share, angle):
                spring([6 * m + k, 6 * i + 2], [1, -1], K0 * w * A * layer)
                spring([6 * i, 6 * i + 1], [-np.sin(t), np.cos(t)], K0 * w * A * layer)
            if k > 0:
                spring([6 * m + k - 1, 6 * m + k], [1, -1], np.pi * A * A * E_F / layer)
        f[6 * m + n - 1] = 1.0
    else:
        grip = np.where(level >= n + 2)[0]
        for i in grip[1:]:
            spring([6 * grip[0] + 2, 6 * i + 2], [1, -1], 100 * K_n.max())
        f[6 * grip + 2] = 1.0 / len(grip)
    for i in face[[0, len(face) // 2, -1]]:  # what moves as a whole
        for k in range(3):
            spring([6 * i + k], [1], 1e-6 * K_n.max())
    values, rows, columns = (np.concatenate(c) for c in zip(*parts))
    K = sparse.coo_matrix((values, (rows, columns)), shape=(size, size)).tocsr()
    scale = sparse.diags(1 / np.sqrt(K.diagonal()))
    found, failed = cg(scale @ K @ scale, scale @ f, tol=1e-10, maxiter=100000)
    if failed:
        raise SystemExit("no equilibrium found")
    u = scale @ found
    if fibre == "chain":
        return np.array([(w * K0 * (u[6 * m + k] - u[6 * ring + 2])).sum() / w.sum() for k, (ring, w) in enumerate(rings)])
    force = K_s[:, None] * np.einsum("pij,pjk,pk->pi", T, jump[:, :3], u[own])
    pull = np.where(inside[a], -force[:, 2], force[:, 2])
    of = level[np.where(inside[a], a, b)]
    return np.array([pull[across & (of == k)].sum() for k in range(n)]) / (2 * np.pi * A * layer)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fibre", choices=("chain", "taken"), default="chain")
    parser.add_argument("--diameter", type=float, default=1.0, help="of the spheres [m]")
    parser.add_argument("--ratio", type=float, default=0.4054, help="K_s/K_n of the bonds; the default is that of the studies")
    parser.add_argument("--no-arms", action="store_true", help="patches of a taken fibre do not turn the spheres")
    args = parser.parse_args()
    with_moments, without = (shear(args.fibre, args.diameter, args.ratio, moments, 0.0 if args.no_arms else 1.0)
                             for moments in (1.0, 0.0))
    span, off = np.ptp(with_moments), with_moments - without
    print(f"tau without moments, root mean square difference over the range {np.sqrt(np.mean(off**2)) / span:.4f}, over the "
          f"largest {np.sqrt(np.mean(off**2)) / with_moments.max():.4f}, without the outermost layers "
          f"{np.sqrt(np.mean(off[1:-1]**2)) / span:.4f}; outermost layers {-off[0] / with_moments[0]:+.3f}, "
          f"{-off[-1] / with_moments[-1]:+.3f}")


main()
