// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds: area-integrated interfaces with their quadrature points, circular parallel bonds of grains, bonds of spheres.
// Each list is sorted by (a, b), a < b.
#pragma once

#include "geometry/quat.h"
#include "gpu/buffer.h"

#include <cstdint>

namespace grainfrac {

/// A dead interface goes over to general contact once it has slid this share of its width [-]: by then its points no
/// longer lie face to face. Larger keeps stale points, smaller hands over while the old law is still the better one.
inline constexpr double retirement_slip = 0.2;

/// Components on the two tangents of an interface.
struct Vec2 {
    double x = 0.0, y = 0.0;
};

/// What the points of a flat face add up to: a face without damage needs no more. A point lies at centre + xi t_1 +
/// eta t_2 in either frame, t_2 = normal x tangent.
struct FaceMoments {
    Vec3 centre_a, centre_b;  ///< weighted mean of the points, in the frames of a and b [m]
    double area = 0.0;        ///< sum of the weights; 0: the points do not lie so, each counts by itself [m^2]
    double xx = 0.0, xy = 0.0, yy = 0.0;  ///< sums of weight times xi^2, xi eta, eta^2 [m^4]
    double reach_1 = 0.0, reach_2 = 0.0;  ///< largest |xi|, |eta| of points and corners [m]
};

/// InterfaceBonds::history of a face none of whose points can have been damaged. The second holds only until the faces
/// have been evaluated: some point might begin now.
namespace no_history {
inline constexpr int none = -1, begins = -2;
}

/// Grain boundaries, one entry per shared face (physics: total form, no history but damage and slip).
struct InterfaceBonds {
    Buffer<std::int32_t> a, b;          ///< bodies
    Buffer<std::int32_t> law;           ///< into Model::interface_laws
    Buffer<std::int32_t> point_begin;   ///< first quadrature point; one more entry at the end
    Buffer<std::int32_t> corner_begin;  ///< first corner of the face polygon; one more entry at the end
    Buffer<Vec3> normal_a, normal_b;    ///< unit normal from a to b, in the frames of a and b [-]
    Buffer<Vec3> tangent_a, tangent_b;  ///< first tangent, in the frames of a and b [-]
    Buffer<FaceMoments> moments;        ///< follow from the points
    Buffer<double> area;                ///< [m^2]
    Buffer<double> slip_limit;          ///< sliding beyond which a dead face is handed to general contact [m]
    Buffer<double> normal_stiffness;    ///< k_n per area [Pa/m]
    Buffer<double> shear_stiffness;     ///< k_s per area [Pa/m]
    Buffer<double> normal_damping;      ///< c_n per area [Pa s/m]
    Buffer<double> shear_damping;       ///< c_s per area [Pa s/m]
    Buffer<double> strength_factor;     ///< scatter: multiplies sigma_c and c [-]
    Buffer<double> toughness_factor;    ///< scatter: multiplies G_I and G_II [-]
    Buffer<double> pressure;            ///< on the face from outside the model, of a fibre's matrix; for friction [Pa]
    Buffer<double> pressure_at_rest;    ///< p_0, where the fibre bears no stress [Pa]
    Buffer<double> contraction;         ///< k_p: loss of pressure per axial stress of the fibre; 0: none [-]
    Buffer<double> fibre_section;       ///< of the fibre, where it contracts [m^2]
    Buffer<std::int32_t> bond_before, bond_after;  ///< sphere bonds of the fibre's node on either side; -1: none
    Buffer<double> opening_limit;        ///< opening beyond which a dead face is handed to general contact [m]
    Buffer<std::int32_t> transgranular;  ///< 1: made by a split, within what was one grain
    Buffer<double> K_I, K_II;            ///< of the flaw that split the grain; 0 for boundaries [Pa sqrt(m)]
    // state
    Buffer<std::int32_t> history;                     ///< of its first point, into PointHistories; or of no_history
    Buffer<std::int32_t> retired;                     ///< 1: dead and handed over to general contact
    Buffer<double> damage;                            ///< area mean [-]
    Buffer<double> stored_energy;                     ///< [J]
    Buffer<double> fracture_work;                     ///< dissipated by damage so far [J]
    Buffer<double> friction_work;                     ///< dissipated by slip so far [J]
    Buffer<double> viscous_work;                      ///< dissipated by dashpots so far [J]
    Buffer<double> inserted_work;                     ///< minus what it held when it was handed over [J]
    Buffer<double> shear_share;                       ///< integral of mode mix B over damage and area [m^2]
    Buffer<double> first_damage_time;                 ///< -1 before [s]
    Buffer<double> failure_time;                      ///< all points at D = 1; -1 before [s]
    Buffer<Vec3> viscous_force;                       ///< on a, of the last evaluation, for the energy account [N]
    Buffer<Vec3> viscous_torque_a, viscous_torque_b;  ///< [N m]

