// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/spread_supports.h"

#include "gpu/parallel.h"
#include "motion/least_norm.h"

namespace grainfrac {

namespace {

/// Coordinates of a body on the face: 1 and two lengths across the direction, where it was at the start.
struct FacePlace {
    int which;
    Vec3 across_1, across_2;
    View<const std::int32_t> wall;
    View<const Vec3> start;

    GF_FN bool has(int i) const { return wall[i] == which; }
    GF_FN double operator()(int i, int k) const { return k == 0 ? 1.0 : dot(start[i], k == 1 ? across_1 : across_2); }
};

struct Moment {
    FacePlace place;
    int k;
    Vec3 direction;
    View<const Vec3> force;
    View<const double> inverse_mass;
    GF_FN double operator()(int i) const
    {
        return place.has(i) ? inverse_mass[i] * place(i, k) * dot(force[i], direction) : 0.0;
    }
};

struct Mobility {
    FacePlace place;
    int k, l;
    View<const double> inverse_mass;
    GF_FN double operator()(int i) const { return place.has(i) ? inverse_mass[i] * place(i, k) * place(i, l) : 0.0; }
};

struct AddForce {
    static constexpr const char* name = "spread support";
    FacePlace place;
    Vec3 direction;
    double share[3];
    View<Vec3> force;
    GF_FN void operator()(int i) const
    {
        if (!place.has(i)) return;
        double f = 0.0;
        for (int k = 0; k < 3; ++k) f += share[k] * place(i, k);
        force[i] += f * direction;
    }
};

}  // namespace

void spread_support_forces(const Model& model, State& state)
{
    const Device d = model.device;
    Bodies& b = state.bodies;
    for (const std::int32_t w : model.spread_supports) {
        const Vec3 n = model.spread_direction, e1 = any_perpendicular(n), e2 = cross(n, e1);
        const FacePlace place{w, e1, e2, b.wall.read(d), b.start_position.read(d)};
        double A[3][3], r[3];
        for (int k = 0; k < 3; ++k) {
            r[k] = -parallel_sum(d, b.size(), Moment{place, k, n, b.force.read(d), b.inverse_mass.read(d)});
            for (int l = 0; l <= k; ++l)
                A[k][l] = A[l][k] = parallel_sum(d, b.size(), Mobility{place, k, l, b.inverse_mass.read(d)});
        }
        if (A[0][0] == 0.0) continue;
        const std::array<double, 3> share = least_norm_solution(A, r);  // the bodies may lie on one line
        parallel_for(d, b.size(), AddForce{place, n, {share[0], share[1], share[2]}, b.force.write(d)});
    }
}

}  // namespace grainfrac
