// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of views that several kernels share.
#pragma once

#include "model/state.h"

namespace grainfrac {

/// Where bodies are and how they move, read only.
struct MotionView {
    View<const Vec3> position, velocity, angular_velocity;
    View<const Quat> orientation;
    View<const double> inverse_mass;
    View<const Vec3> inverse_inertia;
};
inline MotionView motion_view(const Bodies& b, Device device)
{
    return {b.position.read(device),    b.velocity.read(device),     b.angular_velocity.read(device),
            b.orientation.read(device), b.inverse_mass.read(device), b.inverse_inertia.read(device)};
}

/// Where an interaction writes what it does; `dyad_*` are empty views unless stresses are wanted.
struct SlotsView {
    View<Vec3> force, torque_a, torque_b;
    View<Mat3> dyad_a, dyad_b;
    View<std::int32_t> bond_acts;
};
inline SlotsView slots_view(Slots& s, Device device)
{
    return {s.force.write(device),  s.torque_a.write(device), s.torque_b.write(device),
            s.dyad_a.write(device), s.dyad_b.write(device),   s.bond_acts.write(device)};
}

/// Slot of an interaction, as Incidence counts them; -1 for pairs without a contact.
struct SlotOf {
    int bonds;
    View<const std::int32_t> contact;  // of the pairs
    GF_FN int operator()(int interaction) const
    {
        if (interaction < bonds) return interaction;
        const int k = contact[interaction - bonds];
        return k >= 0 ? bonds + k : -1;
    }
};
inline SlotOf slot_of(const State& state, Device device)
{
    return {state.bond_slots(), state.pairs.contact.read(device)};
}

/// 1/(1/m_a + 1/m_b); 0 if both are driven [kg].
GF_FN double reduced_mass(double inverse_mass_a, double inverse_mass_b)
{
    const double s = inverse_mass_a + inverse_mass_b;
    return s > 0.0 ? 1.0 / s : 0.0;
}

}  // namespace grainfrac