    int size() const { return a.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("a", a);
        visit("b", b);
        visit("law", law);
        visit("point_begin", point_begin);
        visit("corner_begin", corner_begin);
        visit("normal_a", normal_a);
        visit("normal_b", normal_b);
        visit("tangent_a", tangent_a);
        visit("tangent_b", tangent_b);
        visit("moments", moments);
        visit("area", area);
        visit("slip_limit", slip_limit);
        visit("normal_stiffness", normal_stiffness);
        visit("shear_stiffness", shear_stiffness);
        visit("normal_damping", normal_damping);
        visit("shear_damping", shear_damping);
        visit("strength_factor", strength_factor);
        visit("toughness_factor", toughness_factor);
        visit("pressure", pressure);
        visit("pressure_at_rest", pressure_at_rest);
        visit("contraction", contraction);
        visit("fibre_section", fibre_section);
        visit("bond_before", bond_before);
        visit("bond_after", bond_after);
        visit("opening_limit", opening_limit);
        visit("transgranular", transgranular);
        visit("K_I", K_I);
        visit("K_II", K_II);
        visit("history", history);
        visit("retired", retired);
        visit("damage", damage);
        visit("stored_energy", stored_energy);
        visit("fracture_work", fracture_work);
        visit("friction_work", friction_work);
        visit("viscous_work", viscous_work);
        visit("inserted_work", inserted_work);
        visit("shear_share", shear_share);
        visit("first_damage_time", first_damage_time);
        visit("failure_time", failure_time);
        visit("viscous_force", viscous_force);
        visit("viscous_torque_a", viscous_torque_a);
        visit("viscous_torque_b", viscous_torque_b);
    }
};

/// Quadrature points of all interfaces, end to end.
struct InterfacePoints {
    Buffer<Vec3> position_a, position_b;  ///< in the frames of a and b; equal in space at creation [m]
    Buffer<double> weight;                ///< A_q [m^2]

    int size() const { return weight.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("position_a", position_a);
        visit("position_b", position_b);
        visit("weight", weight);
    }
};

/// What the points of some faces remember: all points of a face one after the other, faces in the order in which they
/// came near to damage.
struct PointHistories {
    Buffer<double> damage;   ///< D [-]
    Buffer<double> onset;    ///< lambda_0, energy norm at onset; 0 before [sqrt(J)/m]
    Buffer<double> failure;  ///< lambda_f [sqrt(J)/m]
    Buffer<Vec2> slip;       ///< delta_sl on the mean reference tangents [m]

    int size() const { return damage.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("damage", damage);
        visit("onset", onset);
        visit("failure", failure);
        visit("slip", slip);
    }
};

/// Corners of all interface polygons, end to end, counter-clockwise seen from b: for whole-face failure and for crack
/// pictures.
struct InterfaceCorners {
    Buffer<Vec3> position_a, position_b;  ///< in the frames of a and b [m]

    int size() const { return position_a.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("position_a", position_a);
        visit("position_b", position_b);
    }
};

/// Circular parallel bonds (Potyondy and Cundall 2004), incremental.
struct ParallelBonds {
    Buffer<std::int32_t> a, b;            ///< bodies
    Buffer<std::int32_t> law;             ///< into Model::parallel_laws
    Buffer<Vec3> position_a, position_b;  ///< bond centre in the frames of a and b [m]
    Buffer<Vec3> normal_a, normal_b;      ///< unit normal from a to b, in the frames of a and b [-]
    Buffer<double> radius;                ///< R [m]
    Buffer<double> normal_stiffness;      ///< k_n per area [Pa/m]
    Buffer<double> shear_stiffness;       ///< k_s per area [Pa/m]
    Buffer<double> normal_damping;        ///< c_n [N s/m]
    Buffer<double> shear_damping;         ///< c_s [N s/m]
    Buffer<double> strength_factor;       ///< [-]
    // state
    Buffer<Vec3> force;            ///< on a, elastic, world frame [N]
    Buffer<Vec3> moment;           ///< on a, elastic, world frame [N m]
    Buffer<Vec3> normal;           ///< of the last evaluation, world frame [-]
    Buffer<std::int32_t> cause;    ///< 0 whole, 1 broke in tension, 2 in shear
    Buffer<double> stored_energy;  ///< [J]
    Buffer<double> fracture_work;  ///< [J]
    Buffer<double> viscous_work;   ///< [J]
    Buffer<double> failure_time;   ///< -1 before [s]
    Buffer<Vec3> viscous_force;    ///< on a, of the last evaluation [N]

