// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace grainfrac {

namespace {

// Solids that one could mean: aerogels and osmium stay out, so do soft gels and what is harder than diamond.
constexpr double least_density = 100.0, most_density = 25000.0;  // [kg/m^3]
constexpr double least_modulus = 1e5, most_modulus = 2e12;       // [Pa]
constexpr double most_poisson_ratio = 0.45;                      // networks of springs are compressible
constexpr double most_friction = 2.0;                            // 63 degrees
// Strength over modulus: bonds between atoms break at 0.1 E (Orowan 1949); below 1e-6 a solid hardly bears its weight.
constexpr double most_strength = 0.1, least_strength = 1e-6;
// Twice the energy of a surface is 1 J/m^2 (glass 8, ceramics 10 to 100); 1e5 is that of tough steel.
constexpr double least_fracture_energy = 0.5, most_fracture_energy = 1e5;  // [J/m^2]
constexpr double least_weibull_modulus = 2.0;                              // below it the scatter is half of the mean
constexpr double most_bond_damping = 0.5;   // it makes the time step shorter by sqrt(1 + zeta^2) - zeta = 0.62
constexpr double least_restitution = 0.1;   // unloading is 1/e^2 = 100 times as stiff
constexpr double most_local_damping = 0.5;  // in a stage that loads
constexpr double most_gravity = 100.0;      // [m/s^2]
constexpr double most_safety = 0.9;         // damage and new contacts stiffen the model between two checks

class Warnings {
public:
    explicit Warnings(const Case& c) : c_(c) {}

    std::vector<InputProblem> all()
    {
        for (const MaterialSpec& m : c_.materials) material(m, "materials." + m.name);
        for (std::size_t i = 0; i < c_.bonds.size(); ++i) bond(c_.bonds[i], fmt::format("bonds[{}]", i));
        for (std::size_t i = 0; i < c_.contacts.size(); ++i) contact(c_.contacts[i], fmt::format("contacts[{}]", i));
        for (std::size_t i = 0; i < c_.stages.size(); ++i) {
            const StageSpec& s = c_.stages[i];
            const std::string path = fmt::format("stages[{}]", i);
            if (s.kind == "load" && s.local_damping) local_damping(*s.local_damping, path + ".local_damping");
            if (s.gravity) gravity(*s.gravity, path + ".gravity");
        }
        rigid_motion();
        if (c_.test.wall_friction) friction(*c_.test.wall_friction, "test.wall_friction");
        test();
        control();
        return std::move(found_);
    }

private:
    void warn(std::string key, std::string message) { found_.push_back({std::move(key), std::move(message)}); }

    void material(const MaterialSpec& m, const std::string& path)
    {
        if (m.density < least_density || m.density > most_density) {
            const bool grams = m.density * 1e3 >= least_density && m.density * 1e3 <= most_density;
            const std::string hint = grams ? fmt::format("; was \"{:.4g} g/cm^3\" meant?", m.density)
                                     : m.density > most_density
                                         ? "; a density raised for longer time steps raises inertia by as much"
                                         : "";
            warn(path + ".density", fmt::format("{:.4g} kg/m^3 is not that of a solid, {:.4g} to {:.4g} kg/m^3{}",
                                                m.density, least_density, most_density, hint));
        }
        const double E = m.young_modulus;
        if (E < least_modulus || E > most_modulus) {
            const auto fits = [&](double factor) { return E * factor >= 1e8 && E * factor <= most_modulus; };
            const std::string hint = E < least_modulus && fits(1e9)   ? fmt::format("; was \"{:.4g} GPa\" meant?", E)
                                     : E < least_modulus && fits(1e6) ? fmt::format("; was \"{:.4g} MPa\" meant?", E)
                                                                      : "";
            warn(path + ".young_modulus", fmt::format("{:.4g} Pa is not that of a solid, {:.4g} to {:.4g} Pa{}", E,
                                                      least_modulus, most_modulus, hint));
        }
        if (m.poisson_ratio < 0.0 || m.poisson_ratio > most_poisson_ratio) {
            warn(path + ".poisson_ratio",
                 fmt::format("{:.4g}: solids have 0 to 0.45, and no network of bonds reaches more than 1/3",
                             m.poisson_ratio));
        }
        const bool used =
            std::any_of(c_.parts.begin(), c_.parts.end(), [&](const PartSpec& p) { return p.material == m.name; });
        if (!used) warn(path, "no part is made of this material");
        if (!m.cleavage.planes.empty()) friction(m.cleavage.friction, path + ".cleavage.friction");
    }

    void friction(double mu, const std::string& key)
    {
        if (mu <= most_friction) return;
        const std::string hint = mu < 90.0 ? fmt::format("; it is a coefficient: {:.4g} deg would be {:.3g}", mu,
                                                         std::tan(mu * std::numbers::pi / 180.0))
                                           : "";
        warn(key, fmt::format("{:.4g} is far above that of solids, at most {:.4g}{}", mu, most_friction, hint));
    }

