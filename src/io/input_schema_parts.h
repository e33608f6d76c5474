// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of [[parts]].
#pragma once

#include "io/input_facts.h"
#include "model/case.h"

namespace grainfrac {

template <class V>
void describe(V& v, RegionSpec& s)
{
    const bool is_cylinder = s.shape == "cylinder" || s.shape == "disc", is_sphere = s.shape == "sphere";
    const Condition round{is_cylinder || is_sphere, "shape = \"cylinder\", \"disc\" or \"sphere\""},
        cylinder{is_cylinder, "shape = \"cylinder\" or \"disc\""},
        cuboid{!is_cylinder && !is_sphere, "shape = \"box\" or \"beam\""};
    v("shape", s.shape,
      {.words = "box | beam | cylinder | disc | sphere",
       .required = always,
       .meaning = "box and beam are cuboids, cylinder and disc circular cylinders; sphere: of parts of spheres only"});
    v("center", s.center, {.unit = "m", .meaning = "centre of the region"});
    v("size", s.size,
      {.unit = "m", .range = positive, .required = always, .used = cuboid, .meaning = "full edge lengths"});
    v("diameter", s.diameter,
      {.unit = "m", .range = positive, .required = always, .used = round, .meaning = "of the circle or the ball"});
    v("height", s.height,
      {.unit = "m", .range = positive, .required = always, .used = cylinder, .meaning = "length along the axis"});
    v("axis", s.axis, {.words = "x | y | z", .used = cylinder, .meaning = "direction of the axis"});
    v("facets", s.facets,
      {.range = {8.0, 10000.0},
       .used = cylinder,
       .meaning = "sides of the prism that stands for the circle; parts of spheres have the true circle"});
}

template <class V>
void describe(V& v, OrientationSpec& s)
{
    v("choices", s.choices,
      {.unit = "rad",
       .used = {!s.choices.empty()},
       .meaning = "angles about `about`; one is drawn for each grain",
       .source = "Saleme Ruiz 2016, 2.2.2"});
    v("about", s.about,
      {.words = "x | y | z", .used = {!s.choices.empty(), "choices"}, .meaning = "axis of the choices"});
    v("random", s.random,
      {.words = "uniform | c-fibre",
       .used = {!s.random.empty()},
       .meaning = "uniform: any rotation is as likely as any other; c-fibre: uniform angle about z"});
    v("file", s.file,
      {.used = {!s.file.empty()},
       .meaning = "text file beside the input file, one quaternion `w x y z` a line and grain"});
}

template <class V>
void describe(V& v, FibreSpec& s)
{
    const bool is_wavy = s.shape == "wavy", is_hooked = s.shape == "hooked", has_points = s.shape == "points";
    const Condition ends{!has_points, "shape = \"straight\", \"wavy\" or \"hooked\""},
        wavy{is_wavy, "shape = \"wavy\""}, hooked{is_hooked, "shape = \"hooked\""},
        bent{is_wavy || is_hooked, "shape = \"wavy\" or \"hooked\""}, corners{has_points, "shape = \"points\""};
    v("shape", s.shape,
      {.words = "straight | wavy | hooked | points",
       .meaning = "of the line through the spheres: straight; wavy: a sine; hooked: a straight piece, before it one "
                  "that is inclined and one that is parallel again; points: straight from point to point"});
    v("from", s.from,
      {.unit = "m",
       .required = always,
       .used = ends,
       .meaning = "first sphere; wavy: begin of the middle line; hooked: begin of the straight piece"});
    v("to", s.to,
      {.unit = "m", .required = always, .used = ends, .meaning = "last sphere; wavy: end of the middle line"});
    v("amplitude", s.amplitude,
      {.unit = "m", .range = positive, .required = always, .used = wavy, .meaning = "of the sine"});
    v("wavelength", s.wavelength,
      {.unit = "m", .range = positive, .required = always, .used = wavy, .meaning = "of the sine"});
    v("sideways", s.sideways,
      {.used = bent, .meaning = "to which side the wave goes first, or the hook; its part across the fibre counts"});
    v("hook_length", s.hook_length,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = hooked,
       .meaning = "of the inclined piece, and of the parallel one before it"});
    v("hook_angle", s.hook_angle,
      {.unit = "rad",
       .range = {.least = 0.0, .most = 1.5707963267948966, .above = true},
       .used = hooked,
       .meaning = "between the inclined piece and the fibre"});
    v("points", s.points,
      {.unit = "m", .required = always, .used = corners, .meaning = "corners of the line, at least two"});
    v("spacing", s.spacing,
      {.unit = "m",
       .range = positive,
       .unset = "`diameter`; straight along the c axis of the hcp lattice that it is `inside`: its layers",
       .meaning = "of the spheres along the line; adjusted so that a whole number fits"});
    v("radius", s.radius,
      {.unit = "m",
       .range = positive,
       .unset = "none: the nodes are spheres",
       .meaning = "of the fibre's section: a node has the mass of its piece of the fibre, and with `inside` the "
                  "spheres nearer than this make room (left out: nearer than the radius of its spheres)"});
}

