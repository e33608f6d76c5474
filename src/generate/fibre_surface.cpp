// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/fibre_surface.h"

#include "generate/fibre_in_grains.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace grainfrac {

namespace {

/// Spheres count as the innermost ring up to this share of their diameter beyond the nearest one. What is farther from
/// the axis moves less with the fibre, by tau a ln(r/a)/G: patches at different distances bear different shear. Where
/// that leaves more than `widest_gap` without a sphere, as in packings without order, up to the wider share; with more
/// the fibre would be tied to spheres that lie behind others.
constexpr double ring_width = 0.2, wide_ring = 0.35;
constexpr double widest_gap = 2.0 * std::numbers::pi / 3.0 * (1.0 + 1e-6);  // [rad]
/// Centres whose line is tilted less than this against the plane across the fibre are side by side.
constexpr double side_by_side = 1e-6;

/// A sphere of the matrix beside a node.
struct Neighbour {
    int body = -1;
    Vec3 place;             // of the patch [m]
    Vec3 outward;           // unit, from the axis
    double distance = 0.0;  // from the axis [m]
    double angle = 0.0;     // about it [rad]
    double share = 0.0;     // of the circle [rad]
    double width = 0.0;     // of the ring that it may count to [m]
    double size = 0.0;      // of the sphere [m]
    double along = 0.0;     // the fibre, from the node [m]
};

/// Rectangle about `center`, its normal from a to b.
std::vector<Vec3> rectangle(const Vec3& center, const Vec3& normal, const Vec3& along, double length, double width)
{
    const Vec3 u = 0.5 * length * along, v = 0.5 * width * cross(normal, along);
    return {center - u - v, center + u - v, center + u + v, center - u + v};
}

}  // namespace

Vec3 fibre_tangent(const State& state, const std::vector<int>& nodes, std::size_t k)
{
    const std::size_t before = k > 0 ? k - 1 : k, after = k + 1 < nodes.size() ? k + 1 : k;
    return normalized(state.bodies.position[nodes[after]] - state.bodies.position[nodes[before]]);
}

SharedFace fibre_patch(int fibre, int matrix, const Vec3& center, const Vec3& outward, const Vec3& along, double length,
                       double width)
{
    SharedFace f;
    f.a = std::min(fibre, matrix);
    f.b = std::max(fibre, matrix);
    f.normal = f.a == fibre ? outward : -outward;
    const Vec3 square = normalized(tangential(along, f.normal));
    f.polygon = rectangle(center, f.normal, square, length, width);
    return f;
}

namespace {

class Ring {
public:
    Ring(const Model& model, const State& state, const FibreChain& chain)
        : model_(model), state_(state), chain_(chain), around_(chain.nodes.size())
    {
    }

    void add_sphere(int body)
    {
        const Vec3 x = state_.bodies.position[body];
        std::size_t nearest = 0;
        double least = 1e300;
        for (std::size_t k = 0; k < chain_.nodes.size(); ++k) {
            const double d = norm2(x - state_.bodies.position[chain_.nodes[k]]);
            if (d < least * (1.0 - 1e-12)) {
                least = d;
                nearest = k;
            }
        }
        const double size = 2.0 * model_.shapes.radius[state_.bodies.shape[body]];
        add(nearest, body, x, wide_ring * size, size);
    }

    std::vector<SharedFace> patches()
    {
        for (std::vector<Neighbour>& ring : around_) {
            if (ring.empty()) continue;
            double least = 1e300;
            for (const Neighbour& n : ring) least = std::min(least, n.distance);
            const auto within = [&](double share) {
                std::vector<Neighbour> near;
                for (const Neighbour& n : ring) {
                    if (n.distance <= least + share * n.width) near.push_back(n);
                }
                return near;
            };
            std::vector<Neighbour> near = within(ring_width / wide_ring);
            ring = within(share_circle(near) > widest_gap ? 1.0 : ring_width / wide_ring);
            share_circle(ring);
        }
        const std::vector<double> length = covered();
        std::vector<SharedFace> faces;
        for (std::size_t k = 0; k < around_.size(); ++k) {
            for (const Neighbour& n : around_[k]) {
                faces.push_back(fibre_patch(chain_.nodes[k], n.body, n.place, n.outward,
                                            fibre_tangent(state_, chain_.nodes, k), length[k],
                                            n.share * chain_.radius));
            }
        }
        return faces;
    }

private:
    void add(std::size_t k, int body, const Vec3& place, double width, double size)
    {
        const Vec3 t = fibre_tangent(state_, chain_.nodes, k), from = place - state_.bodies.position[chain_.nodes[k]];
        const double along = dot(from, t), slack = 1e-9 * chain_.whole;
        if (along < -chain_.reach_back(k) - slack || along > chain_.reach_on(k) + slack) return;
        const Vec3 across = tangential(from, t);
        const double r = norm(across);
        if (r == 0.0 || r > chain_.radius + size) return;
        const Vec3 e1 = any_perpendicular(t), e2 = cross(t, e1);
        around_[k].push_back({body, place, across * (1.0 / r), r, std::atan2(dot(across, e2), dot(across, e1)), 0.0,
                              width, size, along});
    }

