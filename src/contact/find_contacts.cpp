// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/find_contacts.h"

#include "contact/manifold.h"
#include "gpu/parallel.h"
#include "gpu/select.h"
#include "model/lanes.h"
#include "model/views.h"

#include <utility>

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
    View<double> apart_until;
    View<ClosestCorners> corners;
    View<std::int32_t> contact;
    View<ContactPoint> point;  // of contacts
    View<std::int32_t> found;

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
        hold(pair);
        return true;
    }

    GF_FN void hold(int pair) const
    {
        const int k = contact[pair];
        if (k == no_contact::held || (k >= 0 && found[k] == held_by_bonds)) return;
        if (k >= 0) {
            point[k] = ContactPoint{};
            found[k] = held_by_bonds;
        } else {
            contact[pair] = no_contact::held;
        }
        apart_until[pair] = 0.0;
    }

    GF_FN void look(int pair) const
    {
        const int i = a[pair], j = b[pair], shape_i = shape[i], shape_j = shape[j], k = contact[pair];
        const double centres2 = norm2(position[j] - position[i]);
        const double reach = shapes.bounding_radius[shape_i] + shapes.bounding_radius[shape_j];
        double clearance = 0.0;
        ContactPoint c;
        if (centres2 >= reach * reach) {
            clearance = std::sqrt(centres2) - reach;
        } else if (shapes.is_ball(shape_i) && shapes.is_ball(shape_j)) {  // which do not wait for orientations
            c = ball_manifold({shapes, shape_i, position[i], {}}, {shapes, shape_j, position[j], {}}, clearance);
        } else {
            ClosestCorners first = corners[pair];
            c = contact_manifold({shapes, shape_i, position[i], orientation[i]},
                                 {shapes, shape_j, position[j], orientation[j]}, clearance, first);
            if (k >= 0 || touch_of(c) == 0) corners[pair] = first;  // else it is looked at once more
        }
        apart_until[pair] = clearance > 0.0 ? travel + closing_share * clearance : 0.0;
        const int touch = touch_of(c);
        if (k >= 0) {
            found[k] = touch;
            point[k] = c;
        } else if (touch != 0) {
            contact[pair] = k == no_contact::held ? no_contact::takes_over : no_contact::begins;
        } else if (k != no_contact::apart) {
            contact[pair] = no_contact::apart;
        }
    }

    GF_FN static int touch_of(const ContactPoint& c)
    {
        return c.overlap_energy > 0.0 ? 1 : c.depth > 0.0 ? cores_penetrate : 0;
    }
};

struct Begins {
    View<const std::int32_t> contact;
    GF_FN bool operator()(int pair) const { return contact[pair] <= no_contact::begins; }
};

struct BeginContacts {
    static constexpr const char* name = "begin contacts";
    View<const std::int32_t> touching, pair_a, pair_b, pair_law;
    int first;
    View<std::int32_t> contact;
    View<std::int32_t> pair, a, b, law, active;
    View<double> stiffness_scale;

    GF_FN void operator()(int i) const
    {
        const int p = touching[i], k = first + i;
        active[k] = contact[p] == no_contact::takes_over ? held_by_bonds : 0;
        contact[p] = k;
        pair[k] = p;
        a[k] = pair_a[p];
        b[k] = pair_b[p];
        law[k] = pair_law[p];
        stiffness_scale[k] = 1.0;
    }
};

/// Pairs that touch for the first time, once they have a contact.
struct LookAgain {
    static constexpr const char* name = "look again";
    FindContacts find;
    View<const std::int32_t> touching;
    GF_FN void operator()(int i) const { find.look(touching[i]); }
};

struct PenetrationTerm {
    View<const std::int32_t> pair, found;
    GF_FN double operator()(int i) const { return found[i] == cores_penetrate ? pair[i] + 1.0 : 0.0; }
};

FindContacts kernel(const Model& model, State& state, bool thorough, Device d)
{
    CandidatePairs& p = state.pairs;
    Contacts& c = state.contacts;
    const Bodies& b = state.bodies;
    const Suppression suppressed{p.bond_slot.read(d), p.bond_count.read(d), state.slots.bond_acts.read(d)};
    return {view(model.shapes, d), b.position.read(d), b.orientation.read(d), b.shape.read(d), p.a.read(d),
            p.b.read(d),           suppressed,         state.travel,          thorough,        p.apart_until.write(d),
            p.corners.write(d),    p.contact.write(d), c.point.write(d),      c.found.write(d)};
}

/// Contacts for the pairs that were found to touch and have none, behind those there are, in the order of the pairs.
void begin_contacts(const Model& model, State& state, Device d)
{
    CandidatePairs& p = state.pairs;
    const Buffer<std::int32_t> touching = select(d, p.size(), Begins{std::as_const(p).contact.read(d)});
    if (touching.empty()) return;
    Contacts& c = state.contacts;
    const int first = c.size(), n = first + touching.size();
    c.for_each_array([&](const char*, auto& array) { array.extend(n); });
    state.slots.extend(state.bond_slots() + n);
    parallel_for(d, touching.size(),
                 BeginContacts{touching.read(d), p.a.read(d), p.b.read(d), p.law.read(d), first, p.contact.write(d),
                               c.pair.write(d), c.a.write(d), c.b.write(d), c.law.write(d), c.active.write(d),
                               c.stiffness_scale.write(d)});
    parallel_for(d, touching.size(), LookAgain{kernel(model, state, true, d), touching.read(d)});
}

}  // namespace

void find_contacts(const Model& model, State& state)
{
    parallel_for(model.device, state.pairs.size(), kernel(model, state, true, model.device));
    begin_contacts(model, state, model.device);
}

void follow_contacts(const Model& model, State& state)
{
    parallel_for(model.device, state.pairs.size(), kernel(model, state, false, model.device));
    begin_contacts(model, state, model.device);
}

void find_contacts(const Model& model, State& state, const std::vector<int>& pairs)
{
    serial_for(pairs, kernel(model, state, true, Device::cpu));
    begin_contacts(model, state, Device::cpu);
}

int penetrating_pair(const Model& model, const State& state)
{
    const Device d = model.device;
    const Contacts& c = state.contacts;
    return static_cast<int>(parallel_max(d, c.size(), PenetrationTerm{c.pair.read(d), c.found.read(d)})) - 1;
}

}  // namespace grainfrac
