// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/simulation.h"

#include "app/progress.h"
#include "app/signals.h"
#include "contact/find_contacts.h"
#include "experiment/bond_stage.h"
#include "experiment/pull_out_path.h"
#include "experiment/specimen.h"
#include "fracture/clusters.h"
#include "fracture/grain_stress.h"
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
/// A run whose energy account is off by this share has gone wrong: a stable one stays below 1e-3.
constexpr double most_energy_error = 0.1;
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
    Simulation(const Case& c, const Options& o, Built& built, ResultFolder& folder, RunRecord& record,
               SnapshotFields& fields)
        : case_(c),
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

    Ending run()
    {
        start(model_, state_);
        choose_step();
        choose_intervals();
        for (int i = 0; i < state_.bodies.size(); ++i)
            energy_floor_ +=
                negligible_energy * state_.bodies.mass[i] * experiment_.wave_speed * experiment_.wave_speed;
        record_.first_momentum = total_momentum(model_, state_);
        record_.cracks = CrackWatch(crack_scale(model_, state_));
        if (case_.output.checkpoint > 0.0) checkpoint();
        Ending ending{exit_code::done, "all stages done"};
        for (std::size_t k = 0; k < experiment_.stages.size(); ++k) {
            const Stage& stage = experiment_.stages[k];
            spdlog::info("stage \"{}\"", stage.name);
            begin_stage(stage, model_, state_);
            if (!stage.released.empty()) shorten_step_if_needed(time_step_bound(model_, state_));
            if (static_cast<int>(k) == experiment_.reference_stage) begin_reference();
            remember_begin(stage);
            if (state_.step == 0) record_row(stage);
            if (experiment_.pull_out && experiment_.pull_out->quasi_static)
                ending = run_path(stage);
            else
                ending = stage.bonds ? bond_stage(stage, k) : run_stage(stage);
            if (!finished_stage_) break;
            if (case_.test.stop.time && experiment_.kind == "custom" && state_.time >= *case_.test.stop.time) break;
        }
        if (ending.code == exit_code::done) last_snapshot(experiment_.stages.back());
        record_.last_momentum = total_momentum(model_, state_);
        record_.time_step = dt_;
        progress_.finish(progress(experiment_.stages.back()));
        return ending;
    }

