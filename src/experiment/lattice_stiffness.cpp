// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/lattice_stiffness.h"

#include <algorithm>
#include <numbers>

namespace grainfrac {

namespace {

/// E = K_n density factor (r + q lambda)/(p + lambda).
struct Form {
    double p, factor, r, q;
};

Form form_of(Packing packing)
{
    switch (packing) {
        case Packing::hcp:
            return {5.0, 6.0 * std::numbers::sqrt2, 1.0, 1.0};
        case Packing::fcc:
            return {3.0, 2.0 * std::numbers::sqrt2, 1.0, 3.0};
        case Packing::honeycomb:
            return {3.0, 2.0, 1.0, 1.0};
        case Packing::random:
            break;
    }
    return {4.0, 1.0 / 3.0, 2.0, 3.0};
}

}  // namespace

double largest_poisson_ratio(Packing packing)
{
    return 1.0 / form_of(packing).p;
}

std::optional<LatticeStiffness> lattice_stiffness(Packing packing, double E, double nu, double density)
{
    const double p = form_of(packing).p;
    constexpr double round_off = 1e-12;  // a third has no decimal form
    if (!(nu > -1.0) || nu > 1.0 / p + round_off) return std::nullopt;
    return lattice_stiffness_at(packing, E, std::max(0.0, 1.0 - p * nu) / (1.0 + nu), density);
}

LatticeStiffness lattice_stiffness_at(Packing packing, double E, double shear_ratio, double density)
{
    return {E / lattice_elasticity(packing, {1.0, shear_ratio}, density).young_modulus, shear_ratio};
}

LatticeElasticity lattice_elasticity(Packing packing, const LatticeStiffness& springs, double density)
{
    const Form f = form_of(packing);
    const double s = springs.shear_ratio;
    return {springs.normal * density * f.factor * (f.r + f.q * s) / (f.p + s), (1.0 - s) / (f.p + s)};
}

std::optional<LatticeStiffness> hcp_stiffness(double E, double nu, double diameter)
{
    return lattice_stiffness(Packing::hcp, E, nu, 1.0 / diameter);
}

std::optional<LatticeStiffness> fcc_stiffness(double E, double nu, double diameter)
{
    return lattice_stiffness(Packing::fcc, E, nu, 1.0 / diameter);
}

std::optional<LatticeStiffness> random_stiffness(double E, double nu, double density)
{
    return lattice_stiffness(Packing::random, E, nu, density);
}

}  // namespace grainfrac
