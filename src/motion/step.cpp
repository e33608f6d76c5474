// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/step.h"

#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "contact/gather.h"
#include "fracture/bond_forces.h"
#include "fracture/fibre_pressure.h"
#include "motion/energy.h"
#include "motion/integrate.h"
#include "motion/servo.h"
#include "motion/spread_supports.h"

namespace grainfrac {

namespace {

void make_room_for_stress(State& state, bool wanted)
{
    const int n = wanted ? state.slots.size() : 0;
    if (state.slots.dyad_a.size() != n) {
        state.slots.dyad_a.resize(n);
        state.slots.dyad_b.resize(n);
    }
}

}  // namespace

void step(const Model& model, State& state, double dt, bool want_stress)
{
    move_walls(model, state, state.time + 0.5 * dt);  // driven bodies: the speed of mid step, for both half kicks
    drive_servos(model, state, dt);                   // walls that hold a push
    kick(model, state, 0.5 * dt);                     // velocities to mid step
    drift(model, state, dt);                          // positions, orientations
    state.time += dt;
    ++state.step;
    if (pairs_are_stale(model, state, dt)) find_pairs(model, state);
    follow_contacts(model, state);  // geometry only: overlap, normal, point; contacts that begin
    make_room_for_stress(state, want_stress);
    contact_forces(model, state, dt);
    fibre_pressures(model, state);
    bond_forces(model, state, dt);  // interfaces and parallel bonds; marks what breaks
    gather_forces(model, state);    // onto the bodies, in a fixed order
    spread_support_forces(model, state);
    kick(model, state, 0.5 * dt, dt);  // velocities to the end of the step; drag
}

void start(const Model& model, State& state)
{
    update_angular_velocity(model, state);
    start_bonds(model, state);
    find_pairs(model, state);
    find_contacts(model, state);
    contact_forces(model, state, 0.0);
    fibre_pressures(model, state);
    bond_forces(model, state, 0.0);
    gather_forces(model, state);
    spread_support_forces(model, state);
    state.initial_energy = 0.0;
    state.initial_energy =
        -energy_ledger(model, state).residual();  // what overlaps and motion at the start hold or lost
}

}  // namespace grainfrac
