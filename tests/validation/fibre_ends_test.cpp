// SPDX-License-Identifier: GPL-3.0-or-later
// Where fibres begin, end, are gripped and leave their matrix; patches cover the cylinder within it, no more, no less.
#include "experiment/experiment.h"
#include "experiment/pull_out.h"
#include "model/case.h"
#include "motion/step.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace grainfrac;

namespace {

const double layer = std::sqrt(2.0 / 3.0);

/// Close packing of spheres of 1 m, 13 layers between -10.61/2 and 10.61/2, with a fibre of radius 1 m.
Case fibre_in_lattice()
{
    Case c;
    MaterialSpec m{.name = "m", .density = 2000.0, .young_modulus = 5e9, .poisson_ratio = 0.1};
    c.materials = {m};
    PartSpec matrix, fibre;
    matrix.name = "matrix";
    matrix.kind = fibre.kind = "spheres";
    matrix.material = fibre.material = "m";
    matrix.generator = "hcp";
    matrix.lattice_origin = "channel";
    matrix.diameter = 1.0;
    matrix.region.shape = "cylinder";
    matrix.region.diameter = 7.0;
    matrix.region.height = 13.0 * layer;
    fibre.name = "fibre";
    fibre.generator = "chain";
    fibre.diameter = 0.8;
    fibre.inside = "matrix";
    fibre.fibre.from = {0.0, 0.0, -6.5 * layer};
    fibre.fibre.to = {0.0, 0.0, 6.5 * layer};
    fibre.fibre.radius = 1.0;
    c.parts = {matrix, fibre};
    BondSpec solid, interface;
    solid.law = "parallel";
    solid.failure = "unbreakable";
    interface.between = {"fibre", "matrix"};
    interface.shear_stiffness = 1e9;
    interface.yield_slip = 1e-3;
    interface.failure_slip = 3e-3;
    c.bonds = {solid, interface};
    c.test.kind = "pull_out";
    c.test.fibre = "fibre";
    c.test.matrix = "matrix";
    return c;
}

double patches(const Built& b)
{
    double area = 0.0;
    for (const int i : fibre_interfaces(*b.experiment.pull_out, b.state)) area += b.state.interfaces.area[i];
    return area;
}

std::vector<int> grips(const Built& b)
{
    std::vector<int> found;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        if (b.state.bodies.wall[i] == b.experiment.pull_out->grip_wall) found.push_back(i);
    }
    return found;
}

std::string key_refused(const Case& c)
{
    try {
        build(c, default_device());
    } catch (const InputError& e) {
        return e.problems.at(0).key;
    }
    return {};
}

}  // namespace

TEST_CASE("fibre ends: a node at each layer stands for a whole piece", "[pull_out]")
{
    const Built b = build(fibre_in_lattice(), default_device());
    const PullOut& p = *b.experiment.pull_out;
    CHECK(p.length == Approx(13.0 * layer).epsilon(1e-9));
    CHECK(patches(b) == Approx(2.0 * std::numbers::pi * 13.0 * layer).epsilon(1e-9));
    CHECK(p.before_exit == Approx(0.5 * layer).epsilon(1e-9));
    CHECK(p.beyond_grip == Approx(0.5 * layer).epsilon(1e-9));
    CHECK(grips(b).size() == 1);
    double mass = 0.0;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        if (b.state.bodies.group[i] == p.fibre_group) mass += b.state.bodies.mass[i];
    }
    CHECK(mass == Approx(2000.0 * std::numbers::pi * 13.0 * layer).epsilon(1e-9));
}

TEST_CASE("fibre ends: with a spacing of its own the chain is as long as told, also between the layers", "[pull_out]")
{
    for (const double spacing : {0.3, 0.5, 1.3}) {
        Case c = fibre_in_lattice();
        c.parts[1].diameter = 0.3;
        c.parts[1].fibre.spacing = spacing;
        const Built b = build(c, default_device());
        CAPTURE(spacing);
        CHECK(patches(b) == Approx(2.0 * std::numbers::pi * 13.0 * layer).epsilon(1e-9));
        CHECK(b.experiment.pull_out->length == Approx(13.0 * layer).epsilon(1e-9));
        CHECK(b.experiment.pull_out->beyond_grip == 0.0);
    }
}

TEST_CASE("fibre ends: what stands out of the matrix is not embedded", "[pull_out]")
{
    Case c = fibre_in_lattice();
    c.parts[1].fibre.to.z += 4.0;  // nodes go on at the distance of the layers
    c.parts[1].fibre.from.z += 3.0 * layer;
    const Built b = build(c, default_device());
    const PullOut& p = *b.experiment.pull_out;
    CHECK(p.length == Approx(10.0 * layer).epsilon(1e-9));
    CHECK(patches(b) == Approx(2.0 * std::numbers::pi * 10.0 * layer).epsilon(1e-9));
    REQUIRE(grips(b).size() == 1);
    // the matrix ends at 6.5 layers, 4 m are 4.9: the last node is in layer 11
    CHECK(b.state.bodies.position[grips(b)[0]].z == Approx(11.0 * layer));
    CHECK(p.before_exit == Approx(0.5 * layer).epsilon(1e-9));
}

