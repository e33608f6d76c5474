// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_starts.h"

namespace grainfrac {
namespace {

const std::string ceramic = R"(
[materials.sic]
density       = "3100 kg/m^3"
young_modulus = "410 GPa"
poisson_ratio = 0.17
)";

const std::string bonds = R"(
[[bonds]]
tensile_strength   = "100 MPa"
cohesion           = "400 MPa"
friction           = 0.5
residual_friction  = 0.4
fracture_energy_I  = "29 J/m^2"
fracture_energy_II = "300 J/m^2"
)";

/// Slip on inclined faces is what breaks a pressed bar.
const std::string bonds_that_slip = R"(
[[bonds]]
tensile_strength   = "100 MPa"
cohesion           = "200 MPa"
friction           = 0.2
fracture_energy_I  = "29 J/m^2"
fracture_energy_II = "116 J/m^2"
)";

const std::string contacts = R"(
[[contacts]]
friction = 0.3
)";

/// A part of hexagonal prisms, cut by a region.
std::string prisms(const std::string& name, const std::string& side, const std::string& thickness,
                   const std::string& region)
{
    return "\n[[parts]]\nname = \"" + name + "\"\nmaterial = \"sic\"\nside = \"" + side + "\"\nthickness = \"" +
           thickness + "\"\nregion = { " + region +
           " }\nat_region_boundary = \"cut\"\nsliver_fraction = 0.3\norientation = { random = \"c-fibre\" }\n";
}

std::string titled(const std::string& title)
{
    return "[simulation]\ntitle = \"" + title + "\"\nseed = 1\n";
}

/// A specimen of grains in one of the tests that make their own walls.
std::string of_grains(const std::string& title, const std::string& part, const std::string& test,
                      const std::string& held_by = bonds)
{
    return titled(title) + ceramic + part + held_by + contacts + "\n[test]\n" + test;
}

const std::string bar = prisms("bar", "0.6 mm", "1.3 mm", R"(shape = "box", size = ["5 mm", "10 mm", "1.3 mm"])");
const std::string beam = prisms("beam", "0.6 mm", "1.3 mm", R"(shape = "beam", size = ["20 mm", "5 mm", "1.3 mm"])");

const std::string spheres = R"(
[materials.soft]
density       = "2400 kg/m^3"
young_modulus = "5 GPa"
poisson_ratio = 0.11

[materials.stiff]
density       = "2400 kg/m^3"
young_modulus = "50 GPa"
poisson_ratio = 0.2
)";

