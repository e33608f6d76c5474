// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/crystal.h"
#include "io/input_checks.h"
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace grainfrac {

namespace {

/// Names of the walls that a ready-made test makes.
std::vector<std::string> walls_of_test(const Checks& checks)
{
    const std::string& kind = checks.input.test.kind;
    if (kind == "drop") return {"floor", "sides"};
    if (kind == "uniaxial_tension" || kind == "dcb") return {"grip_top", "grip_bottom"};
    if (kind == "brazilian" || kind == "uniaxial_compression") {
        if (kind == "uniaxial_compression" && checks.input.test.ends == "gripped") return {"grip_top", "grip_bottom"};
        return {"platen", "platen_top", "platen_bottom"};
    }
    return kind == "custom" ? std::vector<std::string>{}
                            : std::vector<std::string>{"roller", "roller_top", "roller_bottom"};
}

bool is_name(const std::string& name)
{
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char ch) {
        return (ch >= 'a' && ch <= 'z') || (ch >= 'A' && ch <= 'Z') || (ch >= '0' && ch <= '9') || ch == '_' ||
               ch == '-';
    });
}

/// Enters a name that `between` can hold; parts, materials and walls share one list, so that a name is never two
/// things.
void enter_name(Checks& checks, const std::string& name, const std::string& key, const std::string& what)
{
    if (!checks.given(key) || !checks.right(key) || !is_name(name)) checks.names_right = false;
    if (!checks.given(key) || !checks.right(key)) return;
    if (!is_name(name))
        return checks.fail(key, fmt::format("the name of {} must consist of letters, digits, _ and -", what));
    const std::vector<std::string> walls = walls_of_test(checks);
    if (std::find(walls.begin(), walls.end(), name) != walls.end())
        return checks.fail(key, fmt::format("this name belongs to the walls of the {} test", checks.input.test.kind));
    if (const auto [entry, is_new] = checks.owner.try_emplace(name, what); !is_new) {
        checks.fail(key, fmt::format("{} of this name exists already; parts, materials and walls need different names",
                                     entry->second));
    }
}

}  // namespace

void check_names(Checks& checks)
{
    for (const InputProblem& problem :
         checks.problems) {  // one of these is no table: there are names that are not known
        const std::string& key = problem.key;
        if (key == "materials" || key == "parts" || key == "walls" || key == "grips") checks.names_right = false;
    }
    for (const MaterialSpec& m : checks.input.materials) {
        enter_name(checks, m.name, joined("materials", m.name), "a material");
        for (std::size_t k = 0; k < m.cleavage.planes.size(); ++k) {
            try {
                parse_crystal_planes(m.cleavage.planes[k]);
            } catch (const std::invalid_argument& e) {
                checks.fail(fmt::format("{}.cleavage.planes[{}]", joined("materials", m.name), k), e.what());
            }
        }
        const std::string cleavage = joined("materials", m.name) + ".cleavage.", toughness = cleavage + "toughness";
        for (std::size_t k = 0; k < m.cleavage.planes.size(); ++k) {
            const auto first = std::find(m.cleavage.planes.begin(), m.cleavage.planes.end(), m.cleavage.planes[k]);
            if (first - m.cleavage.planes.begin() < static_cast<std::ptrdiff_t>(k))
                checks.fail(fmt::format("{}planes[{}]", cleavage, k), "is listed already");
        }
        const std::optional<double> residual = m.cleavage.residual_friction;
        if (m.cleavage.new_surface == "pre_cut" && residual && *residual > m.cleavage.friction &&
            checks.right(cleavage + "residual_friction") && checks.right(cleavage + "friction")) {
            checks.fail(
                cleavage + "residual_friction",
                fmt::format("must be <= friction, {}, with new_surface = \"pre_cut\": broken planes would create "
                            "energy",
                            m.cleavage.friction));
        }
        const std::size_t count = m.cleavage.toughness.size(), families = m.cleavage.planes.size();
        if (families > 0 && count > 1 && count != families && checks.right(toughness)) {
            checks.fail(toughness,
                        fmt::format("has {} values; must have one for all planes, or {} as `planes`", count, families));
        }
        checks.material_names.push_back(m.name);
    }
    for (std::size_t i = 0; i < checks.input.parts.size(); ++i) {
        enter_name(checks, checks.input.parts[i].name, joined("parts", i) + ".name", "a part");
    }
    for (std::size_t i = 0; i < checks.input.walls.size(); ++i) {
        enter_name(checks, checks.input.walls[i].name, joined("walls", i) + ".name", "a wall");
        checks.wall_names.push_back(checks.input.walls[i].name);
    }
    for (std::size_t i = 0; i < checks.input.grips.size(); ++i) {
        enter_name(checks, checks.input.grips[i].name, joined("grips", i) + ".name", "a grip");
        checks.wall_names.push_back(checks.input.grips[i].name);
        checks.grip_names.push_back(checks.input.grips[i].name);
    }
    std::set<std::string> stages;
    for (std::size_t i = 0; i < checks.input.stages.size(); ++i) {
        const std::string key = joined("stages", i) + ".name";
        if (!checks.given(key) || !checks.right(key)) continue;
        if (!is_name(checks.input.stages[i].name))
            checks.fail(key, "the name of a stage must consist of letters, digits, _ and -");
        if (!stages.insert(checks.input.stages[i].name).second) checks.fail(key, "a stage of this name exists already");
        if (checks.input.stages[i].kind == "bond") checks.bond_stages.push_back(checks.input.stages[i].name);
    }
    for (const auto& [name, what] : checks.owner) checks.pair_names.push_back(name);
    for (const std::string& name : walls_of_test(checks)) checks.pair_names.push_back(name);
    checks.pair_names.emplace_back("*");
}

}  // namespace grainfrac
