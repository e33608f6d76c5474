// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/bond_forces.h"

#include "contact/linear_contact.h"
#include "fracture/face_moments.h"
#include "fracture/interface_frame.h"
#include "gpu/parallel.h"
#include "gpu/select.h"
#include "model/point_history.h"
#include "model/views.h"

namespace grainfrac {

namespace {

struct InterfaceForces {
    static constexpr const char* name = "interface forces";
    MotionView body;
    SlotsView slot;
    View<const InterfaceLaw> laws;
    double dt, time;
    bool fracture_active, dashpots_active;

    View<const std::int32_t> a, b, law, point_begin, corner_begin;
    View<const Vec3> normal_a, normal_b, tangent_a, tangent_b;
    View<const FaceMoments> moments;
    View<const double> area, slip_limit, pressure, normal_stiffness, shear_stiffness, normal_damping, shear_damping;
    View<const double> strength_factor, toughness_factor, opening_limit;
    View<const Vec3> point_a, point_b, corner_a, corner_b;
    View<const double> weight;

    View<std::int32_t> history, retired;
    View<double> damage, stored_energy, fracture_work, friction_work, viscous_work, inserted_work, shear_share;
    View<double> first_damage_time, failure_time;
    View<Vec3> viscous_force, viscous_torque_a, viscous_torque_b;
    View<double> point_damage, point_onset, point_failure;  // of faces with a history
    View<Vec2> point_slip;

    GF_FN InterfaceFrame frame(int i) const
    {
        return {body.orientation[a[i]],
                body.orientation[b[i]],
                body.position[b[i]] - body.position[a[i]],
                normal_a[i],
                normal_b[i],
                tangent_a[i],
                tangent_b[i]};
    }

    /// Whole-face failure: true when a corner of the face meets the onset surface.
    GF_FN bool face_fails(int i, const InterfaceFrame& f, const InterfaceLaw& l) const
    {
        for (int c = corner_begin[i]; c < corner_begin[i + 1]; ++c) {
            const Vec3 jump = f.between + f.rotation_b * corner_b[c] - f.rotation_a * corner_a[c];
            const double sigma = normal_stiffness[i] * dot(jump, f.n);
            const double tau = shear_stiffness[i] * norm(tangential(jump, f.n));
            if (l.onset_factor(sigma, tau, strength_factor[i]) >= 1.0) return true;
        }
        return false;
    }

    GF_FN double power_on_bodies(int i) const
    {
        return dot(viscous_force[i], body.velocity[a[i]] - body.velocity[b[i]]) +
               dot(viscous_torque_a[i], body.angular_velocity[a[i]]) +
               dot(viscous_torque_b[i], body.angular_velocity[b[i]]);
    }

    /// Elastic forces, and those of the dashpots: on a; torques on a and b.
    struct FaceAction {
        Vec3 force, torque_a, torque_b;
        Vec3 drag, drag_torque_a, drag_torque_b;
        Mat3 dyad_a, dyad_b;
        double stored = 0.0;
    };

