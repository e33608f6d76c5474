// SPDX-License-Identifier: GPL-3.0-or-later
// Contact shapes: convex cores dilated by a radius. A sphere is one vertex, a cylinder one edge, a grain its eroded
// polyhedron; nothing else in the code knows which is which.
#pragma once

#include "geometry/polyhedron.h"
#include "gpu/buffer.h"

#include <cstdint>
#include <vector>

namespace grainfrac {

struct Edge {
    std::int32_t from = 0, to = 0;  ///< vertex indices within the shape
};

/// All shapes, end to end; shape s owns the entries [begin[s], begin[s+1]) of each kind. Positions are in the body
/// frame (origin at the centre of mass, principal axes).
struct Shapes {
    Buffer<double> radius;           ///< dilation radius rho [m]
    Buffer<double> bounding_radius;  ///< of the dilated body about its centre of mass [m]
    Buffer<double> point_area;       ///< reference area of point contacts; 0 where the shape has no face [m^2]
    Buffer<double> largest_face;     ///< area of the core's largest face, point_area for round shapes [m^2]
    Buffer<std::int32_t> vertex_begin, edge_begin, face_begin;
    Buffer<Vec3> vertices;  ///< [m]
    Buffer<Edge> edges;
    Buffer<Vec3> face_normals;        ///< unit outward [-]
    Buffer<double> face_offsets;      ///< of the core's faces [m]
    Buffer<std::int32_t> loop_begin;  ///< per face, into loops; one more entry at the end
    Buffer<std::int32_t> loops;       ///< vertex indices within the shape, counter-clockwise from outside

    int size() const { return radius.size(); }

    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("radius", radius);
        visit("bounding_radius", bounding_radius);
        visit("point_area", point_area);
        visit("largest_face", largest_face);
        visit("vertex_begin", vertex_begin);
        visit("edge_begin", edge_begin);
        visit("face_begin", face_begin);
        visit("vertices", vertices);
        visit("edges", edges);
        visit("face_normals", face_normals);
        visit("face_offsets", face_offsets);
        visit("loop_begin", loop_begin);
        visit("loops", loops);
    }
};

/// Vertices an engine of one contact may have to hold in registers; more is refused when a shape is added, since the
/// manifold clips faces in fixed-size arrays.
inline constexpr int max_face_vertices = 24;

/// Append a polyhedral core (body frame); returns the shape's index. Throws std::invalid_argument for a face with more
/// than max_face_vertices vertices.
int add_shape(Shapes& shapes, const Polyhedron& core, double radius);
/// A ball that is a wall: its contacts take their reference area from the other body.
int add_sphere_shape(Shapes& shapes, double radius);
/// A ball that is a particle: its section is the reference area of its contacts.
int add_ball_shape(Shapes& shapes, double radius);
/// A cylinder with rounded ends along `axis` (body frame): the one-edge core of full length `length`.
int add_cylinder_shape(Shapes& shapes, const Vec3& axis, double length, double radius);

/// What kernels see.
struct ShapesView {
    View<const double> radius, bounding_radius, point_area;
    View<const std::int32_t> vertex_begin, edge_begin, face_begin;
    View<const Vec3> vertices;
    View<const Edge> edges;
    View<const Vec3> face_normals;
    View<const double> face_offsets;
    View<const std::int32_t> loop_begin, loops;

    /// One corner, its centre of mass.
    GF_FN bool is_ball(int shape) const { return vertex_begin[shape + 1] - vertex_begin[shape] == 1; }
};
ShapesView view(const Shapes& shapes, Device device);

}  // namespace grainfrac
