// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of [[walls]], [[grips]] and [[stages]].
#pragma once

#include "io/input_facts.h"
#include "model/case.h"

namespace grainfrac {

template <class V>
void describe(V& v, ServoSpec& s)
{
    v("force", s.force, {.unit = "N", .range = positive, .unset = "from `stress`", .meaning = "wanted push"});
    v("stress", s.stress,
      {.unit = "Pa", .range = positive, .unset = "from `force`", .meaning = "wanted push over `area`"});
    v("area", s.area,
      {.unit = "m^2",
       .range = positive,
       .used = {!s.force.has_value(), "stress"},
       .unset = "section, across `direction`, of the box around the grains when the stage begins",
       .meaning = "of `stress`"});
    v("direction", s.direction,
      {.used = {norm2(s.direction) > 0.0}, .meaning = "of the push; plates: left out, their normal"});
    v("max_speed", s.max_speed,
      {.unit = "m/s",
       .range = positive,
       .unset = "0.01 sigma_c/(rho c0) of the weakest bonds, 1e-5 c0 without bonds",
       .meaning = "never faster, also before it touches"});
}

template <class V>
void describe(V& v, WallSpec& s)
{
    const Condition plate{s.shape == "plate", "shape = \"plate\""}, box{s.shape == "box", "shape = \"box\""},
        cylinder{s.shape == "cylinder", "shape = \"cylinder\""}, stl{s.shape == "stl", "shape = \"stl\""};
    const Condition curved{cylinder.holds || s.shape == "sphere", "shape = \"cylinder\" or \"sphere\""};
    const Condition flat{plate.holds || box.holds, "shape = \"plate\" or \"box\""};
    v("name", s.name,
      {.required = always, .meaning = "for `between`, `move` and the results; letters, digits, `_`, `-`"});
    v("shape", s.shape,
      {.words = "plate | box | cylinder | sphere | stl",
       .meaning = "rigid body; box: an open container, its plates look inwards; stl: triangles of a file"});
    v("center", s.center,
      {.unit = "m", .meaning = "plate: centre of its loaded face; stl: where the file's origin is; others: centre"});
    v("normal", s.normal, {.used = plate, .meaning = "direction of the loaded face, to the specimen"});
    v("axis", s.axis, {.used = cylinder, .meaning = "direction of its axis"});
    v("size", s.size,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = flat,
       .meaning = "plate: 2 extents in its plane, first along x (along y if the normal is along x), then across; box: "
                  "3 inner lengths"});
    v("open", s.open,
      {.words = "+x | -x | +y | -y | +z | -z",
       .used = {box.holds && !s.open.empty(), box.holds ? "" : box.text},
       .meaning = "sides of a box that have no plate"});
    v("thickness", s.thickness,
      {.unit = "m", .range = not_negative, .used = flat, .meaning = "of the plates; 0: a tenth of the larger extent"});
    v("radius", s.radius,
      {.unit = "m", .range = positive, .required = always, .used = curved, .meaning = "of the surface"});
    v("length", s.length,
      {.unit = "m", .range = positive, .required = always, .used = cylinder, .meaning = "along the axis"});
    v("file", s.file,
      {.required = always, .used = stl, .meaning = "triangles, ASCII or binary STL, beside the input file"});
    v("file_unit", s.file_unit,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = stl,
       .meaning = "length of one unit of the file, such as \"1 mm\""});
    v("closed", s.closed,
      {.used = stl,
       .meaning = "every edge must belong to two triangles; false: an open surface is meant, such as a funnel"});
    v("velocity", s.velocity,
      {.unit = "m/s", .used = {!s.servo.given()}, .meaning = "velocity, unless a stage says otherwise"});
    v.table("servo", s.servo,
            {.used = {s.servo.given()}, .meaning = "instead of a velocity: the wall moves so that it holds a push"});
    v("ramp", s.ramp,
      {.unit = "s", .range = not_negative, .meaning = "time over which the speed or the push rises smoothly from 0"});
}

template <class V>
void describe(V& v, GripSpec& s)
{
    const Condition by_region{s.at.empty(), "no `at`"};
    v("name", s.name,
      {.required = always, .meaning = "for `move`, `release` and the results; letters, digits, `_`, `-`"});
    v("part", s.part, {.required = always, .meaning = "name of the part whose bodies it takes"});
    v("at", s.at,
      {.words = "first | last",
       .used = {!s.at.empty()},
       .meaning = "the first or the last sphere of a chain; left out: all in `region`"});
    v.table("region", s.region,
            {.required = by_region, .used = {s.by_region()}, .meaning = "bodies of the part whose centre is inside"});
    v("hold", s.hold,
      {.words = "x | y | z | rotation",
       .meaning =
           "what goes as the grip does; the rest is left to the forces. Without rotation its bodies turn freely"});
    v("velocity", s.velocity, {.unit = "m/s", .meaning = "velocity, unless a stage says otherwise"});
    v("ramp", s.ramp,
      {.unit = "s", .range = not_negative, .meaning = "time over which the speed rises smoothly from 0"});
}