    GF_FN void operator()(int i) const
    {
        if (retired[i] != 0) {
            slot.force[i] = slot.torque_a[i] = slot.torque_b[i] = Vec3{};
            friction_work[i] +=
                stored_energy[i];  // what it held ends with it; the contact that takes over inserts its own
            stored_energy[i] = 0.0;
            viscous_force[i] = viscous_torque_a[i] = viscous_torque_b[i] = Vec3{};
            if (slot.dyad_a.size > 0) slot.dyad_a[i] = slot.dyad_b[i] = Mat3{};
            return;
        }
        const InterfaceLaw l = laws[law[i]];
        const InterfaceFrame f = frame(i);
        const bool by_face = l.failure == FailureUnit::face;
        const bool may_fail = fracture_active && l.failure != FailureUnit::unbreakable;
        const double c_n = dashpots_active ? normal_damping[i] : 0.0, c_s = dashpots_active ? shear_damping[i] : 0.0;
        // Work of dashpots, trapezoidal in time: half of each force with the velocity before it, half with the one
        // after.
        double viscous = 0.5 * power_on_bodies(i);
        FaceAction s;
        if (first_damage_time[i] >= 0.0 || !whole_face(i, f, l, may_fail, c_n, c_s, s)) {
            if (history[i] < 0) {  // it is evaluated again, once its points have one
                history[i] = no_history::begins;
                return;
            }
            const bool fail_now = may_fail && by_face && damage[i] < 1.0 && face_fails(i, f, l);
            by_points(i, f, l, may_fail && !by_face, fail_now, c_n, c_s, s);
        }
        viscous_force[i] = s.drag;
        viscous_torque_a[i] = s.drag_torque_a;
        viscous_torque_b[i] = s.drag_torque_b;
        viscous += 0.5 * power_on_bodies(i);
        viscous_work[i] -= viscous * dt;

        slot.force[i] = -(s.force + s.drag);
        slot.torque_a[i] = s.torque_a + s.drag_torque_a;
        slot.torque_b[i] = s.torque_b + s.drag_torque_b;
        if (slot.dyad_a.size > 0) {
            slot.dyad_a[i] = s.dyad_a;
            slot.dyad_b[i] = s.dyad_b;
        }
        stored_energy[i] = s.stored;
    }

    /// A face without damage, none of whose points can meet the onset surface: the jump is linear over the face, so
    /// that forces follow from its moments. False: some point might; then each has to be asked.
    GF_FN bool whole_face(int i, const InterfaceFrame& f, const InterfaceLaw& l, bool may_fail, double c_n, double c_s,
                          FaceAction& s) const
    {
        const FaceMoments m = moments[i];
        if (m.area == 0.0) return false;
        const double k_n = normal_stiffness[i], k_s = shear_stiffness[i];
        const Vec3 arm_a = f.rotation_a * m.centre_a, arm_b = f.rotation_b * m.centre_b;
        const Vec3 a1 = f.rotation_a * tangent_a[i], a2 = cross(f.rotation_a * normal_a[i], a1);
        const Vec3 b1 = f.rotation_b * tangent_b[i], b2 = cross(f.rotation_b * normal_b[i], b1);
        const Vec3 jump = f.between + arm_b - arm_a, jump_1 = b1 - a1, jump_2 = b2 - a2;
        if (may_fail) {  // at the worst corner of the rectangle about all points and corners
            const InterfaceJump d = f.in_frame(jump), d_1 = f.in_frame(jump_1), d_2 = f.in_frame(jump_2);
            const auto most = [&](double at_centre, double per_1, double per_2) {
                return at_centre + m.reach_1 * std::fabs(per_1) + m.reach_2 * std::fabs(per_2);
            };
            const double s1 = most(std::fabs(d.s1), d_1.s1, d_2.s1), s2 = most(std::fabs(d.s2), d_1.s2, d_2.s2);
            if (!l.below_onset(k_n * most(d.n, d_1.n, d_2.n), k_s * k_s * (s1 * s1 + s2 * s2), strength_factor[i]))
                return false;
        }
        // both forces act at the midpoint of the two points: see by_points
        const Vec3 middle_a = arm_a + 0.5 * jump, middle_b = arm_b - 0.5 * jump;
        const Vec3 along_1 = 0.5 * (a1 + b1), along_2 = 0.5 * (a2 + b2);
        // force, moment of its gradient over the face
        const auto sum = [&](const Vec3& at_centre, const Vec3& per_1, const Vec3& per_2, Vec3& force, Vec3& torque_a,
                             Vec3& torque_b) {
            force = m.area * at_centre;
            const Vec3 bending =
                cross(along_1, m.xx * per_1 + m.xy * per_2) + cross(along_2, m.xy * per_1 + m.yy * per_2);
            torque_a = cross(middle_a, force) + bending;
            torque_b = -(cross(middle_b, force) + bending);
        };
        const auto acting = [&](double n, double t, const Vec3& v) { return ((n - t) * dot(v, f.n)) * f.n + t * v; };
        Vec3 t0 = acting(k_n, k_s, jump), t1 = acting(k_n, k_s, jump_1), t2 = acting(k_n, k_s, jump_2);
        sum(t0, t1, t2, s.force, s.torque_a, s.torque_b);
        s.stored = 0.5 * (m.area * dot(jump, t0) + m.xx * dot(jump_1, t1) + 2.0 * m.xy * dot(jump_1, t2) +
                          m.yy * dot(jump_2, t2));
        if (c_n + c_s > 0.0) {
            const Vec3 wa = body.angular_velocity[a[i]], wb = body.angular_velocity[b[i]], spin = wb - wa;
            const Vec3 rate = body.velocity[b[i]] - body.velocity[a[i]] + cross(wb, middle_b) - cross(wa, middle_a);
            const Vec3 d0 = acting(c_n, c_s, rate), d1 = acting(c_n, c_s, cross(spin, along_1)),
                       d2 = acting(c_n, c_s, cross(spin, along_2));
            sum(d0, d1, d2, s.drag, s.drag_torque_a, s.drag_torque_b);
            t0 += d0;
            t1 += d1;
            t2 += d2;
        }
        if (slot.dyad_a.size > 0) {
            const Mat3 bending =
                Mat3::outer(along_1, m.xx * t1 + m.xy * t2) + Mat3::outer(along_2, m.xy * t1 + m.yy * t2);
            s.dyad_a = Mat3::outer(middle_a, m.area * t0) + bending;
            s.dyad_b = -1.0 * (Mat3::outer(middle_b, m.area * t0) + bending);
        }
        return true;
    }

