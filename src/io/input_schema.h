// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of the input file, told once: name, member, unit, allowed values, meaning, source. Defaults are those of
// the structs in model/case.h. The reader, the writer of resolved.toml and the generator of docs/input.md walk these
// descriptions with a visitor V:
//   v("key", member, Facts{...})        a value
//   v.table("key", member, Facts{...})  a sub-table
//   v.array("key", vector, Facts{...})  an array of tables, [[key]]
//   v.named("key", vector, Facts{...})  tables with names, [key.NAME]
// A new key is a member in case.h and a line here.
#pragma once

#include "model/case.h"

#include <limits>
#include <string>
#include <vector>

namespace grainfrac {

/// Allowed values of a number, in the SI unit of its key.
struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool above = false;  ///< `least` itself is not allowed
    bool below = false;  ///< `most` itself is not allowed
};
inline constexpr Range any_value{};
inline constexpr Range positive{.least = 0.0, .above = true};
inline constexpr Range not_negative{.least = 0.0};
inline constexpr Range share{.least = 0.0, .most = 1.0};
inline constexpr Range share_above_0{.least = 0.0, .most = 1.0, .above = true};
inline constexpr Range share_below_1{.least = 0.0, .most = 1.0, .below = true};
inline constexpr Range at_least_1{.least = 1.0};

/// Whether something holds for the table's other values, and how a message says so ("" where it is always so).
struct Condition {
    bool holds;
    const char* text = "";
};
inline constexpr Condition always{true};
inline constexpr Condition never{false};

struct Facts {
    const char* unit = "1";  ///< SI unit; "1": none
    Range range = any_value;
    const char* words = "";  ///< allowed texts: "columnar | half | AA = columnar"; "": any text
    Condition required = never;
    Condition used = always;  ///< else left out of resolved.toml and, if it has a text, refused
    const char* unset = "";   ///< optional members: what "auto" stands for
    const char* meaning = "";
    const char* source = "";
};

struct Word {
    std::string typed, meant;  ///< "AA", "columnar"; the same but for an alias
};
std::vector<Word> words_of(const Facts& facts);
bool in_range(double value, const Range& range);
/// "> 0 m", ">= 0 and <= 1", "" if all is allowed.
std::string range_text(const Facts& facts);

/// What a key takes, for messages: `a quantity > 0 m such as "1 m"`, `one of "x", "y"`.
std::string expected(const double& member, const Facts& facts);
std::string expected(const std::optional<double>& member, const Facts& facts);
std::string expected(const int& member, const Facts& facts);
std::string expected(const std::int64_t& member, const Facts& facts);
std::string expected(const std::optional<std::int64_t>& member, const Facts& facts);
std::string expected(const bool& member, const Facts& facts);
std::string expected(const std::string& member, const Facts& facts);
std::string expected(const Vec3& member, const Facts& facts);
std::string expected(const std::optional<Vec3>& member, const Facts& facts);
std::string expected(const std::vector<double>& member, const Facts& facts);
std::string expected(const std::array<std::string, 2>& member, const Facts& facts);
std::string expected(const std::vector<std::string>& member, const Facts& facts);
std::string expected(const std::vector<Vec3>& member, const Facts& facts);

template <class V>
void describe(V& v, SimulationSpec& s)
{
    v("title", s.title, {.meaning = "for the report and the plots"});
    v("seed", s.seed, {.range = not_negative, .meaning = "every random draw follows from it"});
}

