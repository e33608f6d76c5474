// SPDX-License-Identifier: GPL-3.0-or-later
// Cracks by mode, their directions, and where they began, of states whose answer is known.
#include "io/crack_start.h"
#include "io/plots.h"
#include "sample.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace grainfrac;

namespace {

constexpr double unit = 1e-3;  // side of the square faces below [m]
constexpr double square = unit * unit;

/// A square face across x with its lower corner at x, y, z [units].
CrackFace face_at(double x, double y, double z, double time, int mode = 0, int cause = 0)
{
    CrackFace c;
    const Vec3 o = unit * Vec3{x, y, z};
    c.polygon = {o, o + Vec3{0, unit, 0}, o + Vec3{0, unit, unit}, o + Vec3{0, 0, unit}};
    c.normal = {1, 0, 0};
    c.area = square;
    c.time = time;
    c.mode = mode;
    c.cause = cause;
    return c;
}

/// A face whose trace in the xy plane has this direction.
CrackFace traced(double degrees, double area, int mode)
{
    CrackFace c;
    const double a = degrees * std::numbers::pi / 180.0;
    c.normal = {std::sin(a), -std::cos(a), 0.0};
    c.area = area;
    c.mode = mode;
    return c;
}

const CrackScale four_faces{3.5 * square, 0.1 * unit};

}  // namespace

TEST_CASE("areas and work by mode", "[output][cracks]")
{
    sample::World w = sample::make_world();
    InterfaceBonds& bonds = w.state.interfaces;
    bonds.fracture_work.host() = {3e-4, 1e-4};
    const double face = bonds.area[0];
    CHECK(crack_sums(w.state).intergranular_area == face);
    CHECK(crack_sums(w.state).transgranular_area == 0.0);
    CHECK(crack_sums(w.state).transgranular_work == 0.0);
    bonds.transgranular.host()[1] = 1;  // damaged, not broken: work without area
    CHECK(crack_sums(w.state).transgranular_area == 0.0);
    CHECK(crack_sums(w.state).transgranular_work == 1e-4);
    bonds.failure_time.host()[1] = 3e-6;
    sample::add_parallel_bond(w.state);
    const CrackSums sums = crack_sums(w.state);
    CHECK(sums.transgranular_area == bonds.area[1]);
    CHECK(sums.intergranular_area == Approx(face + std::numbers::pi * 0.2e-3 * 0.2e-3).epsilon(1e-14));

    // The same as the list of cracks says.
    double between = 0.0, through = 0.0;
    for (const CrackFace& c : collect_cracks(w.model, w.state)) (c.mode == 1 ? through : between) += c.area;
    CHECK(between == Approx(sums.intergranular_area).epsilon(1e-14));
    CHECK(through == sums.transgranular_area);
}

TEST_CASE("the rose counts area by direction and mode", "[output][cracks]")
{
    // 0 and 180 degrees are one direction; a degree of rotation does not leave the sector of a lattice direction; 45
    // degrees is the border of two sectors; a face in the xy plane has no trace.
    std::vector<CrackFace> cracks{traced(0.0, 1.0, 0),   traced(181.0, 2.0, 0), traced(89.0, 3.0, 0),
                                  traced(271.0, 4.0, 0), traced(45.0, 2.0, 0),  traced(60.0, 5.0, 1)};
    cracks.push_back(cracks[0]);
    cracks.back().normal = {0, 0, 1};
    const CrackRose between = crack_rose(cracks, 0), through = crack_rose(cracks, 1);
    CHECK(between.area == Approx(12.0).epsilon(1e-15));
    CHECK(between.share[0] == Approx(3.0 / 12.0).epsilon(1e-14));
    CHECK(between.share[9] == Approx(7.0 / 12.0).epsilon(1e-14));
    CHECK(between.share[4] == Approx(1.0 / 12.0).epsilon(1e-14));
    CHECK(between.share[5] == Approx(1.0 / 12.0).epsilon(1e-14));
    CHECK(std::accumulate(between.share.begin(), between.share.end(), 0.0) == Approx(1.0).epsilon(1e-14));
    CHECK(through.area == 5.0);
    CHECK(through.share[6] == 1.0);
    CHECK(crack_rose({}, 0).area == 0.0);
}

TEST_CASE("the share of cracks through grains", "[output][cracks]")
{
    HistoryTable t;
    t.names = {"time_s",
               "nominal_strain",
               "intergranular_area_m2",
               "transgranular_area_m2",
               "fracture_work_J",
               "transgranular_fracture_work_J"};
    t.columns = {{0, 1, 2, 3}, {0, 1e-4, 2e-4, 3e-4}, {0, 0, 1, 3}, {0, 0, 1, 1}, {0, 2, 4, 8}, {0, 2, 2, 2}};
    TransgranularShare s = transgranular_share(t);
    CHECK(s.over_strain);
    CHECK(s.x == t.columns[1]);
    CHECK(std::isnan(s.of_area[0]));
    CHECK(std::isnan(s.of_area[1]));
    CHECK(s.of_area[2] == 0.5);
    CHECK(s.of_area[3] == 0.25);
    CHECK(std::isnan(s.of_work[0]));
    CHECK(s.of_work[1] == 1.0);
    CHECK(s.of_work[3] == 0.25);
    t.columns[1] = {0, 0, 0, 0};  // a drop
    s = transgranular_share(t);
    CHECK_FALSE(s.over_strain);
    CHECK(s.x == t.columns[0]);
}