    /// Every point by itself, as the law sees it.
    GF_FN void by_points(int i, const InterfaceFrame& f, const InterfaceLaw& l, bool may_start, bool fail_now,
                         double c_n, double c_s, FaceAction& s) const
    {
        const double k_n = normal_stiffness[i], k_s = shear_stiffness[i];
        const Vec3 wa = body.angular_velocity[a[i]], wb = body.angular_velocity[b[i]];
        const Vec3 relative_velocity = body.velocity[b[i]] - body.velocity[a[i]];
        double fractured = 0.0, slid = 0.0, sheared = 0.0, damaged = 0.0;
        double least_opening = 1e300, most_sliding2 = 0.0;
        for (int q = point_begin[i], h = history[i]; q < point_begin[i + 1]; ++q, ++h) {
            const double w = weight[q];
            const Vec3 arm_a = f.rotation_a * point_a[q], arm_b = f.rotation_b * point_b[q];
            const Vec3 jump = f.between + arm_b - arm_a;
            const auto [d_n, d_1, d_2] = f.in_frame(jump);
            InterfacePointState p;
            if (point_onset[h] > 0.0)
                p = {point_damage[h], point_onset[h], point_failure[h], point_slip[h].x, point_slip[h].y};
            const double onset_before = p.onset;
            // at the midpoint of both points: there a common rigid motion has no rate, whatever the jump
            const Vec3 middle_a = arm_a + 0.5 * jump, middle_b = arm_b - 0.5 * jump;
            const Vec3 rate = relative_velocity + cross(wb, middle_b) - cross(wa, middle_a);
            const double rate_n = dot(rate, f.n);
            const InterfaceJump before{d_n - dt * rate_n, d_1 - dt * dot(rate, f.t1), d_2 - dt * dot(rate, f.t2)};
            const InterfaceResponse r = l({d_n, d_1, d_2}, before, k_n, k_s, strength_factor[i], toughness_factor[i],
                                          may_start, fail_now, p, fracture_active, pressure[i]);
            if (p.onset > 0.0) {
                point_damage[h] = p.damage;
                point_onset[h] = p.onset;
                point_failure[h] = p.failure;
                point_slip[h] = {p.slip1, p.slip2};
                if (onset_before == 0.0 && first_damage_time[i] < 0.0) first_damage_time[i] = time;
            }
            s.stored += w * r.stored;
            fractured += w * r.fracture_work;
            slid += w * r.friction_work;
            sheared += w * r.shear_share;
            damaged += w * p.damage;
            least_opening = smaller(least_opening, d_n);
            most_sliding2 = larger(most_sliding2, d_1 * d_1 + d_2 * d_2);

            // Both forces act at the midpoint: at their own points the pair would leave the torque jump x traction.
            const Vec3 t = w * (r.normal * f.n + r.shear1 * f.t1 + r.shear2 * f.t2);
            s.force += t;
            s.torque_a += cross(middle_a, t);
            s.torque_b -= cross(middle_b, t);
            Vec3 t_all = t;
            if (c_n + c_s > 0.0 && p.damage < 1.0) {
                const Vec3 v = (w * (1.0 - p.damage)) * ((c_n - c_s) * rate_n * f.n + c_s * rate);
                s.drag += v;
                s.drag_torque_a += cross(middle_a, v);
                s.drag_torque_b -= cross(middle_b, v);
                t_all += v;
            }
            if (slot.dyad_a.size > 0) {
                s.dyad_a = s.dyad_a + Mat3::outer(middle_a, t_all);
                s.dyad_b = s.dyad_b - Mat3::outer(middle_b, t_all);
            }
        }
        fracture_work[i] += fractured;
        friction_work[i] += slid;
        shear_share[i] += sheared;
        damage[i] = damaged / area[i];
        if (damaged > 0.0 && all_points_broken(i)) {
            damage[i] = 1.0;
            if (failure_time[i] < 0.0) failure_time[i] = time;
            if (least_opening > opening_limit[i] || most_sliding2 > slip_limit[i] * slip_limit[i]) {
                retired[i] = 1;
                slot.bond_acts[i] = 0;
            }
        }
    }