template <class V>
void describe(V& v, CleavageSpec& s)
{
    const Condition cohesive{s.new_surface != "free", "new_surface = \"cohesive\" or \"pre_cut\""};
    v("planes", s.planes,
      {.required = always,
       .meaning = "cleavage planes in the grain's crystal frame, Miller-Bravais: braces for all planes that symmetry "
                  "makes equal, parentheses for one",
       .source = "Saleme Ruiz 2016, 3.2"});
    v("slabs", s.slabs,
      {.meaning = "planes beside the grain's centre too: the short diagonals of a whole hexagonal prism"});
    v("toughness", s.toughness,
      {.unit = "Pa m^0.5",
       .range = positive,
       .required = always,
       .meaning = "K_c: one for all planes, or one for each entry of `planes`"});
    v("mode_ratio", s.mode_ratio,
      {.range = positive, .meaning = "C: toughness in shear over K_c", .source = "Saleme Ruiz 2016 (3.25)"});
    v("criterion", s.criterion,
      {.words = "ellipse | shetty | energy",
       .meaning = "ellipse: (K_I/K_c)^2 + (K_II/(C K_c))^2; shetty: K_I/K_c + (K_II/(C K_c))^2; energy: energy release "
                  "rate over K_c^2 (1 - nu^2)/E",
       .source = "Saleme Ruiz 2016 (3.25); Shetty 1987"});
    v("flaw", s.flaw,
      {.words = "through | edge | penny",
       .meaning = "through: crack of length 2a, Y = 1; edge: depth a, Y = 1.12; penny: radius a, Y = 2/pi"});
    v("flaw_size", s.flaw_size,
      {.unit = "m", .range = positive, .required = always, .meaning = "a in K = Y sigma sqrt(pi a)"});
    v("flaw_site", s.flaw_site,
      {.words = "surface | buried",
       .meaning = "surface: where on the plane's edge it is worst; buried: at its middle"});
    v("finite_width", s.finite_width, {.meaning = "K grows as the flaw takes more of the plane's width"});
    v("friction", s.friction, {.range = not_negative, .meaning = "of closed flaws"});
    v("gate", s.gate,
      {.words = "principal | hydrostatic | none",
       .meaning = "which grains are looked at: principal stress, shear or a face's traction above 0.3 of what splits; "
                  "mean stress above `hydrostatic_threshold`; all",
       .source = "Saleme Ruiz 2016 (3.22) for hydrostatic"});
    v("hydrostatic_threshold", s.hydrostatic_threshold,
      {.unit = "Pa",
       .required = always,
       .used = {s.gate == "hydrostatic", "gate = \"hydrostatic\""},
       .meaning = "tension positive"});
    v("new_surface", s.new_surface,
      {.words = "cohesive | free | pre_cut",
       .meaning = "cohesive: it keeps the traction that the plane carried and softens; free: it is gone at once, which "
                  "costs no energy and kicks the fragments; pre_cut: every candidate plane is an interface from the "
                  "start, and no grain is split in the run"});
    v("fracture_energy", s.fracture_energy,
      {.unit = "J/m^2",
       .range = positive,
       .used = cohesive,
       .unset = "K_c^2 (1 - nu^2)/E",
       .meaning = "G_I of the new surface"});
    v("fracture_energy_II", s.fracture_energy_II,
      {.unit = "J/m^2", .range = positive, .used = cohesive, .unset = "G_I/C^2", .meaning = "G_II of the new surface"});
    v("residual_friction", s.residual_friction,
      {.range = not_negative,
       .used = cohesive,
       .unset = "0.4; with `pre_cut` the smaller of that and `friction`",
       .meaning = "of the broken surface while it is an interface"});
    v("normal_stiffness", s.normal_stiffness,
      {.unit = "Pa/m",
       .range = positive,
       .used = cohesive,
       .unset = "the larger of E over the mean diameter of the ball that fits in a grain, and 5 sigma_th^2/G_I: then "
                "the surface starts with at most a tenth of its fracture energy",
       .meaning = "k_n of the new surface"});
    v("damping", s.damping,
      {.range = not_negative, .used = cohesive, .meaning = "of the new surface, share of critical"});
    v("min_fragment_volume", s.min_fragment_volume,
      {.range = {.least = 0.0, .most = 0.5, .below = true},
       .meaning = "smallest part, over the volume of the grain at the start"});
    v("min_section", s.min_section,
      {.range = share_below_1, .meaning = "smallest section, over the surface of what is split"});
    v("min_inradius", s.min_inradius,
      {.range = not_negative, .meaning = "smallest inradius of a part, over the dilation radius"});
    v("max_generation", s.max_generation,
      {.range = {0.0, 20.0}, .meaning = "how often a grain and its fragments may be split"});
}

template <class V>
void describe(V& v, MaterialSpec& s)
{
    v("density", s.density, {.unit = "kg/m^3", .range = positive, .required = always, .meaning = "mass per volume"});
    v("young_modulus", s.young_modulus,
      {.unit = "Pa", .range = positive, .required = always, .meaning = "Young's modulus E of the polycrystal"});
    v("poisson_ratio", s.poisson_ratio,
      {.range = {-1.0, 0.5, true, true},
       .required = always,
       .meaning = "Poisson's ratio nu; enters the `auto` stiffness of bonds"});
    v.table("cleavage", s.cleavage,
            {.used = {!s.cleavage.planes.empty()}, .meaning = "transgranular fracture; left out: grains never split"});
}

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

