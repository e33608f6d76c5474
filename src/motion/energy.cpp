// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/energy.h"

#include "gpu/parallel.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

struct Entry {
    View<const double> values;
    GF_FN double operator()(int i) const { return values[i]; }
};

double total(Device d, const Buffer<double>& values)
{
    return parallel_sum(d, values.size(), Entry{values.read(d)});
}

/// Of contacts, in the order of their pairs: sums do not depend on which met first.
struct EntryOfPair {
    View<const std::int32_t> contact;
    View<const double> values;
    GF_FN double operator()(int i) const { return contact[i] >= 0 ? values[contact[i]] : 0.0; }
};

/// 1/2 m v^2 + 1/2 L_b . I^-1 L_b of what is not driven or held.
struct KineticEnergy {
    View<const Vec3> velocity, angular_momentum, inverse_inertia;
    View<const double> mass, inverse_mass;
    View<const std::int32_t> held;
    GF_FN double operator()(int i) const
    {
        const Vec3 L = angular_momentum[i], j = inverse_inertia[i];
        Vec3 v = velocity[i];
        for (int k = 0; k < 3; ++k) {
            if ((held[i] >> k) % 2 != 0) v[k] = 0.0;
        }
        const double translation = inverse_mass[i] > 0.0 ? 0.5 * mass[i] * norm2(v) : 0.0;
        return translation + 0.5 * (L.x * L.x * j.x + L.y * L.y * j.y + L.z * L.z * j.z);
    }
};

struct Speed {
    View<const Vec3> velocity;
    View<const double> inverse_mass;
    GF_FN double operator()(int i) const { return inverse_mass[i] > 0.0 ? norm(velocity[i]) : 0.0; }
};

}  // namespace

double fastest_speed(const Model& model, const State& state)
{
    const Device d = model.device;
    const Bodies& b = state.bodies;
    return parallel_max(d, b.size(), Speed{b.velocity.read(d), b.inverse_mass.read(d)});
}

double Ledger::relative_error() const
{
    const double scale =
        std::max({std::fabs(external), std::fabs(gravity), kinetic, elastic_bonds + elastic_contacts, initial});
    return scale > 0.0 && std::fabs(residual()) > negligible ? std::fabs(residual()) / scale : 0.0;
}

Ledger energy_ledger(const Model& model, const State& state)
{
    const Device d = model.device;
    const Bodies& b = state.bodies;
    const InterfaceBonds& i = state.interfaces;
    const ParallelBonds& p = state.parallels;
    const SphereBonds& s = state.sphere_bonds;
    const Contacts& c = state.contacts;
    const PastContacts& past = state.past_contacts;
    const auto of_contacts = [&](const Buffer<double>& values) {
        return parallel_sum(d, state.pairs.size(), EntryOfPair{state.pairs.contact.read(d), values.read(d)});
    };
    Ledger e;
    e.kinetic = parallel_sum(d, b.size(),
                             KineticEnergy{b.velocity.read(d), b.angular_momentum.read(d), b.inverse_inertia.read(d),
                                           b.mass.read(d), b.inverse_mass.read(d), b.held.read(d)});
    e.elastic_bonds = total(d, i.stored_energy) + total(d, p.stored_energy) + total(d, s.stored_energy);
    e.elastic_contacts = of_contacts(c.stored_energy);
    e.fracture = total(d, i.fracture_work) + total(d, p.fracture_work) + total(d, s.fracture_work);
    e.friction = total(d, i.friction_work) + of_contacts(c.friction_work) + past.friction_work;
    e.damping = total(d, i.viscous_work) + total(d, p.viscous_work) + total(d, s.viscous_work) +
                of_contacts(c.viscous_work) + past.viscous_work + of_contacts(c.hysteresis_work) +
                past.hysteresis_work + total(d, b.damping_work);
    e.inserted = total(d, i.inserted_work) + of_contacts(c.inserted_work) + past.inserted_work;
    e.external = total(d, b.external_work);
    e.gravity = total(d, b.gravity_work);
    e.initial = state.initial_energy;
    return e;
}

Momentum total_momentum(const Model&, const State& state)
{
    const Bodies& b = state.bodies;
    Momentum m;
    for (int i = 0; i < b.size(); ++i) {
        if (b.inverse_mass[i] == 0.0) continue;
        const Vec3 p = b.mass[i] * b.velocity[i];
        m.mass += b.mass[i];
        m.linear += p;
        m.angular += cross(b.position[i], p) + rotate(b.orientation[i], b.angular_momentum[i]);
    }
    return m;
}

}  // namespace grainfrac
