// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/face_moments.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Of the size of the face and its distance from the centres: points that are off by no more lie in the plane.
constexpr double round_off = 1e-13;

/// Coordinates of a point of a face, in the frame of one of its bodies.
struct FaceAxes {
    Vec3 centre, t1, t2;
    double x(const Vec3& p) const { return dot(p - centre, t1); }
    double y(const Vec3& p) const { return dot(p - centre, t2); }
    double off(const Vec3& p, double x, double y) const { return norm(p - centre - x * t1 - y * t2); }
};

}  // namespace

FaceMoments face_moments(const State& state, int i)
{
    const InterfaceBonds& f = state.interfaces;
    const InterfacePoints& p = state.points;
    FaceMoments m;
    for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
        m.area += p.weight[q];
        m.centre_a += p.weight[q] * p.position_a[q];
        m.centre_b += p.weight[q] * p.position_b[q];
    }
    if (m.area <= 0.0) return {};
    m.centre_a = m.centre_a * (1.0 / m.area);
    m.centre_b = m.centre_b * (1.0 / m.area);
    const FaceAxes a{m.centre_a, f.tangent_a[i], cross(f.normal_a[i], f.tangent_a[i])};
    const FaceAxes b{m.centre_b, f.tangent_b[i], cross(f.normal_b[i], f.tangent_b[i])};
    const double tolerance = round_off * (norm(m.centre_a) + norm(m.centre_b) + std::sqrt(m.area));
    const auto fits = [&](const Vec3& on_a, const Vec3& on_b) {
        const double x = a.x(on_a), y = a.y(on_a);
        m.reach_1 = std::max(m.reach_1, std::fabs(x));
        m.reach_2 = std::max(m.reach_2, std::fabs(y));
        return a.off(on_a, x, y) <= tolerance && b.off(on_b, x, y) <= tolerance;
    };
    for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
        if (!fits(p.position_a[q], p.position_b[q])) return {};
        const double x = a.x(p.position_a[q]), y = a.y(p.position_a[q]), w = p.weight[q];
        m.xx += w * x * x;
        m.xy += w * x * y;
        m.yy += w * y * y;
    }
    for (int c = f.corner_begin[i]; c < f.corner_begin[i + 1]; ++c) {
        if (!fits(state.corners.position_a[c], state.corners.position_b[c])) return {};
    }
    return m;
}

void find_face_moments(State& state)
{
    for (int i = 0; i < state.interfaces.size(); ++i) state.interfaces.moments.at(i) = face_moments(state, i);
}

}  // namespace grainfrac
