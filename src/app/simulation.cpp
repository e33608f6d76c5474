// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/simulation.h"

#include "app/progress.h"
#include "app/run_state.h"
#include "app/signals.h"
#include "experiment/bond_stage.h"
#include "experiment/pull_out_path.h"
#include "experiment/specimen.h"
#include "experiment/stability.h"
#include "fracture/clusters.h"
#include "fracture/grain_stress.h"
#include "io/checkpoint.h"
#include "io/folder_mark.h"
#include "model/grain_body.h"
#include "model/validate.h"
#include "motion/servo.h"
#include "motion/step.h"
#include "motion/time_step.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>

namespace grainfrac {

namespace {

/// History rows of a run whose interval the user left open.
constexpr double automatic_rows = 2000.0;
/// Snapshots of a run whose number the user left open.
constexpr double automatic_snapshots = 20.0;
/// The time step is checked against the present stiffness after this many steps: contacts come slowly compared to it.
constexpr int steps_between_checks = 500;
/// Shorter time steps are logged from this share on.
constexpr double logged_change = 0.01;
/// Steps between two looks at whether the run is still stable, where no row comes sooner.
constexpr int steps_between_looks = 200;
/// Nothing moves faster than so many times the waves, or what was told or set free to move.
constexpr double fastest = 10.0;
/// A residual below this share of E V (as m c_0^2) is round-off, whatever the other terms are: strains of 1e-9.
constexpr double negligible_energy = 1e-18;
/// At rest the floor bears the weight within this share of it.
constexpr double balanced = 0.1;
/// First move of the grip over the fibre's length where no slip is told [-].
constexpr double first_shift = 1e-5;
/// Kinetic over elastic energy counts from this share of the peak load: at the very start both are nothing.
constexpr double monitored_load = 0.1;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t)
{
    return std::chrono::duration<double>(Clock::now() - t).count();
}

class Simulation {
public:
    Simulation(const Case& c, const Options& o, const RunOrigin& origin, Built& built, ResultFolder& folder,
               RunRecord& record, SnapshotFields& fields)
        : case_(c),
          origin_(origin),
          model_(built.model),
          state_(built.state),
          experiment_(built.experiment),
          cleavage_(built.cleavage),
          folder_(folder),
          record_(record),
          fields_(fields),
          progress_(o.quiet)
    {
    }

    void begin()
    {
        start(model_, state_);
        choose_step();
        choose_history();
        choose_snapshots();
        for (int i = 0; i < state_.bodies.size(); ++i)
            run_.energy_floor +=
                negligible_energy * state_.bodies.mass[i] * experiment_.wave_speed * experiment_.wave_speed;
        run_.most_speed = speed_limit();
        record_.first_momentum = total_momentum(model_, state_);
        record_.cracks = CrackWatch(crack_scale(model_, state_));
        if (case_.output.checkpoint > 0.0 || case_.output.checkpoint_steps) checkpoint();
    }

    /// Instead of begin().
    void restore(const RunFacts& facts, const Restart& restart)
    {
        const double build = record_.phases.build;
        const RunOrigin now = origin_;
        read_checkpoint(restart.checkpoint, facts.version, [&](Archive& archive) { transfer(archive); });
        origin_ = now;
        record_.phases.build += build;
        if (restart.new_time_step) choose_step();
        change_intervals(restart);
        folder_.go_on(facts, origin_.resolved, mark_, case_.test.profiles_at);
        for (const auto& newer : restart.refused) {
            spdlog::warn("{} is damaged or of another version: set aside as {}.refused", newer.string(),
                         newer.filename().string());
            set_aside(newer);
        }
        spdlog::info("goes on from {}, step {}, t = {:.6g} s{}", restart.checkpoint.string(), state_.step, state_.time,
                     restart.input_changed ? ", with a changed input" : "");
        if (restart.input_changed) checkpoint();  // older ones know nothing of the change
        last_checkpoint_ = Clock::now();
        last_checkpoint_step_ = state_.step;
    }

