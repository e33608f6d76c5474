// SPDX-License-Identifier: GPL-3.0-or-later
// walls.csv: forces, places and the spread of the contacts of walls and grips.
#include "experiment/grips.h"
#include "experiment/walls.h"
#include "io/history_csv.h"
#include "io/wall_history.h"
#include "support/spheres.h"

#include <filesystem>

using namespace grainfrac;
using namespace grainfrac::test;

TEST_CASE("walls.csv: force, place and contacts of a plate and of a grip")
{
    // nine spheres on a square grid of 2 m, pressed into a plate below by 1 mm; a tenth, far away, hangs on a grip
    Assembly a = sphere_assembly(unbreakable_bond(false), 1.0);
    a.model.contact_laws.host() = {LinearContact{1e6, 0.0, 0.0, 1.0, 0.0}};
    a.model.contact_law_of.assign(9, 0);
    for (int i = 0; i < 9; ++i) sphere(a, {2.0 * (i % 3), 2.0 * (i / 3), 0.5 - 1e-3}, 0.5);
    sphere(a, {20, 0, 5}, 0.5);
    sphere(a, {20, 0, 6}, 0.5);
    join(a, 9, 10, {1e3, 0, 0, 0});
    const int plate = add_wall(a.model, "floor");
    add_plate(a.model, a.state, plate, {2, 2, 0}, {0, 0, 1}, {1, 0, 0}, 10.0, 10.0, 1.0);
    GripSpec g;
    g.name = "hook";
    g.part = "part";
    g.region.shape = "box";
    g.region.center = {20, 0, 6};
    g.region.size = {1, 1, 1};
    g.hold = {"z"};
    add_grip(a.model, a.state, g, "grips[0]");
    shift(a.state, 9, {0, 0, -1e-3});
    a.model.gravity = {0, 0, -9.81};
    start(a.model, a.state);

    const std::vector<WallRow> rows = wall_rows(a.model, a.state);
    REQUIRE(rows.size() == 2);
    double pressed = 0.0;
    for (int i = 0; i < 9; ++i) pressed += a.state.bodies.force[i].z + 9.81 * a.state.bodies.mass[i];
    CHECK(rows[0].force.z == Approx(-pressed).epsilon(1e-12));
    CHECK(rows[0].contacts == 9);
    CHECK(rows[0].position.x == Approx(2.0));
    CHECK(rows[0].contact_radius == Approx(std::sqrt(2.0 * (4.0 * 4.0 + 4.0 * 8.0) / 9.0)).epsilon(1e-9));
    CHECK(rows[1].force.z == Approx(-1.0).epsilon(1e-9));  // its own weight is not in it
    CHECK(rows[1].contacts == 0);
    CHECK(rows[1].contact_radius == 0.0);
    CHECK(rows[1].position == Vec3{20, 0, 6});

    const std::filesystem::path file = std::filesystem::temp_directory_path() / "grainfrac_walls.csv";
    {
        WallHistory history(file, {"1", "hash", "cpu", 1, 1, "custom"}, a.model);
        history.append(a.model, a.state);
        release_grip(a.model, a.state, 1);
        history.append(a.model, a.state);
    }
    const HistoryTable table = read_history_csv(file);
    std::filesystem::remove(file);
    CHECK(table.names.size() == 17);
    CHECK(table.rows() == 2);
    CHECK(table.column("floor_force_z_N")[0] == rows[0].force.z);
    CHECK(table.column("floor_contact_radius_m")[0] == rows[0].contact_radius);
    CHECK(table.column("hook_position_z_m")[0] == 6.0);
    CHECK(table.column("hook_force_z_N")[1] == 0.0);
}
