// SPDX-License-Identifier: GPL-3.0-or-later
// Velocity Verlet with a symmetric rotation splitting (Dullweber, Leimkuhler and McLachlan 1997, J. Chem. Phys. 107,
// 5840; quaternions: Miller et al. 2002). One force evaluation a step, second order, symplectic, reversible;
// torque-free it keeps |L| and the space vector L to round-off.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// v += dt F/m, L_b += dt R^T T with local damping where it is on; books the work of driven bodies, gravity, damping.
/// After it the drag of relaxation over `drag_time`: with whole steps of drag between undamped ones the account stays
/// exact (a drag within the kicks would be booked short by c dt^3 F^2/(16 m) a step).
void kick(const Model& model, State& state, double dt, double drag_time = 0.0);
/// Positions and orientations over dt; angular velocities follow.
void drift(const Model& model, State& state, double dt);
/// Velocities of driven bodies at `time` (mid step).
void move_walls(const Model& model, State& state, double time);
/// angular_velocity from angular_momentum and orientation, for all free bodies.
void update_angular_velocity(const Model& model, State& state);

/// Turn over dt of a torque-free rigid body; L and q are advanced. Symmetric: axes 1, 2, 3, 2, 1.
GF_FN void rotate_freely(const Vec3& inverse_inertia, double dt, Vec3& L, Quat& q)
{
    if (inverse_inertia.x == inverse_inertia.y && inverse_inertia.y == inverse_inertia.z) {  // a sphere: about L itself
        const double length = norm(L);
        if (length > 0.0) q = normalized(q * from_axis_angle(L * (1.0 / length), dt * length * inverse_inertia.x));
        return;
    }
    const int axis[5] = {0, 1, 2, 1, 0};
    const double part[5] = {0.5, 0.5, 1.0, 0.5, 0.5};
    for (int k = 0; k < 5; ++k) {
        const int e = axis[k], f = (e + 1) % 3, g = (e + 2) % 3;
        const double angle = part[k] * dt * L[e] * inverse_inertia[e];
        if (angle == 0.0) continue;
        const auto [s, c] = sine_cosine(angle);
        const double Lf = L[f], Lg = L[g];
        L[f] = c * Lf + s * Lg;  // L <- Rot(e, -angle) L
        L[g] = c * Lg - s * Lf;
        const SineCosine half = sine_cosine(0.5 * angle);
        Quat turn{half.cosine, 0.0, 0.0, 0.0};
        (e == 0 ? turn.x : (e == 1 ? turn.y : turn.z)) = half.sine;
        q = q * turn;
    }
    q = normalized(q);
}

}  // namespace grainfrac