    Ending run()
    {
        Ending ending{exit_code::done, "all stages done"};
        const auto stages = static_cast<std::int64_t>(experiment_.stages.size());
        progress_.begin(progress(experiment_.stages[static_cast<std::size_t>(run_.stage)]));
        for (; run_.stage < stages; ++run_.stage, run_.stage_begun = false) {
            const Stage& stage = experiment_.stages[static_cast<std::size_t>(run_.stage)];
            spdlog::info("stage \"{}\"{}", stage.name, run_.stage_begun ? " goes on" : "");
            if (!run_.stage_begun) begin(stage);
            if (experiment_.pull_out && experiment_.pull_out->quasi_static)
                ending = run_path(stage);
            else
                ending = stage.bonds ? bond_stage(stage) : run_stage(stage);
            if (!finished_stage_) break;
            if (case_.test.stop.time && experiment_.kind == "custom" && state_.time >= *case_.test.stop.time) break;
        }
        if (ending.code == exit_code::done) last_snapshot(experiment_.stages.back());
        record_.last_momentum = total_momentum(model_, state_);
        record_.time_step = run_.dt;
        progress_.finish(progress(experiment_.stages.back()));
        return ending;
    }

private:
    void begin(const Stage& stage)
    {
        begin_stage(stage, model_, state_);
        if (!stage.released.empty()) shorten_step_if_needed(time_step_bound(model_, state_));
        if (run_.stage == experiment_.reference_stage) begin_reference();
        remember_begin(stage);
        if (state_.step == 0) record_row(stage);
        run_.stage_begun = true;
    }

    /// All that the run needs to go on, for both directions. Members that are not here hold nothing from one step to
    /// the next.
    void transfer(Archive& archive)
    {
        archive("/origin", origin_);
        grainfrac::transfer(archive, "/model", model_);
        grainfrac::transfer(archive, "/state", state_);
        archive("/run", run_);
        archive("/record", record_);
        archive("/fields", fields_);
        archive("/specimen", experiment_.specimen);
        if (experiment_.pull_out) archive("/equilibria", experiment_.pull_out->path);
        bool on_path = path_.has_value();
        archive("/on_path", on_path);
        if (archive.loading()) {
            if (const std::string why = why_not_valid(model_, state_); !why.empty()) archive.fail(why);
            if (run_.stage < 0 || run_.stage >= static_cast<std::int64_t>(experiment_.stages.size()) ||
                static_cast<int>(model_.grain_shapes.size()) != state_.bodies.size() ||
                (on_path && !experiment_.pull_out))
                archive.fail("was made from another input");
            path_.reset();
            if (on_path) make_path();
        }
        if (on_path) archive("/path", *path_);
        archive("/folder", mark_);
    }

    void choose_step()
    {
        const ChosenStep s = choose_time_step(case_, model_, state_);
        run_.dt = s.dt;
        run_.step_limit = 0.0;
        record_.critical_step = s.critical;
        record_.limiter = s.limiter;
        spdlog::info("time step {:.4g} s, stability limit {:.4g} s ({})", run_.dt, s.critical, s.limiter);
    }

    void choose_history()
    {
        const double expected = experiment_.expected_duration;
        run_.history = case_.output.history.value_or(expected > 0.0 ? std::max(expected / automatic_rows, run_.dt)
                                                                    : 100.0 * run_.dt);
        record_.history_interval = run_.history;
    }

    void choose_snapshots()
    {
        const double expected = experiment_.expected_duration;
        const double count =
            case_.output.snapshots ? static_cast<double>(*case_.output.snapshots) : automatic_snapshots;
        run_.every = case_.output.every.value_or(expected > 0.0 ? expected / count : 5000.0 * run_.dt);
        record_.snapshot_interval = run_.every;
    }

    /// An interval that did not change stays: chosen anew from the present, shorter step it would move rows, and with
    /// them where stages end. A new one counts from the last row or snapshot.
    void change_intervals(const Restart& restart)
    {
        const double history = run_.history, every = run_.every;
        if (restart.new_history) choose_history();
        if (restart.new_snapshots) choose_snapshots();
        if (!record_.rows.empty()) run_.next_history += run_.history - history;
        if (run_.next_snapshot > 0.0) run_.next_snapshot += run_.every - every;
    }

