// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of fragments and clusters, and the shape numbers in them.
#include "io/atomic_file.h"
#include "io/fragments.h"
#include "io/history_csv.h"
#include "io/plots.h"
#include "sample.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace grainfrac;

namespace {

const double face_area = sample::side * sample::thickness;
const double prism_surface = 3.0 * std::sqrt(3.0) * sample::side * sample::side + 6.0 * face_area;

}  // namespace

TEST_CASE("shape numbers of a hexagonal prism, a box and a ball", "[output][fragments]")
{
    const sample::World w = sample::make_world();
    const std::vector<Fragment> rows = collect_fragments(w.model, w.state, w.fields);
    REQUIRE(rows.size() == 3);  // by id, without walls
    for (int id = 0; id < 3; ++id) CHECK(rows[static_cast<std::size_t>(id)].id == id);
    const Fragment& f = rows[0];
    CHECK(f.faces == 8);
    CHECK(f.parent == -1);
    CHECK(f.cluster == 0);
    CHECK(f.shape.volume == Approx(sample::prism_volume).epsilon(1e-12));
    CHECK(f.shape.surface == Approx(prism_surface).epsilon(1e-12));
    // A hexagon of side s has the second moment 5 sqrt(3)/16 s^4 about any axis, so 5 s^2/24 per area; a length t has
    // t^2/12. Full axes are 2 sqrt(5 m_2).
    const double across = 2.0 * std::sqrt(5.0 * 5.0 / 24.0) * sample::side,
                 along = 2.0 * std::sqrt(5.0 / 12.0) * sample::thickness;
    CHECK(f.shape.axes.x == Approx(along).epsilon(1e-12));
    CHECK(f.shape.axes.y == Approx(across).epsilon(1e-12));
    CHECK(f.shape.elongation() == Approx(across / along).epsilon(1e-12));
    CHECK(f.shape.flatness() == Approx(1.0).epsilon(1e-12));
    // Wadell: pi^(1/3) (6 V)^(2/3)/A
    CHECK(f.shape.sphericity() ==
          Approx(std::cbrt(std::numbers::pi) * std::pow(6.0 * sample::prism_volume, 2.0 / 3.0) / prism_surface)
              .epsilon(1e-12));

    // A body without polyhedron is the ball of its mass.
    sample::World ball = sample::make_world();
    ball.model.grain_shapes[0] = {};
    const double d = std::cbrt(6.0 * sample::prism_volume / std::numbers::pi), m = ball.state.bodies.mass[0];
    ball.state.bodies.inertia.host()[0] = Vec3{1, 1, 1} * (0.1 * m * d * d);
    const Fragment b = collect_fragments(ball.model, ball.state, ball.fields).at(2);  // id 2
    CHECK(b.faces == 0);
    CHECK(b.shape.sphericity() == Approx(1.0).epsilon(1e-12));
    CHECK(b.shape.axes.x == Approx(d).epsilon(1e-12));
    CHECK(b.shape.axes.z == Approx(d).epsilon(1e-12));
}

TEST_CASE("spheres are fragments, held ones among them, and make clusters", "[output][fragments]")
{
    const sample::World w = sample::make_spheres();
    const std::vector<Fragment> pieces = collect_fragments(w.model, w.state, w.fields);
    REQUIRE(pieces.size() == 3);
    const double R = sample::sphere_radius, volume = 4.0 / 3.0 * std::numbers::pi * R * R * R;
    for (const Fragment& f : pieces) {
        CHECK(f.faces == 0);
        CHECK(f.shape.volume == Approx(volume).epsilon(1e-12));
        CHECK(f.shape.axes.x == Approx(2.0 * R).epsilon(1e-12));
    }
    const std::vector<Cluster> clusters = collect_clusters(w.model, w.state, w.fields);
    REQUIRE(clusters.size() == 2);
    CHECK(clusters[0].fragments == 2);
    CHECK(clusters[0].shape.volume == Approx(2.0 * volume).epsilon(1e-12));
    CHECK(clusters[0].position.x == Approx(0.5 * (1.0 - sample::sphere_gap)).epsilon(1e-12));
    CHECK(clusters[1].fragments == 1);
}

