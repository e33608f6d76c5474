// SPDX-License-Identifier: GPL-3.0-or-later
// The input file as plain data, in SI units: what the reader fills and the builders read. One struct per TOML table;
// names are the keys. Which keys exist, their units, ranges and defaults is told once, in io/input_schema.h.
#pragma once

#include "geometry/vec3.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace grainfrac {

struct SimulationSpec {
    std::string title;
    std::int64_t seed = 1;
};

/// How grains of a material split; without planes they never do.
struct CleavageSpec {
    std::vector<std::string> planes;           ///< Miller-Bravais: "{10-10}", "{11-20}", "(0001)", ...
    bool slabs = true;                         ///< also the planes of 2.7 beside the centre, of whole prisms
    std::vector<double> toughness;             ///< K_c, one for all or one for each of `planes` [Pa sqrt(m)]
    double mode_ratio = 0.816;                 ///< C [-]
    std::string criterion = "ellipse";         ///< ellipse | shetty | energy
    std::string flaw = "through";              ///< through | edge | penny
    double flaw_size = 0.0;                    ///< a [m]
    std::string flaw_site = "surface";         ///< surface | buried
    bool finite_width = true;                  ///< K grows with the flaw's share of the plane
    double friction = 0.3;                     ///< of closed flaws [-]
    std::string gate = "principal";            ///< principal | hydrostatic | none
    double hydrostatic_threshold = 0.0;        ///< gate = hydrostatic, tension positive [Pa]
    std::string new_surface = "cohesive";      ///< cohesive | free | pre_cut
    std::optional<double> fracture_energy;     ///< G_I of the new surface [J/m^2]; auto: K_c^2 (1 - nu^2)/E
    std::optional<double> fracture_energy_II;  ///< [J/m^2]; auto: G_I/C^2
    std::optional<double> residual_friction;   ///< [-]; auto: 0.4, pre_cut: not above `friction`
    std::optional<double> normal_stiffness;    ///< of the new surface [Pa/m]; auto: see cleavage_rules.cpp
    double damping = 0.05;                     ///< [-]
    double min_fragment_volume = 0.02;         ///< of the grain at the start [-]
    double min_section = 0.02;                 ///< of the parent's surface [-]
    double min_inradius = 3.0;                 ///< of a part, over the parent's dilation radius [-]
    std::int64_t max_generation = 2;           ///< splits behind a fragment [-]
};

struct MaterialSpec {
    std::string name;
    double density = 0.0;        ///< [kg/m^3]
    double young_modulus = 0.0;  ///< [Pa]
    double poisson_ratio = 0.0;  ///< [-]
    CleavageSpec cleavage{};
};

struct RegionSpec {
    std::string shape = "box";  ///< box | beam | cylinder | disc | sphere
    Vec3 center;                ///< [m]
    Vec3 size;                  ///< box, beam: full lengths [m]
    double diameter = 0.0;      ///< cylinder, disc, sphere [m]
    double height = 0.0;        ///< cylinder, disc [m]
    std::string axis = "z";     ///< cylinder, disc: x | y | z
    int facets = 96;            ///< sides that stand for the circle [-]
};

/// Crystal orientation of the grains: exactly one way is set.
struct OrientationSpec {
    std::vector<double> choices;  ///< angles about `about`, one drawn per grain [rad]
    std::string about = "z";      ///< x | y | z
    std::string random;           ///< "", "uniform" (SO(3)) or "c-fibre" (uniform angle about z)
    std::string file;             ///< text file: one quaternion w x y z a line and grain; relative to the input file
};

/// Where a chain of spheres runs.
struct FibreSpec {
    std::string shape = "straight";  ///< straight | wavy | hooked | points
    Vec3 from, to;                   ///< centres of the first and last sphere; hooked: of the straight piece [m]
    double amplitude = 0.0;          ///< wavy [m]
    double wavelength = 0.0;         ///< wavy [m]
    Vec3 sideways{1, 0, 0};          ///< wavy, hooked: direction of the wave, of the hooks
    double hook_length = 0.0;        ///< hooked: of each of the two inclined pieces before `from` [m]
    double hook_angle = 0.7853981633974483;  ///< hooked: of the inclined piece against the fibre [rad]
    std::vector<Vec3> points;                ///< points: corners of the line [m]
    std::optional<double> spacing;           ///< of the spheres along the line; auto: their diameter [m]
    std::optional<double> radius;            ///< of the section; auto: that of the spheres, and their mass [m]
};

