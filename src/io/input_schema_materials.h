// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of [simulation] and [materials.NAME].
#pragma once

#include "io/input_facts.h"
#include "model/case.h"

namespace grainfrac {

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

}  // namespace grainfrac
