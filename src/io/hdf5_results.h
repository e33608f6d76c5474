// SPDX-License-Identifier: GPL-3.0-or-later
// results.h5: history, snapshots, bonds, cracks, clusters and fragments in one file that can be read while it grows
// (schema: docs/output.md).
#pragma once

#include "io/bond_faces.h"
#include "io/folder_mark.h"
#include "io/fragments.h"
#include "io/hdf5_file.h"
#include "io/results.h"

#include <map>
#include <string>
#include <tuple>
#include <unordered_map>

namespace grainfrac {

/// Rises when a reader of the file has to change.
inline constexpr std::int64_t results_schema = 2;

/// The growing file. Everything given is flushed when a call returns; errors throw std::runtime_error.
class Hdf5Results {
public:
    Hdf5Results(const std::filesystem::path& path, const RunFacts& facts);
    /// Goes on from `mark`: the file becomes what it was then. Broken off, it can be done again.
    Hdf5Results(const std::filesystem::path& path, const RunFacts& facts, const Hdf5Mark& mark);

    /// Everything so far is on disk when this returns.
    Hdf5Mark mark();
    void append_history(const HistoryRow& row);
    void append_snapshot(const Model& model, const State& state, const SnapshotFields& fields,
                         const std::vector<CrackFace>& cracks);
    /// What happened after the last snapshot: bonds, cracks and clusters; and the fragments of the end.
    void finish(const Model& model, const State& state, const SnapshotFields& fields,
                const std::vector<CrackFace>& cracks);
    void close();

private:
    void make(const RunFacts& facts);
    void make_snapshots();
    void make_bonds();
    void make_cracks();
    void make_tables();
    void append_grains(const Model& model, const State& state, const SnapshotFields& fields);
    void write_bond_table(const State& state, const std::vector<BondFacts>& bonds, const std::vector<int>& slots);
    struct BondRow {
        int slot = 0;
        hsize_t row = 0;
    };
    std::vector<BondRow> update_bonds(const State& state, const std::vector<BondFacts>& bonds);
    void append_cracks(const std::vector<CrackFace>& cracks);
    /// Rows of one struct as datasets of `group`, one for each of its columns.
    using Table = std::map<std::string, Hdf5Growing>;
    template <class Row>
    Table make_table(const std::string& group);
    template <class Row>
    void append_table(Table& table, const std::vector<Row>& rows);
    void append_clusters(const std::vector<Cluster>& clusters, const State& state, std::int32_t snapshot);

    template <class Visit>
    void for_each_dataset(Visit&& visit);
    std::vector<std::int64_t> extents();

    Hdf5File file_;
    Hdf5Growing history_;
    struct Snapshots {
        Hdf5Growing time, step, grain_id, radius, position, orientation, velocity, stress, cluster, damage, cleavage;
    } snapshots_;
    struct Bonds {
        Hdf5Growing kind, grain_a, grain_b, area, normal, normal_stiffness, shear_stiffness, damage, failure_time,
            cause;
    } bonds_;
    struct Cracks {
        Hdf5Growing time, first_damage_time, mode, cause, grain_a, grain_b, area, center, normal, opening, k_i, k_ii;
    } cracks_;
    Hdf5Growing cluster_snapshot_, cluster_time_;
    Table clusters_, fragments_;
    std::unordered_map<std::int32_t, hsize_t> grain_rows_;
    std::map<std::tuple<std::int32_t, std::int32_t, int>, hsize_t> bond_rows_;  // ids of the grains, number in the pair
    std::vector<FileRange> chunks_;  // where in the file the data is, as far as known at the last mark
    Hdf5Mark now_;                   // but for what is looked up in the file
};

}  // namespace grainfrac