struct PartSpec {
    std::string name;
    std::string kind = "grains";  ///< grains | spheres
    std::string material;
    std::string generator = "hexagonal_prisms";  ///< grains: hexagonal_prisms | file; spheres: hcp | fcc |
                                                 ///< random_dense | chain | taken | file
    std::string file;                       ///< generator = "file": a microstructure written by `grainfrac generate`
    double side = 0.0;                      ///< [m]
    double thickness = 0.0;                 ///< [m]
    std::string stacking = "columnar";      ///< columnar (AA) | half | hollow (AB)
    std::string lattice = "nominal";        ///< nominal | contained
    bool centered = false;                  ///< a prism stands on the line through the region's centre
    std::optional<double> dilation_radius;  ///< [m]; auto: 0.04 of the mean inradius
    double sliver_fraction = 0.05;          ///< [-]
    double gap = 0.0;                       ///< between neighbours, which are smaller by it [m]
    // spheres
    double diameter = 0.0;                ///< hcp, fcc: spacing too; random_dense: the mean; chain: of its spheres [m]
    double size_ratio = 1.0;              ///< random_dense: largest over smallest diameter [-]
    double solid_fraction = 0.6;          ///< random_dense [-]
    std::string lattice_axis = "z";       ///< hcp: c axis: x | y | z
    std::string lattice_origin = "site";  ///< hcp: site | channel: what lies on the line through the region's centre
    std::string inside;                   ///< part whose spheres make room (chain) or are taken (taken)
    FibreSpec fibre;                      ///< chain
    std::vector<Vec3> copies;             ///< chain: the same again, moved by these [m]
    RegionSpec region;
    std::string at_region_boundary = "keep";  ///< keep | cut
    OrientationSpec orientation;
    Vec3 velocity;          ///< initial [m/s]
    Vec3 angular_velocity;  ///< initial, of each grain about its own centre [rad/s]
};

struct BondSpec {
    std::array<std::string, 2> between{"*", "*"};
    std::string law = "interface";           ///< interface | parallel | spring | point
    std::string form = "total";              ///< parallel between spheres: total | incremental
    std::optional<double> normal_stiffness;  ///< [Pa/m]; auto: from elasticity and the distance of the centres
    std::optional<double> shear_ratio;       ///< k_s/k_n [-]; auto: from `elasticity`
    /// Rule of `auto`. Grains: homogeneous (nu = 0) | plane (honeycomb) | solid (isotropic 3-D); spheres: their
    /// packing's
    std::string elasticity = "homogeneous";
    std::string failure = "point";       ///< unbreakable | point (each point) | face (whole face at its worst corner)
    std::string softening = "bilinear";  ///< brittle | bilinear
    std::string onset = "mohr_coulomb";  ///< mohr_coulomb | quadratic
    double tensile_strength = 0.0;       ///< [Pa]
    double cohesion = 0.0;               ///< [Pa]
    double friction = 0.0;               ///< tan(phi) of the onset surface [-]
    std::optional<double> residual_friction;     ///< mu_r of broken points [-]; default: friction
    double fracture_energy_I = 0.0;              ///< [J/m^2]
    double fracture_energy_II = 0.0;             ///< [J/m^2]
    std::string mixed_mode = "bk";               ///< bk (Benzeggagh-Kenane) | power
    double mixed_mode_exponent = 2.0;            ///< eta or alpha [-]
    std::string quadrature = "auto";             ///< auto, cross, fan3, fan7, gauss2.., lobatto3..
    double damping = 0.05;                       ///< zeta, fraction of critical [-]
    std::optional<double> weibull_modulus;       ///< m [-]
    std::optional<double> weibull_area;          ///< A_0 [m^2]; default: mean face
    bool weibull_scales_energy = true;           ///< G_c by the factor squared (constant process zone)
    std::optional<double> misorientation_angle;  ///< theta_m of Read-Shockley [rad]
    double misorientation_effect = 0.3;          ///< chi [-]
    double moment_contribution = 1.0;            ///< parallel, point: beta [-]
    std::optional<double> bond_radius;           ///< parallel: circle of equal area; point: dilation radius [m]
    double gap_factor = 1e-3;                    ///< spheres: largest gap that is bonded, over both radii [-]
    // the interface of a fibre (a part with `inside`)
    double shear_stiffness = 0.0;        ///< K_0 [Pa/m]
    std::optional<double> yield_slip;    ///< delta_0 [m]
    std::optional<double> failure_slip;  ///< delta_1 [m]
    double residual_shear = 0.0;         ///< tau_r of the broken interface [Pa]
    double radial_pressure = 0.0;        ///< p_0 of the matrix on the fibre [Pa]
    std::optional<double> contraction;   ///< k_p: loss of p per axial stress of the fibre [-]; auto: of a wide matrix
    std::string frame = "surface";       ///< surface: of the fibre's cylinder | branch: between the centres
    std::string reach = "level";         ///< lattice fibre: level: spheres side by side | all: all that touch
    std::string made_in;                 ///< stage of kind "bond" that makes them; "": there from the start
};

