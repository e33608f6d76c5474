// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/lattice_stiffness.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;

// The elastic constants of the lattices with their inner displacements and rotations relaxed (an eigenvalue-free closed
// form from the equilibrium of the two-sphere cell), turned into the compliances of a bar.
TEST_CASE("springs of lattices: constants of the relaxed cells")
{
    const double d = 0.7, E = 5e9, s = std::sqrt(2.0) / d;
    for (const double nu : {-0.3, 0.0, 0.1, 0.19, 0.2}) {
        const auto h = hcp_stiffness(E, nu, d);
        REQUIRE(h);
        const double Kn = h->normal, Ks = h->shear_ratio * Kn, q = 24.0 * (Kn + 5.0 * Ks);
        const double C11 = s * (29.0 * Kn * Kn + 170.0 * Kn * Ks + 89.0 * Ks * Ks) / q;
        const double C12 = s * (Kn - Ks) * (11.0 * Kn + 49.0 * Ks) / q;
        const double C13 = s * (Kn - Ks) / 3.0, C33 = 2.0 * s * (2.0 * Kn + Ks) / 3.0;
        CHECK(C33 - 2.0 * C13 * C13 / (C11 + C12) == Approx(E).epsilon(1e-12));
        CHECK(C13 / (C11 + C12) == Approx(nu).margin(1e-14));
    }
    for (const double nu : {-0.3, 0.0, 0.2, 1.0 / 3.0}) {
        const auto f = fcc_stiffness(E, nu, d);
        REQUIRE(f);
        const double Kn = f->normal, Ks = f->shear_ratio * Kn;
        const double C11 = s * (Kn + Ks), C12 = 0.5 * s * (Kn - Ks);
        CHECK(C11 - 2.0 * C12 * C12 / (C11 + C12) == Approx(E).epsilon(1e-12));
        CHECK(C12 / (C11 + C12) == Approx(nu).margin(1e-14));
    }
}

// An isotropic set of directions has the means <n_x^4> = 1/5, <n_x^2 n_y^2> = 1/15; the energy of a uniform strain.
TEST_CASE("springs of a random packing: uniform strain of isotropic directions")
{
    const double E = 3e9, density = 7.0;
    for (const double nu : {-0.2, 0.0, 0.1, 0.25}) {
        const auto r = random_stiffness(E, nu, density);
        REQUIRE(r);
        const double Kn = r->normal, Ks = r->shear_ratio * Kn;
        const double C11 = density * (Kn / 5.0 + Ks * (1.0 / 3.0 - 1.0 / 5.0));
        const double C12 = density * (Kn - Ks) / 15.0;
        CHECK(C11 - 2.0 * C12 * C12 / (C11 + C12) == Approx(E).epsilon(1e-12));
        CHECK(C12 / (C11 + C12) == Approx(nu).margin(1e-14));
    }
}

TEST_CASE("springs of packings: range of Poisson ratios and the way back")
{
    CHECK_FALSE(hcp_stiffness(1e9, 0.21, 1.0));
    CHECK_FALSE(fcc_stiffness(1e9, 0.34, 1.0));
    CHECK_FALSE(random_stiffness(1e9, 0.26, 1.0));
    CHECK_FALSE(fcc_stiffness(1e9, -1.0, 1.0));
    for (const Packing p : {Packing::hcp, Packing::fcc, Packing::random}) {
        CHECK(lattice_stiffness(p, 1e9, largest_poisson_ratio(p), 2.0)->shear_ratio == 0.0);
        const LatticeElasticity e = lattice_elasticity(p, lattice_stiffness_at(p, 4e9, 0.3, 2.0), 2.0);
        CHECK(e.young_modulus == Approx(4e9).epsilon(1e-14));
        CHECK(lattice_stiffness(p, 4e9, e.poisson_ratio, 2.0)->shear_ratio == Approx(0.3).epsilon(1e-14));
    }
}
