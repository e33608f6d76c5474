// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/derived.h"
#include "experiment/plausibility.h"
#include "experiment/specimen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

// The guide of the theory page, 0.01 sigma_c/(rho c_0) a side, is on the safe side: the kinetic share goes with the
// square of the speed. Twice as fast the load still grows over 25 passages of a wave.
constexpr double most_over_guide = 2.0;
// A process zone wants three points (Turon et al. 2007, Eng. Fract. Mech. 74, 1665); a face has four along its side. At
// half of a grain bonds snap back, which is refused.
constexpr double least_zone = 0.75;
// Strength must be reached with this margin: nominal stress of an intact specimen, as stiff as its material, over
// sigma_c. Stress raisers and ragged ends are within it.
constexpr double least_reach = 0.5;
constexpr int least_grains = 10;    // of a specimen
constexpr double most_steps = 1e9;  // days for a hundred grains
constexpr double most_snapshots = 5e3, most_rows = 2e6;
constexpr double wasteful_step = 1e-2;                    // of the stability limit
constexpr double most_stiffness = 10.0;                   // implied over the material's modulus, either way
constexpr double most_contact_stiffness = 100.0;          // over E/h
constexpr double narrow_plane = 2.0 * last_finite_width;  // crack over width beyond which no formula holds

class Warnings {
public:
    Warnings(const Case& c, const Built& b, double dt, double critical)
        : c_(c), b_(b), test_(b.experiment), dt_(dt), critical_(critical)
    {
    }

    std::vector<InputProblem> all()
    {
        for (std::size_t k = 0; k < c_.parts.size(); ++k) part(static_cast<int>(k));
        for (std::size_t i = 0; i < c_.contacts.size(); ++i) contact(c_.contacts[i], fmt::format("contacts[{}]", i));
        for (const MaterialSpec& m : c_.materials) flaws(m);
        loading();
        if (test_.kind == "drop") impact();
        time();
        return std::move(found_);
    }

private:
    void warn(std::string key, std::string message) { found_.push_back({std::move(key), std::move(message)}); }

    const Material& material_of(int part) const
    {
        const std::int32_t m = b_.model.groups[static_cast<std::size_t>(part)].material;
        return b_.model.materials[static_cast<std::size_t>(m)];
    }

    void part(int k)
    {
        const PartSpec& spec = c_.parts[static_cast<std::size_t>(k)];
        const Material& m = material_of(k);
        int bodies = 0;
        for (int i = 0; i < b_.state.bodies.size(); ++i) bodies += b_.state.bodies.group[i] == k ? 1 : 0;
        const bool strength_test = test_.kind != "custom" && test_.kind != "drop" && test_.kind != "pull_out";
        if (strength_test && bodies < least_grains)
            warn(fmt::format("parts[{}]", k),
                 fmt::format("a specimen of {} grains: its strength is that of single faces; at least {}", bodies,
                             least_grains));

        for (int other = k + 1; other < static_cast<int>(c_.parts.size()); ++other)
            fracture(part_bonds(c_, b_, k, other), k);
        const PartBonds p = part_bonds(c_, b_, k, k);
        if (p.entry < 0) return;
        const std::string bond = fmt::format("bonds[{}]", p.entry);
        const BondSpec& b = c_.bonds[static_cast<std::size_t>(p.entry)];
        if (b.normal_stiffness && p.young_modulus) {
            const double ratio = *p.young_modulus / m.young_modulus;
            if (ratio > most_stiffness || ratio < 1.0 / most_stiffness) {
                warn(bond + ".normal_stiffness",
                     fmt::format("{:.4g} Pa/m over {:.4g} m make part \"{}\" of modulus {:.4g} Pa, {:.3g} times its "
                                 "material's; \"auto\" gives that",
                                 *b.normal_stiffness, p.spacing, spec.name, *p.young_modulus, ratio));
            }
        }
        fracture(p, k);
    }

