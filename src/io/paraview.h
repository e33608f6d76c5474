// SPDX-License-Identifier: GPL-3.0-or-later
// The layers of a snapshot as VTK XML files, and the .pvd series that ParaView opens (fields: docs/output.md).
#pragma once

#include "io/results.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace grainfrac {

// One file each; all are written aside and renamed, and valid when empty. Throw std::runtime_error.

/// Grains as polyhedra (.vtu).
void write_grains(const std::filesystem::path& path, const Model& model, const State& state,
                  const SnapshotFields& fields);
/// Spheres as points with a radius (.vtp).
void write_spheres(const std::filesystem::path& path, const Model& model, const State& state,
                   const SnapshotFields& fields);
/// Bonds as the polygons between grains, those of spheres as lines between the centres (.vtp).
void write_bonds(const std::filesystem::path& path, const State& state);
/// Contacts that carry force, one vertex each (.vtp).
void write_contacts(const std::filesystem::path& path, const State& state);
/// Broken faces (.vtp).
void write_cracks(const std::filesystem::path& path, const State& state, const std::vector<CrackFace>& cracks);
/// Driven bodies, but for spheres (.vtp).
void write_walls(const std::filesystem::path& path, const Model& model, const State& state);

/// Some bodies, grains as polyhedra and spheres as points, with motion, force and kinetic energy (.vtu).
void write_culprits(const std::filesystem::path& path, const Model& model, const State& state,
                    const std::vector<int>& bodies);

/// The series at a checkpoint.
struct ParaviewMark {
    std::map<std::string, std::string> entries;  ///< per kind: the DataSet lines of its .pvd
    std::int64_t frame = 0;
};

/// Files of the series that are not there.
std::vector<std::string> missing_frames(const std::filesystem::path& folder, const ParaviewMark& mark);

/// The folder with its series, one frame after another.
class ParaviewSeries {
public:
    explicit ParaviewSeries(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Goes on from a checkpoint: later frames are removed.
    ParaviewSeries(std::filesystem::path folder, const ParaviewMark& mark);
    const ParaviewMark& mark() const { return now_; }

    void write_frame(const Model& model, const State& state, const SnapshotFields& fields,
                     const std::vector<CrackFace>& cracks, bool contacts);

private:
    /// Enter `file` into `kind`.pvd, which is made anew, so that a ParaView that is open can reload it.
    void enter(const std::string& kind, const std::string& file, double time);
    void write_series(const std::string& kind) const;

    std::filesystem::path folder_;
    ParaviewMark now_;
};

}  // namespace grainfrac