struct ContactSpec {
    std::array<std::string, 2> between{"*", "*"};
    std::string law = "linear";
    std::optional<double> normal_stiffness;  ///< area stiffness k_c [Pa/m]; auto: E/h, ten times that against walls
    double shear_ratio = 0.4;                ///< [-]
    double friction = 0.3;                   ///< [-]
    std::string dissipation = "hysteretic";  ///< hysteretic (unload factor 1/e^2) | viscous | none
    double restitution = 1.0;                ///< e [-]
};

/// A wall that holds a force: it moves along `direction` as fast as the force that is missing asks.
struct ServoSpec {
    std::optional<double> force;      ///< wanted push [N]
    std::optional<double> stress;     ///< or push over `area` [Pa]
    std::optional<double> area;       ///< [m^2]; auto: section of the box around the grains when the stage begins
    Vec3 direction;                   ///< of the push; zero: the normal of a plate [-]
    std::optional<double> max_speed;  ///< [m/s]; auto: the quasi-static speed

    bool given() const { return force || stress; }
};

struct WallSpec {
    std::string name;
    std::string shape = "plate";    ///< plate | box | cylinder | sphere | stl
    Vec3 center;                    ///< plate: centre of its loaded face; stl: origin of the file; others: centre [m]
    Vec3 normal{0, 1, 0};           ///< plate: points to the specimen [-]
    Vec3 axis{0, 0, 1};             ///< cylinder [-]
    std::vector<double> size;       ///< plate: extents along its two in-plane directions; box: inner lengths [m]
    std::vector<std::string> open;  ///< box: sides without a plate, "+z"
    double thickness = 0.0;         ///< plate, box; 0: a tenth of the larger extent [m]
    double radius = 0.0;            ///< cylinder, sphere [m]
    double length = 0.0;            ///< cylinder [m]
    std::string file;               ///< stl: beside the input file
    double file_unit = 0.0;         ///< stl: length of one unit of the file [m]
    bool closed = true;             ///< stl: every edge must belong to two triangles
    Vec3 velocity;                  ///< [m/s]
    ServoSpec servo;                ///< instead of a velocity
    double ramp = 0.0;              ///< time over which the speed rises smoothly [s]
};

/// Bodies of a part that go as told: a wall made of them.
struct GripSpec {
    std::string name;
    std::string part;
    std::string at;                                            ///< first | last sphere of a chain; "": by `region`
    RegionSpec region;                                         ///< bodies whose centre is inside
    std::vector<std::string> hold{"x", "y", "z", "rotation"};  ///< what they do not choose themselves
    Vec3 velocity;                                             ///< [m/s]
    double ramp = 0.0;                                         ///< time over which the speed rises smoothly [s]

