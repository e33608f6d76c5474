// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mass_properties.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

/// Products of inertia below this share of the trace are round-off: the frame counts as principal.
constexpr double principal_tolerance = 1e-12;

/// Eigenvectors as columns of a proper rotation; the largest component of the first two is positive, so that the same
/// shape always gets the same frame.
void set_principal_frame(MassProperties& m)
{
    const Mat3& inertia = m.inertia;
    const double scale = trace(inertia);
    const double products = std::max({std::fabs(inertia[0].y), std::fabs(inertia[0].z), std::fabs(inertia[1].z)});
    if (products <= principal_tolerance * scale) {
        m.principal_inertia = {inertia[0].x, inertia[1].y, inertia[2].z};
        m.principal_axes = {};
        return;
    }
    Eigen::Matrix3d a;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a(i, j) = inertia[i][j] / scale;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a);
    Eigen::Matrix3d axes = solver.eigenvectors();
    for (int j = 0; j < 2; ++j) {
        int largest = 0;
        axes.col(j).cwiseAbs().maxCoeff(&largest);
        if (axes(largest, j) < 0.0) axes.col(j) *= -1.0;
    }
    axes.col(2) = axes.col(0).cross(axes.col(1));
    Mat3 r;
    for (int i = 0; i < 3; ++i) r[i] = {axes(i, 0), axes(i, 1), axes(i, 2)};
    m.principal_axes = from_matrix(r);
    m.principal_inertia = scale * Vec3{solver.eigenvalues()[0], solver.eigenvalues()[1], solver.eigenvalues()[2]};
}

double volume_of(const Polyhedron& p)
{
    double six_volumes = 0.0;
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        const std::vector<Vec3> polygon = face_polygon(p, static_cast<int>(f));
        six_volumes += 2.0 * dot(area_vector(polygon), polygon[0] - p.vertices[0]);
    }
    return six_volumes / 6.0;
}

}  // namespace

MassProperties mass_properties(const Polyhedron& p)
{
    MassProperties m;
    if (p.vertices.empty()) return m;
    Vec3 origin;
    for (const Vec3& v : p.vertices) origin += v;
    origin *= 1.0 / static_cast<double>(p.vertices.size());

    // signed tetrahedra (0, a, b, c): v = a.(b x c)/6, int x = v s/4, int xx^T = v/20 (aa + bb + cc + ss), s = a + b +
    // c
    Vec3 first;
    Mat3 second;
    for (const auto& face : p.faces) {
        const auto vertex = [&](std::size_t k) { return p.vertices[static_cast<std::size_t>(face[k])] - origin; };
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            const Vec3 a = vertex(0), b = vertex(k), c = vertex(k + 1), s = a + b + c;
            const double v = dot(a, cross(b, c)) / 6.0;
            m.volume += v;
            first += (0.25 * v) * s;
            second =
                second + (v / 20.0) * (Mat3::outer(a, a) + Mat3::outer(b, b) + Mat3::outer(c, c) + Mat3::outer(s, s));
        }
    }
    const Vec3 c = first / m.volume;
    m.centroid = origin + c;
    m.euler = second - m.volume * Mat3::outer(c, c);
    m.inertia = trace(m.euler) * Mat3::identity() - m.euler;
    set_principal_frame(m);
    return m;
}

double dilated_volume(const Polyhedron& core, double radius)
{
    // sum of l_e theta_e over the edges, theta_e the angle between the outward normals of the two faces
    std::map<std::pair<int, int>, std::size_t> face_of;
    for (std::size_t f = 0; f < core.faces.size(); ++f) {
        const auto& face = core.faces[f];
        for (std::size_t k = 0; k < face.size(); ++k) face_of[{face[k], face[(k + 1) % face.size()]}] = f;
    }
    double edges = 0.0;
    for (const auto& [edge, f] : face_of) {
        if (edge.first > edge.second) continue;
        const auto twin = face_of.find({edge.second, edge.first});
        if (twin == face_of.end()) continue;
        const Vec3 &a = core.planes[f].normal, &b = core.planes[twin->second].normal;
        const double angle = std::atan2(norm(cross(a, b)), dot(a, b));
        edges += angle * norm(core.vertices[static_cast<std::size_t>(edge.first)] -
                              core.vertices[static_cast<std::size_t>(edge.second)]);
    }
    return volume_of(core) + surface_area(core) * radius + 0.5 * radius * radius * edges +
           4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

}  // namespace grainfrac