    Ending run_stage(const Stage& stage)
    {
        finished_stage_ = false;
        while (true) {
            if (state_.step % steps_between_checks == 0 && state_.step > 0)
                shorten_step_if_needed(time_step_bound(model_, state_));
            const bool snapshot = state_.time + 0.5 * run_.dt >= run_.next_snapshot;
            const bool cleave = !cleavage_.empty() && stage.cleavage;
            const bool ask_gate = cleave && gate_is_due(state_);
            const auto before = Clock::now();
            step(model_, state_, run_.dt, snapshot || ask_gate);
            record_.phases.steps += seconds_since(before);
            // a snapshot waits for the step after a split, when the stresses of the parts are known
            if (!(cleave && split_where_due(ask_gate)) && snapshot) write_snapshot();
            if (state_.time + 0.5 * run_.dt >= run_.next_history || time_is_up(stage)) {
                record_row(stage);
                if (!is_stable(record_.rows.back().energy)) return unstable();
                if (const std::string why = why_ended(stage); !why.empty()) {
                    finished_stage_ = true;
                    spdlog::info("stage \"{}\" ended: {}", stage.name, why);
                    return {exit_code::done, why};
                }
                progress_.update(progress(stage));
            } else if (state_.step % steps_between_looks == 0 && !is_stable(energy_now())) {
                record_row(stage);
                return unstable();
            }
            if (pending_signal() != 0) return stop_for_signal();
            if (checkpoint_is_due()) checkpoint();
        }
    }

    void make_path()
    {
        const PullOut& p = *experiment_.pull_out;
        PathSettings s;
        double failure = 0.0;
        for (const BondSpec& b : case_.bonds)
            failure = std::max({failure, b.yield_slip.value_or(0.0), b.failure_slip.value_or(0.0)});
        if (failure == 0.0) failure = first_shift * p.length;
        s.by_damage = case_.test.control == "damage";
        s.damage_step = case_.test.damage_step;
        s.shift = case_.test.displacement_step.value_or(failure / 20.0);
        s.slide = case_.test.slide_step.value_or(p.length / 60.0);
        s.slides = case_.test.stop.slip.has_value();
        s.relax.tolerance = case_.test.relaxed;
        path_.emplace(p, s, model_, state_);
    }

    /// A row of equilibria instead of time steps.
    Ending run_path(const Stage& stage)
    {
        finished_stage_ = false;
        if (!path_) make_path();
        while (true) {
            const auto before = Clock::now();
            const State last_state = state_;
            const PullOutPath last_path = *path_;
            const PullOutPath::Found found = path_->next(model_, state_, [] { return pending_signal() != 0; });
            record_.phases.steps += seconds_since(before);
            if (pending_signal() != 0) {  // a relaxation is not broken off and taken up again with the same bits
                state_ = last_state;
                path_.emplace(last_path);
                return stop_for_signal();
            }
            if (found == PullOutPath::Found::end) {
                finished_stage_ = true;
                return {exit_code::done, "the interface is broken"};
            }
            if (found == PullOutPath::Found::not_at_rest) {
                return {exit_code::unstable,
                        fmt::format("unstable: no equilibrium after {} steps, the mean residual is {:.2g} of the mean "
                                    "force of the bonds; raise test.relaxed, or hold what can move freely",
                                    path_->last().steps, path_->last().residual)};
            }
            if (found == PullOutPath::Found::not_softening) {
                return {
                    exit_code::unstable,
                    "unstable: with friction no state was found where the interface softens; lower test.relaxed, or "
                    "use test.control = \"displacement\""};
            }
            record_row(stage);
            spdlog::debug("equilibrium {}: {} steps, residual {:.2g}", state_.time, path_->last().steps,
                          path_->last().residual);
            if (state_.time >= run_.next_snapshot) write_snapshot_at_rest();
            if (!is_stable(record_.rows.back().energy)) return unstable();
            if (const std::string why = why_path_ended(); !why.empty()) {
                finished_stage_ = true;
                return {exit_code::done, why};
            }
            progress_.update(progress(stage));
            if (checkpoint_is_due()) checkpoint();
        }
    }

    std::string why_pull_out_ended() const
    {
        const PullOutState& s = experiment_.pull_out->path.back();
        const StopSpec& stop = case_.test.stop;
        if (stop.damage && s.mean_damage >= *stop.damage)
            return fmt::format("mean damage {:.4g} reached", s.mean_damage);
        if (stop.slip && s.exit_slip >= *stop.slip) return fmt::format("slip {:.4g} m reached", s.exit_slip);
        return {};
    }