    void fracture(const PartBonds& p, int part)
    {
        const Material& m = material_of(part);
        const auto scales = fracture_scales(c_, p, m.young_modulus);
        if (!scales || (p.number == 0 && c_.bonds[static_cast<std::size_t>(p.entry)].made_in.empty())) return;
        const std::string bond = fmt::format("bonds[{}]", p.entry);
        const BondSpec& b = c_.bonds[static_cast<std::size_t>(p.entry)];
        if (scales->process_zone < least_zone * p.spacing) {
            warn(bond + ".fracture_energy_I",
                 fmt::format(
                     "the process zone E G_I/sigma_c^2 = {:.3g} m (E {:.4g} Pa, G_I {:.4g} J/m^2, sigma_c {:.4g} Pa) "
                     "is {:.2g} of the distance of the centres, {:.3g} m: cracks run by strength, not by energy; "
                     "refine the grains to {:.3g} m, raise G_I or lower sigma_c",
                     scales->process_zone, m.young_modulus, b.fracture_energy_I, b.tensile_strength,
                     scales->process_zone / p.spacing, p.spacing, scales->process_zone / least_zone));
        }
        if (!b.made_in.empty() && scales->snap_back <= 1.0) {  // of bonds that are there it is an error
            warn(bond + ".fracture_energy_I",
                 fmt::format(
                     "{:.4g} J/m^2 is below sigma_c^2/(2 k_n) = {:.4g} J/m^2 (sigma_c {:.4g} Pa, k_n {:.4g} Pa/m): "
                     "stage \"{}\" will refuse to make bonds that snap back",
                     b.fracture_energy_I, b.fracture_energy_I / scales->snap_back, b.tensile_strength,
                     p.normal_stiffness, b.made_in));
        }
    }

    void contact(const ContactSpec& s, const std::string& path)
    {
        if (!s.normal_stiffness || !(b_.model.nominal_length > 0.0)) return;
        double stiffest = 0.0;
        for (const Material& m : b_.model.materials)
            stiffest = std::max(stiffest, m.young_modulus / b_.model.nominal_length);
        if (*s.normal_stiffness > most_contact_stiffness * stiffest) {
            warn(path + ".normal_stiffness",
                 fmt::format(
                     "{:.4g} Pa/m is {:.3g} times E/h = {:.4g} Pa/m: contacts set a time step {:.2g} times as short",
                     *s.normal_stiffness, *s.normal_stiffness / stiffest, stiffest,
                     std::sqrt(*s.normal_stiffness / stiffest)));
        }
    }

    void flaws(const MaterialSpec& m)
    {
        const CleavageSpec& s = m.cleavage;
        for (std::size_t k = 0; k < b_.cleavage.size(); ++k) {
            if (c_.parts[k].material != m.name || s.planes.empty()) continue;
            const double width = mean_width(static_cast<int>(k));
            const double crack = s.flaw == "edge" ? s.flaw_size : 2.0 * s.flaw_size;
            const double most = s.finite_width ? narrow_plane : most_flaw_share;
            if (crack <= most * width) continue;
            warn(fmt::format("materials.{}.cleavage.flaw_size", m.name),
                 fmt::format("the flaw is {:.3g} m long, {:.2g} of the width of a plane, {:.3g} m; {}", crack,
                             crack / width, width,
                             s.finite_width
                                 ? "no formula for its stress intensity holds there"
                                 : fmt::format("that of an infinite body holds to {:.2g}; set finite_width", most)));
        }
    }