    GF_FN bool all_points_broken(int i) const
    {
        for (int h = history[i]; h < history[i] + point_begin[i + 1] - point_begin[i]; ++h) {
            if (point_damage[h] < 1.0) return false;
        }
        return true;
    }
};

struct BeginsHistory {
    View<const std::int32_t> history;
    GF_FN bool operator()(int i) const { return history[i] == no_history::begins; }
};

/// Faces that have got a history.
struct EvaluateAgain {
    static constexpr const char* name = "interface forces again";
    InterfaceForces forces;
    View<const std::int32_t> list;
    GF_FN void operator()(int i) const { forces(list[i]); }
};

/// Increments in the frame that turns with the bond; normal_old is the normal of the last evaluation.
struct ParallelForces {
    static constexpr const char* name = "parallel bond forces";
    MotionView body;
    SlotsView slot;
    View<const ParallelLaw> laws;
    double dt, time;
    bool fracture_active;
    int first_slot;

    View<const std::int32_t> a, b, law;
    View<const Vec3> position_a, position_b, normal_a, normal_b;
    View<const double> radius, normal_stiffness, shear_stiffness, normal_damping, shear_damping, strength_factor;

    View<Vec3> force, moment, normal;
    View<std::int32_t> cause;
    View<double> stored_energy, fracture_work, viscous_work, failure_time;
    View<Vec3> viscous_force;

    GF_FN void clear(int s, int i) const
    {
        slot.force[s] = slot.torque_a[s] = slot.torque_b[s] = Vec3{};
        stored_energy[i] = 0.0;
        viscous_force[i] = Vec3{};
        if (slot.dyad_a.size > 0) slot.dyad_a[s] = slot.dyad_b[s] = Mat3{};
    }