    std::string why_path_ended() const
    {
        if (const std::string why = why_pull_out_ended(); !why.empty()) return why;
        const PullOutState& s = experiment_.pull_out->path.back();
        const StopSpec& stop = case_.test.stop;
        if (stop.strain && s.end_displacement >= *stop.strain * experiment_.pull_out->length)
            return fmt::format("displacement {:.4g} m reached", s.end_displacement);
        if (stop.time && state_.time >= *stop.time) return fmt::format("{:.0f} equilibria", state_.time);
        if (stop.load_drop && broken_or_damaged() &&
            record_.rows.back().load < (1.0 - *stop.load_drop) * record_.peak_load)
            return fmt::format("load dropped by {:.0f} % from its peak {:.5g} N", 100.0 * *stop.load_drop,
                               record_.peak_load);
        return {};
    }

    /// Stresses come with the forces: they are found once more, without a step.
    void write_snapshot_at_rest()
    {
        Model at_rest = model_;
        at_rest.fracture_active = false;
        step(at_rest, state_, 0.0, true);
        write_snapshot();
    }

    /// Load, displacement, strain and peak of the test count from here.
    void begin_reference()
    {
        take_reference(experiment_, model_, state_);
        record_.peak_load = record_.peak_stress = record_.peak_displacement = 0.0;
        record_.peak_time = record_.load_start = state_.time;
    }

    void remember_begin(const Stage& stage)
    {
        run_.stage_start = state_.time;
        run_.stage_kinetic = 0.0;
        run_.stage_body = -1;
        for (int i = 0; i < state_.bodies.size() && run_.stage_body < 0 && stage.loaded_wall >= 0; ++i) {
            if (state_.bodies.wall[i] == stage.loaded_wall) run_.stage_body = i;
        }
        if (run_.stage_body >= 0) run_.stage_origin = state_.bodies.position[run_.stage_body];
        run_.stage_section =
            stage.stress ? section_across(specimen_extent(model_, state_).size(), stage.load_direction) : 0.0;
        run_.stage_peak = run_.stage_first_load = stage.unloads ? stage_load(stage) : 0.0;
    }
    /// Push of the first wall that the stage moves; of ready-made tests and stages that move none, the test's load [N].
    double stage_load(const Stage& stage) const
    {
        if (stage.loaded_wall < 0) return record_.rows.empty() ? 0.0 : record_.rows.back().load;
        return wall_push(model_, state_, stage.loaded_wall, stage.load_direction);
    }
    /// Of a ready-made test: closing of both platens; else how far the stage's first moving wall went [m].
    double stage_displacement() const
    {
        if (experiment_.kind != "custom") return record_.rows.back().displacement;
        return run_.stage_body < 0 ? 0.0 : norm(state_.bodies.position[run_.stage_body] - run_.stage_origin);
    }

    /// Bonds between what faces each other now; takes no time.
    Ending bond_stage(const Stage& stage)
    {
        const auto refused = [&](const std::string& why) {
            return Ending{exit_code::wrong_input, fmt::format("stages[{}]: {}", run_.stage, why)};
        };
        finished_stage_ = false;
        BondsMade made;
        try {
            made = make_bonds(model_, state_, *stage.bonds, case_.simulation.seed);
        } catch (const InputError& e) {
            return refused(fmt::format("{}: {}", e.problems.front().key, e.problems.front().message));
        }
        if (made.number == 0) {
            return refused(fmt::format("no faces of grains lie against each other within bond_distance = {:.4g} m",
                                       stage.bonds->distance));
        }
        if (const std::string why = why_not_valid(model_, state_); !why.empty())
            throw std::logic_error("new bonds made an impossible state: " + why);
        record_.bonding_energy -= made.removed_energy;
        const Vec3 p = made.before.linear, L = made.before.angular;
        spdlog::info(
            "{} bonds of {:.4g} m^2 made; taken out to begin without stress: {:.4g} J, momentum ({:.3g}, {:.3g}, "
            "{:.3g}) "
            "kg m/s, angular momentum ({:.3g}, {:.3g}, {:.3g}) kg m^2/s",
            made.number, made.area, made.removed_energy, p.x, p.y, p.z, L.x, L.y, L.z);
        if (!case_.control.time_step) {
            choose_step();
        } else if (const TimeStepBound bound = time_step_bound(model_, state_); run_.dt > bound.with_damping) {
            return {exit_code::wrong_input, fmt::format("control.time_step: must be <= {:.4g} s, the stability limit "
                                                        "once the bonds are made ({})",
                                                        bound.with_damping, bound.limiter)};
        }
        run_.broken = -1;  // fragments are to be counted anew
        record_row(stage);
        finished_stage_ = true;
        return {exit_code::done, fmt::format("{} bonds made", made.number)};
    }