private:
    void choose_step()
    {
        const ChosenStep s = choose_time_step(case_, model_, state_);
        dt_ = s.dt;
        record_.critical_step = s.critical;
        record_.limiter = s.limiter;
        spdlog::info("time step {:.4g} s, stability limit {:.4g} s ({})", dt_, s.critical, s.limiter);
    }

    void choose_intervals()
    {
        const double expected = experiment_.expected_duration;
        history_ =
            case_.output.history.value_or(expected > 0.0 ? std::max(expected / automatic_rows, dt_) : 100.0 * dt_);
        const double count =
            case_.output.snapshots ? static_cast<double>(*case_.output.snapshots) : automatic_snapshots;
        every_ = case_.output.every.value_or(expected > 0.0 ? expected / count : 5000.0 * dt_);
        record_.history_interval = history_;
        record_.snapshot_interval = every_;
    }

    Ending run_stage(const Stage& stage)
    {
        finished_stage_ = false;
        while (true) {
            if (state_.step % steps_between_checks == 0 && state_.step > 0)
                shorten_step_if_needed(time_step_bound(model_, state_));
            const bool snapshot = state_.time + 0.5 * dt_ >= next_snapshot_;
            const bool cleave = !cleavage_.empty() && stage.cleavage;
            const bool ask_gate = cleave && gate_is_due(state_);
            const auto before = Clock::now();
            step(model_, state_, dt_, snapshot || ask_gate);
            record_.phases.steps += seconds_since(before);
            // a snapshot waits for the step after a split, when the stresses of the parts are known
            if (!(cleave && split_where_due(ask_gate)) && snapshot) write_snapshot();
            if (state_.time + 0.5 * dt_ >= next_history_ || time_is_up(stage)) {
                record_row(stage);
                if (const std::string why = why_unstable(); !why.empty())
                    return {exit_code::unstable, "unstable: " + why};
                if (const std::string why = why_ended(stage); !why.empty()) {
                    finished_stage_ = true;
                    spdlog::info("stage \"{}\" ended: {}", stage.name, why);
                    return {exit_code::done, why};
                }
                progress_.update(progress(stage));
            }
            if (const int signal = pending_signal(); signal != 0) {
                checkpoint();
                return {128 + signal, signal == 2 ? "interrupted by SIGINT" : "terminated by SIGTERM"};
            }
            if (case_.output.checkpoint > 0.0 && seconds_since(last_checkpoint_) > case_.output.checkpoint)
                checkpoint();
        }
    }

    /// A row of equilibria instead of time steps.
    Ending run_path(const Stage& stage)
    {
        finished_stage_ = false;
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
        PullOutPath path(p, s, model_, state_);
        while (true) {
            const auto before = Clock::now();
            const PullOutPath::Found found = path.next(model_, state_, [] { return pending_signal() != 0; });
            record_.phases.steps += seconds_since(before);
            if (const int signal = pending_signal(); signal != 0) {
                checkpoint();
                return {128 + signal, signal == 2 ? "interrupted by SIGINT" : "terminated by SIGTERM"};
            }
            if (found == PullOutPath::Found::end) {
                finished_stage_ = true;
                return {exit_code::done, "the interface is broken"};
            }
            if (found == PullOutPath::Found::not_at_rest) {
                return {exit_code::unstable,
                        fmt::format("unstable: no equilibrium after {} steps, the mean residual is {:.2g} of the mean "
                                    "force of the bonds; raise test.relaxed, or hold what can move freely",
                                    path.last().steps, path.last().residual)};
            }
            if (found == PullOutPath::Found::not_softening) {
                return {
                    exit_code::unstable,
                    "unstable: with friction no state was found where the interface softens; lower test.relaxed, or "
                    "use test.control = \"displacement\""};
            }
            record_row(stage);
            spdlog::debug("equilibrium {}: {} steps, residual {:.2g}", state_.time, path.last().steps,
                          path.last().residual);
            if (state_.time >= next_snapshot_) write_snapshot_at_rest();
            if (const std::string why = why_unstable(); !why.empty()) return {exit_code::unstable, "unstable: " + why};
            if (const std::string why = why_path_ended(); !why.empty()) {
                finished_stage_ = true;
                return {exit_code::done, why};
            }
            progress_.update(progress(stage));
            if (case_.output.checkpoint > 0.0 && seconds_since(last_checkpoint_) > case_.output.checkpoint)
                checkpoint();
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
        stage_start_ = state_.time;
        stage_kinetic_ = 0.0;
        stage_body_ = -1;
        for (int i = 0; i < state_.bodies.size() && stage_body_ < 0 && stage.loaded_wall >= 0; ++i) {
            if (state_.bodies.wall[i] == stage.loaded_wall) stage_body_ = i;
        }
        if (stage_body_ >= 0) stage_origin_ = state_.bodies.position[stage_body_];
        stage_section_ =
            stage.stress ? section_across(specimen_extent(model_, state_).size(), stage.load_direction) : 0.0;
        stage_peak_ = stage_first_load_ = stage.unloads ? stage_load(stage) : 0.0;
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
        return stage_body_ < 0 ? 0.0 : norm(state_.bodies.position[stage_body_] - stage_origin_);
    }

    /// Bonds between what faces each other now; takes no time.
    Ending bond_stage(const Stage& stage, std::size_t k)
    {
        const auto refused = [&](const std::string& why) {
            return Ending{exit_code::wrong_input, fmt::format("stages[{}]: {}", k, why)};
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
        } else if (const TimeStepBound bound = time_step_bound(model_, state_); dt_ > bound.with_damping) {
            return {exit_code::wrong_input, fmt::format("control.time_step: must be <= {:.4g} s, the stability limit "
                                                        "once the bonds are made ({})",
                                                        bound.with_damping, bound.limiter)};
        }
        broken_ = -1;  // fragments are to be counted anew
        record_row(stage);
        finished_stage_ = true;
        return {exit_code::done, fmt::format("{} bonds made", made.number)};
    }

    void shorten_step_if_needed(const TimeStepBound& bound)
    {
        if (case_.control.time_step) return;
        if (bound.body < 0) return;
        const double allowed = case_.control.time_step_safety * bound.with_damping;
        if (allowed >= dt_) return;
        const bool worth_a_line = allowed < (1.0 - logged_change) * dt_;
        if (worth_a_line)
            spdlog::info("step {}: time step {:.4g} -> {:.4g} s ({})", state_.step, dt_, allowed, bound.limiter);
        dt_ = allowed;
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
            look_for_splits(model_, state_, ask_gate ? &stress : nullptr, cleavage_, dt_);
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
            const TimeStepBound bound = time_step_bound(model_, state_, parts);
            shorten_step_if_needed(bound);
            if (case_.control.time_step && bound.body >= 0 && dt_ > bound.with_damping) {
                too_long_ = fmt::format(
                    "control.time_step = {:.4g} s is above the stability limit {:.4g} s since a grain was split ({}); "
                    "shorten it, or leave it out",
                    dt_, bound.with_damping, bound.limiter);
                record_.critical_step = bound.with_damping;
                record_.limiter = bound.limiter;
            }
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
        r.energy.negligible = energy_floor_;
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
        stage_peak_ = std::max(stage_peak_, stage_load(stage));
        stage_kinetic_ = std::max(stage_kinetic_, r.energy.kinetic);
        next_history_ = state_.time + history_;
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
        if (broken != broken_ || record_.rows.empty()) {
            const std::vector<std::int32_t> cluster = bonded_clusters(state_);
            fragments_ = static_cast<std::int64_t>(std::set<std::int32_t>(cluster.begin(), cluster.end()).size()) -
                         (std::find(cluster.begin(), cluster.end(), -1) != cluster.end() ? 1 : 0);
            broken_ = broken;
            record_.cracks.look(model_, state_);
        }
        r.fragments = fragments_;
    }

    std::string why_unstable() const
    {
        if (!too_long_.empty()) return too_long_;
        if (const int pair = penetrating_pair(model_, state_); pair >= 0) {
            return fmt::format(
                "the cores of bodies {} and {} penetrate; the contact is too soft or something moves too fast: raise "
                "contacts.normal_stiffness or lower the speed",
                state_.bodies.id[state_.contacts.a[pair]], state_.bodies.id[state_.contacts.b[pair]]);
        }
        const Ledger& e = record_.rows.back().energy;
        if (!std::isfinite(e.kinetic) || !std::isfinite(e.residual())) {
            const std::string what = why_not_valid(model_, state_);
            return fmt::format("{}; lower control.time_step_safety", what.empty() ? "an energy is not finite" : what);
        }
        if (e.relative_error() > most_energy_error) {
            return fmt::format("the energy account is off by {:.0f} %; lower control.time_step_safety",
                               100.0 * e.relative_error());
        }
        return {};
    }

    bool time_is_up(const Stage& s) const
    {
        const bool test_over =
            experiment_.kind == "custom" && case_.test.stop.time && state_.time >= *case_.test.stop.time;
        return test_over || (s.duration && state_.time - stage_start_ >= *s.duration);
    }

    std::string why_ended(const Stage& s) const
    {
        const HistoryRow& r = record_.rows.back();
        if (s.duration && state_.time - stage_start_ >= *s.duration)
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
        if (s.stress && reached(*s.stress * stage_section_))
            return fmt::format("stress {:.5g} Pa reached", load / stage_section_);
        if (s.load_drop && s.unloads && load <= (1.0 - *s.load_drop) * stage_first_load_)
            return fmt::format("load went back from {:.5g} to {:.5g} N", stage_first_load_, load);
        if (s.load_drop && !s.unloads && broken_or_damaged() && load < (1.0 - *s.load_drop) * stage_peak_) {
            return fmt::format("load dropped by {:.0f} % from its peak {:.5g} N", 100.0 * *s.load_drop, stage_peak_);
        }
        // what a moving wall has not reached yet is not at rest
        const bool settled = state_.time > stage_start_ + s.ramp && (s.loaded_wall < 0 || load > 0.0) &&
                             (s.servos.empty() || servos_hold(model_, state_));
        if (s.unbalanced_force_ratio && settled && r.unbalanced_force_ratio < *s.unbalanced_force_ratio)
            return fmt::format("unbalanced force ratio below {:.2g}", *s.unbalanced_force_ratio);
        const bool still = r.energy.kinetic <= energy_floor_;  // nothing moved, or round-off does
        if (s.rest && settled &&
            (still || (r.energy.kinetic < *s.rest * stage_kinetic_ && r.unbalanced_force_ratio < balanced)))
            return fmt::format("at rest, kinetic energy {:.2g} J", r.energy.kinetic);
        const double lasted = state_.time - rest_start_;
        if (s.rest_energy && lasted >= s.rest_time &&
            std::fabs(rest_impulse_ - s.weight * lasted) < balanced * s.weight * lasted)
            return fmt::format("at rest, kinetic energy {:.2g} J", r.energy.kinetic);
        if (case_.test.stop.time && experiment_.kind == "custom" && state_.time >= *case_.test.stop.time)
            return "stop.time reached";
        return {};
    }
    /// How long the kinetic energy has been low, and the impulse of the floor since then.
    void watch_rest(const Stage& s, const HistoryRow& r)
    {
        if (!s.rest_energy || record_.rows.empty() || r.energy.kinetic >= *s.rest_energy) {
            rest_start_ = r.time;
            rest_impulse_ = 0.0;
            return;
        }
        const HistoryRow& before = record_.rows.back();
        rest_impulse_ += 0.5 * (before.load + r.load) * (r.time - before.time);
    }
    /// A load drop counts only once something failed: waves make the load of a platen dip at first touch.
    bool broken_or_damaged() const { return broken_ > 0; }

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
        p.broken = broken_;
        return p;
    }

    void write_snapshot()
    {
        const auto before = Clock::now();
        fields_.stress = grain_stress(model_, state_);
        fields_.cleavage = find_cleavage(model_, state_, fields_.stress, cleavage_);
        fields_.cluster = bonded_clusters(state_);
        folder_.write_snapshot(model_, state_, fields_, case_.output.contacts);
        next_snapshot_ = state_.time + every_;
        record_.phases.output += seconds_since(before);
    }

    /// The state in which the run ended is always shown: one more step, which also gathers stresses.
    void last_snapshot(const Stage& stage)
    {
        if (experiment_.pull_out && experiment_.pull_out->quasi_static) return write_snapshot_at_rest();
        step(model_, state_, dt_, true);
        record_row(stage);
        write_snapshot();
    }

    /// A state that is not possible is never written over a good one.
    void checkpoint()
    {
        last_checkpoint_ = Clock::now();
        if (const std::string why = why_not_valid(model_, state_); !why.empty()) {
            spdlog::warn("no checkpoint: {}", why);
            return;
        }
        folder_.write_checkpoint(model_, state_);
    }

    const Case& case_;
    Model& model_;
    State& state_;
    Experiment& experiment_;
    const std::vector<CleavageRules>& cleavage_;
    ResultFolder& folder_;
    RunRecord& record_;
    SnapshotFields& fields_;
    Progress progress_;
    double dt_ = 0.0, history_ = 0.0, every_ = 0.0;
    double next_history_ = 0.0, next_snapshot_ = 0.0;
    double stage_start_ = 0.0, stage_peak_ = 0.0, stage_first_load_ = 0.0, stage_section_ = 0.0, stage_kinetic_ = 0.0;
    int stage_body_ = -1;
    Vec3 stage_origin_;
    bool finished_stage_ = false;
    double rest_start_ = 0.0, rest_impulse_ = 0.0;  // [s], [N s]
    std::string too_long_;                          // why a time step that the user fixed is no longer stable
    std::int64_t broken_ = 0, fragments_ = 0;
    double energy_floor_ = 0.0;  // [J]
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

Ending simulate(const Case& c, const Options& o, Built& built, ResultFolder& folder, RunRecord& record,
                SnapshotFields& last_fields)
{
    const Ending ending = Simulation(c, o, built, folder, record, last_fields).run();
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
