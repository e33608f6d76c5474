// SPDX-License-Identifier: GPL-3.0-or-later
// Bond and contact tables of the input as laws by pair.
#pragma once

#include "generate/assemble.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Index of the most specific entry whose `between` covers groups a and b, -1 if none does. A group is named by its own
/// name, "platen" or "roller" (all of a ready-made test), its material, or "*"; the later of equals wins.
int most_specific(const std::vector<std::array<std::string, 2>>& betweens, const Model& model, int group_a,
                  int group_b);

/// One rule for every pair of groups that is bonded at the start or by a stage; fills interface_laws and parallel_laws.
class BondTable {
public:
    /// Of the entries of [[bonds]] with this `made_in`; "": those that are there from the start.
    BondTable(const Case& c, Model& model, const std::string& made_in = "");
    /// nullptr if the pair is not bonded.
    const BondRule* rule_of(int group_a, int group_b) const;
    /// Entry of [[bonds]] that the rule of law `law` came from.
    int entry_of(const BondRule& rule) const;

private:
    int groups_ = 0;
    std::vector<BondRule> rules_;
    std::vector<int> entry_;
    std::vector<int> of_pair_;
};

/// A bilinear point needs lambda_f > lambda_0: G_I > sigma_c^2/(2 k_n) and G_II > c^2/(2 k_s), or it would snap back
/// within itself. Throws InputError where a bond of this table does not.
void check_snap_back(const Model& model, const State& state, const BondTable& table);

/// contact_laws and contact_law_of. `spacing`: mean grain spacing of each group, 0 for walls [m].
void make_contact_laws(const Case& c, const std::vector<double>& spacing, Model& model);

/// Viscous ratio zeta < 1 that gives a restitution when the contact cannot pull; 1 for what no such ratio reaches [-].
double damping_ratio_of(double restitution);

/// Stiffness k_n h and ratio k_s/k_n that make an assembly of modulus E and Poisson ratio nu (rigid-body-spring
/// network; Kawai 1978). `kind`: homogeneous (nu = 0: k_n = k_s = E/h, exact on any Voronoi or power diagram), plane
/// (hexagonal prisms, plane stress), solid (statistically isotropic; mean field). A given ratio takes precedence over
/// nu.
struct NetworkStiffness {
    double modulus = 0.0;      ///< k_n h [Pa]
    double shear_ratio = 1.0;  ///< [-]
};
NetworkStiffness network_stiffness(const std::string& kind, double E, double nu, std::optional<double> shear_ratio);

}  // namespace grainfrac
