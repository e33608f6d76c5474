// SPDX-License-Identifier: GPL-3.0-or-later
// Grains that are cut along all their candidate planes before the run: the same cleavage without any change of topology
// (14.8), to hold the splits of a run against.
#pragma once

#include "fracture/cleave.h"
#include "generate/assemble.h"
#include "model/case.h"

#include <vector>

namespace grainfrac {

/// What the cuts made.
class PreCut {
public:
    /// Cuts the grains of parts with new_surface = "pre_cut" by every candidate plane of their crystals, as far as the
    /// limits on fragments allow, and takes their families out of `rules`: they are not split again. Parts keep the
    /// site of the grain, so that bonds to neighbours are as stiff as those of the whole grain.
    PreCut(const Case& c, std::vector<CleavageRules>& rules, std::vector<GrainSpec>& grains);

    /// Rule of the bond between two grains of the list if a candidate plane parts them; nullptr for any other pair.
    const BondRule* rule_of(int a, int b) const;

    /// Marks the bonds that were made by these rules as transgranular; a flaw in a plane of finite width is weaker.
    void finish(State& state) const;

private:
    struct Family {
        CleavageLaw law;
        BondRule rule;
    };
    struct Cut {
        Plane plane;  // in space
        std::size_t family = 0;
    };
    /// Of each grain of the list.
    struct Piece {
        std::int32_t origin = -1;
        Vec3 center;
    };
    std::vector<Family> families_;
    std::vector<std::vector<Cut>> cuts_;  // of the whole grain, by origin
    std::vector<Piece> pieces_;
};

}  // namespace grainfrac
