// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/gather.h"
#include "experiment/bending.h"
#include "experiment/brazilian.h"
#include "experiment/cleavage_rules.h"
#include "experiment/custom.h"
#include "experiment/dcb.h"
#include "experiment/drop.h"
#include "experiment/experiment.h"
#include "experiment/fibre_interface.h"
#include "experiment/grips.h"
#include "experiment/laws.h"
#include "experiment/pre_cut.h"
#include "experiment/precrack.h"
#include "experiment/pull_out.h"
#include "experiment/resources.h"
#include "experiment/specimen.h"
#include "experiment/sphere_bonds.h"
#include "experiment/start_overlap.h"
#include "experiment/uniaxial.h"
#include "experiment/walls.h"
#include "generate/microstructure.h"
#include "generate/packings.h"
#include "generate/spheres.h"
#include "model/validate.h"
#include "model/views.h"
#include "motion/servo.h"
#include "motion/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Skin of the neighbour list over the mean grain spacing: a few rebuilds a run, few pairs that never touch.
constexpr double default_skin = 0.1;

/// A beam of whole grains rests on its rollers edge on round: without friction it would slip off sideways. Friction
/// mu of the rollers takes up to mu w/a from the bending moment, 10 % here for w = a.
constexpr double default_roller_friction = 0.1;

/// Every test by the name that test.kind gives it.
struct KnownTest {
    const char* kind;
    Experiment (*set_up)(const Case& c, Model& model, State& state);
};
constexpr KnownTest known_tests[] = {{"brazilian", set_up_brazilian},
                                     {"uniaxial_compression", set_up_uniaxial},
                                     {"uniaxial_tension", set_up_uniaxial},
                                     {"three_point_bending", set_up_bending},
                                     {"four_point_bending", set_up_bending},
                                     {"notched_beam", set_up_bending},
                                     {"dcb", set_up_dcb},
                                     {"drop", set_up_drop},
                                     {"pull_out", set_up_pull_out},
                                     {"custom", set_up_custom}};

Experiment set_up_test(const Case& c, Model& model, State& state)
{
    for (const KnownTest& test : known_tests) {
        if (c.test.kind == test.kind) return test.set_up(c, model, state);
    }
    throw std::logic_error("test " + c.test.kind + " passed the input check");
}

/// The platens or rollers of a ready-made test have the friction of test.wall_friction, as an entry of [[contacts]] for
/// them would say; it comes first, so that any entry of the user for them is used instead.
Case with_wall_friction(Case c)
{
    const bool rolls = c.test.kind.ends_with("bending") || c.test.kind == "notched_beam";
    if (c.test.kind != "uniaxial_compression" && !rolls) return c;
    ContactSpec spec;
    for (const ContactSpec& s : c.contacts) {
        if (s.between[0] == "*" && s.between[1] == "*") spec = s;
    }
    spec.between = {"*", rolls ? "roller" : "platen"};
    spec.friction = c.test.wall_friction.value_or(rolls ? default_roller_friction : 0.0);
    c.contacts.insert(c.contacts.begin(), spec);
    return c;
}

/// Mean diameter of the inscribed balls of each group's grains, or of its spheres [m].
std::vector<double> grain_spacing(const Model& model, const std::vector<GrainSpec>& grains,
                                  const std::vector<SphereSpec>& spheres)
{
    std::vector<double> sum(model.groups.size(), 0.0);
    std::vector<int> count(model.groups.size(), 0);
    for (const GrainSpec& g : grains) {
        sum[static_cast<std::size_t>(g.group)] += 2.0 * inscribed_ball(g.shape).radius;
        ++count[static_cast<std::size_t>(g.group)];
    }
    for (const SphereSpec& s : spheres) {
        sum[static_cast<std::size_t>(s.group)] += 2.0 * s.radius;
        ++count[static_cast<std::size_t>(s.group)];
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = count[i] > 0 ? sum[i] / count[i] : 0.0;
    return sum;
}

void check_bonds_exist(const Case& c, const Model& model, const State& state, const BondTable& table)
{
    if (c.bonds.empty() || state.bond_slots() > 0) return;
    for (std::size_t a = 0; a < model.groups.size(); ++a) {
        if (table.rule_of(static_cast<int>(a), static_cast<int>(a)) != nullptr && state.bodies.size() > 1) {
            throw InputError("bonds[0].between",
                             "no two grains of these parts share a face, and no two spheres touch, so that no bond can "
                             "be made");
        }
    }
}

/// Arrays that grew one by one have room for as much again.
void trim(State& state)
{
    const auto each = [](auto& arrays) {
        arrays.for_each_array([](const char*, auto& array) { array.host().shrink_to_fit(); });
    };
    each(state.bodies);
    each(state.interfaces);
    each(state.points);
    each(state.corners);
    each(state.parallels);
    each(state.sphere_bonds);
}

}  // namespace

