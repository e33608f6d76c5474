// SPDX-License-Identifier: GPL-3.0-or-later
// Driven bodies: plates, boxes and platens made of plates, cylinders, spheres, triangulated surfaces.
#pragma once

#include "geometry/stl.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

#include <string>
#include <vector>

namespace grainfrac {

/// New wall (and group) of this name, without bodies yet; returns its index.
int add_wall(Model& model, const std::string& name);

/// Plate of wall `wall` whose loaded face is centred at `face_center` and looks along `normal`; in-plane full lengths
/// `width` along `along` and `depth` across it.
void add_plate(Model& model, State& state, int wall, const Vec3& face_center, const Vec3& normal, const Vec3& along,
               double width, double depth, double thickness);

/// Cylinder of wall `wall` with its axis through `center`; returns its body.
int add_cylinder(Model& model, State& state, int wall, const Vec3& axis, double length, const Vec3& center,
                 double radius);

/// Container of wall `wall`: plates that look inwards at the six sides of a box of inner lengths `inside`, but for
/// those that `open` names, as "+z".
void add_box(Model& model, State& state, int wall, const Vec3& center, const Vec3& inside, double thickness,
             const std::vector<std::string>& open);

/// Move the bodies of a wall along the unit vector `direction` until the first of them touches a free body: gap 0, no
/// overlap, found by conservative advancement. False (nothing moved) if they would pass all bodies.
bool move_to_touch(const Model& model, State& state, int wall, const Vec3& direction);
/// The same for these driven bodies alone.
bool move_to_touch(const Model& model, State& state, const std::vector<int>& bodies, const Vec3& direction);

/// Triangulated surface of wall `wall`: a body without thickness or rounding for each of its flat convex facets, felt
/// from both sides. `unit` is the length of one unit of the mesh [m].
void add_mesh(Model& model, State& state, int wall, const TriangleMesh& mesh, double unit, const Vec3& origin);

/// A wall of the input with its bodies. Throws InputError for what is wrong with its file, which is searched beside
/// `input_file`; `key` is the wall's.
void add_wall(Model& model, State& state, const WallSpec& spec, const std::string& key, const std::string& input_file);

}  // namespace grainfrac
