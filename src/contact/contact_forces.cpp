// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/contact_forces.h"

#include "contact/contact_action.h"
#include "gpu/parallel.h"
#include "model/views.h"

namespace grainfrac {

namespace {

template <class Law>
struct ContactForces {
    static constexpr const char* name = "contact forces";
    MotionView body;
    SlotsView slot;
    View<const Law> laws;
    double dt;
    int first_slot;
    View<const std::int32_t> pair, a, b, law;
    View<const std::int32_t> bond_slot, bond_count;  // of pairs
    View<const ContactPoint> point;
    View<const std::int32_t> found;
    View<std::int32_t> active;
    View<Vec3> shear_force, normal;
    View<double> twist_moment, max_overlap, offset_overlap, stiffness_scale, viscous_force, normal_force, stored_energy;
    View<double> friction_work, viscous_work, hysteresis_work, shear_stiffness, twist_stiffness, inserted_work;

    /// The dashpot's second half step, at the speed with which the contact opened. Its arms are those of the last
    /// force.
    GF_FN double last_viscous_work(int i) const
    {
        if (active[i] != 1 || viscous_force[i] == 0.0) return 0.0;
        double v_n = dot(body.velocity[b[i]] - body.velocity[a[i]], normal[i]);
        if (normal_force[i] > 0.0) {
            const int s = first_slot + i;
            v_n += (dot(slot.torque_a[s], body.angular_velocity[a[i]]) +
                    dot(slot.torque_b[s], body.angular_velocity[b[i]])) /
                   normal_force[i];
        }
        return -0.5 * dt * viscous_force[i] * v_n;
    }

    GF_FN void clear(int i) const
    {
        const int s = first_slot + i;
        viscous_work[i] += last_viscous_work(i);
        slot.force[s] = slot.torque_a[s] = slot.torque_b[s] = Vec3{};
        if (slot.dyad_a.size > 0) slot.dyad_a[s] = slot.dyad_b[s] = Mat3{};
        if (active[i] > 0) {  // what the springs along the surfaces still held is lost to the last slip
            if (shear_stiffness[i] > 0.0) friction_work[i] += 0.5 * norm2(shear_force[i]) / shear_stiffness[i];
            if (twist_stiffness[i] > 0.0)
                friction_work[i] += 0.5 * twist_moment[i] * twist_moment[i] / twist_stiffness[i];
        }
        active[i] = found[i];
        shear_force[i] = Vec3{};
        twist_moment[i] = max_overlap[i] = offset_overlap[i] = viscous_force[i] = normal_force[i] = stored_energy[i] =
            shear_stiffness[i] = twist_stiffness[i] = 0.0;
        stiffness_scale[i] = 1.0;
    }

    /// Force that the pair's bonds put on a in their last step; their slots keep it until the bonds are evaluated
    /// again.
    GF_FN Vec3 inherited_force(int i) const
    {
        const int first = bond_slot[pair[i]], end = first + bond_count[pair[i]];
        Vec3 f;
        for (int s = first; s < end; ++s) f -= slot.force[s];
        return f;
    }

    /// The first contact after the pair's bonds ended: it presses what they pressed, be it nothing, however deep the
    /// grains are in each other beside the dead faces.
    GF_FN void take_over(int i, const ContactPoint& c, const Law& l, ContactHistory& h) const
    {
        const Vec3 f = inherited_force(i);
        const double pressed = larger(0.0, -dot(f, c.normal)), own = l.area_stiffness * c.overlap_force;
        h.shear_force = tangential(f, c.normal);
        h.normal = c.normal;
        match_force(pressed, own, c, h.offset_overlap, h.stiffness_scale, h.max_overlap);
    }

    GF_FN ContactReading read(int i) const
    {
        const int A = a[i], B = b[i];
        ContactReading x;
        x.point = point[i];
        x.history = {shear_force[i],    normal[i],          twist_moment[i],    max_overlap[i],
                     offset_overlap[i], stiffness_scale[i], shear_stiffness[i], twist_stiffness[i]};
        x.viscous_force = viscous_force[i];
        x.position_a = body.position[A];
        x.position_b = body.position[B];
        x.velocity_a = body.velocity[A];
        x.velocity_b = body.velocity[B];
        x.spin_a = body.angular_velocity[A];
        x.spin_b = body.angular_velocity[B];
        x.reduced_mass = reduced_mass(body.inverse_mass[A], body.inverse_mass[B]);
        return x;
    }

