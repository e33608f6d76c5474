// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/relax.h"

#include "contact/gather.h"
#include "gpu/parallel.h"
#include "model/views.h"
#include "motion/energy.h"
#include "motion/spread_supports.h"
#include "motion/step.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

constexpr double step_length = 1.0;      ///< of relaxation; any would do [s]
constexpr double mass_safety = 0.9;      ///< of the stable step: Underwood's 1.1 on the masses
constexpr int steps_between_looks = 10;  ///< for drag and residual
/// The drag of a step is kept below this share of critical at the highest frequency, 2/dt.
constexpr double most_drag = 0.5;
/// The drag follows frequencies up to this many times the slowest known one.
constexpr double above_slowest = 2.0;
/// Forces below this share of the largest mean force there was are none.
constexpr double least_measure = 1e-3;

/// What is free of a body: 0 where it is driven or held.
GF_FN Vec3 free_part(const Vec3& v, double inverse_mass, std::int32_t held)
{
    if (inverse_mass == 0.0) return {};
    return {held % 2 != 0 ? 0.0 : v.x, (held / 2) % 2 != 0 ? 0.0 : v.y, (held / 4) % 2 != 0 ? 0.0 : v.z};
}

struct Residual {
    View<const Vec3> force;
    View<const double> inverse_mass;
    View<const std::int32_t> held;
    GF_FN double operator()(int i) const { return norm(free_part(force[i], inverse_mass[i], held[i])); }
};

struct Acting {
    SlotOf slot_of;
    View<const Vec3> force;
    GF_FN double operator()(int i) const { return slot_of(i) >= 0 ? norm(force[slot_of(i)]) : 0.0; }
};

struct IsActing {
    SlotOf slot_of;
    View<const Vec3> force;
    GF_FN double operator()(int i) const { return slot_of(i) >= 0 && norm2(force[slot_of(i)]) > 0.0 ? 1.0 : 0.0; }
};

struct KeepForces {
    static constexpr const char* name = "keep forces";
    View<const Vec3> force, torque;
    View<Vec3> old_force, old_torque;
    GF_FN void operator()(int i) const
    {
        old_force[i] = force[i];
        old_torque[i] = torque[i];
    }
};

/// Stiffness and mass terms of the Rayleigh quotient of the motion.
struct Curvature {
    View<const Vec3> force, torque, old_force, old_torque, velocity, angular_velocity;
    View<const double> inverse_mass;
    View<const std::int32_t> held;
    GF_FN double operator()(int i) const
    {
        return -dot(free_part(force[i] - old_force[i], inverse_mass[i], held[i]), velocity[i]) -
               dot(torque[i] - old_torque[i], angular_velocity[i]);
    }
};

/// What a start from rest under a force lacks of the energy that it is given: h^2 F^2/(8 m), the leapfrog's own.
struct StartLoss {
    double h;
    View<const Vec3> force, torque, inverse_inertia;
    View<const Quat> orientation;
    View<const double> inverse_mass;
    View<const std::int32_t> held;
    GF_FN double operator()(int i) const
    {
        const Vec3 t = rotate_back(orientation[i], torque[i]), j = inverse_inertia[i];
        const double turning = held[i] >= 8 ? 0.0 : t.x * t.x * j.x + t.y * t.y * j.y + t.z * t.z * j.z;
        return 0.125 * h * h * (inverse_mass[i] * norm2(free_part(force[i], inverse_mass[i], held[i])) + turning);
    }
};

double start_loss(const Model& model, const State& state)
{
    const Device d = model.device;
    const Bodies& b = state.bodies;
    return parallel_sum(d, b.size(),
                        StartLoss{step_length, b.force.read(d), b.torque.read(d), b.inverse_inertia.read(d),
                                  b.orientation.read(d), b.inverse_mass.read(d), b.held.read(d)});
}

double sum_of_motion(const Model& model, const State& state)
{
    return 2.0 * energy_ledger(model, state).kinetic;
}

/// The state's own masses and the model's own settings come back at the end.
class Borrowed {
public:
    Borrowed(Model& model, State& state, const std::vector<FictitiousMass>& masses, bool fracture)
        : model_(model),
          state_(state),
          mass_(state.bodies.mass.host()),
          inverse_mass_(state.bodies.inverse_mass.host()),
          inertia_(state.bodies.inertia.host()),
          inverse_inertia_(state.bodies.inverse_inertia.host()),
          time_(state.time),
          motion_(model.wall_motion.host()),
          fracture_(model.fracture_active),
          dashpots_(model.dashpots_active),
          local_damping_(model.local_damping)
    {
        Bodies& b = state.bodies;
        for (int i = 0; i < b.size(); ++i) {
            const FictitiousMass& f = masses[static_cast<std::size_t>(i)];
            if (f.mass <= 0.0) continue;
            if (b.inverse_mass[i] > 0.0) {
                b.mass.at(i) = f.mass;
                b.inverse_mass.at(i) = 1.0 / f.mass;
            }
            if (f.inertia <= 0.0) continue;
            b.inertia.at(i) = f.inertia * b.inertia[i];
            b.inverse_inertia.at(i) = (1.0 / f.inertia) * b.inverse_inertia[i];
        }
        for (WallMotion& m : model.wall_motion.host()) m = WallMotion{};
        model.fracture_active = fracture;
        model.dashpots_active = false;
        model.local_damping = 0.0;
    }
    ~Borrowed()
    {
        Bodies& b = state_.bodies;
        b.mass.host() = mass_;
        b.inverse_mass.host() = inverse_mass_;
        b.inertia.host() = inertia_;
        b.inverse_inertia.host() = inverse_inertia_;
        state_.time = time_;
        model_.wall_motion.host() = motion_;
        model_.fracture_active = fracture_;
        model_.dashpots_active = dashpots_;
        model_.local_damping = local_damping_;
        model_.drag_rate = 0.0;
    }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;

private:
    Model& model_;
    State& state_;
    std::vector<double> mass_, inverse_mass_;
    std::vector<Vec3> inertia_, inverse_inertia_;
    double time_;
    std::vector<WallMotion> motion_;
    bool fracture_, dashpots_;
    double local_damping_;
};

