// SPDX-License-Identifier: GPL-3.0-or-later
// The result folder: history, snapshots, cracks, checkpoints, summary (interface: docs/output.md).
#pragma once

#include "fracture/cleave.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"
#include "motion/energy.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace grainfrac {

class Archive;
struct FibreProfile;
struct PullOutState;

/// How much broke where.
struct CrackSums {
    double intergranular_area = 0.0;  ///< of broken faces between grains, and of broken parallel bonds [m^2]
    double transgranular_area = 0.0;  ///< of broken faces within what was one grain [m^2]
    double transgranular_work = 0.0;  ///< dissipated by damage of such faces, also of those that still hold [J]
};

/// One row of history.csv; the csv and the HDF5 table are both made from for_each_column. Counts are visited as
/// integers.
struct HistoryRow {
    std::int64_t step = 0;
    double time = 0.0;            ///< [s]
    double displacement = 0.0;    ///< closing of the platens [m]
    double load = 0.0;            ///< magnitude in a compression test [N]
    double nominal_strain = 0.0;  ///< [-]
    double nominal_stress = 0.0;  ///< [Pa]
    Ledger energy;
    double unbalanced_force_ratio = 0.0;  ///< largest resultant over mean interaction force [-]
    double platen_imbalance = 0.0;        ///< |F_top - F_bottom| over their mean [-]
    std::int64_t broken_bonds_tension = 0, broken_bonds_shear = 0, split_grains = 0, fragments = 0;
    CrackSums cracks;

    template <class Visit>  // visit(name with unit, value)
    void for_each_column(Visit&& visit) const
    {
        visit("step", step);
        visit("time_s", time);
        visit("displacement_m", displacement);
        visit("load_N", load);
        visit("nominal_strain", nominal_strain);
        visit("nominal_stress_Pa", nominal_stress);
        visit("kinetic_energy_J", energy.kinetic);
        visit("elastic_energy_bonds_J", energy.elastic_bonds);
        visit("elastic_energy_contacts_J", energy.elastic_contacts);
        visit("friction_work_J", energy.friction);
        visit("damping_work_J", energy.damping);
        visit("fracture_work_J", energy.fracture);
        visit("inserted_energy_J", energy.inserted);
        visit("external_work_J", energy.external);
        visit("gravity_work_J", energy.gravity);
        visit("energy_error", energy.relative_error());
        visit("unbalanced_force_ratio", unbalanced_force_ratio);
        visit("platen_imbalance", platen_imbalance);
        visit("broken_bonds_tension", broken_bonds_tension);
        visit("broken_bonds_shear", broken_bonds_shear);
        visit("split_grains", split_grains);
        visit("fragments", fragments);
        visit("intergranular_area_m2", cracks.intergranular_area);
        visit("transgranular_area_m2", cracks.transgranular_area);
        visit("transgranular_fracture_work_J", cracks.transgranular_work);
    }
};

/// What a snapshot shows beyond the state itself.
struct SnapshotFields {
    std::vector<Mat3> stress;             ///< mean Cauchy stress of each body, tension positive; zero for walls [Pa]
    std::vector<std::int32_t> cluster;    ///< bonded component of each body, -1 for walls; numbered by size, largest 0
    std::vector<GrainCleavage> cleavage;  ///< of each body; where no material cleaves, all are as far from it as can be

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c] = *this;
        visit("stress", a);
        visit("cluster", b);
        visit("cleavage", c);
    }
};

/// A face that broke.
struct CrackFace {
    std::vector<Vec3> polygon;              ///< where it is now (mean of the two sides) [m]
    int mode = 0;                           ///< 0 intergranular, 1 transgranular
    int cause = 0;                          ///< 0 tension, 1 shear, 2 mixed
    double time = 0.0;                      ///< when its last point failed [s]
    double first_damage_time = 0.0;         ///< [s]
    double area = 0.0;                      ///< [m^2]
    Vec3 normal;                            ///< from grain_a to grain_b [-]
    double opening = 0.0;                   ///< mean normal jump now [m]
    double K_I = 0.0, K_II = 0.0;           ///< transgranular only [Pa m^0.5]
    std::int32_t grain_a = 0, grain_b = 0;  ///< body ids
};
/// Every interface that failed and every broken parallel bond (as a 16-gon), in the order of their times.
std::vector<CrackFace> collect_cracks(const Model& model, const State& state);