std::vector<InputStart> made()
{
    return {
        {"brazilian", "a disc pressed along its diameter",
         of_grains("Brazilian disc",
                   prisms("disc", "0.8 mm", "5 mm", R"(shape = "disc", diameter = "15 mm", height = "5 mm")"),
                   R"(kind = "brazilian"
platen_speed = "50 mm/s"
contact_half_width = "1.3 mm"
stop = { load_drop = 0.5, strain = 0.01 }
)")},
        {"uniaxial_compression", "a bar pressed along its length",
         of_grains("Bar under compression", bar, R"(kind = "uniaxial_compression"
platen_speed = "50 mm/s"
direction = "y"
ends = "platens"
wall_friction = 0.1
stop = { load_drop = 0.5, strain = 0.02 }
)",
                   bonds_that_slip)},
        {"uniaxial_tension", "a bar pulled along its length",
         of_grains("Bar under tension", bar, R"(kind = "uniaxial_tension"
platen_speed = "20 mm/s"
direction = "y"
stop = { load_drop = 0.5, strain = 0.01 }
)")},
        {"three_point_bending", "a beam over two supports, loaded at mid span",
         of_grains("Beam over two supports", beam, R"(kind = "three_point_bending"
platen_speed = "40 mm/s"
outer_span = "16 mm"
stop = { load_drop = 0.5, strain = 0.01 }

[control]
local_damping = 0.3
)")},
        {"four_point_bending", "a beam over four rollers",
         of_grains("Beam over four rollers", beam, R"(kind = "four_point_bending"
platen_speed = "40 mm/s"
outer_span = "16 mm"
inner_span = "8 mm"
stop = { load_drop = 0.5, strain = 0.01 }

[control]
local_damping = 0.3
)")},
        {"notched_beam", "toughness from the peak load of a beam with a notch",
         of_grains("Notched beam",
                   prisms("beam", "0.3 mm", "1 mm", R"(shape = "beam", size = ["12 mm", "3.2 mm", "1 mm"])"),
                   R"(kind = "notched_beam"
platen_speed = "20 mm/s"
outer_span = "10 mm"
inner_span = 0
notch_depth = "0.9 mm"
wall_friction = 0.03
stop = { load_drop = 0.5, strain = 0.01 }

[control]
local_damping = 0.3
)")},
        {"dcb",
         "toughness of a boundary from two arms that are pulled apart", titled("Double cantilever beam") + ceramic + R"(
[[parts]]
name = "lower"
material = "sic"
side = "0.1 mm"
thickness = "1 mm"
region = { shape = "beam", size = ["4 mm", "0.64 mm", "1 mm"] }

[[parts]]                        # four rows of 1.5 sides higher: the lattices fit
name = "upper"
material = "sic"
side = "0.1 mm"
thickness = "1 mm"
region = { shape = "beam", size = ["4 mm", "0.64 mm", "1 mm"], center = [0, "0.6 mm", 0] }

[[bonds]]                        # within the arms
failure = "unbreakable"
quadrature = "cross"

[[bonds]]
between = ["lower", "upper"]
tensile_strength = "100 MPa"
cohesion = "200 MPa"
friction = 0.5
residual_friction = 0.4
fracture_energy_I = "10 J/m^2"
fracture_energy_II = "10 J/m^2"
)" + contacts + R"(
[test]
kind = "dcb"
platen_speed = "30 mm/s"
crack_length = "2 mm"
ramp = "40 us"
stop = { strain = 0.002 }

[control]
local_damping = 0.3
)"},
        {"drop", "loose grains that fall on a floor; [[bonds]] would make one body of them",
         titled("Grains that fall on a floor") + ceramic + R"(
[[parts]]
name = "grains"
material = "sic"
side = "0.6 mm"
thickness = "1.3 mm"
dilation_radius = "0.1 mm"
region = { shape = "box", size = ["4.5 mm", "4.5 mm", "2.6 mm"] }

[[contacts]]
normal_stiffness = "2e9 Pa/m"
friction = 0.3
dissipation = "hysteretic"
restitution = 0.5

[test]
kind = "drop"
drop_height = "1 mm"
side_gap = "1 mm"
stop = { time = "0.03 s", rest = 0.01 }

[output]
history = "20 us"
snapshots = 20
)"},
        {"pull_out", "a fibre pulled out of a matrix of spheres", titled("Fibre pull-out") + spheres + R"(
[[parts]]
name = "matrix"
kind = "spheres"
material = "soft"
generator = "hcp"
diameter = "1 mm"
lattice_origin = "channel"
region = { shape = "cylinder", diameter = "8 mm", height = "10 mm", axis = "z" }

[[parts]]
name = "fibre"
kind = "spheres"
material = "stiff"
generator = "chain"
diameter = "0.8 mm"
inside = "matrix"
fibre = { from = [0, 0, "-5.2 mm"], to = [0, 0, "5.2 mm"], radius = "1 mm" }

[[bonds]]
between = ["matrix", "matrix"]
law = "parallel"
failure = "unbreakable"

[[bonds]]
between = ["fibre", "fibre"]
law = "parallel"
failure = "unbreakable"

[[bonds]]
between = ["fibre", "matrix"]
law = "interface"
shear_stiffness = "2e11 Pa/m"
yield_slip = "5 um"
failure_slip = "15 um"

[test]
kind = "pull_out"
fibre = "fibre"
matrix = "matrix"
control = "damage"
damage_step = 0.05
)"},
        {"custom", "walls and stages of your own: here a bar pressed between two plates",
         titled("Bar between two plates") + ceramic + bar + bonds_that_slip + contacts + R"(
[[walls]]
name = "bottom"
center = [0, "-5 mm", 0]
normal = [0, 1, 0]
size = ["6 mm", "6 mm"]

[[walls]]
name = "top"
center = [0, "5 mm", 0]
normal = [0, -1, 0]
size = ["6 mm", "6 mm"]

[[stages]]
name = "press"
kind = "load"
move = [{ wall = "top", velocity = [0, "-100 mm/s", 0] }]
ramp = "10 us"
load_drop = 0.5

[test]
kind = "custom"
stop = { time = "1 ms" }

[output]
history = "0.2 us"
snapshots = 20
)"},
        {"calibrate", "bond stiffnesses that give spheres a wanted elasticity; for `grainfrac calibrate`",
         titled("Calibration of a packing") + R"(
[materials.rock]
density       = "2400 kg/m^3"
young_modulus = "5 GPa"
poisson_ratio = 0.15

[[parts]]
name = "matrix"
kind = "spheres"
material = "rock"
generator = "hcp"
diameter = "1 mm"
region = { shape = "cylinder", diameter = "12 mm", height = "20 mm" }

[[bonds]]
between = ["matrix", "matrix"]
law = "parallel"
failure = "unbreakable"

[[calibration]]
part = "matrix"
young_modulus = "5 GPa"
poisson_ratio = 0.15
)"},
    };
}

}  // namespace

const std::vector<InputStart>& input_starts()
{
    static const std::vector<InputStart> starts = made();
    return starts;
}

}  // namespace grainfrac