    bool by_region() const { return region.diameter > 0.0 || norm2(region.size) > 0.0; }
};

/// How a wall moves in a stage: at a velocity, or by a servo.
struct StageMotion {
    std::string wall;
    Vec3 velocity;  ///< [m/s]
    ServoSpec servo;

    bool moves() const { return norm2(velocity) > 0.0 || servo.given(); }
};
struct StageSpec {
    std::string name;
    std::string kind = "load";                     ///< settle | compact | bond | load | unload
    std::vector<StageMotion> motions;              ///< walls that are not named keep their own motion
    std::vector<std::string> release;              ///< grips whose bodies are free from this stage on
    double ramp = 0.0;                             ///< [s]
    std::optional<Vec3> gravity;                   ///< default: control.gravity [m/s^2]
    std::optional<double> local_damping;           ///< default: control.local_damping, settle: 0.7 [-]
    bool fracture = true;                          ///< bonds may break in this stage
    bool cleavage = true;                          ///< grains may split in this stage
    double bond_distance = 0.0;                    ///< bond: largest gap or overlap of two faces [m]
    double bond_angle = 0.0872664625997165;        ///< bond: largest angle between them; 5 degrees [rad]
    std::optional<double> duration;                ///< [s]
    std::optional<double> unbalanced_force_ratio;  ///< ends below this [-]
    std::optional<double> rest;                    ///< ends when kinetic energy is below this share of its largest [-]
    std::optional<double> load;                    ///< ends when the push of the first moving wall reaches this [N]
    std::optional<double> stress;                  ///< the same over the specimen's section [Pa]
    std::optional<double> load_drop;               ///< ends when the load fell by this share of its peak [-]
    std::optional<double> max_displacement;        ///< of the first moving wall [m]
};

struct StopSpec {
    std::optional<double> load_drop;  ///< share of the peak load [-]
    std::optional<double> strain;     ///< platen displacement over specimen size [-]
    std::optional<double> time;       ///< [s]
    std::optional<double> rest;       ///< drop: kinetic energy over m g h [-]
    std::optional<double> slip;       ///< pull_out: of the exit [m]
    std::optional<double> damage;     ///< pull_out: mean of the interface [-]
};
struct TestSpec {
    /// brazilian | uniaxial_compression | uniaxial_tension | three_point_bending | four_point_bending | notched_beam |
    /// dcb | drop | pull_out | custom
    std::string kind = "custom";
    double platen_speed = 0.0;                 ///< closing (tension: opening) speed of both sides together [m/s]
    std::string platen = "flat";               ///< brazilian: flat | curved
    double platen_radius = 0.0;                ///< curved; 0: 1.5 specimen radii (ISRM) [m]
    std::optional<double> contact_half_width;  ///< flat: half width of the platen [m]; auto: 0.05 of the diameter
    std::string direction = "y";               ///< loading axis: x | y | z
    std::string ends = "platens";              ///< uniaxial_compression: platens | gripped
    std::optional<double> grip_length;         ///< [m]; auto: one row of grains
    std::optional<double> wall_friction;       ///< [-]; auto: platens of uniaxial_compression 0, rollers 0.1
    double outer_span = 0.0;                   ///< between the supports [m]
    double inner_span = 0.0;                   ///< between the loading rollers; notched_beam: 0: one roller [m]
    std::optional<double> roller_radius;       ///< [m]; auto: half of the beam's height
    double notch_depth = 0.0;                  ///< notched_beam [m]
    double crack_length = 0.0;                 ///< dcb [m]
    double drop_height = 0.0;                  ///< [m]
    std::optional<double> side_gap;            ///< drop: from specimen to side walls [m]; auto: no side walls
    std::string fibre;                         ///< pull_out: part that is pulled
    std::string matrix;                        ///< pull_out: part that holds it
    std::string support = "uniform";           ///< pull_out: of the matrix' far face: uniform | held
    std::string control = "damage";            ///< pull_out: damage (whole path) | displacement | speed
    double damage_step = 0.01;                 ///< pull_out: mean damage of an event at most [-]
    std::optional<double> displacement_step;   ///< pull_out, displacement: of the grip between equilibria [m]
    std::vector<double> profiles_at{0.0, 0.1, 0.5, 0.8, 0.9};  ///< pull_out: mean damages whose profiles are kept [-]
    std::optional<double> slide_step;                          ///< pull_out: of the grip once all is broken [m]
    double relaxed = 1e-6;       ///< pull_out: mean residual over mean force of bonds at rest [-]
    std::optional<double> ramp;  ///< [s]; auto: 10 L/c0
    StopSpec stop;
};

