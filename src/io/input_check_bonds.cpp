// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_checks.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <type_traits>

namespace grainfrac {

namespace {

/// Names in `between` exist, and no two entries are for the same pair.
template <class Spec>
void check_pairs(Checks& checks, const std::string& table, const std::vector<Spec>& entries)
{
    std::map<std::tuple<std::string, std::string, std::string>, std::string> seen;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string path = joined(table, i), key = path + ".between";
        if (!checks.right(key)) continue;
        for (std::size_t k = 0; k < 2; ++k) {
            const std::string& name = entries[i].between[k];
            if (!checks.names_right ||
                std::find(checks.pair_names.begin(), checks.pair_names.end(), name) != checks.pair_names.end())
                continue;
            checks.fail(joined(key, k), "no part, material or wall of this name; " + choice(name, checks.pair_names));
        }
        auto pair = std::minmax(entries[i].between[0], entries[i].between[1]);
        std::string made_in;
        if constexpr (std::is_same_v<Spec, BondSpec>) made_in = entries[i].made_in;
        const auto [entry, is_new] = seen.try_emplace({pair.first, pair.second, made_in}, path);
        if (!is_new) checks.fail(key, fmt::format("{} is for the same pair", entry->second));
    }
}

bool may_join(const Checks& checks, const BondSpec& b, const std::string& material)
{
    return std::any_of(checks.input.parts.begin(), checks.input.parts.end(), [&](const PartSpec& p) {
        const auto is_it = [&](const std::string& name) { return name == "*" || name == p.name || name == material; };
        return p.material == material && (is_it(b.between[0]) || is_it(b.between[1]));
    });
}

/// The rules of "auto" give a negative shear stiffness beyond a certain Poisson's ratio (physics/grains 9).
void check_elasticity(Checks& checks, const BondSpec& b, const std::string& path)
{
    if (b.elasticity == "homogeneous" || b.shear_ratio || !checks.right(path + ".elasticity") ||
        !checks.right(path + ".shear_ratio")) {
        return;
    }
    const bool plane = b.elasticity == "plane";
    const double limit = plane ? 1.0 / 3.0 : 1.0 / 4.0;
    for (const MaterialSpec& m : checks.input.materials) {
        if (!may_join(checks, b, m.name) || m.poisson_ratio < limit || !checks.right(joined("materials", m.name)))
            continue;
        checks.fail(path + ".elasticity",
                    fmt::format("\"{}\" with shear_ratio = \"auto\" needs poisson_ratio < {}; that of \"{}\" is {}",
                                b.elasticity, plane ? "1/3" : "1/4", m.name, m.poisson_ratio));
    }
}

/// Laws by what they join: spheres have no faces, grains no centre that a spring could hang on.
void check_what_is_joined(Checks& checks, const BondSpec& b, const std::string& path)
{
    if (!checks.right("parts")) return;
    const bool no_grains = std::all_of(checks.input.parts.begin(), checks.input.parts.end(),
                                       [](const PartSpec& p) { return p.kind == "spheres"; });
    const bool some_sphere =
        is_a(checks, "spheres", b.between[0]) || is_a(checks, "spheres", b.between[1]) || no_grains;
    if (b.law == "interface" && some_sphere && !checks.given(path + ".shear_stiffness") &&
        checks.right(path + ".law") && checks.right(path + ".between")) {
        // without it the entry was read as one of grains
        std::erase_if(checks.problems, [&](const InputProblem& p) { return p.key.rfind(path + '.', 0) == 0; });
        checks.fail(path + ".shear_stiffness", "missing; required for the interface of a fibre, such as \"1e9 Pa/m\"");
    }
    if (!checks.right(path)) return;
    const bool some_grain = is_a(checks, "grains", b.between[0]) || is_a(checks, "grains", b.between[1]);
    if (b.law == "spring" && !some_sphere)
        checks.fail(path + ".law", "\"spring\" joins spheres; grains take \"interface\", \"parallel\" or \"point\"");
    if (b.law == "point" && some_sphere)
        checks.fail(path + ".law", "\"point\" joins grains; spheres take \"parallel\" or \"spring\"");
    if (b.law != "interface" && some_sphere && some_grain)
        checks.fail(path + ".law", fmt::format("\"{}\" cannot join spheres and grains; use \"interface\"", b.law));
    if (b.shear_ratio && *b.shear_ratio == 0.0 && !some_sphere && checks.right(path + ".shear_ratio"))
        checks.fail(path + ".shear_ratio", "must be > 0 between grains");
    if (b.failure_slip && !b.yield_slip && checks.right(path + ".failure_slip"))
        checks.fail(path + ".yield_slip", "missing; required with failure_slip");
    if (b.failure_slip && b.yield_slip && *b.failure_slip <= *b.yield_slip && checks.right(path + ".failure_slip"))
        checks.fail(path + ".failure_slip", fmt::format("must be > {:.6g} m, the yield_slip", *b.yield_slip));
}

void check_bond(Checks& checks, const BondSpec& b, const std::string& path)
{
    check_elasticity(checks, b, path);
    check_what_is_joined(checks, b, path);
    if (checks.given(path + ".made_in") && checks.right(path + ".made_in") && checks.right("stages") &&
        std::find(checks.bond_stages.begin(), checks.bond_stages.end(), b.made_in) == checks.bond_stages.end()) {
        checks.fail(path + ".made_in",
                    "no stage of kind = \"bond\" has this name; " + choice(b.made_in, checks.bond_stages));
    }
    if (b.failure == "unbreakable" || !checks.right(path + ".failure")) return;
    if (b.failure == "face" && checks.right(path + ".law") && checks.right(path + ".softening")) {
        if (b.law != "interface")
            checks.fail(path + ".failure", fmt::format("\"face\" needs law = \"interface\", not \"{}\"", b.law));
        if (b.softening != "brittle") {
            checks.fail(path + ".failure",
                        fmt::format("\"face\" needs softening = \"brittle\", not \"{}\"", b.softening));
        }
    }
    if (b.law != "interface" && b.softening == "bilinear" && checks.given(path + ".softening") &&
        checks.right(path + ".law")) {
        checks.fail(path + ".softening", fmt::format("\"bilinear\" needs law = \"interface\", not \"{}\"", b.law));
    }
    if (b.shear_stiffness == 0.0 && b.residual_friction && *b.residual_friction > b.friction &&
        checks.right(path + ".residual_friction") && checks.right(path + ".friction")) {
        checks.fail(path + ".residual_friction",
                    fmt::format("must be <= friction, {}: broken bonds would create energy", b.friction));
    }
    const bool strengths_right = b.cohesion > 0.0 && checks.right(path + ".tensile_strength") &&
                                 checks.right(path + ".cohesion") && checks.right(path + ".friction") &&
                                 checks.right(path + ".onset");
    if (b.onset == "mohr_coulomb" && strengths_right && b.tensile_strength * b.friction > b.cohesion) {
        checks.fail(path + ".tensile_strength",
                    fmt::format("must be <= {:.6g} Pa, cohesion / friction, with onset = \"mohr_coulomb\"",
                                b.cohesion / b.friction));
    }
}

}  // namespace

void check_bonds(Checks& checks)
{
    check_pairs(checks, "bonds", checks.input.bonds);
    check_pairs(checks, "contacts", checks.input.contacts);
    for (std::size_t i = 0; i < checks.input.bonds.size(); ++i)
        check_bond(checks, checks.input.bonds[i], joined("bonds", i));
}

}  // namespace grainfrac
