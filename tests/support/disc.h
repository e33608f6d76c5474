// SPDX-License-Identifier: GPL-3.0-or-later
// Brazilian discs of SiC as cases, and runs of them without files.
#pragma once

#include "experiment/experiment.h"
#include "gpu/device.h"
#include "model/validate.h"
#include "motion/energy.h"
#include "motion/step.h"
#include "motion/time_step.h"

#include <algorithm>
#include <vector>

namespace grainfrac::test {

inline Case disc_case(double side, bool cut)
{
    Case c;
    c.simulation.seed = 3;
    c.materials = {{"sic", 3100, 410e9, 0.17, {}}};
    PartSpec p;
    p.name = "disc";
    p.material = "sic";
    p.side = side;
    p.thickness = 5e-3;
    p.region.shape = "disc";
    p.region.diameter = 15e-3;
    p.region.height = 5e-3;
    p.at_region_boundary = cut ? "cut" : "keep";
    p.sliver_fraction = 0.3;
    p.orientation.choices = {0.0};
    c.parts = {p};
    BondSpec b;
    b.tensile_strength = 100e6;
    b.cohesion = 300e6;
    b.friction = 0.5;
    b.residual_friction = 0.4;
    b.fracture_energy_I = 29;
    b.fracture_energy_II = 150;
    c.bonds = {b};
    c.contacts = {ContactSpec{}};
    c.test.kind = "brazilian";
    c.test.platen_speed = 0.05;
    c.test.stop.load_drop = 0.5;
    return c;
}

inline double stable_step(const Built& b, double safety = 0.8)
{
    return safety * time_step_bound(b.model, b.state).with_damping;
}

/// Start, then load for `steps` steps of dt.
inline void begin(Built& b)
{
    start(b.model, b.state);
    begin_stage(b.experiment.stages.front(), b.model, b.state);
}
inline void run_steps(Built& b, double dt, int steps)
{
    for (int i = 0; i < steps; ++i) step(b.model, b.state, dt);
}

/// The whole experiment turned by q about the origin; before it begins. What is held along single axes is not.
inline void turn_all(Built& b, const Quat& q)
{
    const auto turn = [&](Vec3& v) { v = rotate(q, v); };
    const auto turn_each = [&](Buffer<Vec3>& all) {
        for (Vec3& v : all.host()) turn(v);
    };
    Bodies& s = b.state.bodies;
    for (Buffer<Vec3>* each : {&s.position, &s.start_position, &s.velocity, &s.angular_velocity,
                               &b.state.sphere_bonds.normal, &b.state.parallels.normal})
        turn_each(*each);
    for (Buffer<Quat>* each : {&s.orientation, &s.start_orientation}) {
        for (Quat& o : each->host()) o = normalized(q * o);
    }
    for (Stage& stage : b.experiment.stages) {
        for (Vec3& v : stage.wall_velocity) turn(v);
        for (Servo& servo : stage.servos) turn(servo.direction);
        if (stage.gravity) turn(*stage.gravity);
    }
    turn(b.model.gravity);
    turn(b.model.spread_direction);
    turn(b.experiment.specimen.load_direction);
    if (b.experiment.pull_out) {
        turn(b.experiment.pull_out->direction);
        for (Vec3& v : b.experiment.pull_out->along) turn(v);
    }
}

/// Interfaces that failed, in the order of their times.
inline std::vector<int> break_sequence(const State& s)
{
    std::vector<int> broken;
    for (int i = 0; i < s.interfaces.size(); ++i) {
        if (s.interfaces.failure_time[i] >= 0) broken.push_back(i);
    }
    std::stable_sort(broken.begin(), broken.end(),
                     [&](int x, int y) { return s.interfaces.failure_time[x] < s.interfaces.failure_time[y]; });
    return broken;
}

}  // namespace grainfrac::test
