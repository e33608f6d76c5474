// SPDX-License-Identifier: GPL-3.0-or-later
// The search for bond constants, on samples that are formulas.
#include "experiment/calibration.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;

namespace {

/// A finite sample: softer than its packing, the more so the weaker its shear springs, and another Poisson ratio.
Response sample(Packing packing, const BondConstants& k)
{
    const LatticeElasticity e = lattice_elasticity(packing, {k.normal_stiffness, k.shear_ratio}, 1.0);
    const double weaker = 0.08 / (1.0 + k.shear_ratio);
    Response r;
    r.young_modulus = (1.0 - weaker) * e.young_modulus;
    r.poisson_ratio = e.poisson_ratio + 0.3 * weaker - 0.2 * weaker * weaker;
    r.at_rest = true;
    return r;
}

}  // namespace

TEST_CASE("bond constants: at most four trials from any start")
{
    for (const Packing packing : {Packing::hcp, Packing::fcc, Packing::random, Packing::honeycomb}) {
        for (const double nu : {-0.1, 0.0, 0.1, 0.19}) {
            for (const double start_ratio : {0.0, 0.03, 0.3, 1.0, 5.0}) {
                for (const double start : {1e3, 1e9, 1e15}) {
                    ElasticTarget target;
                    target.young_modulus = 5e9;
                    target.poisson_ratio = nu;
                    target.packing = packing;
                    target.tolerance = 0.005;
                    const auto trials = find_bond_constants(target, {start, start_ratio},
                                                            [&](const BondConstants& k) { return sample(packing, k); });
                    INFO("start " << start_ratio << ", nu " << nu << ", packing " << static_cast<int>(packing));
                    CHECK(meets(target, trials.back().response));
                    CHECK(trials.size() <= 4);
                }
            }
        }
    }
}

TEST_CASE("bond constants: where the closed form is the sample, the second trial meets the target")
{
    ElasticTarget target;
    target.young_modulus = 70e9;
    target.poisson_ratio = 0.12;
    target.packing = Packing::hcp;
    target.tolerance = 1e-12;
    const auto trials = find_bond_constants(target, {1.0, 1.0}, [](const BondConstants& k) {
        const LatticeElasticity e = lattice_elasticity(Packing::hcp, {k.normal_stiffness, k.shear_ratio}, 1.0);
        return Response{e.young_modulus, e.poisson_ratio, 0.0, 0, true};
    });
    CHECK(trials.size() == 2);
    CHECK(meets(target, trials.back().response));
}

TEST_CASE("bond constants: a Poisson ratio that is not sought leaves the shear ratio")
{
    ElasticTarget target;
    target.young_modulus = 1e9;
    target.packing = Packing::random;
    const auto trials =
        find_bond_constants(target, {1e6, 0.4}, [](const BondConstants& k) { return sample(Packing::random, k); });
    CHECK(trials.size() == 2);
    CHECK(trials.back().bonds.shear_ratio == 0.4);
}

TEST_CASE("bond constants: a Poisson ratio out of reach is an error that tells how far it goes")
{
    ElasticTarget target;
    target.young_modulus = 1e9;
    target.poisson_ratio = 0.3;
    target.packing = Packing::random;
    try {
        find_bond_constants(target, {1e6, 0.4}, [](const BondConstants& k) { return sample(Packing::random, k); });
        FAIL("no error");
    } catch (const InputError& e) {
        CHECK(e.problems.front().key == "poisson_ratio");
        CHECK(e.problems.front().message.find("at most 0.27") != std::string::npos);
    }
}
