// SPDX-License-Identifier: GPL-3.0-or-later
// Grains cut in two along a plane: bodies, boundary interfaces and contacts of the parts, and the new surface.
#pragma once

#include "geometry/cut.h"
#include "geometry/quadrature.h"
#include "model/model.h"
#include "model/state.h"

#include <cstdint>
#include <vector>

namespace grainfrac {

/// What the new surface is, and what a split may make.
struct SplitRules {
    bool cohesive = true;           ///< the new surface keeps the traction that the plane carried; false: free
    std::int32_t law = 0;           ///< of the new surface, into Model::interface_laws
    double normal_stiffness = 0.0;  ///< k_n per area [Pa/m]
    double shear_stiffness = 0.0;   ///< k_s per area [Pa/m]
    double damping = 0.0;           ///< zeta of the new surface [-]
    QuadratureRule quadrature = QuadratureRule::automatic;
    double least_volume = 0.02;         ///< of a part, over the volume of the grain at the start [-]
    double least_inradius = 3.0;        ///< of a part, over the parent's dilation radius [-]
    double least_section = 0.02;        ///< area of the plane over the parent's surface [-]
    std::int32_t most_generations = 2;  ///< splits that a part may have behind it [-]
};

/// One grain and the plane n . x = d that splits it, in space. Part 1 is where n . x > d.
struct SplitRequest {
    std::int32_t body = -1;
    Plane plane;
    SplitRules rules;
    int candidate = 0;             ///< which of the grain's planes this is: what a refusal is remembered under
    double K_I = 0.0, K_II = 0.0;  ///< of the flaw, for the results [Pa sqrt(m)]
};

enum class SplitStatus {
    done,
    generation,     ///< it has been split too often
    small_part,     ///< a part would have too little volume
    thin_part,      ///< a part would be too thin for its dilation radius
    small_section,  ///< the plane only chips the grain
    outside,        ///< the plane misses the grain
    degenerate,     ///< the cut is not clean: a part would be no closed convex polyhedron
};
const char* to_string(SplitStatus status);

struct SplitReport {
    SplitStatus status = SplitStatus::outside;
    std::int32_t body = -1;      ///< index of part 2: that of the parent
    std::int32_t new_body = -1;  ///< index of part 1; -1 unless done
    std::int32_t parent_id = -1;
    double area = 0.0;             ///< of the plane within the grain [m^2]
    double inserted_energy = 0.0;  ///< W_ins: what the new surface holds without work done [J]
};

/// Planes of a grain that refusals can be told apart of.
inline constexpr int most_candidates = 63;
/// The bit of Bodies::saturated for a candidate plane.
inline std::int64_t candidate_bit(int candidate)
{
    return std::int64_t{1} << candidate;
}

/// Whether a grain (sharp, dilated by `radius`) may be parted by this cut; `done` if so. `whole_volume`: of the grain
/// at the start [m^3].
SplitStatus why_not_parted(const Polyhedron& grain, const CutResult& cut, double radius, double whole_volume,
                           const SplitRules& rules);
/// Whether the grain may be split by the plane; what `split_grains` would report.
SplitStatus why_not_split(const Model& model, const State& state, const SplitRequest& request);

/// Split grains (at most one plane per body; in the order of the bodies, whatever the order of the requests) and bring
/// the forces up to date, so that the next step finds everything as after a step. Mass, first moment, momenta and
/// kinetic energy are kept; a cohesive surface also keeps the accelerations.
/// Sources: Saleme Ruiz 2016, ch. 3, for the cut; cohesive surface with inherited traction: Papoulia, Sam & Vavasis
/// 2003.
std::vector<SplitReport> split_grains(Model& model, State& state, std::vector<SplitRequest> requests);

}  // namespace grainfrac
