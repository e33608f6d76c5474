// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of packings, pulled: moduli of the inside against the closed forms of the lattices, of finite cylinders
// against the sheet of computed ones, calibration from starts that are far off.
#include "experiment/calibration.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace grainfrac;

namespace {

Case packed(const std::string& generator, double diameter)
{
    Case c;
    c.materials = {{"rock", 2400.0, 5e9, 0.15}};
    PartSpec p;
    p.name = "block";
    p.kind = "spheres";
    p.material = "rock";
    p.generator = generator;
    p.diameter = diameter;
    p.region.shape = "cylinder";
    p.region.diameter = p.region.height = 20.0 * diameter;
    c.parts = {p};
    BondSpec b;
    b.law = "parallel";
    b.failure = "unbreakable";
    c.bonds = {b};
    CalibrationSpec s;
    s.part = "block";
    s.young_modulus = 5e9;
    s.poisson_ratio = 0.15;
    c.calibration = {s};
    return c;
}

}  // namespace

TEST_CASE("the inside of a close packing has the constants of the infinite one")
{
    for (const char* generator : {"hcp", "fcc"}) {
        Case c = packed(generator, 0.7);
        c.calibration[0].width = c.calibration[0].length = 0.7 * 9.0;
        const CalibrationSample sample(c, 0, default_device());
        const Response r = sample.pull(sample.start());
        INFO(generator);
        REQUIRE(r.at_rest);
        CHECK(r.young_modulus == Approx(5e9).epsilon(2e-3));
        CHECK(r.poisson_ratio == Approx(0.15).margin(1e-3));
    }
}

// Three spheres a level about a channel of hcp, rows of them turned by 60 degrees: uniform strain with the levels free
// to shrink, K_s = 0. Per level 6 springs that rise (n_z^2 = 2/3) and 3 level ones: E A h = K d^2 (6 (2/3 + s/3)^2 + 3
// s^2), s = -4/11 the lateral strain over the axial one; h = sqrt(2/3) d.
TEST_CASE("a thin fibre is taken for its sample from where the lattice has its origin")
{
    Case c = packed("hcp", 1.0);
    c.parts[0].lattice_origin = "channel";
    PartSpec fibre = c.parts[0];
    fibre.name = "fibre";
    fibre.generator = "taken";
    fibre.inside = "block";
    fibre.region.diameter = 2.0;
    c.parts.push_back(fibre);
    CalibrationSpec& s = c.calibration[0];
    s.part = "fibre";
    s.poisson_ratio.reset();
    s.start_normal_stiffness = 4e9 / std::numbers::pi;  // K = 1e9 N/m
    s.start_shear_ratio = 1e-9;
    const CalibrationSample sample(c, 0, default_device());
    const Response r = sample.pull(sample.start());
    REQUIRE(r.at_rest);
    const double lateral = -4.0 / 11.0, rise = 2.0 / 3.0 + lateral / 3.0;
    const double EA = 1e9 * (6.0 * rise * rise + 3.0 * lateral * lateral) / std::sqrt(2.0 / 3.0);
    CHECK(r.young_modulus * std::numbers::pi == Approx(EA).epsilon(0.02));  // the ends are held together
}

// Particles per level times their cells as the section; ends pulled evenly. Computed for R = 6 m, L = 30 m by a
// solution of the linear system of another program: E over the closed form, nu within 0.002.
TEST_CASE("a finite cylinder of close packing is softer by its surface")
{
    struct Row {
        double d, lambda, softer;
    };
    for (const Row& row : {Row{1.0, 0.01, 0.914}, Row{1.0, 0.3, 0.926}}) {
        Case c = packed("hcp", row.d);
        CalibrationSpec& s = c.calibration[0];
        s.measure = "section";
        s.width = 12.0;
        s.length = 30.0;
        s.start_shear_ratio = row.lambda;
        const LatticeElasticity form =
            lattice_elasticity(Packing::hcp, lattice_stiffness_at(Packing::hcp, 5e9, row.lambda, 1.0), 1.0);
        const CalibrationSample sample(c, 0, default_device());
        const Response r = sample.pull(sample.start());
        INFO("lambda " << row.lambda);
        REQUIRE(r.at_rest);
        CHECK(r.young_modulus / 5e9 == Approx(row.softer).margin(0.01));
        CHECK(r.poisson_ratio == Approx(form.poisson_ratio).margin(0.003));
    }
}

