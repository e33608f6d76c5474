// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Poisson ratios below this are told from zero by this share of it: they may be zero.
constexpr double smallest_poisson_ratio = 0.1;
/// Shear ratios beyond are no springs of a solid any more: nu is within 1 % of its limit -1.
constexpr double largest_shear_ratio = 1000.0;

/// Within this range of the form's Poisson ratio the difference is taken for a line; beyond, it bends.
constexpr double straight = 0.1;

/// Response over closed form: how the sample differs from the infinite packing.
struct Difference {
    double stiffness;  ///< of the modulus, a factor [-]
    double poisson;    ///< of the Poisson ratio, to be added [-]
};

Difference difference_of(Packing packing, const Trial& t)
{
    const LatticeElasticity form = lattice_elasticity(packing, {t.bonds.normal_stiffness, t.bonds.shear_ratio}, 1.0);
    return {t.response.young_modulus / form.young_modulus, t.response.poisson_ratio - form.poisson_ratio};
}

/// The difference at another shear ratio: on the line through the last two trials, or as in the last.
Difference expected_difference(Packing packing, const std::vector<Trial>& trials, double poisson_of_form)
{
    const Trial& last = trials.back();
    const Difference a = difference_of(packing, last);
    if (trials.size() < 2) return a;
    const Trial& before = trials[trials.size() - 2];
    const auto of_form = [&](const Trial& t) {
        return lattice_elasticity(packing, {1.0, t.bonds.shear_ratio}, 1.0).poisson_ratio;
    };
    const double span = of_form(last) - of_form(before);
    if (std::fabs(span) < 1e-6 || std::fabs(span) > straight) return a;
    const Difference b = difference_of(packing, before);
    const double share = (poisson_of_form - of_form(last)) / span;
    return {a.stiffness + share * (a.stiffness - b.stiffness), a.poisson + share * (a.poisson - b.poisson)};
}

BondConstants next_constants(const ElasticTarget& target, const std::vector<Trial>& trials)
{
    const Packing p = target.packing;
    double ratio = trials.back().bonds.shear_ratio;
    if (target.poisson_ratio) {
        // The form's nu at which form + difference is what is wanted; the difference moves little with it.
        // From afar the difference says little of what it is there: first to where the form would have it.
        double nu = *target.poisson_ratio;
        const double last = lattice_elasticity(p, {1.0, ratio}, 1.0).poisson_ratio;
        const bool near = std::fabs(nu - last) <= straight;
        for (int i = 0; near && i < 50; ++i) nu = *target.poisson_ratio - expected_difference(p, trials, nu).poisson;
        const double most = largest_poisson_ratio(p),
                     least = lattice_elasticity(p, {1.0, largest_shear_ratio}, 1.0).poisson_ratio;
        nu = std::clamp(nu, least, most);
        ratio = lattice_stiffness(p, 1.0, nu, 1.0)->shear_ratio;
        if (ratio == 0.0 && trials.back().bonds.shear_ratio == 0.0) {
            throw InputError("poisson_ratio",
                             fmt::format("no shear ratio of the bonds reaches it; this sample reaches at most {:.4g}",
                                         trials.back().response.poisson_ratio));
        }
    }
    const double nu = lattice_elasticity(p, {1.0, ratio}, 1.0).poisson_ratio;
    const double stiffer = expected_difference(p, trials, nu).stiffness;
    return {lattice_stiffness_at(p, target.young_modulus / stiffer, ratio, 1.0).normal, ratio};
}

}  // namespace

bool meets(const ElasticTarget& target, const Response& r)
{
    if (std::fabs(r.young_modulus / target.young_modulus - 1.0) > target.tolerance) return false;
    if (!target.poisson_ratio) return true;
    const double nu = *target.poisson_ratio;
    return std::fabs(r.poisson_ratio - nu) <= target.tolerance * std::max(std::fabs(nu), smallest_poisson_ratio);
}

std::vector<Trial> find_bond_constants(const ElasticTarget& target, const BondConstants& start,
                                       const std::function<Response(const BondConstants&)>& pull)
{
    std::vector<Trial> trials{{start, pull(start)}};
    while (!meets(target, trials.back().response) && static_cast<int>(trials.size()) < target.most_trials) {
        const BondConstants next = next_constants(target, trials);
        trials.push_back({next, pull(next)});
    }
    return trials;
}

}  // namespace grainfrac