template <class V>
void describe(V& v, BondSpec& s)
{
    // the interface of a fibre is told by its stiffness in shear
    const bool of_fibre = s.law == "interface" && s.shear_stiffness > 0.0;
    const bool breakable = s.failure != "unbreakable" && !of_fibre, has_softening = s.law == "interface";
    const bool of_spheres = s.law == "parallel" || s.law == "spring";
    const Condition fibre{of_fibre,
                          of_fibre ? "" : "law = \"interface\" and shear_stiffness, the interface of a fibre"},
        spheres{of_spheres, "law = \"parallel\" or \"spring\""};
    const Condition strengths{breakable, "failure = \"point\" or \"face\""};
    const Condition energies{breakable && has_softening && s.softening == "bilinear", "softening = \"bilinear\""};
    v("between", s.between, {.meaning = "two names of parts, materials or walls, or `*`"});
    v("law", s.law,
      {.words = "interface | parallel | spring | point",
       .meaning = "interface: integrated over the shared face, or the surface of a fibre; parallel: circular parallel "
                  "bond; spring: spheres, without moments (LSDP); point: one a corner of the face",
       .source = "parallel: Potyondy & Cundall 2004; point: Saleme Ruiz 2016, 2.3.3"});
    v("form", s.form,
      {.words = "total | incremental",
       .used = {s.law == "parallel", "law = \"parallel\""},
       .meaning = "parallel between spheres: total: from where they are, without drift; incremental: with a history",
       .source = "total: Kuzkin & Asonov 2012"});
    v("gap_factor", s.gap_factor,
      {.range = not_negative,
       .used = spheres,
       .meaning = "spheres whose gap is at most this share of the sum of their radii are bonded"});
    v("normal_stiffness", s.normal_stiffness,
      {.unit = "Pa/m",
       .range = positive,
       .unset = "grains: from `elasticity`, E and the distance h of the centres; spheres: from E, nu and the packing; "
                "chains: E/h; fibre: 0",
       .meaning = "stiffness per area k_n"});
    v("shear_ratio", s.shear_ratio,
      {.range = not_negative,
       .used = {!of_fibre, "a bond that is no fibre's interface"},
       .unset = "from `elasticity` or the packing, and nu",
       .meaning = "k_s / k_n; grains: > 0"});
    v("shear_stiffness", s.shear_stiffness,
      {.unit = "Pa/m",
       .range = positive,
       .used = {of_fibre, s.law == "interface" ? "" : "law = \"interface\""},
       .meaning = "interface of a fibre: K_0, its only stiffness unless normal_stiffness is given"});
    v("yield_slip", s.yield_slip,
      {.unit = "m",
       .range = positive,
       .used = fibre,
       .unset = "elastic",
       .meaning = "delta_0: slip at strength K_0 delta_0"});
    v("failure_slip", s.failure_slip,
      {.unit = "m",
       .range = positive,
       .used = fibre,
       .unset = "it breaks at once",
       .meaning = "delta_1: slip at which nothing is left; fracture energy K_0 delta_0 delta_1/2",
       .source = "Dressler 2020 (82)"});
    v("residual_shear", s.residual_shear,
      {.unit = "Pa", .range = not_negative, .used = fibre, .meaning = "tau_r: friction of the broken interface"});
    v("radial_pressure", s.radial_pressure,
      {.unit = "Pa",
       .range = not_negative,
       .used = fibre,
       .meaning = "p_0 of the matrix on the fibre; adds residual_friction times it to the friction"});
    v("contraction", s.contraction,
      {.range = not_negative,
       .used = {of_fibre && s.radial_pressure > 0.0, "radial_pressure"},
       .unset = "chain: nu_f E_m/((1 - nu_f) E_m + (1 + nu_m) E_f), a wide matrix; taken: 0",
       .meaning = "k_p: the pressure falls by this times the axial stress of the fibre, p = p_0 - k_p sigma_f >= 0"});
    v("frame", s.frame,
      {.words = "surface | branch",
       .used = fibre,
       .meaning =
           "fibre of generator `taken`: slip in the surface of its cylinder, or square to the line of the centres "
           "as in the source",
       .source = "Dressler 2020, 4.4.5"});
    v("reach", s.reach,
      {.words = "level | all",
       .used = fibre,
       .meaning = "fibre of generator `taken`: bonds between spheres side by side, or between all that touch"});
    v("elasticity", s.elasticity,
      {.words = "homogeneous | plane | solid",
       .meaning = "rule of `auto`: homogeneous k_n = k_s = E/h (nu = 0, exact); plane: honeycomb in plane stress, nu < "
                  "1/3; solid: isotropic tessellation, nu < 1/4",
       .source = "Kawai 1978; Bolander & Saito 1998; Asahina et al. 2017"});
    v("failure", s.failure,
      {.words = "unbreakable | point | face",
       .meaning = "point: each integration point by itself; face: the whole face with its worst corner (law interface, "
                  "softening brittle)"});
    v("softening", s.softening,
      {.words = "brittle | bilinear",
       .used = {has_softening || s.softening == "brittle"},
       .meaning = "brittle: all is lost at onset; bilinear: linear loss over the fracture energy (law interface; the "
                  "others are brittle)",
       .source = "bilinear: Camanho & Davila 2002"});
    v("onset", s.onset,
      {.words = "mohr_coulomb | quadratic",
       .meaning = "mohr_coulomb: with tension cut-off; quadratic: (sigma/sigma_c)^2 + (tau/c)^2 = 1 in tension",
       .source = "Camanho & Davila 2002"});
    v("tensile_strength", s.tensile_strength,
      {.unit = "Pa",
       .range = positive,
       .required = strengths,
       .used = {s.tensile_strength > 0.0},
       .meaning = "sigma_c; at most cohesion/friction with mohr_coulomb"});
    v("cohesion", s.cohesion,
      {.unit = "Pa",
       .range = positive,
       .required = strengths,
       .used = {s.cohesion > 0.0},
       .meaning = "shear strength c without normal stress"});
    v("friction", s.friction, {.range = not_negative, .meaning = "tan(phi) of the onset surface"});
    v("residual_friction", s.residual_friction,
      {.range = not_negative,
       .unset = "`friction`",
       .meaning = "mu_r of broken points, at most `friction` (else breaking could create energy)",
       .source = "Alfano & Sacco 2006"});
    v("fracture_energy_I", s.fracture_energy_I,
      {.unit = "J/m^2",
       .range = positive,
       .required = energies,
       .used = {s.fracture_energy_I > 0.0},
       .meaning = "G_I, mode I"});
    v("fracture_energy_II", s.fracture_energy_II,
      {.unit = "J/m^2",
       .range = positive,
       .required = energies,
       .used = {s.fracture_energy_II > 0.0},
       .meaning = "G_II, mode II"});
    v("mixed_mode", s.mixed_mode,
      {.words = "bk | power",
       .meaning = "energy between the modes: bk G_I + (G_II - G_I) B^eta, or the power law",
       .source = "Benzeggagh & Kenane 1996"});
    v("mixed_mode_exponent", s.mixed_mode_exponent, {.range = positive, .meaning = "eta of bk, alpha of power"});
    v("quadrature", s.quadrature,
      {.words = "auto | cross | fan3 | fan7 | gauss2 | gauss3 | gauss4 | gauss6 | gauss8 | lobatto3 | lobatto4 | "
                "lobatto5 | lobatto6 | lobatto8",
       .meaning = "integration points of a face; auto: 4x4 Gauss on quadrilaterals, fan7 on others"});
    v("damping", s.damping, {.range = share, .meaning = "zeta, share of critical damping of the bond's own vibration"});
    v("weibull_modulus", s.weibull_modulus,
      {.range = positive,
       .unset = "no scatter",
       .meaning = "m of the scatter of strength, one draw a face",
       .source = "Weibull 1951"});
    v("weibull_area", s.weibull_area,
      {.unit = "m^2",
       .range = positive,
       .unset = "mean face",
       .meaning = "reference area A_0 of the size effect",
       .source = "Weibull 1951"});
    v("weibull_scales_energy", s.weibull_scales_energy,
      {.meaning = "fracture energies scale with the square of the strength factor (same process zone)"});
    v("misorientation_angle", s.misorientation_angle,
      {.unit = "rad",
       .range = positive,
       .unset = "no dependence on orientation",
       .meaning = "theta_m of the grain-boundary energy",
       .source = "Read & Shockley 1950"});
    v("misorientation_effect", s.misorientation_effect,
      {.range = share_below_1,
       .meaning = "chi, share of the fracture energy that a boundary of large angle lacks",
       .source = "Rice & Wang 1989"});
    v("moment_contribution", s.moment_contribution,
      {.range = share,
       .meaning = "parallel, point: beta, share of the bending and twisting moments in the stress",
       .source = "Potyondy & Cundall 2004"});
    v("bond_radius", s.bond_radius,
      {.unit = "m",
       .range = positive,
       .unset = "parallel: circle with the face's area; point: dilation radius",
       .meaning = "parallel, point: radius of the bond's section",
       .source = "Saleme Ruiz 2016, eq. 2.10"});
    v("made_in", s.made_in,
      {.used = {!s.made_in.empty()},
       .meaning = "stage of kind `bond` that makes them; left out: they are there from the start"});
}