    void shorten_step_if_needed(const TimeStepBound& bound)
    {
        if (bound.body < 0) return;
        if (case_.control.time_step) {  // the user's stays what it is; the next look ends the run
            if (run_.dt <= bound.with_damping) return;
            run_.step_limit = bound.with_damping;
            record_.critical_step = bound.with_damping;
            record_.limiter = bound.limiter;
            return;
        }
        const double allowed = case_.control.time_step_safety * bound.with_damping;
        if (allowed >= run_.dt) return;
        const bool worth_a_line = allowed < (1.0 - logged_change) * run_.dt;
        if (worth_a_line)
            spdlog::info("step {}: time step {:.4g} -> {:.4g} s ({})", state_.step, run_.dt, allowed, bound.limiter);
        run_.dt = allowed;
        record_.critical_step = bound.with_damping;
        record_.limiter = bound.limiter;
    }

    /// True if a grain was split.
    bool split_where_due(bool ask_gate)
    {
        const auto before = Clock::now();
        std::vector<Mat3> stress;
        if (ask_gate) stress = grain_stress(model_, state_);
        const std::vector<SplitRequest> due =
            look_for_splits(model_, state_, ask_gate ? &stress : nullptr, cleavage_, run_.dt);
        record_.phases.looks += seconds_since(before);
        return !due.empty() && split(due);
    }

    bool split(const std::vector<SplitRequest>& due)
    {
        const auto before = Clock::now();
        std::vector<int> parts;
        for (const SplitReport& r : split_grains(model_, state_, due)) {
            if (r.status == SplitStatus::done) {
                parts.insert(parts.end(), {r.body, r.new_body});
                ++record_.splits;
                record_.split_area += r.area;
                record_.split_energy += r.inserted_energy;
                spdlog::debug("step {}: grain {} split", state_.step, r.parent_id);
            } else {
                ++record_.refused_splits[to_string(r.status)];
                if (r.status == SplitStatus::degenerate) keep_refused_cut(r.body, due);
            }
        }
        if (!parts.empty()) {
            if (const std::string why = why_not_valid(model_, state_); !why.empty())
                throw std::logic_error("a split made an impossible state: " + why);
            shorten_step_if_needed(time_step_bound(model_, state_, parts));
        }
        record_.phases.splitting += seconds_since(before);
        return !parts.empty();
    }

    /// The geometry that no clean cut was found for, to be looked into.
    void keep_refused_cut(int body, const std::vector<SplitRequest>& due) const
    {
        const auto folder = folder_.path() / "refused_cuts";
        std::error_code ignored;
        std::filesystem::create_directories(folder, ignored);
        std::ofstream out(folder / fmt::format("step_{}_grain_{}.txt", state_.step, state_.bodies.id[body]));
        const Polyhedron& p = model_.grain_shapes[static_cast<std::size_t>(body)];
        const Placement place = placement(state_.bodies, body);
        for (const SplitRequest& r : due) {
            if (r.body != body) continue;
            const Vec3 n = rotate_back(place.orientation, r.plane.normal);
            out << fmt::format("plane {:.17g} {:.17g} {:.17g} {:.17g}\n", n.x, n.y, n.z,
                               r.plane.offset - dot(r.plane.normal, place.position));
        }
        for (const Vec3& v : p.vertices) out << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", v.x, v.y, v.z);
        for (const auto& face : p.faces) out << fmt::format("face {}\n", fmt::join(face, " "));
    }