template <class V>
void describe(V& v, PartSpec& s)
{
    const bool is_spheres = s.kind == "spheres";
    const bool not_told = is_spheres && s.generator == "hexagonal_prisms";  // that is said; no more messages for it
    const auto is = [&](const char* generator) { return s.generator == generator; };
    const bool is_packed = is("hcp") || is("fcc") || is("random_dense");
    const Condition grains{!is_spheres, "kind = \"grains\""};
    const Condition prisms{!is_spheres && is("hexagonal_prisms"), "generator = \"hexagonal_prisms\""};
    const Condition from_file{is("file"), "generator = \"file\""};
    const Condition sized{is_packed || is("chain") || not_told,
                          "generator = \"hcp\", \"fcc\", \"random_dense\" or \"chain\""};
    const Condition placed{prisms.holds || is_packed || is("taken"),
                           "generator = \"hexagonal_prisms\", \"hcp\", \"fcc\", \"random_dense\" or \"taken\""};
    const Condition hcp{is("hcp") || not_told, "generator = \"hcp\""};
    const Condition random{is("random_dense") || not_told, "generator = \"random_dense\""};
    const Condition chain{is("chain") || not_told, "generator = \"chain\""};
    const Condition within{is("chain") || is("taken") || not_told, "generator = \"chain\" or \"taken\""};
    const Condition told{!not_told};
    const OrientationSpec& o = s.orientation;
    const bool has_orientation = !(o.choices.empty() && o.random.empty() && o.file.empty());
    const bool has_region = s.region.diameter > 0.0 || norm2(s.region.size) > 0.0;
    v("name", s.name, {.required = always, .meaning = "for `between` and the results; letters, digits, `_`, `-`"});
    v("kind", s.kind,
      {.words = "grains | spheres", .meaning = "grains: rigid polyhedra; spheres: particles of a bonded solid"});
    v("material", s.material, {.required = always, .meaning = "name of a `[materials.NAME]`"});
    v("generator", s.generator,
      {.words = "hexagonal_prisms | file | hcp | fcc | random_dense | chain | taken",
       .required = {is_spheres, "kind = \"spheres\""},
       .meaning = "grains: hexagonal_prisms (unless told) or file; spheres: hcp, fcc: close packings; random_dense: "
                  "without order; chain: along a line, a fibre; taken: those of the part `inside` that are in the "
                  "region; file"});
    v("file", s.file,
      {.required = always,
       .used = from_file,
       .meaning = "grains: a microstructure written by `grainfrac generate`; spheres: a table of centres and radii; "
                  "beside the input file"});
    v("side", s.side,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = prisms,
       .meaning = "edge r of the hexagon",
       .source = "Saleme Ruiz 2016, Table 2.2"});
    v("thickness", s.thickness,
      {.unit = "m",
       .range = positive,
       .required = always,
       .used = prisms,
       .meaning = "full height t of a grain",
       .source = "Saleme Ruiz 2016, Table 2.2"});
    v("stacking", s.stacking,
      {.words = "columnar | half | hollow | AA = columnar | AB = hollow",
       .used = prisms,
       .meaning =
           "shift of every second layer: none, half a pitch along a row, or onto the hollow between three prisms",
       .source = "Saleme Ruiz 2016, Table 2.1"});
    v("lattice", s.lattice,
      {.words = "nominal | contained",
       .used = prisms,
       .meaning =
           "number of rows and columns: those of the source, which may overshoot the region, or only what fits inside",
       .source = "Saleme Ruiz 2016, App. A"});
    v("centered", s.centered,
      {.used = prisms,
       .meaning = "a prism of the first layer stands on the line through the region's centre, as the place of a fibre; "
                  "otherwise the lattice starts in the lower corner of the region's box"});
    v("dilation_radius", s.dilation_radius,
      {.unit = "m",
       .range = positive,
       .used = grains,
       .unset = "0.04 of the mean inradius",
       .meaning =
           "rounding radius rho of edges and corners for contacts; the inradius of a grain must be at least 3 rho",
       .source = "Saleme Ruiz 2016, 2.3.1"});
    v("sliver_fraction", s.sliver_fraction,
      {.range = {0.0, 0.5, false, true},
       .used = prisms,
       .meaning = "cut cells below this share of a whole cell's volume are given to their neighbours"});
    v("gap", s.gap,
      {.unit = "m",
       .range = not_negative,
       .used = prisms,
       .meaning = "between neighbours: every face is moved inwards by half of it, so that the grains are loose"});
    v("diameter", s.diameter,
      {.unit = "m",
       .range = positive,
       .required = told,
       .used = sized,
       .meaning = "of the spheres; hcp, fcc: their distance too; random_dense: mean of the numbers"});
    v("size_ratio", s.size_ratio,
      {.range = {.least = 1.0, .most = 10.0},
       .used = random,
       .meaning = "largest over smallest diameter; between them all are equally frequent"});
    v("solid_fraction", s.solid_fraction,
      {.range = {.least = 0.0, .most = 1.0, .above = true, .below = true},
       .used = random,
       .meaning = "volume of the spheres over that of the region; about 0.63 is possible far from walls"});
    v("lattice_axis", s.lattice_axis,
      {.words = "x | y | z", .used = hcp, .meaning = "c axis, along which the close-packed layers are stacked"});
    v("lattice_origin", s.lattice_origin,
      {.words = "site | channel",
       .used = hcp,
       .meaning = "what lies on the line through the region's centre: a sphere in every second layer, or the channel "
                  "that no layer fills, about which all layers look alike"});
    v("inside", s.inside,
      {.required = {is("taken"), "generator = \"taken\""},
       .used = within,
       .meaning = "part of spheres that make room for the chain, or of which those in the region are taken"});
    v.table("fibre", s.fibre,
            {.required = {is("chain"), "generator = \"chain\""},
             .used = chain,
             .meaning = "line along which the spheres of a chain stand"});
    v("copies", s.copies, {.unit = "m", .used = chain, .meaning = "the same chain again, moved by each of these"});
    v.table("region", s.region,
            {.required = placed,
             .used = {placed.holds || has_region},
             .meaning =
                 "where the centres of grains or spheres are; random_dense: what the spheres fill; file: left out, all "
                 "are taken; a brazilian "
                 "test takes the specimen's size from it"});
    v("at_region_boundary", s.at_region_boundary,
      {.words = "keep | cut",
       .used = prisms,
       .meaning = "keep: whole grains whose centre is inside; cut: grains are cut by the region's surface"});
    v.table("orientation", s.orientation,
            {.used = {has_orientation},
             .meaning = "crystal orientation of the grains, exactly one of `choices`, `random`, `file`; left out: all "
                        "aligned with the axes (`choices = [0]`)"});
    v("velocity", s.velocity, {.unit = "m/s", .meaning = "initial velocity"});
    v("angular_velocity", s.angular_velocity,
      {.unit = "rad/s", .meaning = "initial angular velocity of each grain about its own centre"});
}

}  // namespace grainfrac