/// `largest`: mean force of the interactions so far; once nothing pulls any more it is the measure.
double residual(const Model& model, const State& state, double& largest)
{
    const Device d = model.device;
    const Bodies& b = state.bodies;
    const int n = state.interactions();
    const SlotOf slots = slot_of(state, d);
    const View<const Vec3> force = state.slots.force.read(d);
    const double left =
        parallel_sum(d, b.size(), Residual{b.force.read(d), b.inverse_mass.read(d), b.held.read(d)}) / b.size();
    const double acting = parallel_sum(d, n, IsActing{slots, force});
    const double mean = acting > 0.0 ? parallel_sum(d, n, Acting{slots, force}) / acting : 0.0;
    largest = std::max(largest, mean);
    const double measure = std::max(mean, least_measure * largest);
    return measure > 0.0 ? left / measure : 0.0;
}

/// What still moves at the end stops; its energy is the drag's.
void stop_motion(const Model& model, State& state)
{
    Bodies& b = state.bodies;
    const double kinetic = energy_ledger(model, state).kinetic;
    for (Buffer<Vec3>* motion : {&b.velocity, &b.angular_momentum, &b.angular_velocity})
        std::fill(motion->host().begin(), motion->host().end(), Vec3{});
    if (b.size() > 0) b.damping_work.at(0) += kinetic;
}

}  // namespace

Relaxation::Relaxation(const Model& model, const State& state)
    : masses_(fictitious_masses(model, state, step_length, mass_safety))
{
}

void Relaxation::renew_masses(const Model& model, const State& state)
{
    masses_ = fictitious_masses(model, state, step_length, mass_safety);
}

Relaxed Relaxation::relax(Model& model, State& state, const RelaxSettings& settings,
                          const std::function<bool()>& interrupted, const HeldFriction* friction)
{
    stop_motion(model, state);
    const Borrowed borrowed(model, state, masses_, settings.fracture);
    gather_forces(model, state);  // what a spread support takes goes by the masses
    spread_support_forces(model, state);
    const Device d = model.device;
    Bodies& b = state.bodies;
    Buffer<Vec3> old_force, old_torque;
    old_force.resize(b.size());
    old_torque.resize(b.size());
    if (b.size() > 0) b.damping_work.at(0) += start_loss(model, state);
    const double time = state.time;
    Relaxed r;
    double frequency = 0.0;  // of the motion now [1/s]
    for (r.steps = 0; r.steps < settings.most_steps;) {
        for (int k = 0; k < steps_between_looks; ++k, ++r.steps) {
            if (k == steps_between_looks - 1) {
                parallel_for(d, b.size(),
                             KeepForces{b.force.read(d), b.torque.read(d), old_force.write(d), old_torque.write(d)});
            }
            if (friction != nullptr) friction->put_back(d, state);
            step(model, state, step_length);
            state.time = time;  // what breaks on the way does so at this equilibrium
        }
        r.residual = residual(model, state, largest_force_);
        if (r.residual < settings.tolerance) {
            r.at_rest = true;
            break;
        }
        if (!std::isfinite(r.residual) || (interrupted && interrupted())) break;
        const double stiff = parallel_sum(
            d, b.size(),
            Curvature{b.force.read(d), b.torque.read(d), old_force.read(d), old_torque.read(d), b.velocity.read(d),
                      b.angular_velocity.read(d), b.inverse_mass.read(d), b.held.read(d)});
        const double mass = sum_of_motion(model, state);
        const double rate = mass > 0.0 && stiff > 0.0 ? 2.0 * std::sqrt(stiff / (step_length * mass)) : 0.0;
        frequency = 0.5 * rate;
        double drag = std::min(rate, most_drag * 2.0 / step_length);
        if (slowest_ > 0.0) drag = std::min(drag, 2.0 * above_slowest * slowest_);
        model.drag_rate = drag;
    }
    if (frequency > 0.0) slowest_ = frequency;
    if (b.size() > 0) b.damping_work.at(0) -= start_loss(model, state);
    stop_motion(model, state);
    return r;
}

}  // namespace grainfrac
