// SPDX-License-Identifier: GPL-3.0-or-later
// What the specimen has come to: fragments, each one body, and the clusters that bonds still hold together.
#pragma once

#include "io/results.h"

#include <filesystem>
#include <vector>

namespace grainfrac {

/// Size and shape of a body or of a cluster.
struct PieceShape {
    double mass = 0.0;     ///< [kg]
    double volume = 0.0;   ///< of solid [m^3]
    double surface = 0.0;  ///< [m^2]
    Vec3 axes;             ///< full axes of the ellipsoid with this mass and inertia, longest first [m]

    /// Of the ball of equal volume [m].
    double equivalent_diameter() const;
    /// Middle over longest axis (Zingg 1935) [-].
    double elongation() const { return axes.x > 0.0 ? axes.y / axes.x : 0.0; }
    /// Shortest over middle axis (Zingg 1935) [-].
    double flatness() const { return axes.y > 0.0 ? axes.z / axes.y : 0.0; }
    /// Surface of the ball of equal volume over the surface (Wadell 1932); 1 for a ball [-].
    double sphericity() const;

    template <class Visit>
    void for_each_column(Visit&& visit) const
    {
        visit("mass", "kg", mass);
        visit("volume", "m^3", volume);
        visit("surface", "m^2", surface);
        visit("equivalent_diameter", "m", equivalent_diameter());
        visit("axes", "m", axes);
        visit("elongation", "1", elongation());
        visit("flatness", "1", flatness());
        visit("sphericity", "1", sphericity());
    }
};

/// A grain, or a part of one. The tables in fragments.csv and results.h5 are both made from for_each_column:
/// visit(name, unit, value), counts and ids as integers.
struct Fragment {
    std::int32_t id = 0;
    std::int32_t parent = -1;      ///< id of what it was split from, -1 if it is whole
    std::int32_t fragment_of = 0;  ///< id of the grain that it was at the start
    std::int32_t generation = 0;   ///< splits behind it
    std::int32_t cluster = -1;     ///< as in SnapshotFields; -1: gripped by a wall
    PieceShape shape;
    std::int32_t faces = 0;  ///< of the sharp polyhedron; 0 for a sphere
    Vec3 position;           ///< of the centre of mass [m]
    Vec3 velocity;           ///< [m/s]

    template <class Visit>
    void for_each_column(Visit&& visit) const
    {
        visit("id", "1", id);
        visit("parent", "1", parent);
        visit("fragment_of", "1", fragment_of);
        visit("generation", "1", generation);
        visit("cluster", "1", cluster);
        shape.for_each_column(visit);
        visit("faces", "1", faces);
        visit("position", "m", position);
        visit("velocity", "m/s", velocity);
    }
};

/// What bonds hold together.
struct Cluster {
    std::int32_t cluster = 0;    ///< as in SnapshotFields
    std::int32_t fragments = 0;  ///< bodies in it
    PieceShape shape;            ///< surface: without the faces that hold
    Vec3 position;               ///< of the centre of mass [m]
    Vec3 velocity;               ///< of the centre of mass [m/s]

    template <class Visit>
    void for_each_column(Visit&& visit) const
    {
        visit("cluster", "1", cluster);
        visit("fragments", "1", fragments);
        shape.for_each_column(visit);
        visit("position", "m", position);
        visit("velocity", "m/s", velocity);
    }
};

/// One entry per grain or part of a grain, gripped ones among them, in the order of their ids.
std::vector<Fragment> collect_fragments(const Model& model, const State& state, const SnapshotFields& fields);
/// One entry per cluster of free bodies, in the order of their numbers.
std::vector<Cluster> collect_clusters(const Model& model, const State& state, const SnapshotFields& fields);

/// fragments.csv and clusters.csv in `folder`.
void write_fragment_tables(const std::filesystem::path& folder, const RunFacts& facts,
                           const std::vector<Fragment>& fragments, const std::vector<Cluster>& clusters);

}  // namespace grainfrac
