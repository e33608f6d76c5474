// SPDX-License-Identifier: GPL-3.0-or-later
// The energy, momentum and mass account of a run (ledger: W_ext + W_g + W_ins + E_0 = E_kin + U + D + residual).
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

struct Ledger {
    double kinetic = 0.0;           ///< E_kin [J]
    double elastic_bonds = 0.0;     ///< U of interfaces and parallel bonds [J]
    double elastic_contacts = 0.0;  ///< U of contacts [J]
    double fracture = 0.0;          ///< D_frac [J]
    double friction = 0.0;          ///< D_fric, broken interfaces and contacts [J]
    double damping = 0.0;           ///< D_visc + D_hyst + D_local [J]
    double external = 0.0;          ///< W_ext, driven bodies [J]
    double gravity = 0.0;           ///< W_g [J]
    double inserted = 0.0;  ///< W_ins, stored where a contact takes over from a bond, less what the bond held [J]
    double initial = 0.0;   ///< E_0 [J]

    double negligible = 0.0;  ///< a residual below this is round-off [J]

    /// What was put in less what is found [J].
    double residual() const
    {
        return external + gravity + inserted + initial - kinetic - elastic_bonds - elastic_contacts - fracture -
               friction - damping;
    }
    /// |residual| over the largest of W_ext, E_kin, U, E_0 [-].
    double relative_error() const;
};

/// Sums in a fixed order; call after a completed step.
Ledger energy_ledger(const Model& model, const State& state);

struct Momentum {
    Vec3 linear;        ///< of the free bodies [kg m/s]
    Vec3 angular;       ///< about the origin [kg m^2/s]
    double mass = 0.0;  ///< [kg]
};
/// Of the fastest body that is not driven [m/s].
double fastest_speed(const Model& model, const State& state);

Momentum total_momentum(const Model& model, const State& state);

}  // namespace grainfrac
