// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/random_packing.h"

#include "generate/lattice.h"
#include "model/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace grainfrac {

namespace {

/// Lengths in mean diameters, forces in overlaps, masses 1: then a sphere in its cage has frequencies of about 1 to 3.
constexpr double first_step = 0.05, largest_step = 0.25;
/// Pairs are looked for again when a sphere has moved half of this; of the mean diameter.
constexpr double skin = 0.15;
/// Beyond what a packing takes that exists: up to 2500 just below the densest. More show that it is out of reach.
constexpr int most_steps = 6000;
/// What a wall takes from the solid fraction, per surface over volume in diameters (of the mean volume): fitted to the
/// densest that this relaxation reaches in boxes of 5, 8, 15 and 36 diameters, 0.54, 0.57, 0.603 and 0.622.
constexpr double wall_loss = 0.083;
/// So much less is sure to be reached: seeds and ranges of sizes differ.
constexpr double packing_spread = 0.01;

struct Pair {
    int a, b;
};

/// Diameters, all between the two equally frequent.
struct SizeRange {
    double small, large;  ///< [m]
    explicit SizeRange(const RandomPackingSpec& s)
        : small(2.0 * s.diameter / (1.0 + s.size_ratio)), large(s.size_ratio * small)
    {
    }
    /// Mean of d^n.
    double mean_power(int n) const
    {
        if (large == small) return std::pow(small, n);
        return (std::pow(large, n + 1) - std::pow(small, n + 1)) / ((n + 1) * (large - small));
    }
};

/// Spheres that push each other and the walls apart in proportion to their overlaps.
class Relaxation {
public:
    Relaxation(const SphereRegion& region, std::vector<Ball>& balls, double diameter)
        : region_(region), balls_(balls), diameter_(diameter), velocity_(balls.size()), force_(balls.size())
    {
        for (const Ball& b : balls_) widest_ = std::max(widest_, 2.0 * b.radius);
    }

    /// FIRE (Bitzek et al. 2006) until no overlap is above `tolerance`; returns the largest then, or after
    /// `most_steps`. Other than there, what touches nothing stands still: flying on, it would overlap others for ever.
    double run(double tolerance)
    {
        constexpr double mixing_0 = 0.1;
        double dt = first_step, mixing = mixing_0;
        int downhill = 0;
        find_pairs();
        double overlap = forces();
        for (int step = 0; step < most_steps && overlap > tolerance; ++step) {
            double power = 0.0, v2 = 0.0, f2 = 0.0;
            for (std::size_t i = 0; i < balls_.size(); ++i) {
                velocity_[i] = norm2(force_[i]) > 0.0 ? velocity_[i] + dt * force_[i] : Vec3{};
                power += dot(force_[i], velocity_[i]);
                v2 += norm2(velocity_[i]);
                f2 += norm2(force_[i]);
            }
            const bool uphill = power <= 0.0;
            const double turn = f2 > 0.0 ? mixing * std::sqrt(v2 / f2) : 0.0;
            double fastest = 0.0;
            for (std::size_t i = 0; i < balls_.size(); ++i) {
                velocity_[i] = uphill ? Vec3{} : (1.0 - mixing) * velocity_[i] + turn * force_[i];
                balls_[i].center += dt * diameter_ * velocity_[i];
                fastest = std::max(fastest, norm2(velocity_[i]));
            }
            if (uphill) {
                dt *= 0.5;
                mixing = mixing_0;
                downhill = 0;
            } else if (++downhill > 5) {
                dt = std::min(1.1 * dt, largest_step);
                mixing *= 0.99;
            }
            travel_ += dt * std::sqrt(fastest);
            if (travel_ > 0.5 * skin) find_pairs();
            overlap = forces();
        }
        return overlap;
    }

private:
    /// Pairs nearer than the skin, by a grid whose cells are as wide as the widest sphere and the skin.
    void find_pairs()
    {
        const double margin = skin * diameter_, cell = widest_ + margin;
        const Vec3 low = region_.center - region_.half;
        int n[3];
        for (int k = 0; k < 3; ++k) n[k] = std::max(1, static_cast<int>(2.0 * region_.half[k] / cell));
        const auto cell_of = [&](const Vec3& x, int k) {
            return std::clamp(static_cast<int>((x[k] - low[k]) / (2.0 * region_.half[k]) * n[k]), 0, n[k] - 1);
        };
        const auto index = [&](int x, int y, int z) {
            const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(n[1]) + static_cast<std::size_t>(y);
            return row * static_cast<std::size_t>(n[0]) + static_cast<std::size_t>(x);
        };
        std::vector<int> begin(index(n[0] - 1, n[1] - 1, n[2] - 1) + 2), member(balls_.size());
        std::vector<std::size_t> home;
        for (const Ball& b : balls_) {
            home.push_back(index(cell_of(b.center, 0), cell_of(b.center, 1), cell_of(b.center, 2)));
            ++begin[home.back() + 1];
        }
        for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
        std::vector<int> fill = begin;
        for (std::size_t i = 0; i < balls_.size(); ++i)
            member[static_cast<std::size_t>(fill[home[i]]++)] = static_cast<int>(i);
        pairs_.clear();
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const Ball& a = balls_[i];
            const int x = cell_of(a.center, 0), y = cell_of(a.center, 1), z = cell_of(a.center, 2);
            for (int w = std::max(0, z - 1); w <= std::min(n[2] - 1, z + 1); ++w) {
                for (int v = std::max(0, y - 1); v <= std::min(n[1] - 1, y + 1); ++v) {
                    const auto first = index(std::max(0, x - 1), v, w), last = index(std::min(n[0] - 1, x + 1), v, w);
                    for (int k = begin[first]; k < begin[last + 1]; ++k) {
                        const int j = member[static_cast<std::size_t>(k)];
                        const Ball& b = balls_[static_cast<std::size_t>(j)];
                        const double reach = a.radius + b.radius + margin;
                        if (static_cast<int>(i) < j && norm2(b.center - a.center) < reach * reach)
                            pairs_.push_back({static_cast<int>(i), j});
                    }
                }
            }
        }
        travel_ = 0.0;
    }

