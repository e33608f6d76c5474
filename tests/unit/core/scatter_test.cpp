// SPDX-License-Identifier: GPL-3.0-or-later
// Crystals, boundary energy, Weibull scatter, random numbers.
#include "fracture/clusters.h"
#include "generate/crystal.h"
#include "model/random.h"
#include "support/assembly.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

Quat about_c(double degrees)
{
    return from_axis_angle({0, 0, 1}, degrees * degree);
}

}  // namespace

TEST_CASE("misorientation of hexagonal crystals: symmetric, blind to symmetry and to turning both")
{
    CHECK(hexagonal_misorientation(about_c(10), about_c(70)) == Approx(0).margin(1e-7));
    CHECK(hexagonal_misorientation(about_c(10), about_c(40)) == Approx(30 * degree).epsilon(1e-12));
    for (std::uint32_t k = 0; k < 200; ++k) {
        const Quat a = uniform_rotation(1, RandomPurpose::test, k), b = uniform_rotation(2, RandomPurpose::test, k),
                   r = uniform_rotation(3, RandomPurpose::test, k);
        const double t = hexagonal_misorientation(a, b);
        CHECK(hexagonal_misorientation(b, a) == Approx(t).epsilon(1e-9));
        CHECK(hexagonal_misorientation(r * a, r * b) == Approx(t).epsilon(1e-9));
        CHECK(hexagonal_misorientation(a * about_c(60), b) == Approx(t).epsilon(1e-9));
        CHECK(hexagonal_misorientation(a, b * from_axis_angle({1, 0, 0}, std::numbers::pi)) == Approx(t).epsilon(1e-9));
        CHECK(t < 93.85 * degree);  // the largest angle of group 622
    }
}

TEST_CASE("Read-Shockley and the toughness of a boundary")
{
    CHECK(read_shockley(0.5 * 15 * degree, 15 * degree) == Approx(0.846574).margin(1e-6));
    CHECK(read_shockley(20 * degree, 15 * degree) == 1.0);
    CHECK(boundary_toughness_factor(0, 15 * degree, 0.3) == 1.0);
    CHECK(boundary_toughness_factor(1, 15 * degree, 0.3) == Approx(0.7));
}

TEST_CASE("Weibull factors: mean, scatter, size effect")
{
    const double m = 10;
    double sum = 0, squares = 0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
        const double f = weibull_factor(uniform_random(1, RandomPurpose::test, static_cast<std::uint32_t>(i)), m, 1, 1);
        sum += f;
        squares += f * f;
    }
    const double mean = sum / n, cv = std::sqrt(squares / n / (mean * mean) - 1);
    CHECK(mean == Approx(0.951351).margin(4 * 0.1144 / std::sqrt(n)));
    CHECK(cv == Approx(0.1203).margin(0.001));
    CHECK(weibull_factor(0.3, m, 2, 1) / weibull_factor(0.3, m, 1, 1) == Approx(std::pow(0.5, 0.1)).epsilon(1e-12));
}

TEST_CASE("random draws do not depend on the order in which they are made, and rotations are uniform")
{
    const double late = uniform_random(9, RandomPurpose::strength, 4, 7);
    for (std::uint32_t k = 0; k < 100; ++k) uniform_random(9, RandomPurpose::strength, k, k);
    CHECK(uniform_random(9, RandomPurpose::strength, 4, 7) == late);
    CHECK(uniform_random(10, RandomPurpose::strength, 4, 7) != late);
    CHECK(uniform_random(9, RandomPurpose::orientation, 4, 7) != late);
    Vec3 mean;
    const int n = 20000;
    for (int i = 0; i < n; ++i)
        mean += (1.0 / n) * rotate(uniform_rotation(1, RandomPurpose::test, static_cast<std::uint32_t>(i)), {0, 0, 1});
    CHECK(norm(mean) < 4 / std::sqrt(n));
}

TEST_CASE("fragments: the heaviest first, walls in none")
{
    std::vector<GrainSpec> grains;
    for (int i = 0; i < 6; ++i) grains.push_back(grain(make_box({1, 1, 1}, {i + 0.5, 0, 0}), {i + 0.5, 0, 0}));
    Assembly a = assemble(std::move(grains));
    bond(a, elastic_law(), 1, 0, 1);
    a.state.interfaces.failure_time.host()[1] = 1.0;  // between 1 and 2
    drive(a.state, 5);
    CHECK(bonded_clusters(a.state) == std::vector<std::int32_t>{1, 1, 0, 0, 0, -1});
}
