// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/fibre_in_grains.h"

#include "geometry/gjk.h"
#include "model/views.h"

#include <cmath>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

/// Samples of a node's surface: around and along.
constexpr int around = 72, along = 16;

struct Grain {
    int body;
    PlacedCore core;
    double rounding;  ///< [m]
    double reach;     ///< bounding radius [m]
};

std::vector<Grain> placed(const Model& model, const State& state, const std::vector<int>& bodies)
{
    const ShapesView shapes = view(model.shapes, Device::cpu);
    std::vector<Grain> grains;
    for (const int i : bodies) {
        const std::int32_t s = state.bodies.shape[i];
        grains.push_back(
            {i,
             {shapes.vertices.data + shapes.vertex_begin[s], shapes.vertex_begin[s + 1] - shapes.vertex_begin[s],
              state.bodies.position[i], state.bodies.orientation[i]},
             shapes.radius[s],
             shapes.bounding_radius[s]});
    }
    return grains;
}

/// The nearest grain that the way outwards from a point of the surface runs into, -1: none within `farthest`.
int grain_beside(const Vec3& x, const Vec3& outward, double farthest, const std::vector<Grain>& grains)
{
    const Vec3 way[2] = {{}, farthest * outward};
    int nearest = -1;
    double least = farthest;
    for (const Grain& g : grains) {
        const Vec3 to_grain = g.core.position - x;
        if (norm(to_grain) > g.reach + farthest) continue;
        const double distance = closest_points(PlacedCore{way, 1, x, Quat{}}, g.core, to_grain).distance - g.rounding;
        if (nearest >= 0 ? distance >= least : distance > least) continue;
        if (closest_points(PlacedCore{way, 2, x, Quat{}}, g.core, to_grain).distance > g.rounding) continue;
        least = distance;
        nearest = g.body;
    }
    return nearest;
}

struct Share {
    int samples = 0;
    Vec3 outward;  // sum of the samples' normals
};

}  // namespace

std::vector<SharedFace> grain_patches(const Model& model, const State& state, const FibreChain& chain,
                                      const std::vector<int>& bodies)
{
    std::vector<SharedFace> faces;
    const std::vector<Grain> grains = placed(model, state, bodies);
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
        const Vec3 t = fibre_tangent(state, chain.nodes, k), node = state.bodies.position[chain.nodes[k]];
        const double back = chain.reach_back(k), piece = back + chain.reach_on(k);
        std::vector<Grain> near;
        for (const Grain& g : grains) {
            if (norm(g.core.position - node) < g.reach + 2.0 * chain.radius + piece) near.push_back(g);
        }
        const Vec3 e1 = any_perpendicular(t), e2 = cross(t, e1);
        std::map<int, Share> shares;
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.5) / around;
            const Vec3 outward = std::cos(angle) * e1 + std::sin(angle) * e2;
            for (int j = 0; j < along; ++j) {
                const Vec3 x = node + chain.radius * outward + ((j + 0.5) / along * piece - back) * t;
                const int body = grain_beside(x, outward, chain.radius, near);
                if (body < 0) continue;
                ++shares[body].samples;
                shares[body].outward += outward;
            }
        }
        for (const auto& [body, share] : shares) {
            if (norm(share.outward) < 1e-6) continue;  // all around: no direction of its own
            const Vec3 outward = normalized(tangential(share.outward, t));
            const double width = 2.0 * std::numbers::pi * chain.radius * share.samples / (around * along);
            faces.push_back(fibre_patch(chain.nodes[k], body, node + chain.radius * outward, outward, t, piece, width));
        }
    }
    return faces;
}

bool grains_reach_in(const Model& model, const State& state, const FibreChain& chain, const std::vector<int>& bodies)
{
    constexpr double touching = 1e-6;  // of the radius: no more than touching, to round-off
    const std::vector<Grain> grains = placed(model, state, bodies);
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
        const bool last = k + 1 == chain.nodes.size();
        const Vec3 node = state.bodies.position[chain.nodes[k]];
        const Vec3 way[2] = {{}, last ? Vec3{} : state.bodies.position[chain.nodes[k + 1]] - node};
        const PlacedCore piece{way, last ? 1 : 2, node, Quat{}};
        const double radius = model.shapes.bounding_radius[state.bodies.shape[chain.nodes[k]]];
        for (const Grain& g : grains) {
            const Vec3 to_grain = g.core.position - node;
            if (norm(to_grain) > g.reach + radius + norm(way[1])) continue;
            if (closest_points(piece, g.core, to_grain).distance < g.rounding + radius * (1.0 - touching)) return true;
        }
    }
    return false;
}

}  // namespace grainfrac
