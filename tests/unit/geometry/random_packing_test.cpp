// SPDX-License-Identifier: GPL-3.0-or-later
// Random packings: density, overlaps, sizes, isotropy and contacts, each counted here anew.
#include "generate/random_packing.h"

#include "geometry/near_boxes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace grainfrac;

namespace {

RandomPackingSpec in_box(double size, double solid_fraction, double size_ratio = 1.0)
{
    RegionSpec r;
    r.size = {size, size, size};
    return {SphereRegion(r), 1.0, size_ratio, solid_fraction, 1, 0};
}
RandomPackingSpec in_round(const char* shape, double diameter, double height, double solid_fraction, double size_ratio)
{
    RegionSpec r;
    r.shape = shape;
    r.center = {3, -2, 1};
    r.diameter = diameter;
    r.height = height;
    r.axis = "x";
    return {SphereRegion(r), 1.0, size_ratio, solid_fraction, 4, 1};
}

double volume(const std::vector<Ball>& balls)
{
    double v = 0.0;
    for (const Ball& b : balls) v += 4.0 / 3.0 * std::numbers::pi * b.radius * b.radius * b.radius;
    return v;
}

struct Touching {
    std::vector<int> partners;  ///< of each sphere
    double fabric[6] = {};      ///< mean of n n: XX YY ZZ XY YZ XZ
    double count = 0.0;
};

/// Pairs whose gap is at most `gap` of their mean diameter.
Touching touching(const std::vector<Ball>& balls, double gap)
{
    std::vector<Box> boxes;
    for (const Ball& b : balls) {
        const double r = b.radius * (1.0 + gap);
        boxes.push_back({b.center - Vec3{r, r, r}, b.center + Vec3{r, r, r}});
    }
    Touching t;
    t.partners.resize(balls.size());
    for (const auto& [i, j] : overlapping_boxes(boxes)) {
        const Ball &a = balls[static_cast<std::size_t>(i)], &b = balls[static_cast<std::size_t>(j)];
        const Vec3 branch = b.center - a.center, n = normalized(branch);
        if (norm(branch) > (a.radius + b.radius) * (1.0 + gap)) continue;
        ++t.partners[static_cast<std::size_t>(i)];
        ++t.partners[static_cast<std::size_t>(j)];
        const double nn[6] = {n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.y * n.z, n.x * n.z};
        for (int k = 0; k < 6; ++k) t.fabric[k] += nn[k];
        t.count += 1.0;
    }
    for (double& f : t.fabric) f /= t.count;
    return t;
}

/// Of N directions without order the mean of n_x^2 scatters by sqrt(4/45/N), that of n_x n_y by sqrt(1/15/N).
void check_isotropy(const Touching& t)
{
    for (int k = 0; k < 6; ++k) {
        INFO("component " << k << " of " << t.count << " contacts");
        const double scatter = std::sqrt((k < 3 ? 4.0 / 45.0 : 1.0 / 15.0) / t.count);
        CHECK(std::fabs(t.fabric[k] - (k < 3 ? 1.0 / 3.0 : 0.0)) < 4.0 * scatter);
    }
}

/// Mean number of partners of the spheres that no wall is near to.
double coordination(const RandomPackingSpec& s, const std::vector<Ball>& balls, const Touching& t)
{
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (norm2(s.region.shift_inside(balls[i].center, 3.0 * balls[i].radius)) > 0.0) continue;
        sum += t.partners[i];
        count += 1.0;
    }
    return sum / count;
}

