// SPDX-License-Identifier: GPL-3.0-or-later
// Largest inscribed ball: maximise R subject to n_f . x + R <= d_f, a linear program in (x, R), by an active-set method
// that starts at the mean of the vertices. It moves along the projection of the objective onto the faces that hold the
// ball, takes up the face it meets, and lets go of a face that pulls (Bland's rule: the first such one, no cycling).
#include "geometry/polyhedron.h"

#include <Eigen/Dense>

#include <algorithm>

namespace grainfrac {

namespace {

/// Slopes below this are round-off: faces this close to parallel with the motion do not stop it. Larger loses accuracy
/// of the centre on cells with nearly parallel faces, smaller lets singular active sets in.
constexpr double slope_tolerance = 1e-10;
/// Multipliers above minus this count as pushing.
constexpr double multiplier_tolerance = 1e-12;
/// Active-set steps per face before the best ball so far is returned; a handful is usual.
constexpr int steps_per_face = 20;

Eigen::Vector4d row_of(const Plane& plane)
{
    return {plane.normal.x, plane.normal.y, plane.normal.z, 1.0};
}

}  // namespace

InscribedBall inscribed_ball(const Polyhedron& p)
{
    const double size = bounding_size(p);
    if (p.faces.empty() || !(size > 0.0)) return {};
    Vec3 origin;
    for (const Vec3& v : p.vertices) origin += v;
    origin *= 1.0 / static_cast<double>(p.vertices.size());

    // lengths over the size, positions from the origin, so that tolerances are pure numbers
    const auto room = [&](int f) {
        const Plane& plane = p.planes[static_cast<std::size_t>(f)];
        return (plane.offset - dot(plane.normal, origin)) / size;
    };
    const int n = static_cast<int>(p.planes.size());
    Eigen::Vector4d ball = Eigen::Vector4d::Zero();
    std::vector<int> active{0};
    for (int f = 1; f < n; ++f)
        if (room(f) < room(active[0])) active[0] = f;
    ball[3] = room(active[0]);

    for (int step = 0; step < steps_per_face * n; ++step) {
        Eigen::Matrix<double, Eigen::Dynamic, 4, 0, 4, 4> rows(static_cast<int>(active.size()), 4);
        for (std::size_t i = 0; i < active.size(); ++i)
            rows.row(static_cast<int>(i)) = row_of(p.planes[static_cast<std::size_t>(active[i])]).transpose();
        const Eigen::Vector4d objective = Eigen::Vector4d::UnitW();
        const Eigen::VectorXd multipliers = (rows * rows.transpose()).eval().ldlt().solve(rows * objective);
        const Eigen::Vector4d direction = objective - rows.transpose() * multipliers;
        if (active.size() == 4 || direction.norm() < slope_tolerance) {
            int drop = -1;
            for (std::size_t i = 0; i < active.size(); ++i)
                if (multipliers[static_cast<int>(i)] < -multiplier_tolerance &&
                    (drop < 0 || active[i] < active[static_cast<std::size_t>(drop)]))
                    drop = static_cast<int>(i);
            if (drop < 0) break;
            active.erase(active.begin() + drop);
            continue;
        }
        int stop = -1;
        double length = 0.0;
        for (int f = 0; f < n; ++f) {
            if (std::find(active.begin(), active.end(), f) != active.end()) continue;
            const Eigen::Vector4d row = row_of(p.planes[static_cast<std::size_t>(f)]);
            const double slope = row.dot(direction);
            if (slope <= slope_tolerance) continue;
            const double reach = std::max(0.0, room(f) - row.dot(ball)) / slope;
            if (stop < 0 || reach < length) {
                stop = f;
                length = reach;
            }
        }
        if (stop < 0) break;  // unbounded: not a closed polyhedron
        ball += length * direction;
        active.push_back(stop);
    }

    const Vec3 center = origin + size * Vec3{ball[0], ball[1], ball[2]};
    double radius = size;
    for (const Plane& plane : p.planes) radius = std::min(radius, plane.offset - dot(plane.normal, center));
    return {center, radius};
}

}  // namespace grainfrac