TEST_CASE("a cluster has the mass, the moments and the outer surface of its grains", "[output][fragments]")
{
    const sample::World w = sample::make_world();
    const std::vector<Cluster> clusters = collect_clusters(w.model, w.state, w.fields);
    REQUIRE(clusters.size() == 2);
    CHECK(clusters[0].fragments == 2);
    CHECK(clusters[1].fragments == 1);
    CHECK(clusters[0].shape.volume == Approx(2.0 * sample::prism_volume).epsilon(1e-12));
    CHECK(clusters[0].shape.surface == Approx(2.0 * (prism_surface - face_area)).epsilon(1e-12));
    CHECK(clusters[1].shape.surface == Approx(prism_surface).epsilon(1e-12));
    // Two prisms sqrt(3) s apart: along the line of centres 5 s^2/24 + 3 s^2/4 = 23 s^2/24 per mass.
    const double s = sample::side;
    CHECK(clusters[0].shape.axes.x == Approx(2.0 * std::sqrt(5.0 / 12.0) * sample::thickness).epsilon(1e-12));
    CHECK(clusters[0].shape.axes.y == Approx(2.0 * std::sqrt(5.0 * 23.0 / 24.0) * s).epsilon(1e-12));
    CHECK(clusters[0].shape.axes.z == Approx(2.0 * std::sqrt(5.0 * 5.0 / 24.0) * s).epsilon(1e-12));
    // A cluster of one is its fragment.
    const Fragment alone = collect_fragments(w.model, w.state, w.fields).at(2);
    CHECK(clusters[1].shape.axes.x == Approx(alone.shape.axes.x).epsilon(1e-12));
    CHECK(norm(clusters[1].position - alone.position) < 1e-15);
    CHECK(norm(clusters[1].velocity - alone.velocity) < 1e-15);
}

TEST_CASE("gripped grains are fragments of no cluster", "[output][fragments]")
{
    sample::World w = sample::make_world();
    w.state.bodies.wall.host()[2] = 0;
    w.fields.cluster[2] = -1;
    CHECK(collect_fragments(w.model, w.state, w.fields).size() == 3);
    double mass = 0.0;
    for (const Cluster& c : collect_clusters(w.model, w.state, w.fields)) mass += c.shape.mass;
    CHECK(mass == Approx(2.0 * sample::density * sample::prism_volume).epsilon(1e-12));
}

TEST_CASE("the CSV tables give every number back", "[output][fragments]")
{
    sample::World w = sample::make_world();
    w.state.bodies.parent.host()[1] = 9;
    w.state.bodies.generation.host()[1] = 2;
    const sample::TemporaryFolder folder;
    const std::vector<Fragment> fragments = collect_fragments(w.model, w.state, w.fields);
    write_fragment_tables(folder.path(), sample::facts(), fragments, collect_clusters(w.model, w.state, w.fields));
    const HistoryTable table = read_history_csv(folder / "fragments.csv");
    REQUIRE(table.rows() == 3);
    CHECK(table.column("parent") == std::vector<double>{9, -1, -1});
    CHECK(table.column("generation") == std::vector<double>{2, 0, 0});
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(table.column("volume_m3")[i] == fragments[i].shape.volume);
        CHECK(table.column("axes_z_m")[i] == fragments[i].shape.axes.z);
        CHECK(table.column("velocity_y_m_per_s")[i] == fragments[i].velocity.y);
        CHECK(table.column("sphericity")[i] == fragments[i].shape.sphericity());
    }
    CHECK(read_history_csv(folder / "clusters.csv").column("fragments") == std::vector<double>{2, 1});
}

TEST_CASE("cumulative mass over size", "[output][fragments]")
{
    // in whatever order; a piece without volume does not count
    const SizeDistribution d = size_distribution({{3.0, 5.0}, {1.0, 2.0}, {0.0, 7.0}, {2.0, 3.0}});
    CHECK(d.diameter == std::vector<double>{1.0, 2.0, 3.0});
    REQUIRE(d.mass_up_to.size() == 3);
    CHECK(d.mass_up_to[0] == Approx(0.2).epsilon(1e-15));
    CHECK(d.mass_up_to[1] == Approx(0.5).epsilon(1e-15));
    CHECK(d.mass_up_to[2] == 1.0);
    CHECK(size_distribution({}).diameter.empty());
}