    /// Forces of now; returns the largest overlap.
    double forces()
    {
        double largest = 0.0;
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const Vec3 back = region_.shift_inside(balls_[i].center, balls_[i].radius);
            force_[i] = back / diameter_;
            const double depth = norm2(back);
            if (depth > 0.0) largest = std::max(largest, std::sqrt(depth) / (2.0 * balls_[i].radius));
        }
        for (const Pair& p : pairs_) {
            const Ball &a = balls_[static_cast<std::size_t>(p.a)], &b = balls_[static_cast<std::size_t>(p.b)];
            const Vec3 branch = b.center - a.center;
            const double sum = a.radius + b.radius, distance2 = norm2(branch);
            if (distance2 >= sum * sum) continue;
            const double distance = std::sqrt(distance2), overlap = sum - distance;
            largest = std::max(largest, overlap / sum);
            const Vec3 push = overlap / (distance * diameter_) * branch;
            force_[static_cast<std::size_t>(p.a)] -= push;
            force_[static_cast<std::size_t>(p.b)] += push;
        }
        return largest;
    }

    const SphereRegion& region_;
    std::vector<Ball>& balls_;
    double diameter_, widest_ = 0.0;  ///< [m]
    std::vector<Vec3> velocity_, force_;
    std::vector<Pair> pairs_;
    double travel_ = 0.0;  ///< since the pairs were found; of the mean diameter
};

/// Uniform in the region shrunk by the radius.
Vec3 random_place(const RandomPackingSpec& s, std::uint32_t i, double radius)
{
    const SphereRegion& region = s.region;
    for (int draw = 0;; draw += 3) {
        Vec3 x = region.center;
        for (int k = 0; k < 3; ++k) {
            const double u = uniform_random(s.seed, RandomPurpose::packing, i, s.part, draw + k);
            x[k] += (2.0 * u - 1.0) * (region.half[k] - radius);
        }
        if (norm2(region.shift_inside(x, radius)) == 0.0) return x;
    }
}

/// By boxes of this width: z, y, x.
void sort_in_space(std::vector<Ball>& balls, const SphereRegion& region, double width)
{
    const auto box = [&](const Ball& b, int k) {
        return static_cast<int>((b.center[k] - region.center[k] + region.half[k]) / width);
    };
    std::stable_sort(balls.begin(), balls.end(), [&](const Ball& a, const Ball& b) {
        return std::tuple(box(a, 2), box(a, 1), box(a, 0)) < std::tuple(box(b, 2), box(b, 1), box(b, 0));
    });
}

}  // namespace

double densest_random_packing(const RandomPackingSpec& s)
{
    const SizeRange d(s);
    return densest_random_packing(s.size_ratio) -
           wall_loss * d.mean_power(4) / d.mean_power(3) * s.region.surface() / s.region.volume();
}

double densest_random_packing(double size_ratio)
{
    const double deviation = (size_ratio - 1.0) / (size_ratio + 1.0) / std::sqrt(3.0);
    return 0.634 + 0.0658 * deviation;
}

std::vector<Ball> random_packing(const RandomPackingSpec& s)
{
    const SizeRange d(s);
    if (s.region.thinnest() < d.large) {
        throw InputError("diameter",
                         fmt::format("no sphere fits: the largest are {:.6g} m wide, the region is {:.6g} m "
                                     "at its smallest",
                                     d.large, s.region.thinnest()));
    }
    const double wanted = s.solid_fraction * s.region.volume() / (std::numbers::pi / 6.0 * d.mean_power(3));
    check_count("diameter", wanted);
    const auto count = static_cast<std::uint32_t>(std::max(1L, std::lround(wanted)));
    std::vector<Ball> balls(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Ball& b = balls[i];
        b.radius = 0.5 * (d.small + (d.large - d.small) * (i + 0.5) / count);
        b.center = random_place(s, i, b.radius);
    }
    sort_in_space(balls, s.region, d.large);
    const double overlap = Relaxation(s.region, balls, s.diameter).run(packing_overlap);
    if (overlap > packing_overlap) {
        throw InputError("solid_fraction",
                         fmt::format("cannot be reached in this region: overlaps of {:.2g} of the diameter are left; "
                                     "about {:.2f} is possible, less than far from walls",
                                     overlap, densest_random_packing(s) - packing_spread));
    }
    return balls;
}

}  // namespace grainfrac