    void record_row(const Stage& stage)
    {
        const auto before = Clock::now();
        const Measurement m = measure(experiment_, model_, state_);
        HistoryRow r;
        r.step = state_.step;
        r.time = state_.time;
        r.displacement = m.displacement;
        r.load = m.load;
        r.nominal_strain = m.strain;
        r.nominal_stress = m.stress;
        r.energy = energy_ledger(model_, state_);
        r.energy.negligible = run_.energy_floor;
        r.unbalanced_force_ratio = unbalanced_force_ratio(state_);
        r.platen_imbalance = m.platen_imbalance;
        count_broken(r);
        r.cracks = crack_sums(state_);
        r.split_grains = record_.splits;
        watch_rest(stage, r);
        folder_.append_history(r);
        if (!model_.walls.empty() && (experiment_.kind == "custom" || experiment_.kind == "drop"))
            folder_.append_walls(model_, state_);
        if (experiment_.pull_out) {
            experiment_.pull_out->path.push_back(pull_out_state(*experiment_.pull_out, state_));
            folder_.append_pull_out(experiment_.pull_out->path.back(), fibre_profile(*experiment_.pull_out, state_),
                                    case_.test.profiles_at);
        }
        record_.rows.push_back(r);
        if (m.load > record_.peak_load) {
            record_.peak_load = m.load;
            record_.peak_stress = m.stress;
            record_.peak_time = r.time;
            record_.peak_displacement = m.displacement;
            record_.imbalance_at_peak = m.platen_imbalance;
        }
        run_.stage_peak = std::max(run_.stage_peak, stage_load(stage));
        run_.stage_kinetic = std::max(run_.stage_kinetic, r.energy.kinetic);
        run_.next_history = state_.time + run_.history;
        record_.phases.output += seconds_since(before);
    }

    void count_broken(HistoryRow& r)
    {
        const InterfaceBonds& f = state_.interfaces;
        for (int i = 0; i < f.size(); ++i) {
            if (f.failure_time[i] < 0.0) continue;
            (f.shear_share[i] < 0.5 * f.area[i] ? r.broken_bonds_tension : r.broken_bonds_shear) += 1;
        }
        const auto count = [&](const auto& bonds) {
            for (int i = 0; i < bonds.size(); ++i) {
                if (bonds.cause[i] == static_cast<int>(BondCause::tension)) ++r.broken_bonds_tension;
                if (bonds.cause[i] == static_cast<int>(BondCause::shear)) ++r.broken_bonds_shear;
            }
        };
        count(state_.parallels);
        count(state_.sphere_bonds);
        const std::int64_t broken = r.broken_bonds_tension + r.broken_bonds_shear;
        if (broken != run_.broken || record_.rows.empty()) {
            const std::vector<std::int32_t> cluster = bonded_clusters(state_);
            run_.fragments = static_cast<std::int64_t>(std::set<std::int32_t>(cluster.begin(), cluster.end()).size()) -
                             (std::find(cluster.begin(), cluster.end(), -1) != cluster.end() ? 1 : 0);
            run_.broken = broken;
            record_.cracks.look(model_, state_);
        }
        r.fragments = run_.fragments;
    }

    /// Waves, walls, what moves at the start, and a fall through the whole model set the scale.
    double speed_limit() const
    {
        if (!(experiment_.wave_speed > 0.0)) return 0.0;
        double scale = std::max(experiment_.wave_speed, fastest_speed(model_, state_));
        for (const Stage& s : experiment_.stages) {
            for (const Vec3& v : s.wall_velocity) scale = std::max(scale, norm(v));
        }
        Vec3 low, high;
        for (int i = 0; i < state_.bodies.size(); ++i) {
            const Vec3 x = state_.bodies.position[i];
            for (int k = 0; k < 3; ++k) {
                low[k] = i == 0 ? x[k] : std::min(low[k], x[k]);
                high[k] = i == 0 ? x[k] : std::max(high[k], x[k]);
            }
        }
        return fastest * std::max(scale, std::sqrt(2.0 * norm(model_.gravity) * norm(high - low)));
    }

    Ledger energy_now() const
    {
        Ledger e = energy_ledger(model_, state_);
        e.negligible = run_.energy_floor;
        return e;
    }

    /// A look at what shows that a run has gone wrong; instability_ says what it is.
    bool is_stable(const Ledger& energy)
    {
        StabilityLimits limits;
        const bool too_long = run_.step_limit > 0.0;
        const TimeStepBound bound = too_long ? time_step_bound(model_, state_) : TimeStepBound{};
        if (too_long) limits.bound = &bound;
        limits.time_step = run_.dt;
        limits.fixed_step = case_.control.time_step.has_value();
        limits.speed = run_.most_speed;
        limits.error_before = run_.error_before;
        if (path_) limits.remedy = "lower test.damage_step, test.displacement_step or test.relaxed";
        instability_ = find_instability(model_, state_, energy, limits);
        run_.error_before = account_is_off(energy) ? std::fabs(energy.residual()) : 0.0;
        return !instability_;
    }