    /// Modulus of what a bond may join: the largest.
    double modulus_of(const BondSpec& b) const
    {
        double E = 0.0;
        for (const PartSpec& p : c_.parts) {
            for (const MaterialSpec& m : c_.materials) {
                const bool joined = std::any_of(b.between.begin(), b.between.end(), [&](const std::string& name) {
                    return name == "*" || name == p.name || name == p.material;
                });
                if (m.name == p.material && joined) E = std::max(E, m.young_modulus);
            }
        }
        return E;
    }

    void bond(const BondSpec& b, const std::string& path)
    {
        friction(b.friction, path + ".friction");
        if (b.damping > most_bond_damping) {
            warn(path + ".damping",
                 fmt::format("{:.4g} of critical damping makes the time step {:.3g} of what it is without", b.damping,
                             std::sqrt(1.0 + b.damping * b.damping) - b.damping));
        }
        if (b.failure == "unbreakable" || b.shear_stiffness > 0.0) return;
        const double E = modulus_of(b), s = b.tensile_strength, c = b.cohesion;
        if (E > 0.0 && s > 0.0 && (s > most_strength * E || s < least_strength * E)) {
            const bool small = s < least_strength * E;
            warn(path + ".tensile_strength",
                 fmt::format("{:.4g} Pa is {:.3g} of Young's modulus {:.4g} Pa; solids have {:.0e} to {:.1g}{}", s,
                             s / E, E, least_strength, most_strength,
                             small ? fmt::format("; was \"{:.4g} MPa\" meant?", s) : ""));
        }
        if (c > 0.0 && c < s) {
            warn(path + ".cohesion",
                 fmt::format("{:.4g} Pa is less than tensile_strength, {:.4g} Pa: bonds fail in shear "
                             "wherever they are not pulled squarely",
                             c, s));
        }
        if (b.law == "interface" && b.softening == "bilinear") energies(b, path);
        if (b.weibull_modulus && *b.weibull_modulus < least_weibull_modulus) {
            const double m = *b.weibull_modulus, mean = std::tgamma(1.0 + 1.0 / m);
            warn(path + ".weibull_modulus",
                 fmt::format("{:.3g} scatters strengths by {:.0f} % of their mean; ceramics have 5 to 20", m,
                             100.0 * std::sqrt(std::tgamma(1.0 + 2.0 / m) / (mean * mean) - 1.0)));
        }
    }

    void energies(const BondSpec& b, const std::string& path)
    {
        for (const auto& [key, G] : {std::pair(".fracture_energy_I", b.fracture_energy_I),
                                     std::pair(".fracture_energy_II", b.fracture_energy_II)}) {
            if (G < least_fracture_energy || G > most_fracture_energy)
                warn(path + key, fmt::format("{:.4g} J/m^2 is not that of a solid, {:.4g} to {:.4g} J/m^2", G,
                                             least_fracture_energy, most_fracture_energy));
        }
        if (b.fracture_energy_II < b.fracture_energy_I) {
            warn(path + ".fracture_energy_II",
                 fmt::format("{:.4g} J/m^2 is less than fracture_energy_I, {:.4g} J/m^2: shear "
                             "would cost less than opening",
                             b.fracture_energy_II, b.fracture_energy_I));
        }
    }

    void contact(const ContactSpec& s, const std::string& path)
    {
        friction(s.friction, path + ".friction");
        if (s.dissipation == "hysteretic" && s.restitution < least_restitution) {
            warn(path + ".restitution",
                 fmt::format(
                     "{:.3g} makes contacts {:.3g} times as stiff when they unload, and the time step {:.2g} times "
                     "as short; dissipation = \"viscous\" does not",
                     s.restitution, 1.0 / (s.restitution * s.restitution), 1.0 / s.restitution));
        }
    }

    void local_damping(double alpha, const std::string& key)
    {
        if (alpha > most_local_damping)
            warn(key,
                 fmt::format("{:.3g} brakes what moves under load by {:.3g} of the force on it; it is for settling",
                             alpha, alpha));
    }

    /// Stages that are not there to come to rest, in which something moves as a whole: the damping is for vibrations
    /// about rest, and brakes that too.
    void rigid_motion()
    {
        for (std::size_t i = 0; i < c_.stages.size(); ++i) {
            const StageSpec& s = c_.stages[i];
            const double alpha = s.local_damping.value_or(c_.control.local_damping);
            if (alpha == 0.0 || s.kind == "settle" || s.kind == "bond") continue;
            const std::string what = moving_rigidly(i);
            if (what.empty()) continue;
            warn(s.local_damping ? fmt::format("stages[{}].local_damping", i) : "control.local_damping",
                 fmt::format("in stage \"{}\" {}, and {:.3g} brakes that too, by {:.3g} of the force on it; use the "
                             "damping of the bonds",
                             s.name, what, alpha, alpha));
        }
    }

    static Vec3 velocity_in(const StageSpec& s, const std::string& wall, const Vec3& own)
    {
        for (const StageMotion& m : s.motions) {
            if (m.wall == wall) return m.velocity;
        }
        return own;
    }