/// Of the state as it is.
CrackSums crack_sums(const State& state);

/// Run facts that stand in every file's head.
struct RunFacts {
    std::string version, input_hash, device;
    std::int64_t seed = 0;
    int threads = 1;
    std::string test_kind;  ///< "brazilian", "custom"
    bool fibre = false;     ///< one is pulled out, or a part lies inside another
};

/// A plot that could not be made: worth a warning, not the end of a run.
struct PlotError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct FolderMark;

/// Owns the folder, which no other process can write meanwhile. Every file is either growing (history.csv, results.h5:
/// flushed after each row, results.h5 readable live as SWMR) or written aside and renamed.
class ResultFolder {
public:
    /// Creates the folder. Throws InputError (key "--out") if it exists and `replace` is false or if it cannot be
    /// written; with `replace` an existing folder is removed only if it is a result folder (holds resolved.toml).
    ResultFolder(const std::filesystem::path& folder, bool replace);
    enum class Existing { go_on };
    /// The folder of a run that is to go on. Throws InputError (key "DIR") if it is none, std::runtime_error if a run
    /// is at work in it or it cannot be written.
    ResultFolder(const std::filesystem::path& folder, Existing);
    ~ResultFolder();

    const std::filesystem::path& path() const;

    /// input.toml as given, resolved.toml; opens history.csv and results.h5.
    void begin(const RunFacts& facts, const std::string& input_text, const std::string& resolved_toml);
    void append_history(const HistoryRow& row);
    /// A row of walls.csv.
    void append_walls(const Model& model, const State& state);
    /// paraview/*.vtu|vtp + *.pvd, and the snapshot group of results.h5. `contacts`: write the contact polygons too.
    void write_snapshot(const Model& model, const State& state, const SnapshotFields& fields, bool contacts);
    /// unstable.vtu: where an instability shows.
    void write_culprits(const Model& model, const State& state, const std::vector<int>& bodies);
    /// A row of pull_out.csv, and a profile where one is due.
    void append_pull_out(const PullOutState& row, const FibreProfile& profile, const std::vector<double>& profiles_at);
    /// checkpoint/step_N.h5; keeps the newest two. Throws std::runtime_error.
    void write_checkpoint(std::int64_t step, const std::function<void(Archive&)>& content);
    /// How much of the growing files there is; all of it is on disk when this returns.
    FolderMark mark();
    /// Instead of begin(): the growing files are cut back to the mark and go on from there; what an earlier end left is
    /// removed. Throws CheckpointError if a file holds less than the mark says, or something else.
    void go_on(const RunFacts& facts, const std::string& resolved_toml, const FolderMark& mark,
               const std::vector<double>& profiles_at);
    /// summary.json (text made by the caller), fragments.csv, clusters.csv, plots/*, the tables of results.h5.
    /// Throws PlotError, with everything else written, if a plot could not be made; `plots` false: none are made.
    void finish(const std::string& summary_json, const Model& model, const State& state, const SnapshotFields& fields,
                bool plots = true);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Curves for one plot; used for load-displacement and energies.
struct Curve {
    std::string label;
    std::vector<double> x, y;
};
/// Line plot as SVG and PNG (`stem`.svg, `stem`.png), made with PLplot; needs no display.
void plot_curves(const std::filesystem::path& stem, const std::string& title, const std::string& x_label,
                 const std::string& y_label, const std::vector<Curve>& curves);
/// Crack map: traces of the cracks in the xy plane over the outline of the grains, those between grains coloured by
/// cause, those through grains in a colour of their own; SVG and PNG.
void plot_crack_map(const std::filesystem::path& stem, const Model& model, const State& state,
                    const std::vector<CrackFace>& cracks);

}  // namespace grainfrac