Built build(const Case& c, Device device)
{
    check_resources(c);
    Built built;
    Model& model = built.model;
    State& state = built.state;
    model.device = device;
    for (const MaterialSpec& m : c.materials)
        model.materials.push_back({m.name, m.density, m.young_modulus, m.poisson_ratio});
    const auto material_index = [&](const std::string& name) {
        return static_cast<std::int32_t>(std::find_if(model.materials.begin(), model.materials.end(),
                                                      [&](const Material& m) { return m.name == name; }) -
                                         model.materials.begin());
    };
    for (const PartSpec& p : c.parts) model.groups.push_back({p.name, material_index(p.material), false});

    std::vector<GrainSpec> grains = generate_grains(c);
    make_room_for_fibres(c, grains);
    const std::vector<SphereSpec> spheres = generate_spheres(c);
    std::vector<double> spacing = grain_spacing(model, grains, spheres);
    model.nominal_length = *std::max_element(spacing.begin(), spacing.end());
    const BondTable table(c, model);
    if (std::any_of(c.materials.begin(), c.materials.end(),
                    [](const MaterialSpec& m) { return !m.cleavage.planes.empty(); }))
        built.cleavage = make_cleavage_rules(c, spacing, model);
    const PreCut pre_cut(c, built.cleavage, grains);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        try {
            add_grain(model, state, grains[i]);
        } catch (const std::invalid_argument& e) {
            throw InputError(fmt::format("parts[{}]", grains[i].group), fmt::format("grain {}: {}", i, e.what()));
        }
    }
    const int first_sphere = state.bodies.size();
    for (const SphereSpec& s : spheres) add_sphere(model, state, s);
    const std::vector<Precrack> cracks = precracks(c, grains);
    const auto rule_of = [&](int a, int b) -> const BondRule* {
        const bool both_grains = a < first_sphere && b < first_sphere;
        for (const Precrack& crack : cracks) {
            if (both_grains &&
                crack.cuts(grains[static_cast<std::size_t>(a)].site, grains[static_cast<std::size_t>(b)].site))
                return nullptr;
        }
        if (const BondRule* rule = both_grains ? pre_cut.rule_of(a, b) : nullptr) return rule;
        return table.rule_of(state.bodies.group[a], state.bodies.group[b]);
    };
    bond_shared_faces(model, state, grains, c.simulation.seed, rule_of,
                      fibre_patches(c, model, state, spheres, first_sphere, table));
    pre_cut.finish(state);
    bond_spheres(c, model, state, spheres, first_sphere, table);
    finish_fibre_interfaces(c, model, state, table);
    check_bonds_exist(c, model, state, table);
    check_snap_back(model, state, table);

    model.gravity = c.control.gravity;
    for (std::size_t k = 0; k < c.walls.size(); ++k)
        add_wall(model, state, c.walls[k], fmt::format("walls[{}]", k), c.file);
    for (std::size_t k = 0; k < c.grips.size(); ++k) add_grip(model, state, c.grips[k], fmt::format("grips[{}]", k));
    built.experiment = set_up_test(c, model, state);
    spacing.resize(model.groups.size(), 0.0);
    make_contact_laws(with_wall_friction(c), spacing, model);
    part_fibres(c, model, state, table);

    model.skin = c.control.skin.value_or(default_skin * model.nominal_length);
    built.experiment.quasi_static_speed = quasi_static_speed(c, model);
    if (const std::string why = why_not_valid(model, state); !why.empty()) {
        if (why.find("not finite") != std::string::npos)
            throw InputError("parts", fmt::format("{}: density, sizes or speeds are beyond what a number holds", why));
        throw std::logic_error("built an impossible state: " + why);
    }
    check_nothing_overlaps(c, model, state);
    settle(model, state.sphere_bonds);
    trim(state);
    return built;
}

