// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of [test] and [[calibration]].
#pragma once

#include "io/input_facts.h"
#include "model/case.h"

namespace grainfrac {

template <class V>
void describe(V& v, StopSpec& s)
{
    v("load_drop", s.load_drop,
      {.range = share_above_0, .unset = "not looked at", .meaning = "when the load fell by this share of its peak"});
    v("strain", s.strain,
      {.range = positive, .unset = "not looked at", .meaning = "at this nominal strain of a ready-made test"});
    v("time", s.time, {.unit = "s", .range = positive, .unset = "no limit", .meaning = "at this simulated time"});
    v("slip", s.slip,
      {.unit = "m",
       .range = positive,
       .unset = "not looked at",
       .meaning = "test `pull_out`: at this slip of the fibre where it leaves the matrix; with it the run goes on when "
                  "the interface is broken"});
    v("damage", s.damage,
      {.range = share_above_0,
       .unset = "not looked at",
       .meaning = "test `pull_out`: at this mean damage of the interface"});
    v("rest", s.rest,
      {.range = positive,
       .unset = "not looked at",
       .meaning = "test `drop`: when the kinetic energy has been below this share of the weight times `drop_height` "
                  "for a quarter of the time of fall, in which the floor bore the weight"});
}

template <class V>
void describe(V& v, TestSpec& s)
{
    const auto is = [&](const char* kind) { return s.kind == kind; };
    const bool bends = is("three_point_bending") || is("four_point_bending") || is("notched_beam");
    const Condition brazilian{is("brazilian"), "kind = \"brazilian\""};
    const Condition pull_out{is("pull_out"), "kind = \"pull_out\""};
    const bool at_speed = !pull_out.holds || s.control == "speed";
    const Condition driven{!is("custom") && !is("drop") && at_speed,
                           pull_out.holds ? "control = \"speed\"" : "any kind but \"custom\" and \"drop\""};
    const Condition along_axis{driven.holds && !pull_out.holds,
                               pull_out.holds ? "any kind but \"custom\", \"drop\" and \"pull_out\"" : driven.text};
    const Condition equilibria{pull_out.holds && !at_speed, "kind = \"pull_out\", control not \"speed\""};
    const Condition by_damage{pull_out.holds && s.control == "damage", "kind = \"pull_out\", control = \"damage\""};
    const Condition compression{is("uniaxial_compression"), "kind = \"uniaxial_compression\""};
    const Condition gripped{is("uniaxial_tension") || is("dcb") || (compression.holds && s.ends == "gripped"),
                            "kind = \"uniaxial_tension\" or \"dcb\", or ends = \"gripped\""};
    const Condition rubs{bends || (compression.holds && s.ends == "platens"),
                         "kind = \"uniaxial_compression\" (platens) or bending"};
    const Condition bending{bends, "kind = \"three_point_bending\", \"four_point_bending\" or \"notched_beam\""};
    const Condition two_rollers{is("four_point_bending") || is("notched_beam"),
                                "kind = \"four_point_bending\" or \"notched_beam\""};
    const Condition notched{is("notched_beam"), "kind = \"notched_beam\""}, dcb{is("dcb"), "kind = \"dcb\""},
        drop{is("drop"), "kind = \"drop\""};
    v("kind", s.kind,
      {.words = "brazilian | uniaxial_compression | uniaxial_tension | three_point_bending | four_point_bending | "
                "notched_beam | dcb | drop | pull_out | custom",
       .meaning =
           "brazilian: a disc pressed along its diameter; uniaxial: pressed or pulled at both ends; bending over "
           "rollers; notched_beam: bending of a beam with a notch at mid span; dcb: two arms pulled apart; drop: "
           "grains fall on a floor; pull_out: a fibre pulled out of a matrix; all these make their own walls; custom: "
           "`[[walls]]` and `[[stages]]`"});
    v("platen_speed", s.platen_speed,
      {.unit = "m/s",
       .range = positive,
       .required = always,
       .used = driven,
       .meaning = "closing speed of the two platens, or of rollers and supports, together; opening speed of two grips "
                  "or pins; pull_out: speed of the grip"});
    v("platen", s.platen, {.words = "flat | curved", .used = brazilian, .meaning = "shape of the loaded face"});
    v("platen_radius", s.platen_radius,
      {.unit = "m",
       .range = not_negative,
       .used = brazilian,
       .meaning = "platen `curved`; 0: 1.5 specimen radii",
       .source = "ISRM 1978"});
    v("contact_half_width", s.contact_half_width,
      {.unit = "m",
       .range = positive,
       .used = brazilian,
       .unset = "0.05 of the diameter",
       .meaning = "platen `flat`: half width of the platen",
       .source = "Hondros 1959"});
    v("direction", s.direction,
      {.words = "x | y | z",
       .used = along_axis,
       .meaning = "axis of loading; a beam lies along x, or along y if loaded along x (brazilian: x, y)"});
    v("ends", s.ends,
      {.words = "platens | gripped",
       .used = compression,
       .meaning = "platens press on the ends, or the end grains themselves move and do not turn"});
    v("grip_length", s.grip_length,
      {.unit = "m",
       .range = positive,
       .used = gripped,
       .unset = "one row of grains; dcb: the first grain",
       .meaning = "the grains whose centre is this near to an end are held there; dcb: distance of the pins from the "
                  "open end"});
    v("wall_friction", s.wall_friction,
      {.range = not_negative,
       .used = rubs,
       .unset = "platens 0, rollers 0.1",
       .meaning = "Coulomb's mu of platens or rollers, unless an entry of `[[contacts]]` names them"});
    v("outer_span", s.outer_span,
      {.unit = "m", .range = positive, .required = always, .used = bending, .meaning = "distance of the supports"});
    v("inner_span", s.inner_span,
      {.unit = "m",
       .range = not_negative,
       .required = {is("four_point_bending"), "kind = \"four_point_bending\""},
       .used = two_rollers,
       .meaning = "distance of the two loading rollers; notched_beam: 0: one roller"});
    v("roller_radius", s.roller_radius,
      {.unit = "m",
       .range = positive,
       .used = bending,
       .unset = "half of the beam's height",
       .meaning = "of all rollers"});
    v("notch_depth", s.notch_depth,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = notched,
       .meaning = "grains that lie on either side of mid span have no bond up to this height above the lower side"});
    v("crack_length", s.crack_length,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = dcb,
       .meaning = "grains above and below mid height have no bond up to this distance from the open end"});
    v("drop_height", s.drop_height,
      {.unit = "m",
       .range = not_negative,
       .required = always,
       .used = drop,
       .meaning = "gap between the lowest grain and the floor at the start"});
    v("side_gap", s.side_gap,
      {.unit = "m",
       .range = not_negative,
       .used = drop,
       .unset = "no side walls",
       .meaning = "gap between the specimen and four side walls"});
    v("fibre", s.fibre,
      {.required = always,
       .used = pull_out,
       .meaning = "part that is pulled: a chain, from its last sphere, or spheres taken from a packing"});
    v("matrix", s.matrix, {.required = always, .used = pull_out, .meaning = "part that holds it"});
    v("support", s.support,
      {.words = "uniform | held",
       .used = pull_out,
       .meaning =
           "face of the matrix at the embedded end: held in the mean under a uniform stress, or each body held"});
    v("control", s.control,
      {.words = "damage | displacement | speed",
       .used = pull_out,
       .meaning =
           "damage: equilibria of growing damage, the whole path with its snap-back; displacement: equilibria of "
           "growing displacement of the grip; speed: time steps at platen_speed"});
    v("damage_step", s.damage_step,
      {.range = {1e-6, 1.0}, .used = by_damage, .meaning = "mean damage from one equilibrium to the next"});
    v("displacement_step", s.displacement_step,
      {.unit = "m",
       .range = positive,
       .used = {pull_out.holds && s.control == "displacement", "kind = \"pull_out\", control = \"displacement\""},
       .unset = "a twentieth of the largest failure_slip",
       .meaning = "of the grip from one equilibrium to the next"});
    v("slide_step", s.slide_step,
      {.unit = "m",
       .range = positive,
       .used = equilibria,
       .unset = "a sixtieth of the embedded length",
       .meaning = "of the fibre once its interface is broken"});
    v("profiles_at", s.profiles_at,
      {.range = share,
       .used = pull_out,
       .meaning = "mean damages at which the profile along the fibre goes to profiles.csv"});
    v("relaxed", s.relaxed,
      {.range = {1e-12, 1e-2},
       .used = equilibria,
       .meaning = "an equilibrium: mean residual of the bodies over the mean force of the bonds"});
    v("ramp", s.ramp,
      {.unit = "s",
       .range = not_negative,
       .used = driven,
       .unset = "10 L/c0, c0 = sqrt(E/density), L the length (brazilian: D; bending: L^2/w)",
       .meaning = "time over which the speed rises smoothly from 0"});
    v.table("stop", s.stop, {.meaning = "when the run ends, whichever comes first"});
}

