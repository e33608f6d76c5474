// SPDX-License-Identifier: GPL-3.0-or-later
// The checks of a case table by table; check_case (io/input_check.h) calls them in this order.
#pragma once

#include "model/case.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace grainfrac {

/// What the checks share: the case, what is wrong with it so far, and the names that it gives.
struct Checks {
    const Case& input;
    std::vector<InputProblem>& problems;
    std::set<std::string> wrong;               ///< paths of problems and of the tables around them
    std::set<std::string> released;            ///< grips that let go in the stages so far
    std::map<std::string, std::string> owner;  ///< names that `between` can hold, and what they name
    bool names_right = true;                   ///< else a name that is not there is not worth a message
    std::vector<std::string> material_names, wall_names, grip_names, pair_names, bond_stages;

    bool given(const std::string& key) const { return input.places.count(key) > 0; }
    /// Nothing was wrong with the key or below it before the checks began.
    bool right(const std::string& key) const { return wrong.count(key) == 0; }
    void fail(const std::string& key, std::string message) { problems.push_back({key, std::move(message)}); }
};

/// `names` and, if one is near, which of them was probably meant.
std::string choice(const std::string& name, const std::vector<std::string>& names);
/// Whether a part of this name or material is of this kind.
bool is_a(const Checks& checks, const char* kind, const std::string& name);

/// Materials with their cleavage, and the names of everything: the other checks need them.
void check_names(Checks& checks);
void check_parts(Checks& checks);
/// Bonds and contacts.
void check_bonds(Checks& checks);
/// Walls, grips and stages.
void check_walls(Checks& checks);
void check_test(Checks& checks);

}  // namespace grainfrac
