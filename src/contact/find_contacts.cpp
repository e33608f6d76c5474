// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/find_contacts.h"

#include "contact/manifold.h"
#include "gpu/parallel.h"
#include "model/views.h"

namespace grainfrac {

namespace {

/// True while a bond of the pair still acts: bonds carry compression too, so the pair must not press twice.
struct Suppression {
    View<const std::int32_t> bond_slot, bond_count, bond_acts;

    GF_FN bool operator()(int pair) const
    {
        for (int s = bond_slot[pair]; s < bond_slot[pair] + bond_count[pair]; ++s) {
            if (bond_acts[s] != 0) return true;
        }
        return false;
    }
};

struct FindContacts {
    static constexpr const char* name = "find contacts";
    ShapesView shapes;
    View<const Vec3> position;
    View<const Quat> orientation;
    View<const std::int32_t> shape;
    View<const std::int32_t> a, b;
    Suppression suppressed;
    View<ContactPoint> point;

    GF_FN void operator()(int pair) const
    {
        point[pair] = ContactPoint{};
        const int i = a[pair], j = b[pair];
        const double reach = shapes.bounding_radius[shape[i]] + shapes.bounding_radius[shape[j]];
        if (suppressed(pair)) {
            point[pair].depth = held_by_bonds;
            return;
        }
        if (norm2(position[j] - position[i]) >= reach * reach) return;
        point[pair] = contact_manifold({shapes, shape[i], position[i], orientation[i]},
                                       {shapes, shape[j], position[j], orientation[j]});
    }
};

struct PenetrationTerm {
    View<const ContactPoint> point;
    GF_FN double operator()(int i) const
    {
        return point[i].depth > 0.0 && point[i].overlap_energy <= 0.0 ? i + 1.0 : 0.0;
    }
};

FindContacts kernel(const Model& model, State& state, Device d)
{
    Contacts& c = state.contacts;
    const Bodies& b = state.bodies;
    const Suppression suppressed{c.bond_slot.read(d), c.bond_count.read(d), state.slots.bond_acts.read(d)};
    return {view(model.shapes, d), b.position.read(d), b.orientation.read(d), b.shape.read(d), c.a.read(d),
            c.b.read(d),           suppressed,         c.point.write(d)};
}

}  // namespace

void find_contacts(const Model& model, State& state)
{
    parallel_for(model.device, state.contacts.size(), kernel(model, state, model.device));
}

void find_contacts(const Model& model, State& state, const std::vector<int>& pairs)
{
    serial_for(pairs, kernel(model, state, Device::cpu));
}

int penetrating_pair(const Model& model, const State& state)
{
    const double found =
        parallel_max(model.device, state.contacts.size(), PenetrationTerm{state.contacts.point.read(model.device)});
    return static_cast<int>(found) - 1;
}

}  // namespace grainfrac
