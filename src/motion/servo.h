// SPDX-License-Identifier: GPL-3.0-or-later
// Walls that hold a push. Each step such a wall moves along its direction at
//
//   v = beta (F_wanted - F)/R,   |v| <= max_speed,   R = sum of k_c C A dt + c_n of the wall's contacts
//
// so that over the contacts alone the missing push would shrink by 1 - beta. The dashpots c_n of viscous contacts
// answer a speed at once; left out, the wall would chatter. To the specimen the wall is a dashpot R/beta beside a
// constant force: it takes energy out of vibrations and puts none in.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// How far a push may be from the wanted one to count as held [-].
inline constexpr double servo_tolerance = 0.01;

/// What a wall's bodies press with along a unit vector, at the last gather_forces [N].
double wall_push(const Model& model, const State& state, int wall, const Vec3& direction);

/// Velocities of the walls with a servo for the step from state.time; call after move_walls.
void drive_servos(const Model& model, State& state, double dt);

/// Every servo holds what it wants in the end, within servo_tolerance.
bool servos_hold(const Model& model, const State& state);

}  // namespace grainfrac