TEST_CASE("fibre ends: copies that are shifted along the pull have ends of their own", "[pull_out]")
{
    Case c = fibre_in_lattice();
    c.parts[0].region.diameter = 12.0;
    c.parts[1].fibre.from.z += 3.0 * layer;
    c.parts[1].copies = {{4.0, 0.0, -2.0 * layer}};
    Built b = build(c, default_device());
    start(b.model, b.state);
    const PullOut& p = *b.experiment.pull_out;
    CHECK(p.fibres == 2);
    REQUIRE(grips(b).size() == 2);
    CHECK(b.state.bodies.position[grips(b)[0]].z - b.state.bodies.position[grips(b)[1]].z == Approx(2.0 * layer));
    CHECK(p.length == Approx(10.0 * layer).epsilon(1e-9));
    CHECK(p.section == Approx(2.0 * std::numbers::pi));
    const FibreProfile profile = fibre_profile(p, b.state);
    CHECK(profile.position.size() == 10);  // levels of the two fall together
    CHECK(profile.position.front() == Approx(0.5 * layer));
}

TEST_CASE("fibre ends: spheres taken from packings with and without layers", "[pull_out]")
{
    Case c = fibre_in_lattice();
    c.parts[1].generator = "taken";
    c.parts[1].region.shape = "cylinder";
    c.parts[1].region.diameter = 2.0;
    c.parts[1].region.height = 40.0;
    SECTION("layers: a piece for each, and no patch at the end of a blind hole")
    {
        double height = 13.0 * layer;
        SECTION("all through") {}
        SECTION("blind")
        {
            c.parts[1].region.height = 20.0;
            c.parts[1].region.center.z = 10.0 - 2.1 * layer;  // layers -2 to 6
            height = 9.0 * layer;
        }
        for (const char* reach : {"level", "all"}) {
            c.bonds[1].reach = reach;
            const Built b = build(c, default_device());
            const PullOut& p = *b.experiment.pull_out;
            CAPTURE(reach);
            CHECK(p.length == Approx(height).epsilon(1e-9));
            CHECK(patches(b) == Approx(2.0 * std::numbers::pi * height).epsilon(1e-9));
            for (const int i : grips(b)) CHECK(b.state.bodies.position[i].z == Approx(6.0 * layer));
            for (const int i : fibre_interfaces(p, b.state)) {
                const Vec3 branch =
                    b.state.bodies.position[b.state.interfaces.b[i]] - b.state.bodies.position[b.state.interfaces.a[i]];
                CHECK(std::hypot(branch.x, branch.y) > 0.2);
            }
        }
    }
    SECTION("no layers: the region as far as the packing goes, gripped by what is at its top")
    {
        c.parts[0].generator = "random_dense";
        c.parts[0].solid_fraction = 0.5;
        c.bonds[0].shear_ratio = 0.3;
        c.bonds[0].gap_factor = c.bonds[1].gap_factor = 0.05;
        CHECK(key_refused(c) == "bonds[1].reach");
        c.bonds[1].reach = "all";
        Built b = build(c, default_device());
        const PullOut& p = *b.experiment.pull_out;
        CHECK(p.length == Approx(13.0 * layer).epsilon(0.05));
        CHECK(patches(b) == Approx(2.0 * std::numbers::pi * p.length).epsilon(1e-9));
        CHECK(grips(b).size() >= 2);
        CHECK(p.piece == Approx(1.0));
        for (const int i : grips(b)) CHECK(b.state.bodies.position[i].z > 6.5 * layer - 1.5);
        start(b.model, b.state);
        CHECK(fibre_profile(p, b.state).position.size() > 6);
    }
    SECTION("its axial stress is not known, so that no pressure falls with it")
    {
        c.bonds[1].radial_pressure = 1e6;
        CHECK_NOTHROW(build(c, default_device()));
        c.bonds[1].contraction = 0.1;
        CHECK(key_refused(c) == "bonds[1].contraction");
    }
}

TEST_CASE("fibre ends: bends that bear on nothing are told", "[pull_out]")
{
    Case c = fibre_in_lattice();
    c.parts[0].region.diameter = 9.0;
    c.parts[1].fibre.shape = "hooked";
    c.parts[1].fibre.from.z = -1.0;
    c.parts[1].fibre.hook_length = 1.5;
    CHECK(build(c, default_device()).experiment.warnings.size() == 1);
    c.bonds[1].normal_stiffness = 1e9;
    CHECK(build(c, default_device()).experiment.warnings.empty());
}

TEST_CASE("fibre ends: fibres that reach out of their matrix or run through each other are refused", "[pull_out]")
{
    Case c = fibre_in_lattice();
    c.parts[1].copies = {{2.6, 0.0, 0.0}};
    CHECK(key_refused(c) == "parts[1].copies[0]");  // 2.6 + 1 > 3.5
    c.parts[1].copies = {{1.9, 0.0, 0.0}};
    CHECK(key_refused(c) == "parts[1].copies[0]");
    c.parts[1].copies = {{2.1, 0.0, 0.0}};
    CHECK(key_refused(c).empty());
    c.parts[1].copies.clear();
    c.parts[1].fibre.radius = 3.6;
    CHECK(key_refused(c).rfind("parts[1].fibre", 0) == 0);
}