    /// Of the balls in the grains of a part [m].
    double mean_width(int part) const
    {
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i < b_.state.bodies.size(); ++i) {
            if (b_.state.bodies.group[i] != part) continue;
            sum += 2.0 * inscribed_ball(b_.model.grain_shapes[static_cast<std::size_t>(i)]).radius;
            ++count;
        }
        return count > 0 ? sum / count : 0.0;
    }

    std::string key_of_speed() const
    {
        if (test_.kind != "custom") return "test.platen_speed";
        return fmt::format("stages[{}]", std::max(test_.reference_stage, 0));
    }

    void loading()
    {
        const double strength = weakest_strength(c_), speed = closing_speed(test_), guide = test_.quasi_static_speed;
        const double length = test_.specimen.length, E = loaded_material(b_.model).young_modulus;
        const bool by_walls = test_.quasi_static && !test_.pull_out && speed > 0.0 && length > 0.0;
        if (!by_walls || !(strength > 0.0)) return;
        const bool loads =
            test_.kind != "custom" || c_.stages[static_cast<std::size_t>(test_.reference_stage)].kind == "load";
        if (!loads) return;
        if (guide > 0.0 && 0.5 * speed > most_over_guide * guide) {
            warn(key_of_speed(),
                 fmt::format(
                     "each wall moves at {:.4g} m/s, {:.3g} times the guide for quasi-static tests, 0.01 "
                     "sigma_c/(rho c_0) = {:.4g} m/s (sigma_c {:.4g} Pa, rho c_0 {:.4g} Pa s/m): strength is reached "
                     "within {:.2g} passages of a wave",
                     0.5 * speed, 0.5 * speed / guide, guide, strength, 0.01 * strength / guide,
                     strength / E * test_.wave_speed / speed));
        }
        const bool intact = test_.kind != "dcb" && test_.kind != "notched_beam";  // a notch raises the stress
        if (intact) reach(strength, speed, length, E);
    }

    /// Whether the walls go far enough before the test ends.
    void reach(double strength, double speed, double length, double E)
    {
        const std::size_t at = test_.reference_stage >= 0 ? static_cast<std::size_t>(test_.reference_stage) : 0;
        const Stage& stage = test_.stages[at];
        double way = stage.displacement.value_or(INFINITY);
        if (stage.duration) way = std::min(way, speed * std::max(*stage.duration - 0.5 * stage.ramp, 0.0));
        const double stress = way / length * E;
        if (stress >= least_reach * strength) return;
        const std::string key = test_.kind == "custom" ? key_of_speed() : "test.stop";
        warn(key, fmt::format(
                      "walls close by {:.3g} m at most, a strain of {:.3g} over {:.3g} m: with E {:.4g} Pa a nominal "
                      "stress of {:.3g} Pa, and the weakest bonds bear {:.4g} Pa; nothing will break",
                      way, way / length, length, E, stress, strength));
    }

    /// Grains that hit the floor must not meet core to core.
    void impact()
    {
        const double v = fact(test_, "impact_speed_m_per_s");
        double mass = 0.0, radius = INFINITY, area = 0.0;
        const Bodies& bodies = b_.state.bodies;
        for (int i = 0; i < bodies.size(); ++i) {
            if (bodies.inverse_mass[i] == 0.0 || is_sphere(b_.model, bodies, i)) continue;
            mass = std::max(mass, bodies.mass[i]);
            radius = std::min(radius, b_.model.shapes.radius[bodies.shape[i]]);
            const auto material =
                static_cast<std::size_t>(b_.model.groups[static_cast<std::size_t>(bodies.group[i])].material);
            const double rho = b_.model.materials[material].density;
            area = std::max(area, std::cbrt(bodies.mass[i] / rho) * std::cbrt(bodies.mass[i] / rho));
        }
        double k = INFINITY;
        for (const LinearContact& law : b_.model.contact_laws.host()) {
            if (law.area_stiffness > 0.0) k = std::min(k, law.area_stiffness);
        }
        const double depth = v * std::sqrt(mass / (k * area));  // 1/2 m v^2 = 1/2 k A depth^2
        if (!(depth > radius)) return;
        warn("test.drop_height",
             fmt::format(
                 "a grain of {:.3g} kg hits the floor at {:.3g} m/s and sinks in by {:.3g} m, more than its rounding, "
                 "{:.3g} m (k_c {:.4g} Pa/m): raise contacts.normal_stiffness or dilation_radius",
                 mass, v, depth, radius, k));
    }

    void time()
    {
        if (c_.control.time_step && critical_ > 0.0) {
            if (dt_ > 0.9 * critical_)
                warn("control.time_step",
                     fmt::format("{:.4g} s is {:.3g} of the stability limit {:.4g} s; contacts that "
                                 "come shorten that",
                                 dt_, dt_ / critical_, critical_));
            if (dt_ < wasteful_step * critical_)
                warn("control.time_step",
                     fmt::format("{:.4g} s is {:.2g} of the stability limit {:.4g} s; left out it is "
                                 "chosen",
                                 dt_, dt_ / critical_, critical_));
        }
        const double expected = test_.expected_duration;
        const bool steps_in_time = !test_.pull_out || !test_.pull_out->quasi_static;
        if (!steps_in_time || !(expected > 0.0)) return;
        if (expected / dt_ > most_steps) {
            const bool by_speed = test_.kind != "custom" && test_.kind != "drop";
            warn(by_speed ? "test.platen_speed" : "test.stop",
                 fmt::format("about {:.2g} steps of {:.3g} s for {:.3g} s{}", expected / dt_, dt_, expected,
                             by_speed && test_.quasi_static_speed > 0.0
                                 ? fmt::format("; quasi-static up to {:.3g} m/s", 2.0 * test_.quasi_static_speed)
                                 : ""));
        }
        const auto count = [&](const char* key, const std::optional<double>& interval, double most, const char* what) {
            if (interval && expected / *interval > most)
                warn(key, fmt::format("every {:.3g} s of {:.3g} s are {:.2g} {}; more than {:.2g} fill the disk",
                                      *interval, expected, expected / *interval, what, most));
        };
        count("output.every", c_.output.every, most_snapshots, "snapshots");
        count("output.history", c_.output.history, most_rows, "rows");
    }

    const Case& c_;
    const Built& b_;
    const Experiment& test_;
    double dt_, critical_;
    std::vector<InputProblem> found_;
};

}  // namespace

std::vector<InputProblem> implausible_model(const Case& c, const Built& built, double dt, double critical)
{
    return Warnings(c, built, dt, critical).all();
}

}  // namespace grainfrac