TEST_CASE("a crack is macroscopic when touching faces reach the area", "[output][cracks]")
{
    // A row of faces side by side; one of the same number apart from each other is none.
    std::vector<CrackFace> row, apart;
    for (int k = 0; k < 5; ++k) {
        row.push_back(face_at(0, k, 0, 1e-6 * (k + 1), k == 0 ? 1 : 0));
        apart.push_back(face_at(0, 1.2 * k, 0, 1e-6 * (k + 1)));
    }
    const auto found = find_macroscopic_crack(row, four_faces);
    REQUIRE(found);
    CHECK(found->time == 4e-6);  // of the fourth face
    CHECK(found->faces == 4);
    CHECK(found->area == Approx(4.0 * square).epsilon(1e-14));
    CHECK(found->start.time == 1e-6);
    CHECK(found->start.mode == 1);
    CHECK(norm(found->start.point - unit * Vec3{0, 0.5, 0.5}) < 1e-15);
    CHECK_FALSE(find_macroscopic_crack(apart, four_faces));
    CHECK_FALSE(find_macroscopic_crack({row.begin(), row.begin() + 3}, four_faces));
    CHECK_FALSE(find_macroscopic_crack({}, four_faces));

    // Faces that meet at an angle, in a corner, and across a gap of a twentieth of their side.
    std::vector<CrackFace> bent{face_at(0, 0, 0, 1e-6), face_at(0, 1, 1, 2e-6), face_at(0.05, 2, 2, 3e-6)};
    CrackFace lid = face_at(0, 0, 0, 4e-6);
    lid.normal = {0, 1, 0};
    lid.polygon = {{0, 0, 0}, {0, 0, unit}, {-unit, 0, unit}, {-unit, 0, 0}};
    bent.push_back(lid);
    CHECK(find_macroscopic_crack(bent, four_faces)->time == 4e-6);
}

TEST_CASE("a crack begins where the largest of the cracks that it grew from did", "[output][cracks]")
{
    // One face breaks early at y = 3; three later ones grow from y = 0 towards it; the last joins all.
    const std::vector<CrackFace> cracks{face_at(0, 3, 0, 1e-6), face_at(0, 0, 0, 2e-6, 0, 1), face_at(0, 1, 0, 3e-6),
                                        face_at(0, 2, 0, 4e-6)};
    const auto found = find_macroscopic_crack(cracks, four_faces);
    REQUIRE(found);
    CHECK(found->time == 4e-6);
    CHECK(found->start.time == 2e-6);
    CHECK(found->start.cause == 1);
    CHECK(found->start.faces == 1);
    CHECK(norm(found->start.point - unit * Vec3{0, 0.5, 0.5}) < 1e-15);

    // Of two that are as large, the earlier.
    const std::vector<CrackFace> even{face_at(0, 2, 0, 1e-6), face_at(0, 3, 0, 2e-6), face_at(0, 0, 0, 3e-6),
                                      face_at(0, -1, 0, 4e-6), face_at(0, 1, 0, 5e-6)};
    CHECK(find_macroscopic_crack(even, {4.5 * square, 0.1 * unit})->start.time == 1e-6);
}

TEST_CASE("the watch keeps where the first face broke, not where it went", "[output][cracks]")
{
    sample::World w = sample::make_world();
    w.model.nominal_length = std::sqrt(3.0) * sample::side;
    const CrackScale scale = crack_scale(w.model, w.state);
    // Box round the three prisms: x 2 sqrt(3) s (+ the opening), y 3.5 s, z 5 mm; the smallest face lies across z.
    const double s = sample::side, x = 2.0 * std::sqrt(3.0) * s + sample::crack_opening;
    CHECK(scale.area == Approx(0.25 * x * 3.5 * s).epsilon(1e-12));
    CHECK(scale.reach == Approx(0.1 * w.model.nominal_length).epsilon(1e-15));

    CrackWatch watch(scale);
    watch.look(w.model, w.state);
    REQUIRE(watch.first());
    CHECK(watch.first()->time == 2e-6);
    CHECK(watch.first()->faces == 1);
    const Vec3 middle{0.5 * (std::sqrt(3.0) * s - sample::crack_opening), 0, 0};
    CHECK(norm(watch.first()->point - middle) < 1e-15);
    // One face of 3 mm^2 is more than a quarter of 4.4 mm^2.
    REQUIRE(watch.macroscopic());
    CHECK(watch.macroscopic()->time == 2e-6);
    w.state.bodies.position.host()[0].x -= 1.0;
    watch.look(w.model, w.state);
    CHECK(norm(watch.first()->point - middle) < 1e-15);

    CrackWatch none;
    none.look(w.model, w.state);
    CHECK(none.first());
    CHECK_FALSE(none.macroscopic());
    CHECK(crack_scale({}, {}).area == 0.0);
}