    GF_FN void write(int i, const ContactWriting& w) const
    {
        const ContactResponse& r = w.response;
        viscous_work[i] += w.viscous_work;
        viscous_force[i] = r.viscous_force;
        friction_work[i] += r.friction_work;
        hysteresis_work[i] += r.hysteresis_work;
        shear_stiffness[i] = w.history.shear_stiffness;
        twist_stiffness[i] = w.history.twist_stiffness;
        stored_energy[i] = r.stored;
        normal_force[i] = r.normal_force;
        shear_force[i] = w.history.shear_force;
        normal[i] = w.history.normal;
        twist_moment[i] = w.history.twist_moment;
        max_overlap[i] = w.history.max_overlap;
        offset_overlap[i] = w.history.offset_overlap;
        stiffness_scale[i] = w.history.stiffness_scale;

        const int s = first_slot + i;
        slot.force[s] = w.force;
        slot.torque_a[s] = w.torque_a;
        slot.torque_b[s] = w.torque_b;
        if (slot.dyad_a.size > 0) {
            slot.dyad_a[s] = Mat3::outer(w.arm_a, -w.force);
            slot.dyad_b[s] = Mat3::outer(w.arm_b, w.force);
        }
    }

    GF_FN void operator()(int i) const
    {
        if (found[i] != 1) {
            if (active[i] != found[i]) clear(i);  // otherwise there is nothing: its slot was cleared then
            return;
        }
        const Law l = laws[law[i]];
        ContactReading x = read(i);
        bool taken_over = false;
        if (active[i] != 1) {
            x.history = ContactHistory{};
            x.history.normal = x.point.normal;
            taken_over = active[i] == held_by_bonds;
            if (taken_over) take_over(i, x.point, l, x.history);
            active[i] = 1;
        }
        const ContactWriting w = act(l, x, dt);
        write(i, w);
        // the bonds booked what they held as lost
        if (taken_over) inserted_work[i] += w.response.stored + w.response.friction_work + w.response.hysteresis_work;
    }

    GF_FLATTEN void block(const int* contact, int n) const
    {
        Lanes<ContactReading> in;
        Lanes<ContactWriting> out;
        for (int k = 0; k < n; ++k) in.put(k, read(contact[k]));
        for_lanes(n, [&in, &out, l = laws[law[contact[0]]], dt = dt](int k) { out.put(k, act(l, in.get(k), dt)); });
        for (int k = 0; k < n; ++k) write(contact[k], out.get(k));
    }

    /// Host: contacts of one law that were there before together.
    void range(int begin, int end) const
    {
        int waiting[lanes], n = 0;
        for (int i = begin; i < end; ++i) {
            if (found[i] != 1 || active[i] != 1) {
                (*this)(i);
                continue;
            }
            if (n == lanes || (n > 0 && law[i] != law[waiting[0]])) {
                block(waiting, n);
                n = 0;
            }
            waiting[n++] = i;
        }
        if (n > 0) block(waiting, n);
    }
};

ContactForces<LinearContact> kernel(const Model& model, State& state, double dt, Device d)
{
    Contacts& c = state.contacts;
    const CandidatePairs& p = state.pairs;
    return {motion_view(state.bodies, d),
            slots_view(state.slots, d),
            model.contact_laws.read(d),
            dt,
            state.bond_slots(),
            c.pair.read(d),
            c.a.read(d),
            c.b.read(d),
            c.law.read(d),
            p.bond_slot.read(d),
            p.bond_count.read(d),
            c.point.read(d),
            c.found.read(d),
            c.active.write(d),
            c.shear_force.write(d),
            c.normal.write(d),
            c.twist_moment.write(d),
            c.max_overlap.write(d),
            c.offset_overlap.write(d),
            c.stiffness_scale.write(d),
            c.viscous_force.write(d),
            c.normal_force.write(d),
            c.stored_energy.write(d),
            c.friction_work.write(d),
            c.viscous_work.write(d),
            c.hysteresis_work.write(d),
            c.shear_stiffness.write(d),
            c.twist_stiffness.write(d),
            c.inserted_work.write(d)};
}

}  // namespace

void contact_forces(const Model& model, State& state, double dt)
{
    if (state.contacts.size() == 0) return;
    parallel_for(model.device, state.contacts.size(), kernel(model, state, dt, model.device));
}

void contact_forces(const Model& model, State& state, const std::vector<int>& contacts, double dt)
{
    serial_for(contacts, kernel(model, state, dt, Device::cpu));
}

}  // namespace grainfrac
