// SPDX-License-Identifier: GPL-3.0-or-later
// Pull-outs as cases, and the path of their equilibria without files.
#pragma once

#include "experiment/experiment.h"
#include "experiment/pull_out.h"
#include "experiment/pull_out_path.h"
#include "gpu/device.h"
#include "io/pull_out_files.h"
#include "motion/energy.h"
#include "motion/step.h"
#include "support/workplace.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace grainfrac::test {

/// Matrix of spheres of 1 m, E 5 GPa, radius 6 m; fibre of E 50 GPa, radius 1 m.
inline Case pull_out_case(double length)
{
    Case c;
    MaterialSpec stiff, soft;
    stiff.name = "stiff";
    stiff.density = 4443.0;
    stiff.young_modulus = 50e9;
    stiff.poisson_ratio = 0.2;
    soft = stiff;
    soft.name = "soft";
    soft.young_modulus = 5e9;
    c.materials = {stiff, soft};
    PartSpec matrix, fibre;
    matrix.name = "matrix";
    matrix.kind = fibre.kind = "spheres";
    matrix.material = "soft";
    matrix.generator = "hcp";
    matrix.lattice_origin = "channel";
    matrix.diameter = 1.0;
    matrix.region.shape = "cylinder";
    matrix.region.diameter = 12.0;
    matrix.region.height = length;
    fibre.name = "fibre";
    fibre.material = "stiff";
    fibre.generator = "chain";
    fibre.diameter = 0.8;
    fibre.inside = "matrix";
    fibre.fibre.from = {0.0, 0.0, -0.5 * length - 0.2};
    fibre.fibre.to = {0.0, 0.0, 0.5 * length + 0.2};
    fibre.fibre.radius = 1.0;
    c.parts = {matrix, fibre};
    BondSpec solid, line, interface;
    solid.law = "parallel";
    solid.failure = "unbreakable";
    line = solid;
    line.between = {"fibre", "fibre"};
    solid.between = {"matrix", "matrix"};
    solid.shear_ratio = 0.4;  // the lattice's axial shear modulus is then E/(2 (1 + 0.3))
    interface.between = {"fibre", "matrix"};
    interface.shear_stiffness = 1e9;
    interface.yield_slip = 1e-3;
    interface.failure_slip = 3e-3;
    c.bonds = {solid, line, interface};
    c.test.kind = "pull_out";
    c.test.fibre = "fibre";
    c.test.matrix = "matrix";
    return c;
}

/// A case that was built and started, and the path that it has gone.
struct PulledOut {
    Built built;
    std::vector<PullOutState> path;
    PullOutPath::Found found = PullOutPath::Found::equilibrium;  // the last

    explicit PulledOut(const Case& c) : built(build(c, default_device())) { start(built.model, built.state); }

    const PullOut& pull_out() const { return *built.experiment.pull_out; }
    PullOutState now() const { return pull_out_state(pull_out(), built.state); }
    /// All equilibria until `enough` says so.
    template <class Enough>
    void follow(const PathSettings& settings, const Enough& enough)
    {
        PullOutPath p(pull_out(), settings, built.model, built.state);
        path = {now()};
        while ((found = p.next(built.model, built.state, {})) == PullOutPath::Found::equilibrium) {
            path.push_back(now());
            if (enough(path.back())) return;
        }
    }
    double largest(double PullOutState::*what) const
    {
        return (*std::max_element(path.begin(), path.end(),
                                  [&](const PullOutState& x, const PullOutState& y) { return x.*what < y.*what; })).*
               what;
    }
};

inline PathSettings by_damage(double step)
{
    PathSettings s;
    s.damage_step = step;
    s.shift = 1e-3;
    return s;
}

inline PathSettings by_displacement(double step)
{
    PathSettings s;
    s.by_damage = false;
    s.shift = step;
    return s;
}

/// Phases in pull_out.csv, each once, in their order.
inline std::vector<int> phases_in_file(const PulledOut& run)
{
    const Workplace place;
    const std::filesystem::path& folder = place.folder;
    PullOutFiles files(folder, {});
    for (const PullOutState& s : run.path) files.append(s, {});
    std::ifstream in(folder / "pull_out.csv");
    std::vector<int> phases;
    std::string line;
    while (std::getline(in, line)) {
        if (line.empty() || line[0] == '#' || line[0] == 'e') continue;
        std::size_t at = 0;
        for (int k = 0; k < 5; ++k) at = line.find(',', at) + 1;
        const int phase = std::stoi(line.substr(at));
        if (phases.empty() || phases.back() != phase) phases.push_back(phase);
    }
    return phases;
}

}  // namespace grainfrac::test
