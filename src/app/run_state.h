// SPDX-License-Identifier: GPL-3.0-or-later
// What the loop of a run keeps from one step to the next, beyond model, state and record. All of it goes into a
// checkpoint.
#pragma once

#include "geometry/vec3.h"

#include <cstdint>

namespace grainfrac {

struct RunState {
    std::int64_t stage = 0;                           ///< the present one, into Experiment::stages
    bool stage_begun = false;                         ///< else it begins next
    double dt = 0.0;                                  ///< [s]
    double history = 0.0, every = 0.0;                ///< between rows, between snapshots [s]
    double next_history = 0.0, next_snapshot = 0.0;   ///< [s]
    double stage_start = 0.0;                         ///< [s]
    double stage_peak = 0.0, stage_first_load = 0.0;  ///< [N]
    double stage_section = 0.0;                       ///< [m^2]
    double stage_kinetic = 0.0;                       ///< largest kinetic energy of the stage [J]
    std::int32_t stage_body = -1;                     ///< whose way is the displacement of the stage
    Vec3 stage_origin;                                ///< where it was when the stage began [m]
    double rest_start = 0.0, rest_impulse = 0.0;      ///< [s], [N s]
    double step_limit = 0.0;                          ///< where the user's time step is above it; 0: it is not [s]
    std::int64_t broken = 0, fragments = 0;
    double energy_floor = 0.0;  ///< [J]
    double most_speed = 0.0;    ///< a body that is faster has run away; 0: not known [m/s]
    double error_before = 0.0;  ///< residual of the energy account at the last look, if it was off by much [J]

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = *this;  // every one of them
        visit("stage", a);
        visit("stage_begun", b);
        visit("dt", c);
        visit("history", d);
        visit("every", e);
        visit("next_history", f);
        visit("next_snapshot", g);
        visit("stage_start", h);
        visit("stage_peak", i);
        visit("stage_first_load", j);
        visit("stage_section", k);
        visit("stage_kinetic", l);
        visit("stage_body", m);
        visit("stage_origin", n);
        visit("rest_start", o);
        visit("rest_impulse", p);
        visit("step_limit", q);
        visit("broken", r);
        visit("fragments", s);
        visit("energy_floor", t);
        visit("most_speed", u);
        visit("error_before", v);
    }
};

}  // namespace grainfrac