    bool a_wall_is_driven(const StageSpec& s) const
    {
        return std::any_of(s.motions.begin(), s.motions.end(), [](const StageMotion& m) { return m.moves(); }) ||
               std::any_of(c_.walls.begin(), c_.walls.end(), [&](const WallSpec& w) {
                   return w.servo.given() || norm2(velocity_in(s, w.name, w.velocity)) > 0.0;
               });
    }

    /// What falls onto walls is at rest once a stage was there for it.
    bool falls(std::size_t stage) const
    {
        if (c_.test.kind != "custom" || !c_.grips.empty()) return false;
        if (c_.walls.empty()) return true;
        const StageSpec& s = c_.stages[stage];
        const bool rests = std::any_of(c_.stages.begin(), c_.stages.begin() + static_cast<std::ptrdiff_t>(stage),
                                       [](const StageSpec& b) { return b.kind == "settle" || b.kind == "compact"; });
        return s.kind == "load" && !rests && !a_wall_is_driven(s);
    }

    std::string moving_rigidly(std::size_t stage) const
    {
        const StageSpec& s = c_.stages[stage];
        for (const PartSpec& p : c_.parts) {
            if (stage == 0 && norm2(p.velocity) + norm2(p.angular_velocity) > 0.0)
                return fmt::format("\"{}\" moves by itself", p.name);
        }
        if (!s.release.empty()) return fmt::format("what \"{}\" held is free", s.release.back());
        const bool heavy = norm2(s.gravity.value_or(c_.control.gravity)) > 0.0;
        if (heavy && falls(stage)) return "all falls freely";
        std::vector<GripSpec> grips;  // that still hold
        for (const GripSpec& g : c_.grips) {
            const bool gone = std::any_of(
                c_.stages.begin(), c_.stages.begin() + static_cast<std::ptrdiff_t>(stage), [&](const StageSpec& b) {
                    return std::find(b.release.begin(), b.release.end(), g.name) != b.release.end();
                });
            if (!gone) grips.push_back(g);
        }
        for (const GripSpec& g : grips) {
            const Vec3 v = velocity_in(s, g.name, g.velocity);
            // of whatever part: what it holds may be bonded to this one
            const bool against = std::any_of(grips.begin(), grips.end(), [&](const GripSpec& other) {
                return norm2(velocity_in(s, other.name, other.velocity) - v) > 0.0;
            });
            if (norm2(v) > 0.0 && !against && (heavy || c_.walls.empty()))
                return fmt::format("\"{}\" draws \"{}\" along", g.name, g.part);
        }
        return {};
    }

    void gravity(const Vec3& g, const std::string& key)
    {
        if (norm(g) > most_gravity)
            warn(key, fmt::format("{:.4g} m/s^2 is {:.3g} times that of the earth", norm(g), norm(g) / 9.81));
    }

    void test()
    {
        const TestSpec& t = c_.test;
        const bool cleaves = std::any_of(c_.materials.begin(), c_.materials.end(),
                                         [](const MaterialSpec& m) { return !m.cleavage.planes.empty(); });
        const bool only_drop = t.stop.load_drop && !t.stop.strain && !t.stop.time && !t.stop.slip && !t.stop.damage;
        if (only_drop && !can_break() && !cleaves && t.kind != "custom" && t.kind != "pull_out")
            warn("test.stop", "nothing in the input can break, so that the load will not drop and the run not end");
        if (t.kind == "drop") drop();
    }

    void drop()
    {
        if (c_.control.local_damping > 0.0) {
            warn("control.local_damping", fmt::format("{:.3g} brakes the fall too: grains fall with {:.3g} g",
                                                      c_.control.local_damping, 1.0 - c_.control.local_damping));
        }
        const bool loses = std::any_of(c_.contacts.begin(), c_.contacts.end(), [](const ContactSpec& s) {
            return s.friction > 0.0 || (s.dissipation != "none" && s.restitution < 1.0);
        });
        const bool by_default = c_.contacts.empty();  // friction of its own
        if (c_.test.stop.rest && !c_.test.stop.time && !loses && !by_default && c_.control.local_damping == 0.0)
            warn("test.stop.rest", "no contact dissipates (friction 0, restitution 1): what falls never comes to rest");
    }

    bool can_break() const
    {
        return std::any_of(c_.bonds.begin(), c_.bonds.end(), [](const BondSpec& b) {
            return b.failure != "unbreakable" && (b.tensile_strength > 0.0 || b.yield_slip);
        });
    }

    void control()
    {
        const ControlSpec& s = c_.control;
        gravity(s.gravity, "control.gravity");
        if (c_.test.kind != "custom" && c_.test.kind != "drop") local_damping(s.local_damping, "control.local_damping");
        if (s.time_step_safety > most_safety && !s.time_step)
            warn("control.time_step_safety",
                 fmt::format("{:.4g} of the stability limit leaves no room for contacts that come; at most {:.4g}",
                             s.time_step_safety, most_safety));
    }

    const Case& c_;
    std::vector<InputProblem> found_;
};

}  // namespace

std::vector<InputProblem> implausible_input(const Case& c)
{
    return Warnings(c).all();
}

}  // namespace grainfrac
