// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/spread_supports.h"

#include "gpu/parallel.h"
#include "motion/least_norm.h"

namespace grainfrac {

namespace {

/// A body of the face: its share of it times 1 and two lengths across the direction, where it was at the start.
struct FacePlace {
    View<const std::int32_t> bodies;
    View<const double> area;
    Vec3 across_1, across_2;
    View<const Vec3> start;

    GF_FN double operator()(int j, int k) const
    {
        return area[j] * (k == 0 ? 1.0 : dot(start[bodies[j]], k == 1 ? across_1 : across_2));
    }
};

struct Moment {
    FacePlace place;
    int k;
    Vec3 direction;
    View<const Vec3> force;
    View<const double> inverse_mass;
    GF_FN double operator()(int j) const
    {
        const int i = place.bodies[j];
        return inverse_mass[i] * place(j, k) * dot(force[i], direction);
    }
};

struct Mobility {
    FacePlace place;
    int k, l;
    View<const double> inverse_mass;
    GF_FN double operator()(int j) const { return inverse_mass[place.bodies[j]] * place(j, k) * place(j, l); }
};

struct AddForce {
    static constexpr const char* name = "spread support";
    FacePlace place;
    Vec3 direction;
    double share[3];
    View<Vec3> force;
    GF_FN void operator()(int j) const
    {
        double f = 0.0;
        for (int k = 0; k < 3; ++k) f += share[k] * place(j, k);
        force[place.bodies[j]] += f * direction;
    }
};

}  // namespace

void spread_support_forces(const Model& model, State& state)
{
    const int n = model.spread_bodies.size();
    if (n == 0) return;
    const Device d = model.device;
    Bodies& b = state.bodies;
    const Vec3 along = model.spread_direction, e1 = any_perpendicular(along), e2 = cross(along, e1);
    const FacePlace place{model.spread_bodies.read(d), model.spread_area.read(d), e1, e2, b.start_position.read(d)};
    double A[3][3], r[3];
    for (int k = 0; k < 3; ++k) {
        r[k] = -parallel_sum(d, n, Moment{place, k, along, b.force.read(d), b.inverse_mass.read(d)});
        for (int l = 0; l <= k; ++l)
            A[k][l] = A[l][k] = parallel_sum(d, n, Mobility{place, k, l, b.inverse_mass.read(d)});
    }
    if (A[0][0] == 0.0) return;
    const std::array<double, 3> share = least_norm_solution(A, r);  // the bodies may lie on one line
    parallel_for(d, n, AddForce{place, along, {share[0], share[1], share[2]}, b.force.write(d)});
}

}  // namespace grainfrac