TEST_CASE("close packings are calibrated in at most four trials from starts far off")
{
    for (const char* generator : {"hcp", "fcc"}) {
        for (const auto& [stiffness, ratio] : {std::pair{1e6, 0.02}, std::pair{1e13, 3.0}}) {
            Case c = packed(generator, 1.0);
            CalibrationSpec& s = c.calibration[0];
            s.width = s.length = 8.0;
            s.poisson_ratio = 0.1;
            s.start_normal_stiffness = stiffness;
            s.start_shear_ratio = ratio;
            const CalibrationSample sample(c, 0, default_device());
            const auto trials = find_bond_constants(sample.target(), sample.start(),
                                                    [&](const BondConstants& k) { return sample.pull(k); });
            INFO(generator << " from " << stiffness << ", " << ratio);
            CHECK(trials.size() <= 4);
            CHECK(trials.back().response.young_modulus == Approx(5e9).epsilon(5e-3));
            CHECK(trials.back().response.poisson_ratio == Approx(0.1).margin(1e-3));
        }
    }
}

// Plane: k_n h = E (3 + s)/(2 (1 + s)), s = (1 - 3 nu)/(1 + nu); the interfaces' constants are those of an endless
// honeycomb (docs/theory/elasticity.md).
TEST_CASE("interfaces of hexagonal prisms are calibrated in their plane")
{
    for (const char* direction : {"x", "y"}) {
        Case c;
        c.materials = {{"sic", 3100.0, 410e9, 0.16}};
        PartSpec p;
        p.name = "plate";
        p.material = "sic";
        p.side = 0.6e-3;
        p.thickness = 1.3e-3;
        p.region.shape = "box";
        p.region.size = {10e-3, 10e-3, 1.3e-3};
        p.orientation.choices = {0.0};
        c.parts = {p};
        BondSpec b;
        b.failure = "unbreakable";
        c.bonds = {b};
        CalibrationSpec s;
        s.part = "plate";
        s.young_modulus = 410e9;
        s.poisson_ratio = 0.16;
        s.direction = direction;
        s.start_normal_stiffness = 1e12;
        s.start_shear_ratio = 1.0;
        c.calibration = {s};
        const CalibrationSample sample(c, 0, default_device());
        const auto trials = find_bond_constants(sample.target(), sample.start(),
                                                [&](const BondConstants& k) { return sample.pull(k); });
        INFO(direction);
        CHECK(trials.size() <= 4);
        CHECK(trials.back().response.young_modulus == Approx(410e9).epsilon(5e-3));
        const double ratio = (1.0 - 3.0 * 0.16) / 1.16, h = std::sqrt(3.0) * 0.6e-3;
        CHECK(trials.back().bonds.shear_ratio == Approx(ratio).epsilon(0.03));
        CHECK(trials.back().bonds.normal_stiffness ==
              Approx(410e9 * (3.0 + ratio) / (2.0 * (1.0 + ratio)) / h).epsilon(0.02));
    }
}

// A chain is a bar: k_n = E/h whatever the section, and the first trial says so.
TEST_CASE("a chain is calibrated as a bar")
{
    Case c = packed("chain", 0.5);
    c.parts[0].region = {};
    c.parts[0].fibre.to = {0, 0, 30};
    c.parts[0].fibre.radius = 1.0;
    c.calibration[0].poisson_ratio.reset();
    c.calibration[0].young_modulus = 50e9;
    const CalibrationSample sample(c, 0, default_device());
    const auto trials =
        find_bond_constants(sample.target(), sample.start(), [&](const BondConstants& k) { return sample.pull(k); });
    CHECK(trials.size() == 1);
    CHECK(trials.back().response.young_modulus == Approx(50e9).epsilon(1e-5));
    CHECK(trials.back().bonds.normal_stiffness == Approx(50e9 / 0.5).epsilon(1e-12));
}