Measurement measure(const Experiment& e, const Model&, const State& state)
{
    Measurement m;
    const Specimen& s = e.specimen;
    if (s.loaded_wall < 0) return m;
    const Bodies& b = state.bodies;
    const auto wall = [&](std::int32_t w, Vec3& force, Vec3& shift) {
        bool first = true;
        for (int i = 0; i < b.size(); ++i) {
            if (b.wall[i] != w) continue;
            force += b.force[i];
            if (first) shift = b.position[i] - b.start_position[i];
            first = false;
        }
    };
    Vec3 force, shift, other_force, other_shift;
    wall(s.loaded_wall, force, shift);
    const double push = -dot(force, s.load_direction);
    m.load = push;
    m.displacement = dot(shift, s.load_direction);
    if (s.opposite_wall >= 0) {
        wall(s.opposite_wall, other_force, other_shift);
        const double other_push = dot(other_force, s.load_direction);
        m.displacement -= dot(other_shift, s.load_direction);
        m.load = 0.5 * (push + other_push);
        if (m.load != 0.0) m.platen_imbalance = std::fabs(push - other_push) / std::fabs(m.load);
    }
    if (e.pull_out && push != 0.0)
        m.platen_imbalance = std::fabs(1.0 - pull_out_state(*e.pull_out, state).support_stress * s.stress_area / push);
    m.displacement -= s.start_displacement;
    if (s.length > 0.0) m.strain = m.displacement / s.length;
    if (s.stress_area > 0.0) m.stress = m.load / s.stress_area;
    return m;
}

void begin_stage(const Stage& stage, Model& model, State& state)
{
    auto& motions = model.wall_motion.host();
    for (std::size_t w = 0; w < motions.size(); ++w) {
        const Vec3 wanted = w < stage.wall_velocity.size() ? stage.wall_velocity[w] : Vec3{};
        motions[w] = {motions[w].at(state.time), wanted, state.time, stage.ramp, {}, 0.0, 0.0, 0.0};
        if (w >= stage.servos.size() || norm2(stage.servos[w].direction) == 0.0) continue;
        const Servo& servo = stage.servos[w];
        const auto section = [&] { return section_across(specimen_extent(model, state).size(), servo.direction); };
        motions[w].push_direction = servo.direction;
        motions[w].push = servo.force ? *servo.force : servo.stress * (servo.area ? *servo.area : section());
        motions[w].from_push = wall_push(model, state, static_cast<int>(w), servo.direction);
        motions[w].max_speed = servo.max_speed;
    }
    model.local_damping = stage.local_damping;
    model.fracture_active = stage.fracture;
    for (const std::int32_t grip : stage.released) release_grip(model, state, grip);
    const bool falls_anew = stage.gravity && norm2(*stage.gravity - model.gravity) > 0.0;
    if (falls_anew) model.gravity = *stage.gravity;
    if (falls_anew || !stage.released.empty()) gather_forces(model, state);  // the next half kick works with it
}

void take_reference(Experiment& e, const Model& model, const State& state)
{
    const Vec3 size = specimen_extent(model, state).size();
    e.specimen.length = length_along(size, e.specimen.load_direction);
    e.specimen.stress_area = section_across(size, e.specimen.load_direction);
    e.specimen.start_displacement += measure(e, model, state).displacement;
}

double unbalanced_force_ratio(const State& state)
{
    double most = 0.0, sum = 0.0;
    int acting = 0;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.inverse_mass[i] > 0.0) most = std::max(most, norm(state.bodies.force[i]));
    }
    const SlotOf slots = slot_of(state, Device::cpu);
    for (int i = 0; i < state.interactions(); ++i) {
        const double f = slots(i) >= 0 ? norm(state.slots.force[slots(i)]) : 0.0;
        if (f > 0.0) {
            sum += f;
            ++acting;
        }
    }
    if (acting == 0 || sum == 0.0) return most > 0.0 ? 1.0 : 0.0;  // free fall is not rest
    return most * acting / sum;
}

}  // namespace grainfrac
