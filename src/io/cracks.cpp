// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bond_faces.h"
#include "io/results.h"

#include <algorithm>
#include <utility>

namespace grainfrac {

std::vector<CrackFace> collect_cracks(const Model&, const State& state)
{
    std::vector<CrackFace> cracks;
    for (int slot = 0; slot < state.bond_slots(); ++slot) {
        const BondFacts facts = bond_facts(state, slot);
        if (facts.cause == CrackCause::none) continue;
        BondFace face = bond_face(state, slot);
        CrackFace crack;
        crack.polygon = std::move(face.polygon);
        crack.mode = facts.transgranular ? 1 : 0;
        crack.cause = static_cast<int>(facts.cause);
        crack.time = facts.failure_time;
        crack.first_damage_time = facts.first_damage_time;
        crack.area = face.area;
        crack.normal = face.normal;
        crack.opening = face.opening;
        crack.K_I = facts.K_I;
        crack.K_II = facts.K_II;
        crack.grain_a = state.bodies.id[facts.a];
        crack.grain_b = state.bodies.id[facts.b];
        cracks.push_back(std::move(crack));
    }
    std::stable_sort(cracks.begin(), cracks.end(),
                     [](const CrackFace& a, const CrackFace& b) { return a.time < b.time; });
    return cracks;
}

CrackSums crack_sums(const State& state)
{
    CrackSums sums;
    for (int slot = 0; slot < state.bond_slots(); ++slot) {
        const BondFacts f = bond_facts(state, slot);
        if (f.transgranular) sums.transgranular_work += f.fracture_work;
        if (f.failure_time >= 0.0) (f.transgranular ? sums.transgranular_area : sums.intergranular_area) += f.area;
    }
    return sums;
}

}  // namespace grainfrac