struct ControlSpec {
    double time_step_safety = 0.8;    ///< [-]
    std::optional<double> time_step;  ///< [s]
    double local_damping = 0.0;       ///< alpha [-]
    Vec3 gravity;                     ///< [m/s^2]
    std::optional<double> skin;       ///< of the neighbour list [m]; auto
};

struct OutputSpec {
    std::optional<double> every;                   ///< snapshots [s]
    std::optional<std::int64_t> snapshots;         ///< or their number (needs stop.time or a stage duration)
    std::optional<double> history;                 ///< [s]; auto: 1/1000 of the run or 100 steps
    double checkpoint = 60.0;                      ///< wall time; 0: never [s]
    std::optional<std::int64_t> checkpoint_steps;  ///< or so many steps after the last one, whichever is first
    bool contacts = true;                          ///< write paraview/contacts.pvd
};

/// Where a key stands in the input file, for messages about it.
struct SourcePlace {
    std::string file;  ///< as the user typed it; "--set" for overrides
    int line = 0;      ///< 1-based; 0: not in the file
    std::string text;  ///< the value as written
};

/// Wanted elasticity and strength of a part, for `grainfrac calibrate`.
struct CalibrationSpec {
    std::string part;
    double young_modulus = 0.0;                    ///< [Pa]
    std::optional<double> poisson_ratio;           ///< [-]; auto: whatever comes of the shear ratio
    std::optional<double> tensile_strength;        ///< [Pa]; auto: strengths stay as they are
    std::optional<double> tolerance;               ///< [-]; auto: 0.005, random packings 0.02
    std::int64_t max_trials = 8;                   ///< of the elastic constants [-]
    std::string measure = "auto";                  ///< auto | core | section
    std::string direction = "auto";                ///< auto | x | y | z
    std::optional<double> width, length;           ///< of the sample [m]; auto: 12 spheres, 16 grains
    std::optional<double> area;                    ///< section [m^2]; auto: of the packing
    std::optional<double> start_normal_stiffness;  ///< [Pa/m]; auto: closed form
    std::optional<double> start_shear_ratio;       ///< [-]; auto: closed form
};

struct Case {
    SimulationSpec simulation;
    std::vector<MaterialSpec> materials;
    std::vector<PartSpec> parts;
    std::vector<BondSpec> bonds;
    std::vector<ContactSpec> contacts;
    std::vector<WallSpec> walls;
    std::vector<GripSpec> grips;
    std::vector<StageSpec> stages;
    std::vector<CalibrationSpec> calibration;
    TestSpec test;
    ControlSpec control;
    OutputSpec output;

    std::string file;                           ///< path of the input file as typed
    std::map<std::string, SourcePlace> places;  ///< "materials.sic.density", "parts[0].region.diameter" -> where
};

/// One or more things wrong with the input; each becomes one message block, the program ends with code 2.
struct InputProblem {
    std::string key;      ///< full path of the key, e.g. "parts[0].region.diameter"
    std::string message;  ///< what is wrong and what is allowed, e.g. "must be > 0 m"
};
struct InputError : std::runtime_error {
    explicit InputError(std::vector<InputProblem> p)
        : std::runtime_error(p.empty() ? "" : p.front().message), problems(std::move(p))
    {
    }
    InputError(std::string key, std::string message)
        : InputError(std::vector<InputProblem>{{std::move(key), std::move(message)}})
    {
    }
    std::vector<InputProblem> problems;
};

}  // namespace grainfrac