template <class V>
void describe(V& v, CalibrationSpec& s)
{
    v("part", s.part, {.required = always, .meaning = "whose bonds with itself are sought"});
    v("young_modulus", s.young_modulus, {.unit = "Pa", .range = positive, .required = always, .meaning = "wanted"});
    v("poisson_ratio", s.poisson_ratio,
      {.range = {.least = -1.0, .most = 0.5, .above = true, .below = true},
       .unset = "not sought: the shear ratio stays as it is",
       .meaning = "wanted; springs reach at most 1/5 along the c axis of hcp, 1/3 in fcc and in the plane of hexagonal "
                  "prisms, about 1/4 in random packings"});
    v("tensile_strength", s.tensile_strength,
      {.unit = "Pa",
       .range = positive,
       .unset = "not sought",
       .meaning = "wanted, of the sample; strengths of the bonds keep their proportion, and must be given"});
    v("tolerance", s.tolerance,
      {.range = {.least = 1e-6, .most = 0.5},
       .unset = "0.005, random packings 0.02",
       .meaning = "of the modulus, and of the Poisson ratio over it (over 0.1 where it is less)"});
    v("max_trials", s.max_trials, {.range = {.least = 1.0, .most = 100.0}, .meaning = "tension tests at most"});
    v("measure", s.measure,
      {.words = "auto | core | section",
       .meaning = "core: mean stress over mean strain of the inside, the modulus of the material; section: force over "
                  "section, of this very sample with its softer surface; auto: core, of fibres section"});
    v("direction", s.direction,
      {.words = "auto | x | y | z", .meaning = "of the pull; auto: hcp along c, hexagonal prisms along x, else z"});
    v("width", s.width,
      {.unit = "m",
       .range = positive,
       .unset = "12 spheres, 14 where they are random, 16 grains",
       .meaning = "of the sample, a cylinder; of hexagonal prisms a plate"});
    v("length", s.length, {.unit = "m", .range = positive, .unset = "as the width", .meaning = "of the sample"});
    v("area", s.area,
      {.unit = "m^2",
       .range = positive,
       .used = {s.measure != "core", "measure = \"section\""},
       .unset = "lattices: of the cells of the spheres; fibres: their own",
       .meaning = "section that carries the force"});
    v("start_normal_stiffness", s.start_normal_stiffness,
      {.unit = "Pa/m", .range = positive, .unset = "closed form", .meaning = "of the first trial"});
    v("start_shear_ratio", s.start_shear_ratio,
      {.range = not_negative, .unset = "closed form", .meaning = "of the first trial, k_s/k_n"});
}

}  // namespace grainfrac
