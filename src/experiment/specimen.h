// SPDX-License-Identifier: GPL-3.0-or-later
// What the ready-made tests share: the specimen's measures, grips, the loading stage, numbers read off the load curve.
#pragma once

#include "experiment/experiment.h"

#include <string>
#include <vector>

namespace grainfrac {

/// 0, 1, 2 of "x", "y", "z".
int axis_of(const std::string& name);
Vec3 axis_vector(int axis);

/// Box around the sharp grains.
struct Extent {
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};  ///< [m]
    Vec3 size() const { return high - low; }
    Vec3 center() const { return 0.5 * (low + high); }
};
Extent specimen_extent(const Model& model, const State& state);

/// Of the box, along a direction and across it: |d_x| s_x + ..., |d_x| s_y s_z + ...
double length_along(const Vec3& size, const Vec3& direction);
double section_across(const Vec3& size, const Vec3& direction);

/// Of the parts' materials the one of the smallest impedance sqrt(E rho): the matrix, not its fibres. One that no part
/// is of does not count.
const Material& loaded_material(const Model& model);

/// 0.01 sigma_c/(rho c_0) of the weakest bonds, a bound for the speed of each platen; 0 without a strength [m/s].
double quasi_static_speed(const Case& c, const Model& model);

/// Mean section across an axis, away from the ends: sum of V_i sin^2(pi s_i) over L/2, s_i the grain's place along the
/// axis, 0 to 1. The weight is smooth and vanishes with its slope at the ends, so that ragged ends do not count and a
/// lattice gives its true section: 4 sqrt(3) r t for 4 columns of hexagons [m^2].
double mean_section(const Model& model, const State& state, int axis);

/// Free grains whose centre is within `length` of the specimen's end at the side `sign` of an axis become bodies of the
/// wall: they move as it does and do not turn, while their bonds hold on to the rest. Returns how many.
int grip_end(const Model& model, State& state, int wall, int axis, int sign, double length);

struct HalfSpace {
    int axis = 0, side = 0;  ///< side 1: above, -1: below
    double place = 0.0;      ///< [m]
};
/// The free grain of a half space whose centre is nearest to `place` becomes a pin of the wall: it moves as the wall
/// does and turns freely. Its interfaces do not break, so that the load reaches the specimen. Returns its body, -1 if
/// there is none.
int pin_grain(Model& model, State& state, int wall, const Vec3& place, const HalfSpace& half);

/// Mean position along an axis of a wall's bodies [m].
double mean_position(const State& state, int wall, int axis);

/// Wave speed, the stage "load", in which the loaded and the opposite wall each move at half of test.platen_speed, and
/// a guess of how long it takes. Unless test.ramp says otherwise the speed rises over 10 `ramp_length`/c_0.
void set_loading_stage(const Case& c, const Model& model, double ramp_length, Experiment& e);

/// One of the experiment's facts by name, which must be there.
double fact(const Experiment& e, const std::string& name);

/// Slope of nominal stress over nominal strain between 10 % and 40 % of the peak; 0 if the curve has no such points
/// [Pa].
double secant_modulus(const std::vector<CurvePoint>& curve);

}  // namespace grainfrac
