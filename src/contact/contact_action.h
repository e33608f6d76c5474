// SPDX-License-Identifier: GPL-3.0-or-later
// One evaluation of a contact: from what it reads of its bodies and its history to what it writes.
#pragma once

#include "contact/linear_contact.h"
#include "model/lanes.h"

namespace grainfrac {

struct ContactReading {
    ContactPoint point;
    ContactHistory history;
    double viscous_force = 0.0;  ///< of the last evaluation [N]
    Vec3 position_a, position_b, velocity_a, velocity_b, spin_a, spin_b;
    double reduced_mass = 0.0;  ///< [kg]

    template <class Visit>
    constexpr void for_each_number(Visit&& visit)
    {
        const auto all = [&](auto&... x) { (grainfrac::for_each_number(x, visit), ...); };
        all(point.normal, point.position, point.overlap_force, point.overlap_couple, point.overlap_energy, point.area,
            point.twist_radius);
        history.for_each_number(visit);
        all(viscous_force, position_a, position_b, velocity_a, velocity_b, spin_a, spin_b, reduced_mass);
    }
};

struct ContactWriting {
    Vec3 force, torque_a, torque_b;  ///< on b, about the centres of a and b
    Vec3 arm_a, arm_b;               ///< from the centres to the contact [m]
    ContactHistory history;
    ContactResponse response;
    double viscous_work = 0.0;  ///< of this step [J]

    template <class Visit>
    constexpr void for_each_number(Visit&& visit)
    {
        const auto all = [&](auto&... x) { (grainfrac::for_each_number(x, visit), ...); };
        all(force, torque_a, torque_b, arm_a, arm_b, viscous_work);
        history.for_each_number(visit);
        all(response.normal_force, response.viscous_force, response.stored, response.friction_work,
            response.hysteresis_work);
    }
};

template <class Law>
GF_FN ContactWriting act(const Law& law, const ContactReading& x, double dt)
{
    const ContactPoint& c = x.point;
    ContactWriting w;
    w.arm_a = c.position - x.position_a;
    w.arm_b = c.position - x.position_b;
    ContactMotion m;
    m.velocity = x.velocity_b + cross(x.spin_b, w.arm_b) - x.velocity_a - cross(x.spin_a, w.arm_a);
    m.mean_spin = 0.5 * (x.spin_a + x.spin_b);
    m.twist_rate = dot(x.spin_b - x.spin_a, c.normal);
    m.reduced_mass = x.reduced_mass;
    w.history = x.history;
    w.response = law(c, m, dt, w.history);
    // trapezoidal in time, as for the dashpots of interfaces
    w.viscous_work = -0.5 * dt * (x.viscous_force + w.response.viscous_force) * dot(m.velocity, c.normal);
    w.force = w.response.force;
    const Vec3 couple = w.response.couple * c.normal;
    w.torque_a = -couple - cross(w.arm_a, w.force);
    w.torque_b = cross(w.arm_b, w.force) + couple;
    return w;
}

}  // namespace grainfrac