template <class V>
void describe(V& v, ContactSpec& s)
{
    v("between", s.between, {.meaning = "two names of parts, materials or walls, or `*`"});
    v("law", s.law,
      {.words = "linear",
       .meaning = "linear: springs along and across the normal, Coulomb cap",
       .source = "Cundall & Strack 1979"});
    v("normal_stiffness", s.normal_stiffness,
      {.unit = "Pa/m",
       .range = positive,
       .unset = "E/h, ten times that against walls",
       .meaning = "stiffness per area k_c"});
    v("shear_ratio", s.shear_ratio,
      {.range = not_negative,
       .meaning = "shear over normal stiffness",
       .source = "Saleme Ruiz 2016, Table 2.4 (2000/5000)"});
    v("friction", s.friction, {.range = not_negative, .meaning = "Coulomb's mu"});
    v("dissipation", s.dissipation,
      {.words = "hysteretic | viscous | none",
       .meaning = "hysteretic: unloading is stiffer by 1/e^2; viscous: dashpot for the same e",
       .source = "hysteretic: Walton & Braun 1986"});
    v("restitution", s.restitution,
      {.range = share_above_0, .meaning = "coefficient of restitution e of a head-on collision"});
}

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

template <class V>
void describe(V& v, ControlSpec& s)
{
    v("time_step_safety", s.time_step_safety, {.range = share_above_0, .meaning = "share of the critical time step"});
    v("time_step", s.time_step,
      {.unit = "s",
       .range = positive,
       .unset = "`time_step_safety` of the critical one",
       .meaning = "a fixed time step"});
    v("local_damping", s.local_damping,
      {.range = share_below_1,
       .meaning = "alpha of the local non-viscous damping; not for dynamic tests",
       .source = "Cundall 1987"});
    v("gravity", s.gravity, {.unit = "m/s^2", .meaning = "acceleration of gravity"});
    v("skin", s.skin,
      {.unit = "m",
       .range = positive,
       .unset = "chosen from the grain size",
       .meaning = "reach of the neighbour list beyond contact; speed only, not results"});
}

