// SPDX-License-Identifier: GPL-3.0-or-later
// What changes in a step. Every bond and every contact has a slot; a body adds its slots in a fixed order.
#pragma once

#include "model/bodies.h"
#include "model/bonds.h"
#include "model/contacts.h"

#include <cstdint>

namespace grainfrac {

/// What an interaction does to its two bodies. Slots: bonds, kind by kind as in State::for_each_bond_kind, then
/// contacts.
struct Slots {
    Buffer<Vec3> force;     ///< on b; a gets the opposite [N]
    Buffer<Vec3> torque_a;  ///< about the centre of a [N m]
    Buffer<Vec3> torque_b;  ///< about the centre of b [N m]
    Buffer<Mat3> dyad_a;  ///< sum of d (x) f about the centre of a; empty unless this step was asked for stresses [N m]
    Buffer<Mat3> dyad_b;  ///< the same for b [N m]

    Buffer<std::int32_t> bond_acts;  ///< per slot of a bond: 1 while it holds its pair, which has no contact then

    int size() const { return force.size(); }
    void resize(int n)
    {
        force.resize(n);
        torque_a.resize(n);
        torque_b.resize(n);
    }
    /// More of them at the end, with nothing in them.
    void extend(int n)
    {
        force.extend(n);
        torque_a.extend(n);
        torque_b.extend(n);
    }
};

/// Interactions of each body: entries [begin[i], begin[i+1]), each 2 * interaction + side (0: the body is a, 1: it is
/// b), ascending. Interactions are counted as bonds by their slots, then pairs of the neighbour list: SlotOf
/// (model/views.h).
struct Incidence {
    Buffer<std::int32_t> begin;
    Buffer<std::int32_t> entry;
};

/// Energies of contacts that left the neighbour list [J].
struct PastContacts {
    double friction_work = 0.0, viscous_work = 0.0, hysteresis_work = 0.0, inserted_work = 0.0;
};

struct State {
    Bodies bodies;
    InterfaceBonds interfaces;
    InterfacePoints points;
    PointHistories histories;
    InterfaceCorners corners;
    ParallelBonds parallels;
    SphereBonds sphere_bonds;
    CandidatePairs pairs;
    Contacts contacts;
    Slots slots;
    Incidence incidence;
    PastContacts past_contacts;
    double travel = 0.0;          ///< farthest any surface point may have moved since the neighbour list was made [m]
    double initial_energy = 0.0;  ///< E_0 of the ledger [J]
    double time = 0.0;            ///< [s]
    std::int64_t step = 0;
    std::int64_t next_look = 0;  ///< step of the next look for cleavage that asks the gate

    /// The one list of kinds, in the order of their slots: visit(bonds, first slot).
    template <class Visit>
    void for_each_bond_kind(Visit&& visit) const
    {
        visit(interfaces, 0);
        visit(parallels, interfaces.size());
        visit(sphere_bonds, first_sphere_slot());
    }
    int first_sphere_slot() const { return interfaces.size() + parallels.size(); }
    int bond_slots() const { return first_sphere_slot() + sphere_bonds.size(); }
    int interactions() const { return bond_slots() + pairs.size(); }

    /// visit(contact) in the order of the pairs, whenever they met.
    template <class Visit>
    void for_each_contact(Visit&& visit) const
    {
        for (int i = 0; i < pairs.size(); ++i) {
            if (pairs.contact[i] >= 0) visit(pairs.contact[i]);
        }
    }
};

}  // namespace grainfrac
