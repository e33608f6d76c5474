// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/find_contacts.h"

#include "contact/manifold.h"
#include "gpu/parallel.h"
#include "model/lanes.h"
#include "model/views.h"

namespace grainfrac {

namespace {

/// Two surfaces that come nearer by State::travel each close this much of what was between them, and a little is left
/// for round-off and for spins that change within a step.
constexpr double closing_share = 0.49;

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
    double travel;  // now; no pair is skipped if `thorough`
    bool thorough;
    View<ContactPoint> point;
    View<double> apart_until;
    View<std::int32_t> found;
    View<ClosestCorners> corners;

    GF_FN void operator()(int pair) const
    {
        if (!pass_over(pair)) look(pair);
    }

    /// Host: those that are not passed over together, in code for the vector unit of this processor.
    void range(int begin, int end) const
    {
        int waiting[lanes], n = 0;
        const auto look_at = [this, &waiting](int k) { look(waiting[k]); };
        for (int pair = begin; pair < end; ++pair) {
            if (pass_over(pair)) continue;
            waiting[n++] = pair;
            if (n == lanes) {
                for_lanes(n, look_at);
                n = 0;
            }
        }
        for_lanes(n, look_at);
    }

    /// Apart for certain, or held by bonds, which is noted.
    GF_FN bool pass_over(int pair) const
    {
        if (!thorough && travel < apart_until[pair]) return true;
        if (!suppressed(pair)) return false;
        if (found[pair] != held_by_bonds) {
            point[pair] = ContactPoint{};
            point[pair].depth = found[pair] = held_by_bonds;
            apart_until[pair] = 0.0;
        }
        return true;
    }

    GF_FN void look(int pair) const
    {
        const int i = a[pair], j = b[pair], shape_i = shape[i], shape_j = shape[j];
        const double centres2 = norm2(position[j] - position[i]);
        const double reach = shapes.bounding_radius[shape_i] + shapes.bounding_radius[shape_j];
        double clearance = 0.0;
        ContactPoint c;
        if (centres2 >= reach * reach) {
            clearance = std::sqrt(centres2) - reach;
        } else if (shapes.is_ball(shape_i) && shapes.is_ball(shape_j)) {  // which do not wait for orientations
            c = ball_manifold({shapes, shape_i, position[i], {}}, {shapes, shape_j, position[j], {}}, clearance);
        } else {
            c = contact_manifold({shapes, shape_i, position[i], orientation[i]},
                                 {shapes, shape_j, position[j], orientation[j]}, clearance, corners[pair]);
        }
        apart_until[pair] = clearance > 0.0 ? travel + closing_share * clearance : 0.0;
        const int touch = c.overlap_energy > 0.0 ? 1 : 0;
        if (touch == 0 && found[pair] == 0 && point[pair].depth == 0.0 && c.depth == 0.0) return;
        found[pair] = touch;
        point[pair] = c;
    }
};

struct PenetrationTerm {
    View<const ContactPoint> point;
    GF_FN double operator()(int i) const
    {
        return point[i].depth > 0.0 && point[i].overlap_energy <= 0.0 ? i + 1.0 : 0.0;
    }
};

FindContacts kernel(const Model& model, State& state, bool thorough, Device d)
{
    Contacts& c = state.contacts;
    const Bodies& b = state.bodies;
    const Suppression suppressed{c.bond_slot.read(d), c.bond_count.read(d), state.slots.bond_acts.read(d)};
    return {view(model.shapes, d),
            b.position.read(d),
            b.orientation.read(d),
            b.shape.read(d),
            c.a.read(d),
            c.b.read(d),
            suppressed,
            state.travel,
            thorough,
            c.point.write(d),
            c.apart_until.write(d),
            c.found.write(d),
            c.corners.write(d)};
}

}  // namespace

void find_contacts(const Model& model, State& state)
{
    parallel_for(model.device, state.contacts.size(), kernel(model, state, true, model.device));
}

void follow_contacts(const Model& model, State& state)
{
    parallel_for(model.device, state.contacts.size(), kernel(model, state, false, model.device));
}

void find_contacts(const Model& model, State& state, const std::vector<int>& pairs)
{
    serial_for(pairs, kernel(model, state, true, Device::cpu));
}

int penetrating_pair(const Model& model, const State& state)
{
    const double found =
        parallel_max(model.device, state.contacts.size(), PenetrationTerm{state.contacts.point.read(model.device)});
    return static_cast<int>(found) - 1;
}

}  // namespace grainfrac
