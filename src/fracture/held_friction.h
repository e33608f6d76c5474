// SPDX-License-Identifier: GPL-3.0-or-later
// Friction that depends on where an event began and on where it is now, not on the way between. The way to an
// equilibrium by relaxation is none of the material's: each wiggle would turn the friction of what slides there and
// back. Of damage fixed, the friction of monotone slips from one state to the next has a potential, D (k_s s^2/2 +
// cap |slid|) with the elastic slip s at the end, so that there is one equilibrium and no way to it matters.
#pragma once

#include "model/state.h"

namespace grainfrac {

class HeldFriction {
public:
    /// The event begins here.
    explicit HeldFriction(const State& state);
    /// Slips and friction work of the beginning: call it before forces are found, which then have made the way from
    /// there to here in one.
    void put_back(Device device, State& state) const;

private:
    Buffer<Vec2> slip_;             // of the points of interfaces [m]
    Buffer<double> friction_work_;  // of the interfaces [J]
};

}  // namespace grainfrac
