// SPDX-License-Identifier: GPL-3.0-or-later
// walls.csv: what acts on each wall and grip, and where it is; a row per row of history.csv.
#pragma once

#include "io/growing_text.h"
#include "io/results.h"

#include <filesystem>
#include <utility>
#include <vector>

namespace grainfrac {

/// What acts on a wall now.
struct WallRow {
    Vec3 force;                   ///< of everything on its bodies, their weight left out [N]
    Vec3 position;                ///< mean of its bodies [m]
    int bodies = 0;               ///< 0 once a grip has let go
    int contacts = 0;             ///< that press
    double contact_radius = 0.0;  ///< sqrt(2) radius of gyration of the contact points, weighted by their forces [m]
};
/// One a wall, in the order of Model::walls.
std::vector<WallRow> wall_rows(const Model& model, const State& state);

/// The growing file. Each row is on disk when append returns; errors throw std::runtime_error that names the file.
class WallHistory {
public:
    WallHistory(std::filesystem::path path, const RunFacts& facts, const Model& model);
    /// Goes on from a checkpoint.
    WallHistory(std::filesystem::path path, const TextMark& mark) : file_(std::move(path), mark) {}
    void append(const Model& model, const State& state);
    TextMark mark() const { return file_.mark(); }

private:
    GrowingText file_;
};

}  // namespace grainfrac