double largest_overlap(const RandomPackingSpec& s, const std::vector<Ball>& balls)
{
    double largest = 0.0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& a = balls[i];
        largest = std::max(largest, norm(s.region.shift_inside(a.center, a.radius)) / (2.0 * a.radius));
        for (std::size_t j = 0; j < i; ++j) {
            const double sum = a.radius + balls[j].radius;
            largest = std::max(largest, 1.0 - norm(a.center - balls[j].center) / sum);
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("a dense packing of equal spheres", "[packings]")
{
    const RandomPackingSpec s = in_box(15.0, 0.6);  // the densest that this box takes
    const std::vector<Ball> balls = random_packing(s);
    CHECK(volume(balls) / s.region.volume() == Approx(0.6).margin(0.25 / 3375.0));  // half a sphere of 0.52 m^3
    CHECK(largest_overlap(s, balls) <= packing_overlap);
    // Frictionless spheres jam at 6 contacts each, but for the few per cent that rattle (O'Hern et al. 2003); near
    // contacts, n(gap) - 6 ~ gap^0.6, come on top.
    const Touching close = touching(balls, 0.002);
    CHECK(coordination(s, balls, close) == Approx(5.5).margin(0.5));
    CHECK(coordination(s, balls, touching(balls, 0.01)) == Approx(6.25).margin(0.25));
    check_isotropy(close);
    // No order: in a close packing 12 neighbours are at the distance of contact.
    const Touching near = touching(balls, 0.01);
    CHECK(std::count_if(near.partners.begin(), near.partners.end(), [](int n) { return n >= 11; }) < 0.01 * 3867);
}

TEST_CASE("same seed, same packing; another seed or part, another one", "[packings]")
{
    RandomPackingSpec s = in_box(6.0, 0.5, 2.0);
    const auto first = [&] { return random_packing(s)[0].center; };
    const Vec3 x = first();
    CHECK(first() == x);
    s.part = 1;
    CHECK_FALSE(first() == x);
    s.part = 0;
    s.seed = 2;
    CHECK_FALSE(first() == x);
}

TEST_CASE("packings of unequal spheres in round regions", "[packings]")
{
    for (const RandomPackingSpec& s :
         {in_round("cylinder", 9.0, 16.0, 0.58, 3.0), in_round("sphere", 11.0, 0.0, 0.56, 1.5)}) {
        const std::vector<Ball> balls = random_packing(s);
        const auto n = static_cast<double>(balls.size());
        CHECK(volume(balls) / s.region.volume() == Approx(s.solid_fraction).epsilon(0.6 / n));
        CHECK(largest_overlap(s, balls) <= packing_overlap);
        std::vector<double> d;
        for (const Ball& b : balls) d.push_back(2.0 * b.radius);
        std::sort(d.begin(), d.end());
        const double small = 2.0 / (1.0 + s.size_ratio);
        double mean = 0.0;
        for (const double x : d) mean += x / n;
        CHECK(mean == Approx(1.0).epsilon(1e-12));
        CHECK(d.front() == Approx(small).epsilon(1.0 / n));
        CHECK(d.back() == Approx(s.size_ratio * small).epsilon(1.0 / n));
        CHECK(d[d.size() / 4] == Approx(small * (0.75 + 0.25 * s.size_ratio)).epsilon(1.0 / n));  // uniform
        check_isotropy(touching(balls, 0.01));
    }
}

TEST_CASE("a packing that cannot be is refused with what can", "[packings]")
{
    const auto problem = [](const RandomPackingSpec& s) {
        try {
            random_packing(s);
            return std::string();
        } catch (const InputError& e) {
            return e.problems[0].key + ": " + e.problems[0].message.substr(0, 37);
        }
    };
    CHECK(problem(in_box(5.0, 0.6)) == "solid_fraction: cannot be reached in this region: ove");
    CHECK(problem(in_box(0.9, 0.3)) == "diameter: no sphere fits: the largest are 1 m w");
    CHECK(densest_random_packing(in_box(5.0, 0.6)) == Approx(0.54).margin(0.01));  // and 0.53 is made:
    CHECK(problem(in_box(5.0, 0.53)).empty());
}

TEST_CASE("a large packing near the densest", "[packings][slow]")
{
    const RandomPackingSpec s = in_box(30.0, 0.615);
    const std::vector<Ball> balls = random_packing(s);  // 31,700 spheres, some 6 s
    CHECK(volume(balls) / s.region.volume() == Approx(0.615).epsilon(1e-4));
    const Touching close = touching(balls, 0.002);
    CHECK(coordination(s, balls, close) == Approx(5.5).margin(0.5));
    check_isotropy(close);
}