// A chain breaks when its bonds do. Loaded along c all inclined bonds of an endless close packing carry the same,
// N = K_n d eps (2 - nu)/3; those of the surface carry more, so that a sample breaks sooner.
TEST_CASE("the strength of a sample follows the strength of its bonds in proportion")
{
    Case chain = packed("chain", 0.5);
    chain.parts[0].region = {};
    chain.parts[0].fibre.to = {0, 0, 30};
    chain.calibration[0].poisson_ratio.reset();
    chain.bonds[0].failure = "point";
    chain.bonds[0].tensile_strength = 5e6;
    chain.bonds[0].cohesion = 1e12;
    const CalibrationSample bar(chain, 0, default_device());
    CHECK(bar.strength(bar.start()) == Approx(5e6).epsilon(1e-5));

    Case c = packed("hcp", 1.0);
    c.calibration[0].width = c.calibration[0].length = 8.0;
    c.bonds[0].law = "spring";
    c.bonds[0].failure = "point";
    c.bonds[0].tensile_strength = 5e6;
    c.bonds[0].cohesion = 1e12;
    const CalibrationSample sample(c, 0, default_device());
    const BondConstants k = sample.start();
    const double strength = sample.strength(k);
    c.bonds[0].tensile_strength *= 3.0;
    CHECK(CalibrationSample(c, 0, default_device()).strength(k) == Approx(3.0 * strength).epsilon(1e-6));
    const double endless = 5e9 * (5e6 / k.normal_stiffness) / ((2.0 - 0.15) / 3.0);
    CHECK(strength < endless);
    CHECK(strength > 0.5 * endless);
}

TEST_CASE("what cannot be calibrated is said with its key")
{
    const auto problem = [](const Case& c) -> InputProblem {
        try {
            CalibrationSample(c, 0, default_device());
        } catch (const InputError& e) {
            return e.problems.front();
        }
        return {};
    };
    Case c = packed("hcp", 1.0);
    c.calibration[0].poisson_ratio = 0.3;
    CHECK(problem(c).key == "calibration[0].poisson_ratio");
    CHECK(problem(c).message.find("at most 0.2") != std::string::npos);
    c = packed("fcc", 1.0);
    c.calibration[0].part = "rock";
    CHECK(problem(c).key == "calibration[0].part");
    c = packed("fcc", 1.0);
    c.bonds[0].between = {"block", "other"};
    CHECK(problem(c).message.find("no entry of [[bonds]]") != std::string::npos);
    c = packed("fcc", 1.0);
    c.calibration[0].width = 2.0;
    CHECK(problem(c).key == "calibration[0].width");
}

// Bonds only touch the nearest neighbours, so that a sample of a dozen spheres across is as good as another within 2 %.
TEST_CASE("a random packing is calibrated in at most four trials", "[slow]")
{
    for (const auto& [stiffness, ratio] : {std::pair{1e6, 0.05}, std::pair{1e13, 3.0}}) {
        Case c = packed("random_dense", 1.0);
        c.parts[0].size_ratio = 1.5;
        c.parts[0].solid_fraction = 0.56;
        c.bonds[0].gap_factor = 0.05;
        CalibrationSpec& s = c.calibration[0];
        s.width = s.length = 10.0;
        s.start_normal_stiffness = stiffness;
        s.start_shear_ratio = ratio;
        const CalibrationSample sample(c, 0, default_device());
        const auto trials = find_bond_constants(sample.target(), sample.start(),
                                                [&](const BondConstants& k) { return sample.pull(k); });
        INFO("from " << stiffness << ", " << ratio);
        CHECK(trials.size() <= 4);
        CHECK(trials.back().response.young_modulus == Approx(5e9).epsilon(0.02));
        CHECK(trials.back().response.poisson_ratio == Approx(0.15).margin(0.003));
    }
}

TEST_CASE("packings are calibrated in at most four trials for targets and starts all over the range", "[slow]")
{
    for (const char* generator : {"hcp", "fcc", "random_dense"}) {
        const bool random = std::string(generator) == "random_dense";
        for (const double nu : {-0.1, 0.0, 0.1, 0.19}) {
            for (const double ratio : {0.0, 0.01, 0.1, 1.0, 10.0}) {
                Case c = packed(generator, 1.0);
                c.parts[0].size_ratio = 1.5;
                c.parts[0].solid_fraction = 0.56;
                c.bonds[0].gap_factor = 0.05;
                CalibrationSpec& s = c.calibration[0];
                s.width = s.length = random ? 9.0 : 8.0;
                s.poisson_ratio = nu;
                s.start_normal_stiffness = 1e7;
                s.start_shear_ratio = ratio;
                const CalibrationSample sample(c, 0, default_device());
                const auto trials = find_bond_constants(sample.target(), sample.start(),
                                                        [&](const BondConstants& k) { return sample.pull(k); });
                INFO(generator << ", nu " << nu << ", from k_s/k_n = " << ratio);
                CHECK(trials.size() <= 4);
                CHECK(meets(sample.target(), trials.back().response));
            }
        }
    }
}