    /// Length of fibre of each node's patches: half-way to the next node that has some; beyond the last one as far as
    /// its spheres reach, a layer half its distance to the next.
    std::vector<double> covered() const
    {
        std::vector<std::size_t> tied;  // nodes that have some
        for (std::size_t k = 0; k < around_.size(); ++k) {
            if (!around_[k].empty()) tied.push_back(k);
        }
        std::vector<double> gap(tied.size(), 0.0);  // to the next one; 0: too far, the matrix has a hole there
        double sum = 0.0;
        int layers = 0;
        for (std::size_t i = 0; i + 1 < tied.size(); ++i) {
            const std::size_t k = tied[i], l = tied[i + 1];
            const double size = std::max(around_[k].front().size, around_[l].front().size);
            const double way = chain_.way[l] - chain_.way[k];
            if (way > (chain_.reach_on(k) + chain_.reach_back(l) + size) * (1.0 + 1e-9)) continue;
            gap[i] = way;
            sum += way + middle(around_[l]) - middle(around_[k]);
            ++layers;
        }
        std::vector<double> length(around_.size(), 0.0);
        for (std::size_t i = 0; i < tied.size(); ++i) {
            const std::size_t k = tied[i];
            const std::vector<Neighbour>& ring = around_[k];
            const auto beyond = [&](double place, double left) {
                const double reach = 0.5 * ring.front().size;
                return std::clamp(place + (layers > 0 ? std::min(reach, 0.5 * sum / layers) : reach), 0.0, left);
            };
            const bool goes_back = i > 0 && gap[i - 1] > 0.0, goes_on = gap[i] > 0.0;
            length[k] = (goes_back ? 0.5 * gap[i - 1] : beyond(-middle(ring), chain_.way[k])) +
                        (goes_on ? 0.5 * gap[i] : beyond(middle(ring), chain_.whole - chain_.way[k]));
        }
        return length;
    }

    /// Place of a ring along the fibre, from its node [m].
    static double middle(const std::vector<Neighbour>& ring)
    {
        double sum = 0.0;
        for (const Neighbour& n : ring) sum += n.along;
        return sum / static_cast<double>(ring.size());
    }

    /// Half the way to the next on either side; returns the widest gap [rad].
    static double share_circle(std::vector<Neighbour>& ring)
    {
        constexpr double turn = 2.0 * std::numbers::pi;
        std::sort(ring.begin(), ring.end(), [](const Neighbour& x, const Neighbour& y) { return x.angle < y.angle; });
        const std::size_t n = ring.size();
        double widest = n < 2 ? turn : 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            double next = ring[(i + 1) % n].angle - ring[i].angle;
            if (next <= 0.0) next += turn;
            widest = std::max(widest, next);
            double gap = ring[(i + 1) % n].angle - ring[(i + n - 1) % n].angle;
            if (gap <= 0.0) gap += turn;
            ring[i].share = n < 3 ? turn / static_cast<double>(n) : 0.5 * gap;
        }
        return widest;
    }

    const Model& model_;
    const State& state_;
    const FibreChain& chain_;
    std::vector<std::vector<Neighbour>> around_;  // of each node
};

}  // namespace

std::vector<SharedFace> chain_patches(const Model& model, const State& state, const FibreChain& chain,
                                      const std::vector<char>& is_matrix)
{
    Ring ring(model, state, chain);
    std::vector<int> grains;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (is_matrix[static_cast<std::size_t>(i)] == 0) continue;
        if (is_sphere(model, state.bodies, i))
            ring.add_sphere(i);
        else
            grains.push_back(i);
    }
    std::vector<SharedFace> faces = ring.patches();
    const std::vector<SharedFace> of_grains = grain_patches(model, state, chain, grains);
    faces.insert(faces.end(), of_grains.begin(), of_grains.end());
    return faces;
}

std::vector<SharedFace> lattice_patches(const State& state, const FibreLattice& fibre,
                                        const std::vector<std::pair<int, int>>& pairs)
{
    std::vector<SharedFace> faces;
    const auto from_axis = [&](int i) { return tangential(state.bodies.position[i] - fibre.center, fibre.axis); };
    for (const auto& [inner, outer] : pairs) {
        const Vec3 x = state.bodies.position[inner], y = state.bodies.position[outer], branch = normalized(y - x);
        if (fibre.same_level && std::fabs(dot(branch, fibre.axis)) > side_by_side) continue;
        if (norm(from_axis(outer)) <= fibre.radius) continue;  // before the fibre's end, not beside it
        const Vec3 middle = 0.5 * (x + y);
        const Vec3 radial = normalized(from_axis(inner) + from_axis(outer));
        faces.push_back(fibre_patch(inner, outer, middle, fibre.radial ? radial : branch, fibre.axis, 1.0, 1.0));
    }
    const double area = 2.0 * std::numbers::pi * fibre.radius * fibre.length / static_cast<double>(faces.size());
    for (SharedFace& f : faces) {
        const Vec3 c = 0.25 * (f.polygon[0] + f.polygon[1] + f.polygon[2] + f.polygon[3]);
        for (Vec3& x : f.polygon) x = c + std::sqrt(area) * (x - c);
    }
    return faces;
}

}  // namespace grainfrac