    GF_FN void operator()(int i) const
    {
        const int s = first_slot + i;
        const bool broken_before = cause[i] != static_cast<int>(BondCause::whole);
        if (broken_before && norm2(force[i]) + norm2(moment[i]) == 0.0) {
            clear(s, i);
            return;
        }
        const Quat qa = body.orientation[a[i]], qb = body.orientation[b[i]];
        const Vec3 n = normalized(rotate(qa, normal_a[i]) + rotate(qb, normal_b[i]));
        const Vec3 arm_a = rotate(qa, position_a[i]), arm_b = rotate(qb, position_b[i]);
        const Vec3 jump = body.position[b[i]] + arm_b - body.position[a[i]] - arm_a;
        const Vec3 middle_a = arm_a + 0.5 * jump, middle_b = arm_b - 0.5 * jump;
        const Vec3 wa = body.angular_velocity[a[i]], wb = body.angular_velocity[b[i]];
        const Vec3 rate = body.velocity[b[i]] + cross(wb, middle_b) - body.velocity[a[i]] - cross(wa, middle_a);
        const Vec3 turn = wb - wa;

        if (broken_before) {  // the step in which the force falls to nothing: half of it did work on the way
            fracture_work[i] += 0.5 * dt * (dot(force[i], rate) + dot(moment[i], turn));
            force[i] = moment[i] = Vec3{};
            clear(s, i);
            return;
        }

        const CircularSection section(radius[i]);
        const double k_n = normal_stiffness[i], k_s = shear_stiffness[i];
        const double spin = 0.5 * dt * dot(wa + wb, n);
        const Vec3 u_n = dot(rate, n) * n, turn_n = dot(turn, n) * n;
        Vec3 f = turn_with_contact(force[i], normal[i], n, spin);
        Vec3 m = turn_with_contact(moment[i], normal[i], n, spin);
        f += dt * (k_n * section.area * u_n + k_s * section.area * (rate - u_n));
        m += dt * (k_s * section.polar * turn_n + k_n * section.bending * (turn - turn_n));
        force[i] = f;
        moment[i] = m;
        normal[i] = n;
        const double f_n = dot(f, n), m_n = dot(m, n);
        stored_energy[i] =
            0.5 * (f_n * f_n / (k_n * section.area) + norm2(tangential(f, n)) / (k_s * section.area) +
                   m_n * m_n / (k_s * section.polar) + norm2(tangential(m, n)) / (k_n * section.bending));

        const Vec3 drag = normal_damping[i] * u_n + shear_damping[i] * (rate - u_n);
        viscous_work[i] += 0.5 * dt * dot(viscous_force[i] + drag, rate);
        viscous_force[i] = drag;

        const Vec3 on_a = f + drag;
        slot.force[s] = -on_a;
        slot.torque_a[s] = cross(middle_a, on_a) + m;
        slot.torque_b[s] = -(cross(middle_b, on_a) + m);
        if (slot.dyad_a.size > 0) {
            slot.dyad_a[s] = Mat3::outer(middle_a, on_a);
            slot.dyad_b[s] = Mat3::outer(middle_b, -on_a);
        }
        if (!fracture_active) return;
        const BondCause broken = laws[law[i]].broken(f, m, n, radius[i], strength_factor[i]);
        if (broken != BondCause::whole) {  // this force still acts in this step; the contact takes over in the next
            cause[i] = static_cast<int>(broken);
            slot.bond_acts[s] = 0;
            failure_time[i] = time;
            fracture_work[i] = stored_energy[i];
            stored_energy[i] = 0.0;
        }
    }
};

InterfaceForces interface_kernel(const Model& model, State& state, double dt, Device d)
{
    InterfaceBonds& i = state.interfaces;
    const InterfacePoints& p = state.points;
    PointHistories& h = state.histories;
    return {motion_view(state.bodies, d),
            slots_view(state.slots, d),
            model.interface_laws.read(d),
            dt,
            state.time,
            model.fracture_active,
            model.dashpots_active,
            i.a.read(d),
            i.b.read(d),
            i.law.read(d),
            i.point_begin.read(d),
            i.corner_begin.read(d),
            i.normal_a.read(d),
            i.normal_b.read(d),
            i.tangent_a.read(d),
            i.tangent_b.read(d),
            i.moments.read(d),
            i.area.read(d),
            i.slip_limit.read(d),
            i.pressure.read(d),
            i.normal_stiffness.read(d),
            i.shear_stiffness.read(d),
            i.normal_damping.read(d),
            i.shear_damping.read(d),
            i.strength_factor.read(d),
            i.toughness_factor.read(d),
            i.opening_limit.read(d),
            p.position_a.read(d),
            p.position_b.read(d),
            state.corners.position_a.read(d),
            state.corners.position_b.read(d),
            p.weight.read(d),
            i.history.write(d),
            i.retired.write(d),
            i.damage.write(d),
            i.stored_energy.write(d),
            i.fracture_work.write(d),
            i.friction_work.write(d),
            i.viscous_work.write(d),
            i.inserted_work.write(d),
            i.shear_share.write(d),
            i.first_damage_time.write(d),
            i.failure_time.write(d),
            i.viscous_force.write(d),
            i.viscous_torque_a.write(d),
            i.viscous_torque_b.write(d),
            h.damage.write(d),
            h.onset.write(d),
            h.failure.write(d),
            h.slip.write(d)};
}

ParallelForces parallel_kernel(const Model& model, State& state, double dt, Device d)
{
    ParallelBonds& p = state.parallels;
    return {motion_view(state.bodies, d),
            slots_view(state.slots, d),
            model.parallel_laws.read(d),
            dt,
            state.time,
            model.fracture_active,
            state.interfaces.size(),
            p.a.read(d),
            p.b.read(d),
            p.law.read(d),
            p.position_a.read(d),
            p.position_b.read(d),
            p.normal_a.read(d),
            p.normal_b.read(d),
            p.radius.read(d),
            p.normal_stiffness.read(d),
            p.shear_stiffness.read(d),
            p.normal_damping.read(d),
            p.shear_damping.read(d),
            p.strength_factor.read(d),
            p.force.write(d),
            p.moment.write(d),
            p.normal.write(d),
            p.cause.write(d),
            p.stored_energy.write(d),
            p.fracture_work.write(d),
            p.viscous_work.write(d),
            p.failure_time.write(d),
            p.viscous_force.write(d)};
}

/// Histories for the faces that were found to need one, in the order of the faces.
void evaluate_those_that_begin(const Model& model, State& state, double dt, Device d)
{
    const InterfaceBonds& f = state.interfaces;
    const Buffer<std::int32_t> list = select(d, f.size(), BeginsHistory{f.history.read(d)});
    if (list.empty()) return;
    begin_histories(state, list.host());
    parallel_for(d, list.size(), EvaluateAgain{interface_kernel(model, state, dt, d), list.read(d)});
}

}  // namespace

void bond_forces(const Model& model, State& state, double dt)
{
    if (state.interfaces.size() > 0) {
        parallel_for(model.device, state.interfaces.size(), interface_kernel(model, state, dt, model.device));
        evaluate_those_that_begin(model, state, dt, model.device);
    }
    if (state.parallels.size() > 0)
        parallel_for(model.device, state.parallels.size(), parallel_kernel(model, state, dt, model.device));
    if (state.sphere_bonds.size() > 0) sphere_bond_forces(model, state, dt);
}

void bond_forces(const Model& model, State& state, const std::vector<int>& interfaces,
                 const std::vector<int>& parallels, const std::vector<int>& sphere_bonds)
{
    serial_for(interfaces, interface_kernel(model, state, 0.0, Device::cpu));
    evaluate_those_that_begin(model, state, 0.0, Device::cpu);
    serial_for(parallels, parallel_kernel(model, state, 0.0, Device::cpu));
    sphere_bond_forces(model, state, sphere_bonds);
}

void start_bonds(const Model&, State& state)
{
    find_face_moments(state);
    ParallelBonds& p = state.parallels;
    for (int i = 0; i < p.size(); ++i) {
        const Vec3 na = rotate(state.bodies.orientation[p.a[i]], p.normal_a[i]);
        const Vec3 nb = rotate(state.bodies.orientation[p.b[i]], p.normal_b[i]);
        p.normal.host()[static_cast<std::size_t>(i)] = normalized(na + nb);
    }
    SphereBonds& s = state.sphere_bonds;
    for (int i = 0; i < s.normal.size(); ++i)
        s.normal.at(i) = normalized(state.bodies.position[s.b[i]] - state.bodies.position[s.a[i]]);
}

}  // namespace grainfrac