template <class V>
void describe(V& v, StageMotion& s)
{
    v("wall", s.wall, {.required = always, .meaning = "name of a wall or grip"});
    v("velocity", s.velocity, {.unit = "m/s", .used = {!s.servo.given()}, .meaning = "its velocity in this stage"});
    v.table("servo", s.servo,
            {.used = {s.servo.given()}, .meaning = "instead of a velocity: the wall moves so that it holds a push"});
}

template <class V>
void describe(V& v, StageSpec& s)
{
    const bool is_bond = s.kind == "bond";
    const Condition bond{is_bond, "kind = \"bond\""}, takes_time{!is_bond, "any kind but \"bond\""};
    v("name", s.name, {.required = always, .meaning = "for the log and the results; letters, digits, `_`, `-`"});
    v("kind", s.kind,
      {.words = "settle | compact | bond | load | unload",
       .meaning = "settle: come to rest; compact: walls press grains together; bond: the `[[bonds]]` with `made_in` = "
                  "its name are made, at once; load: what load, strain and strength refer to begins with the first of "
                  "these that moves a wall; unload: walls go back",
       .source = "Saleme Ruiz 2016, App. C"});
    v.array("move", s.motions,
            {.used = takes_time,
             .meaning = "walls that move in this stage; those not named keep their own motion. unload: left out, the "
                        "walls that moved last go back at the same speeds"});
    v("release", s.release,
      {.used = {takes_time.holds && !s.release.empty(), takes_time.holds ? "" : takes_time.text},
       .meaning = "names of grips that let go at the beginning of this stage"});
    v("ramp", s.ramp,
      {.unit = "s",
       .range = not_negative,
       .used = takes_time,
       .meaning = "time over which speeds and pushes change smoothly"});
    v("gravity", s.gravity,
      {.unit = "m/s^2", .used = takes_time, .unset = "control.gravity", .meaning = "gravity in this stage"});
    v("local_damping", s.local_damping,
      {.range = share_below_1,
       .used = takes_time,
       .unset = "control.local_damping; settle: 0.7",
       .meaning = "alpha of the local non-viscous damping in this stage; for settling only",
       .source = "Cundall 1987"});
    v("fracture", s.fracture, {.used = takes_time, .meaning = "bonds may break in this stage"});
    v("cleavage", s.cleavage, {.used = takes_time, .meaning = "grains may split in this stage"});
    v("bond_distance", s.bond_distance,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = bond,
       .meaning = "faces whose gap or overlap is nowhere larger are bonded"});
    v("bond_angle", s.bond_angle,
      {.unit = "rad",
       .range = {0.0, 0.5, true},
       .used = bond,
       .meaning = "largest angle between two such faces; 5 degrees unless told"});
    v("duration", s.duration,
      {.unit = "s", .range = positive, .used = takes_time, .unset = "no limit", .meaning = "ends after this time"});
    v("unbalanced_force_ratio", s.unbalanced_force_ratio,
      {.range = positive,
       .used = takes_time,
       .unset = "not looked at",
       .meaning = "ends when the unbalanced force is below this share of the mean contact force, and every servo holds "
                  "its push within 1 %"});
    v("rest", s.rest,
      {.range = share_above_0,
       .used = takes_time,
       .unset = "not looked at",
       .meaning = "ends when the kinetic energy is below this share of the largest in this stage, with the unbalanced "
                  "force below a tenth, and every servo holding its push within 1 %"});
    v("load", s.load,
      {.unit = "N",
       .range = positive,
       .used = takes_time,
       .unset = "not looked at",
       .meaning = "ends when the first moving wall pushes so much"});
    v("stress", s.stress,
      {.unit = "Pa",
       .range = positive,
       .used = takes_time,
       .unset = "not looked at",
       .meaning = "the same, over the section of the box around the grains when the stage begins"});
    v("load_drop", s.load_drop,
      {.range = share_above_0,
       .used = takes_time,
       .unset = "not looked at; unload: 1",
       .meaning = "ends when something broke and the load fell by this share of its peak in this stage; unload: by "
                  "this share of the load at its begin"});
    v("max_displacement", s.max_displacement,
      {.unit = "m",
       .range = positive,
       .used = takes_time,
       .unset = "not looked at",
       .meaning = "ends when the first moving wall went this far"});
}

}  // namespace grainfrac