    /// Says where it shows, in words and in a file; the checkpoint before it stays.
    Ending unstable()
    {
        folder_.write_culprits(model_, state_, instability_.bodies);
        return {exit_code::unstable, "unstable: " + instability_.reason};
    }

    bool time_is_up(const Stage& s) const
    {
        const bool test_over =
            experiment_.kind == "custom" && case_.test.stop.time && state_.time >= *case_.test.stop.time;
        return test_over || (s.duration && state_.time - run_.stage_start >= *s.duration);
    }

    std::string why_ended(const Stage& s) const
    {
        const HistoryRow& r = record_.rows.back();
        if (s.duration && state_.time - run_.stage_start >= *s.duration)
            return fmt::format("time {:.4g} s reached", state_.time);
        if (s.displacement && stage_displacement() >= *s.displacement) {
            return fmt::format("displacement {:.4g} m reached", stage_displacement());
        }
        if (experiment_.pull_out && !experiment_.pull_out->path.empty()) {
            if (const std::string why = why_pull_out_ended(); !why.empty()) return why;
        }
        const double load = stage_load(s);
        const auto reached = [&](double wanted) { return s.unloads ? load <= wanted : load >= wanted; };
        if (s.load && reached(*s.load)) return fmt::format("load {:.5g} N reached", load);
        if (s.stress && reached(*s.stress * run_.stage_section))
            return fmt::format("stress {:.5g} Pa reached", load / run_.stage_section);
        if (s.load_drop && s.unloads && load <= (1.0 - *s.load_drop) * run_.stage_first_load)
            return fmt::format("load went back from {:.5g} to {:.5g} N", run_.stage_first_load, load);
        if (s.load_drop && !s.unloads && broken_or_damaged() && load < (1.0 - *s.load_drop) * run_.stage_peak) {
            return fmt::format("load dropped by {:.0f} % from its peak {:.5g} N", 100.0 * *s.load_drop,
                               run_.stage_peak);
        }
        // what a moving wall has not reached yet is not at rest
        const bool settled = state_.time > run_.stage_start + s.ramp && (s.loaded_wall < 0 || load > 0.0) &&
                             (s.servos.empty() || servos_hold(model_, state_));
        if (s.unbalanced_force_ratio && settled && r.unbalanced_force_ratio < *s.unbalanced_force_ratio)
            return fmt::format("unbalanced force ratio below {:.2g}", *s.unbalanced_force_ratio);
        const bool still = r.energy.kinetic <= run_.energy_floor;  // nothing moved, or round-off does
        if (s.rest && settled &&
            (still || (r.energy.kinetic < *s.rest * run_.stage_kinetic && r.unbalanced_force_ratio < balanced)))
            return fmt::format("at rest, kinetic energy {:.2g} J", r.energy.kinetic);
        const double lasted = state_.time - run_.rest_start;
        if (s.rest_energy && lasted >= s.rest_time &&
            std::fabs(run_.rest_impulse - s.weight * lasted) < balanced * s.weight * lasted)
            return fmt::format("at rest, kinetic energy {:.2g} J", r.energy.kinetic);
        if (case_.test.stop.time && experiment_.kind == "custom" && state_.time >= *case_.test.stop.time)
            return "stop.time reached";
        return {};
    }
    /// How long the kinetic energy has been low, and the impulse of the floor since then.
    void watch_rest(const Stage& s, const HistoryRow& r)
    {
        if (!s.rest_energy || record_.rows.empty() || r.energy.kinetic >= *s.rest_energy) {
            run_.rest_start = r.time;
            run_.rest_impulse = 0.0;
            return;
        }
        const HistoryRow& before = record_.rows.back();
        run_.rest_impulse += 0.5 * (before.load + r.load) * (r.time - before.time);
    }
    /// A load drop counts only once something failed: waves make the load of a platen dip at first touch.
    bool broken_or_damaged() const { return run_.broken > 0; }

    ProgressState progress(const Stage& s) const
    {
        ProgressState p;
        p.stage = s.name;
        p.step = state_.step;
        p.time = state_.time;
        if (experiment_.expected_duration > 0.0) p.done = std::min(0.99, state_.time / experiment_.expected_duration);
        if (!record_.rows.empty()) {
            p.load = record_.rows.back().load;
            p.fragments = record_.rows.back().fragments;
        }
        p.broken = run_.broken;
        return p;
    }

