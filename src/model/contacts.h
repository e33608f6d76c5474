// SPDX-License-Identifier: GPL-3.0-or-later
// Candidate pairs of the neighbour list, and contacts: what those that touch, or have done so, remember.
#pragma once

#include "geometry/gjk.h"
#include "gpu/buffer.h"

#include <cstdint>

namespace grainfrac {

/// Geometry of one contact, found anew every step: its potential U [m^4] and what a motion of b does to it. The law
/// multiplies all three by k_c; for faces pressed uniformly by g they are A g, 0 and A g^2/2.
struct ContactPoint {
    Vec3 normal;                  ///< unit, direction of the force on b; zero if the bodies are apart [-]
    Vec3 position;                ///< on its line of action: the centre of pressure [m]
    double overlap_force = 0.0;   ///< |dU/dx| [m^3]
    double overlap_couple = 0.0;  ///< -dU/d(angle of b about the normal) [m^4]
    double overlap_energy = 0.0;  ///< U [m^4]
    double area = 0.0;            ///< of a uniform pressure with this force and energy; A_ref for points [m^2]
    double twist_radius = 0.0;    ///< radius of the circle as large as the pressed faces; 0 for points and lines [m]
    double depth = 0.0;           ///< largest penetration [m]
};

/// Contacts::found and Contacts::active of a pair whose bonds still act: it has no contact of its own.
inline constexpr int held_by_bonds = -1;
/// The same of a pair whose cores are in each other, an error state.
inline constexpr int cores_penetrate = -2;

/// CandidatePairs::contact of a pair that has none. The last two hold only until the pairs have been looked at: it is
/// to get one, and in the second case takes over from the pair's bonds.
namespace no_contact {
inline constexpr int held = held_by_bonds, apart = -2, begins = -3, takes_over = -4;
}

/// Pairs of the neighbour list, sorted by (a, b), a < b: what it takes to pass them over. Most never touch.
struct CandidatePairs {
    Buffer<std::int32_t> a, b;  ///< bodies
    Buffer<std::int32_t> law;   ///< into Model::contact_laws
    Buffer<std::int32_t>
        bond_slot;  ///< first slot of the bonds between a and b; they suppress the contact till retired
    Buffer<std::int32_t> bond_count;  ///< how many
    Buffer<double> apart_until;       ///< State::travel up to which the two cannot meet; 0: to be looked at [m]
    Buffer<ClosestCorners> corners;   ///< where the search for the closest points of the cores begins
    Buffer<std::int32_t> contact;     ///< into Contacts, or one of no_contact

    int size() const { return a.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("a", a);
        visit("b", b);
        visit("law", law);
        visit("bond_slot", bond_slot);
        visit("bond_count", bond_count);
        visit("apart_until", apart_until);
        visit("corners", corners);
        visit("contact", contact);
    }
};

/// Contacts of the pairs that have touched since they came into the neighbour list. In the order of the pairs when the
/// list is made; those that come later are added at the end, those of one step in the order of the pairs.
struct Contacts {
    Buffer<std::int32_t> pair;   ///< into CandidatePairs
    Buffer<std::int32_t> a, b;   ///< bodies, as of the pair
    Buffer<std::int32_t> law;    ///< into Model::contact_laws, as of the pair
    Buffer<ContactPoint> point;  ///< derived
    Buffer<std::int32_t> found;  ///< derived: 1 if they touch, 0 if apart, held_by_bonds or cores_penetrate
    // state
    Buffer<std::int32_t> active;     ///< `found` of the last evaluation
    Buffer<Vec3> shear_force;        ///< F_t on a, world frame [N]
    Buffer<Vec3> normal;             ///< of the last evaluation [-]
    Buffer<double> twist_moment;     ///< about the normal, on a [N m]
    Buffer<double> max_overlap;      ///< largest root of 2 U of this contact's life, less its offset [m^2]
    Buffer<double> offset_overlap;   ///< taken off that root so that a hand-over makes no force [m^2]
    Buffer<double> stiffness_scale;  ///< multiplies k_c for the life of a handed-over contact [-]
    Buffer<double> viscous_force;    ///< along the normal, of the last evaluation [N]
    Buffer<double> normal_force;     ///< of the last evaluation, for output [N]
    Buffer<double> stored_energy;    ///< [J]
    Buffer<double> friction_work;    ///< [J]
    Buffer<double> viscous_work;     ///< [J]
    Buffer<double> hysteresis_work;  ///< [J]
    Buffer<double> shear_stiffness;  ///< K_s of the last evaluation [N/m]
    Buffer<double> twist_stiffness;  ///< K_t of the last evaluation [N m]
    Buffer<double> inserted_work;    ///< stored at a hand-over, without work [J]

    int size() const { return a.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("pair", pair);
        visit("a", a);
        visit("b", b);
        visit("law", law);
        visit("point", point);
        visit("found", found);
        visit("active", active);
        visit("shear_force", shear_force);
        visit("normal", normal);
        visit("twist_moment", twist_moment);
        visit("max_overlap", max_overlap);
        visit("offset_overlap", offset_overlap);
        visit("stiffness_scale", stiffness_scale);
        visit("viscous_force", viscous_force);
        visit("normal_force", normal_force);
        visit("stored_energy", stored_energy);
        visit("friction_work", friction_work);
        visit("viscous_work", viscous_work);
        visit("hysteresis_work", hysteresis_work);
        visit("shear_stiffness", shear_stiffness);
        visit("twist_stiffness", twist_stiffness);
        visit("inserted_work", inserted_work);
    }
};

}  // namespace grainfrac
