// SPDX-License-Identifier: GPL-3.0-or-later
// A ready-made test: platens, stages, what is measured, when it ends. Case in, everything that a run needs out.
#pragma once

#include "experiment/laws.h"
#include "fracture/cleave.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

#include <optional>
#include <string>
#include <vector>

namespace grainfrac {

/// A wall that holds a push in a stage; no direction: it moves at its velocity.
struct Servo {
    Vec3 direction;               ///< unit; zero: none [-]
    std::optional<double> force;  ///< wanted [N]
    double stress = 0.0;          ///< or this [Pa]
    std::optional<double> area;   ///< times this; else the specimen's section when the stage begins [m^2]
    double max_speed = 0.0;       ///< [m/s]
};

/// Bonds that a stage makes at once.
struct BondsToMake {
    BondTable table;
    double distance = 0.0;  ///< largest gap or overlap of two faces [m]
    double angle = 0.0;     ///< largest angle between them [rad]
};

/// One stage of the loading programme; the first end condition that holds ends it.
struct Stage {
    std::string name;
    std::vector<Vec3> wall_velocity;               ///< one per wall [m/s]
    std::vector<Servo> servos;                     ///< one per wall, or none at all
    std::vector<std::int32_t> released;            ///< grips that let go at its beginning
    double ramp = 0.0;                             ///< time over which walls change speed or push [s]
    std::optional<Vec3> gravity;                   ///< else as before [m/s^2]
    double local_damping = 0.0;                    ///< [-]
    bool fracture = true;                          ///< bonds may break
    bool cleavage = true;                          ///< grains may split
    std::optional<BondsToMake> bonds;              ///< made at the beginning; such a stage takes no time
    bool unloads = false;                          ///< load_drop is a share of the load at the beginning
    std::int32_t loaded_wall = -1;                 ///< the first that moves; its push is the load of the stage
    Vec3 load_direction;                           ///< unit, of its push [-]
    std::optional<double> duration;                ///< [s]
    std::optional<double> load_drop;               ///< share of the peak load of this stage [-]
    std::optional<double> load;                    ///< push of the loaded wall [N]
    std::optional<double> stress;                  ///< the same over the section when the stage begins [Pa]
    std::optional<double> displacement;            ///< closing of the walls [m]
    std::optional<double> unbalanced_force_ratio;  ///< [-]
    std::optional<double> rest;                    ///< kinetic energy over its largest in the stage [-]
    std::optional<double> rest_energy;  ///< at rest: kinetic energy below this, the load that of the weight [J]
    double weight = 0.0;                ///< for rest_energy: the floor bears it, in the mean over rest_time [N]
    double rest_time = 0.0;             ///< for rest_energy: how long it has to stay below it [s]
};

/// What the measures refer to.
struct Specimen {
    double length = 0.0;              ///< along the load: strain = displacement/length; 0: no nominal values [m]
    double stress_area = 0.0;         ///< nominal stress = load/area; Brazilian: pi D t/2; 0: none [m^2]
    Vec3 load_direction;              ///< unit [-]
    std::int32_t loaded_wall = -1;    ///< its motion is the displacement, its force the load
    std::int32_t opposite_wall = -1;  ///< for imbalance; -1: none
    bool compression = true;          ///< load is the magnitude of a push
    double start_displacement = 0.0;  ///< of the walls, where the displacement counts from [m]
};

/// A row of the history, as far as derived results need it.
struct CurvePoint {
    double time = 0.0;    ///< [s]
    double load = 0.0;    ///< [N]
    double strain = 0.0;  ///< nominal [-]
    double stress = 0.0;  ///< nominal [Pa]
};
/// An entry of summary.json under "test", e.g. "modulus_Pa".
struct NamedResult {
    std::string name;
    double value = 0.0;
};

/// One state of the pull-out.
struct PullOutState {
    double end_stress = 0.0;        ///< pull over the fibre's section [Pa]
    double exit_slip = 0.0;         ///< where the fibre leaves the matrix [m]
    double end_displacement = 0.0;  ///< of the fibre's end against the mean of the support [m]
    double embedded_slip = 0.0;     ///< at the embedded end [m]
    double mean_damage = 0.0;       ///< over the area of the interface [-]
    double support_stress = 0.0;    ///< what the support bears, over the fibre's section [Pa]
};

/// What a pull-out test is about. Lengths along a fibre count from where its matrix begins.
struct PullOut {
    int fibre_group = -1, matrix_group = -1;
    int grip_wall = -1, support_wall = -1;
    int fibres = 1;
    Vec3 direction;                    ///< of the pull, along an axis [-]
    double length = 0.0;               ///< L within the matrix, mean of the fibres [m]
    double piece = 0.0;                ///< distance of the fibre's levels [m]
    double section = 0.0;              ///< of all fibres together [m^2]
    double young_modulus = 0.0;        ///< of the fibre [Pa]
    double before_exit = 0.0;          ///< from the last level to where the fibre leaves the matrix [m]
    double beyond_grip = 0.0;          ///< from the gripped bodies to the fibre's end [m]
    bool quasi_static = false;         ///< a path of equilibria, else time steps
    std::vector<double> place{};       ///< of each body along its fibre; below 0: not of a fibre, or not tied [m]
    std::vector<Vec3> along{};         ///< of each body of a fibre: its direction there [-]
    std::vector<char> at_end{};        ///< of each body: 1 first of its fibre in the matrix, 2 last one [-]
    std::vector<PullOutState> path{};  ///< so far
};

struct Experiment {
    std::string kind;
    Specimen specimen;
    std::vector<Stage> stages;
    int reference_stage = -1;           ///< where it begins, length, section and displacement are taken anew; -1: never
    double expected_duration = 0.0;     ///< guess from elasticity and strength, for output intervals and time left [s]
    double wave_speed = 0.0;            ///< sqrt(E/rho) of the loaded material [m/s]
    double quasi_static_speed = 0.0;    ///< 0.01 sigma_t/(rho c_0); 0 without a strength [m/s]
    double speed_of_each_wall = 0.0;    ///< that the test drives; 0: not known [m/s]
    bool quasi_static = true;           ///< else inertia belongs to the test, and nothing warns of it
    std::vector<NamedResult> facts;     ///< lengths that the test chose or found, for summary.json
    std::vector<std::string> warnings;  ///< what the user should know of the set-up
    std::optional<PullOut> pull_out;    ///< kind pull_out
    /// What the curve says beyond its peak; nullptr: nothing.
    std::vector<NamedResult> (*results)(const Experiment&, const std::vector<CurvePoint>& curve) = nullptr;
};

struct Measurement {
    double displacement = 0.0;      ///< closing of the walls [m]
    double load = 0.0;              ///< [N]
    double strain = 0.0;            ///< [-]
    double stress = 0.0;            ///< [Pa]
    double platen_imbalance = 0.0;  ///< |F_a - F_b| over their mean [-]
};

/// Model, state and experiment of a case. Throws InputError for what only building can find out.
struct Built {
    Model model;
    State state;
    Experiment experiment;
    std::vector<CleavageRules> cleavage{};  ///< one per group; empty where no material cleaves
};
Built build(const Case& c, Device device);

/// Forces on the walls and how far they went.
Measurement measure(const Experiment& e, const Model& model, const State& state);

/// Set wall motions, gravity, damping and fracture switch of a stage that begins now.
void begin_stage(const Stage& stage, Model& model, State& state);

/// Length, section and displacement refer to the state as it is now.
void take_reference(Experiment& e, const Model& model, const State& state);

/// Largest resultant on a free body over the mean force of its interactions [-].
double unbalanced_force_ratio(const State& state);

}  // namespace grainfrac