    int size() const { return a.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("a", a);
        visit("b", b);
        visit("law", law);
        visit("position_a", position_a);
        visit("position_b", position_b);
        visit("normal_a", normal_a);
        visit("normal_b", normal_b);
        visit("radius", radius);
        visit("normal_stiffness", normal_stiffness);
        visit("shear_stiffness", shear_stiffness);
        visit("normal_damping", normal_damping);
        visit("shear_damping", shear_damping);
        visit("strength_factor", strength_factor);
        visit("force", force);
        visit("moment", moment);
        visit("normal", normal);
        visit("cause", cause);
        visit("stored_energy", stored_energy);
        visit("fracture_work", fracture_work);
        visit("viscous_work", viscous_work);
        visit("failure_time", failure_time);
        visit("viscous_force", viscous_force);
    }
};

/// What many bonds between spheres have in common: all of a lattice, down to round-off, that are made at once.
struct SphereBondKind {
    double share = 0.0;                                     ///< w: arm of a over the distance of the centres [-]
    double length = 0.0;                                    ///< unstressed distance of the centres [m]
    double radius = 0.0;                                    ///< R of the section, for stresses and pictures [m]
    double normal_stiffness = 0.0;                          ///< K_n [N/m]
    double shear_stiffness = 0.0;                           ///< K_s [N/m]
    double bending_stiffness = 0.0, twist_stiffness = 0.0;  ///< K_b, K_t; 0 for spring-dashpots [N m]
    Quat turn;  ///< total form: from the frame of b to that of a when the bond was made [-]
};

/// Bonds between spheres, from centre to centre; the interface of a fibre is an InterfaceBond. The law says which form:
/// total (from where the spheres are now, Kuzkin and Asonov 2012) or incremental (with a history, spring-dashpot). What
/// no law of the model needs may be empty (settle, generate/spheres.h).
struct SphereBonds {
    Buffer<std::int32_t> a, b;       ///< bodies
    Buffer<std::int32_t> law;        ///< into Model::sphere_bond_laws
    Buffer<std::int32_t> kind;       ///< into kinds
    Buffer<SphereBondKind> kinds;    ///< a table; of any length
    Buffer<double> strength_factor;  ///< scatter: multiplies strengths [-]
    Buffer<Vec3> axis_a;  ///< total form: unit vector from a to b when the bond was made, in the frame of a [-]
    // state
    Buffer<Vec3> shear_force;      ///< incremental form: on b, world frame [N]
    Buffer<Vec3> moment;           ///< incremental form: bending moment on b at the contact point, world frame [N m]
    Buffer<double> twist;          ///< incremental form: moment on b about the normal [N m]
    Buffer<Vec3> normal;           ///< incremental form: of the last evaluation [-]
    Buffer<std::int32_t> cause;    ///< 0 whole, 1 broke in tension, 2 in shear
    Buffer<double> stored_energy;  ///< [J]
    Buffer<double> fracture_work;  ///< [J]
    Buffer<double> viscous_work;   ///< [J]
    Buffer<double> failure_time;   ///< -1 before [s]
    Buffer<Vec3> viscous_force, viscous_moment;  ///< with dashpots: on b at the contact point, of the last evaluation
                                                 ///< [N], [N m]

    int size() const { return a.size(); }
    const SphereBondKind& kind_of(int i) const { return kinds.host()[static_cast<std::size_t>(kind[i])]; }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("a", a);
        visit("b", b);
        visit("law", law);
        visit("kind", kind);
        visit("kinds", kinds);
        visit("strength_factor", strength_factor);
        visit("axis_a", axis_a);
        visit("shear_force", shear_force);
        visit("moment", moment);
        visit("twist", twist);
        visit("normal", normal);
        visit("cause", cause);
        visit("stored_energy", stored_energy);
        visit("fracture_work", fracture_work);
        visit("viscous_work", viscous_work);
        visit("failure_time", failure_time);
        visit("viscous_force", viscous_force);
        visit("viscous_moment", viscous_moment);
    }
};

/// Whether a bond has left its pair to general contact.
inline bool is_gone(const InterfaceBonds& bonds, int i)
{
    return bonds.retired[i] != 0;
}
inline bool is_gone(const ParallelBonds& bonds, int i)
{
    return bonds.cause[i] != 0;
}
inline bool is_gone(const SphereBonds& bonds, int i)
{
    return bonds.cause[i] != 0;
}

}  // namespace grainfrac
