// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bond_faces.h"
#include "io/results.h"

#include <algorithm>
#include <numbers>

namespace grainfrac {

namespace {

CrackFace crack_of(const State& state, int a, int b, BondFace face, CrackCause cause)
{
    CrackFace crack;
    crack.polygon = std::move(face.polygon);
    crack.cause = static_cast<int>(cause);
    crack.area = face.area;
    crack.normal = face.normal;
    crack.opening = face.opening;
    crack.grain_a = state.bodies.id[a];
    crack.grain_b = state.bodies.id[b];
    return crack;
}

}  // namespace

std::vector<CrackFace> collect_cracks(const Model&, const State& state)
{
    std::vector<CrackFace> cracks;
    const InterfaceBonds& interfaces = state.interfaces;
    for (int i = 0; i < interfaces.size(); ++i) {
        const CrackCause cause = interface_cause(interfaces, i);
        if (cause == CrackCause::none) continue;
        cracks.push_back(crack_of(state, interfaces.a[i], interfaces.b[i], interface_face(state, i), cause));
        cracks.back().time = interfaces.failure_time[i];
        cracks.back().first_damage_time = interfaces.first_damage_time[i];
        cracks.back().mode = interfaces.transgranular[i];
        cracks.back().K_I = interfaces.K_I[i];
        cracks.back().K_II = interfaces.K_II[i];
    }
    const ParallelBonds& parallels = state.parallels;
    for (int i = 0; i < parallels.size(); ++i) {
        const CrackCause cause = parallel_cause(parallels, i);
        if (cause == CrackCause::none) continue;
        cracks.push_back(crack_of(state, parallels.a[i], parallels.b[i], parallel_face(state, i), cause));
        // A parallel bond breaks at once: its damage starts when it ends.
        cracks.back().time = cracks.back().first_damage_time = parallels.failure_time[i];
    }
    std::stable_sort(cracks.begin(), cracks.end(),
                     [](const CrackFace& a, const CrackFace& b) { return a.time < b.time; });
    return cracks;
}

CrackSums crack_sums(const State& state)
{
    CrackSums sums;
    const InterfaceBonds& interfaces = state.interfaces;
    for (int i = 0; i < interfaces.size(); ++i) {
        const bool through_grain = interfaces.transgranular[i] != 0;
        if (through_grain) sums.transgranular_work += interfaces.fracture_work[i];
        if (interfaces.failure_time[i] >= 0.0)
            (through_grain ? sums.transgranular_area : sums.intergranular_area) += interfaces.area[i];
    }
    const ParallelBonds& parallels = state.parallels;
    for (int i = 0; i < parallels.size(); ++i) {
        if (parallels.cause[i] != 0)
            sums.intergranular_area += std::numbers::pi * parallels.radius[i] * parallels.radius[i];
    }
    return sums;
}

}  // namespace grainfrac