    void write_snapshot()
    {
        const auto before = Clock::now();
        fields_.stress = grain_stress(model_, state_);
        fields_.cleavage = find_cleavage(model_, state_, fields_.stress, cleavage_);
        fields_.cluster = bonded_clusters(state_);
        folder_.write_snapshot(model_, state_, fields_, case_.output.contacts);
        run_.next_snapshot = state_.time + run_.every;
        record_.phases.output += seconds_since(before);
    }

    /// The state in which the run ended is always shown: one more step, which also gathers stresses.
    void last_snapshot(const Stage& stage)
    {
        if (experiment_.pull_out && experiment_.pull_out->quasi_static) return write_snapshot_at_rest();
        step(model_, state_, run_.dt, true);
        record_row(stage);
        write_snapshot();
    }

    bool checkpoint_is_due() const
    {
        const OutputSpec& o = case_.output;
        const bool asked = checkpoint_asked_for();  // one that is due anyway fulfils the wish
        return asked || (o.checkpoint > 0.0 && seconds_since(last_checkpoint_) > o.checkpoint) ||
               (o.checkpoint_steps && state_.step - last_checkpoint_step_ >= *o.checkpoint_steps);
    }

    /// A state that is not possible is never written over a good one.
    void checkpoint()
    {
        std::string why = why_not_valid(model_, state_);
        if (why.empty() && account_is_off(energy_now())) why = "the energy account is off by more than 10 %";
        if (!why.empty()) {
            spdlog::warn("no checkpoint: {}", why);  // the last good one stays
        } else {
            mark_ = folder_.mark();
            folder_.write_checkpoint(state_.step, [&](Archive& archive) { transfer(archive); });
        }
        last_checkpoint_ = Clock::now();
        last_checkpoint_step_ = state_.step;
    }

    Ending stop_for_signal()
    {
        const int signal = pending_signal();
        checkpoint();
        return {128 + signal, signal == 2 ? "interrupted by SIGINT" : "terminated by SIGTERM"};
    }

    const Case& case_;
    RunOrigin origin_;
    Model& model_;
    State& state_;
    Experiment& experiment_;
    const std::vector<CleavageRules>& cleavage_;
    ResultFolder& folder_;
    RunRecord& record_;
    SnapshotFields& fields_;
    Progress progress_;
    RunState run_;
    Instability instability_;          // what the last look found
    std::optional<PullOutPath> path_;  // of a stage that is a row of equilibria
    FolderMark mark_;                  // of the checkpoint that is being written or was read
    bool finished_stage_ = false;      // the stage that just ran
    std::int64_t last_checkpoint_step_ = 0;
    Clock::time_point last_checkpoint_;
};

/// From a tenth of the peak load to the peak.
void monitor_quasi_static(RunRecord& record)
{
    for (const HistoryRow& r : record.rows) {
        if (r.time > record.peak_time) break;
        if (r.time < record.load_start) continue;
        const double elastic = r.energy.elastic_bonds + r.energy.elastic_contacts;
        if (r.load < monitored_load * record.peak_load || elastic <= 0.0) continue;
        record.kinetic_over_elastic = std::max(record.kinetic_over_elastic, r.energy.kinetic / elastic);
    }
}

}  // namespace

Ending simulate(const Case& c, const Options& o, const RunFacts& facts, const RunOrigin& origin, Built& built,
                ResultFolder& folder, RunRecord& record, SnapshotFields& last_fields, const Restart* restart)
{
    Simulation simulation(c, o, origin, built, folder, record, last_fields);
    if (restart != nullptr)
        simulation.restore(facts, *restart);
    else
        simulation.begin();
    const Ending ending = simulation.run();
    const auto bodies = static_cast<std::size_t>(built.state.bodies.size());
    if (ending.code != exit_code::done) last_fields.cluster = bonded_clusters(built.state);
    if (last_fields.stress.size() != bodies) {  // stopped before its first snapshot, or after a split since its last
        last_fields.stress.assign(bodies, {});
        last_fields.cleavage.assign(bodies, {});
    }
    record.cracks.look(built.model, built.state);
    monitor_quasi_static(record);
    return ending;
}

}  // namespace grainfrac
