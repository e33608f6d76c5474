// SPDX-License-Identifier: GPL-3.0-or-later
// Candidate pairs of the neighbour list and what a contact remembers. Sorted by (a, b), a < b.
#pragma once

#include "geometry/vec3.h"
#include "gpu/buffer.h"

#include <cstdint>

namespace grainfrac {

/// Geometry of one contact, found anew every step: the resultant of its manifold.
struct ContactPoint {
    Vec3 normal;                  ///< unit, from a to b; zero if the bodies are apart [-]
    Vec3 position;                ///< centre of pressure [m]
    double overlap_volume = 0.0;  ///< integral of the penetration over the manifold [m^3]
    double overlap_square = 0.0;  ///< integral of half its square [m^4]
    double area = 0.0;            ///< of the manifold, reference area for points and lines [m^2]
    double twist_radius = 0.0;    ///< radius of the circle of equal area; 0 for points and lines [m]
    double depth = 0.0;           ///< largest penetration [m]
    double footprint = 0.0;       ///< area that the two faces share, pressed or not; 0 for points and lines [m^2]
};

struct Contacts {
    Buffer<std::int32_t> a, b;  ///< bodies
    Buffer<std::int32_t> law;   ///< into Model::contact_laws
    Buffer<std::int32_t>
        bond_slot;  ///< first slot of the bonds between a and b; they suppress the contact till retired
    Buffer<std::int32_t> bond_count;  ///< how many
    Buffer<ContactPoint> point;       ///< derived
    // state
    Buffer<std::int32_t> active;     ///< 1 while in contact, after any hand-over
    Buffer<Vec3> shear_force;        ///< F_t on a, world frame [N]
    Buffer<Vec3> normal;             ///< of the last evaluation [-]
    Buffer<double> twist_moment;     ///< about the normal, on a [N m]
    Buffer<double> max_overlap;      ///< largest overlap volume of this contact's life, less its offset [m^3]
    Buffer<double> max_energy;       ///< elastic energy there [J]
    Buffer<double> offset_force;     ///< taken off so that a hand-over makes no force [N]
    Buffer<double> stiffness_scale;  ///< multiplies k_c for the life of a handed-over contact [-]
    Buffer<double> viscous_force;    ///< along the normal, of the last evaluation [N]
    Buffer<double> normal_force;     ///< of the last evaluation, for output [N]
    Buffer<double> stored_energy;    ///< [J]
    Buffer<double> friction_work;    ///< [J]
    Buffer<double> viscous_work;     ///< [J]
    Buffer<double> hysteresis_work;  ///< [J]
    Buffer<double> area;             ///< of the manifold at the last evaluation [m^2]
    Buffer<double> footprint;        ///< of the last evaluation [m^2]
    Buffer<double> normal_energy;    ///< stored in the overlap at the last evaluation [J]
    Buffer<double>
        inserted_work;  ///< stored energy that a change of the manifold made (+) or took (-) without work [J]

    int size() const { return a.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("a", a);
        visit("b", b);
        visit("law", law);
        visit("bond_slot", bond_slot);
        visit("bond_count", bond_count);
        visit("point", point);
        for_each_history(visit);
    }
    /// What travels with a pair when the neighbour list is made anew.
    template <class Visit>
    void for_each_history(Visit&& visit)
    {
        visit("active", active);
        visit("shear_force", shear_force);
        visit("normal", normal);
        visit("twist_moment", twist_moment);
        visit("max_overlap", max_overlap);
        visit("max_energy", max_energy);
        visit("offset_force", offset_force);
        visit("stiffness_scale", stiffness_scale);
        visit("viscous_force", viscous_force);
        visit("normal_force", normal_force);
        visit("stored_energy", stored_energy);
        visit("friction_work", friction_work);
        visit("viscous_work", viscous_work);
        visit("hysteresis_work", hysteresis_work);
        visit("area", area);
        visit("footprint", footprint);
        visit("normal_energy", normal_energy);
        visit("inserted_work", inserted_work);
    }
};

}  // namespace grainfrac
