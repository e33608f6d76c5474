// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and bonds from polyhedra: the one place where grains enter a model, whatever generated them.
#pragma once

#include "geometry/quadrature.h"
#include "geometry/shared_faces.h"
#include "model/grain_body.h"
#include "model/model.h"
#include "model/state.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace grainfrac {

/// One grain as it lies in space.
struct GrainSpec {
    Polyhedron shape;              ///< sharp [m]
    Vec3 site;                     ///< generator point of its cell; the distance of sites sets bond stiffness [m]
    double dilation_radius = 0.0;  ///< wanted; reduced where the grain is too small for it [m]
    std::int32_t material = 0, group = 0;
    std::int32_t origin = -1;  ///< place in the list of the first grain cut from the same one; -1: none was cut
    Quat crystal;              ///< crystal to space [-]
    Vec3 velocity;             ///< [m/s]
    Vec3 angular_velocity;     ///< [rad/s]
};

/// Body in its principal frame with an eroded, dilated contact shape. Returns its index. Throws std::invalid_argument
/// for a shape that is no closed convex polyhedron.
int add_grain(Model& model, State& state, const GrainSpec& grain);

/// Driven body. `core` in the frame of the body at `position`.
int add_wall_plate(Model& model, State& state, int wall, int group, const Polyhedron& core, const Vec3& position,
                   double radius);
int add_wall_round(Model& model, State& state, int wall, int group, const Vec3& axis, double length,
                   const Vec3& position, double radius);

/// How to make the bonds of one kind of grain pair.
struct BondRule {
    enum class Kind { interface, parallel, point, sphere, fibre } kind = Kind::interface;
    std::int32_t law = 0;  ///< into Model::interface_laws, parallel_laws or sphere_bond_laws
    QuadratureRule quadrature = QuadratureRule::automatic;
    double damping = 0.0;                    ///< zeta [-]
    std::optional<double> normal_stiffness;  ///< [Pa/m]; else modulus/h
    double modulus = 0.0;                    ///< k_n h of the pair [Pa]
    double shear_ratio = 1.0;                ///< k_s/k_n [-]
    double shear_stiffness = 0.0;            ///< fibre: K_0; its k_n is normal_stiffness or 0 [Pa/m]
    std::optional<double> bond_radius;       ///< parallel and point bonds [m]
    std::optional<double> weibull_modulus;
    std::optional<double> weibull_area;  ///< [m^2]; else the mean face of this rule
    bool weibull_scales_energy = true;
    std::optional<double> misorientation_angle;  ///< theta_m [rad]
    double misorientation_effect = 0.0;          ///< chi [-]
};

/// Bonds on every face that two grains share. `rule_of(a, b)` names the rule of a pair of bodies, nullptr: no bond.
/// `sites` and `grains`: of each body, in order of index. Scatter follows from the seed and the pair of ids alone.
/// `patches`: of fibres' surfaces, besides. @return number of bonds made
int bond_shared_faces(Model& model, State& state, const std::vector<GrainSpec>& grains, std::int64_t seed,
                      const std::function<const BondRule*(int, int)>& rule_of, std::vector<SharedFace> patches = {});

/// The same for faces between bodies where they are now, sorted by pair. `distance`: of the two sites across a face
/// [m].
int bond_faces(Model& model, State& state, const std::vector<SharedFace>& faces,
               const std::function<double(const SharedFace&)>& distance, std::int64_t seed,
               const std::function<const BondRule*(int, int)>& rule_of);

/// Weibull factor of one face: (A_0/A)^(1/m) (-ln U)^(1/m), clipped to [0.2, 3] of its mean.
double weibull_factor(double u, double modulus, double area, double reference_area);

}  // namespace grainfrac
