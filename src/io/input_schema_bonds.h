// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of [[bonds]] and [[contacts]].
#pragma once

#include "io/input_facts.h"
#include "model/case.h"

namespace grainfrac {

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

}  // namespace grainfrac