template <class V>
void describe(V& v, OutputSpec& s)
{
    v("every", s.every,
      {.unit = "s",
       .range = positive,
       .unset = "a twentieth of the expected run, or `snapshots`",
       .meaning = "simulated time between snapshots"});
    v("snapshots", s.snapshots,
      {.range = {1.0, 1e6},
       .unset = "`every`",
       .meaning = "or their number; needs `test.stop.time` or a stage with a duration"});
    v("history", s.history,
      {.unit = "s",
       .range = positive,
       .unset = "1/2000 of the expected run, or 100 steps",
       .meaning = "simulated time between rows of history.csv"});
    v("checkpoint", s.checkpoint,
      {.unit = "s", .range = not_negative, .meaning = "wall time between checkpoints; 0: none by time"});
    v("checkpoint_steps", s.checkpoint_steps,
      {.range = {1.0, 1e12},
       .unset = "by wall time only",
       .meaning = "most steps between checkpoints, besides `checkpoint`"});
    v("contacts", s.contacts, {.meaning = "write paraview/contacts.pvd"});
}

template <class V>
void describe(V& v, Case& c)
{
    v.table("simulation", c.simulation, {.meaning = "what the run is called and where its random numbers start"});
    v.named("materials", c.materials, {.meaning = "materials, each with a name of its own"});
    v.array("parts", c.parts, {.required = always, .meaning = "what is simulated; at least one"});
    v.array("bonds", c.bonds, {.meaning = "what holds grains together; without an entry that fits, they are loose"});
    v.array("contacts", c.contacts, {.meaning = "how grains push on each other and on walls"});
    v.array("walls", c.walls, {.meaning = "rigid bodies with a prescribed motion"});
    v.array("grips", c.grips,
            {.meaning = "bodies of a part that are held or driven, each set a wall of its own; test `custom`"});
    v.array("stages", c.stages,
            {.meaning = "test `custom`: one after the other, each until the first of its end conditions"});
    v.array("calibration", c.calibration,
            {.meaning = "for `grainfrac calibrate`: a part and the elasticity and strength that it is to have; `run` "
                        "leaves it aside"});
    v.table("test", c.test, {.meaning = "a ready-made experiment: places platens, loads, measures"});
    v.table("control", c.control, {.meaning = "time step, damping, gravity"});
    v.table("output", c.output, {.meaning = "what is written and how often"});
}

}  // namespace grainfrac
