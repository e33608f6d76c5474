// SPDX-License-Identifier: GPL-3.0-or-later
// A string of spheres drawn over a fixed cylinder: the tensions on its two sides are as 1 to e^(mu theta) (Euler).
#include "experiment/walls.h"
#include "support/spheres.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double drum = 10.0, radius = 0.25, strand = 5.0;  // [m]; what hangs down straight on either side
constexpr double stiffness = 1.0, tension = 2e-4;           // [N/m], [N]: a strain of 4e-4
constexpr double drawn = 5e-6;                              // wave speed 0.5 m/s: inertia is 1e-5 of K h [m/s]

/// Over half the drum, its axis y; both ends are pins that keep their speed.
struct String {
    Assembly s;
    int n = 0;

    explicit String(double turn) : s(sphere_assembly(unbreakable_bond(false, 0.5)))
    {
        const double reach = drum + radius, arc = turn * reach;
        const int links = static_cast<int>(std::lround((arc + 2.0 * strand) / (2.0 * radius)));
        const double h = (arc + 2.0 * strand) / links;
        n = links + 1;
        for (int i = 0; i < n; ++i) {
            const double way = i * h - strand - 0.5 * arc, over = std::clamp(way, -0.5 * arc, 0.5 * arc),
                         phi = over / reach;
            const Vec3 along{std::cos(phi), 0.0, -std::sin(phi)};
            sphere(s, reach * Vec3{std::sin(phi), 0.0, std::cos(phi)} + (way - over) * along, radius);
            set_mass(s, i, 1.0, radius);
            s.state.bodies.held.at(i) = 2 + 8;  // in the plane of the turn, and does not roll
        }
        for (int i = 0; i + 1 < n; ++i) join(s, i, i + 1, {stiffness, 0.0, 0.0, 0.0});
        add_wall(s.model, "drum");
        s.model.contact_law_of.assign(4, 0);
        add_cylinder(s.model, s.state, 0, {0, 1, 0}, 4.0, {}, drum);
        s.model.contact_laws.host() = {
            LinearContact{stiffness / (std::numbers::pi * radius * radius), 1.0, 0.0, 1.0, 0.5}};
    }
    Vec3 direction(int link) const
    {
        return normalized(s.state.bodies.position[link + 1] - s.state.bodies.position[link]);
    }
    double pull(int link) const
    {
        return -dot(s.state.slots.force[s.state.first_sphere_slot() + link], direction(link));
    }
    /// Both ends go on along their strands: what the first gives, the last takes.
    void drive_ends(double give, double take)
    {
        drive(s.state, 0, give * direction(0));
        drive(s.state, n - 1, take * direction(n - 2));
    }
    void run(double way, double speed, double dt)
    {
        for (double gone = 0.0; gone < way; gone += speed * dt) step(s.model, s.state, dt);
    }
};

}  // namespace

TEST_CASE("a string drawn over a cylinder: tensions as e^(mu theta)")
{
    for (const auto& [mu, turn] : {std::pair(0.3, std::numbers::pi), std::pair(0.5, 0.5 * std::numbers::pi)}) {
        String string(turn);
        string.drive_ends(0.0, 0.0);
        start(string.s.model, string.s.state);
        const double dt = 0.5 * time_step_bound(string.s.model, string.s.state).with_damping;
        // stretched without friction from both ends
        const double stretch = 0.5 * (string.n - 1) * tension / stiffness;
        string.drive_ends(-drawn, drawn);
        string.run(stretch, drawn, dt);
        string.s.model.contact_laws.host()[0].friction = mu;
        string.drive_ends(drawn, drawn);
        string.run(2.0 * stretch, drawn, dt);
        double slack = 0.0, tight = 0.0, theta = 0.0;
        constexpr int samples = 2000;
        for (int k = 0; k < samples; ++k) {
            step(string.s.model, string.s.state, dt);
            slack += string.pull(0) / samples;
            tight += string.pull(string.n - 2) / samples;
            theta += std::acos(dot(string.direction(1), string.direction(string.n - 3))) / samples;
        }
        INFO("mu " << mu << ", theta " << theta << ", tensions " << slack << ", " << tight << ", ratio "
                   << tight / slack << " of " << std::exp(mu * theta));
        CHECK(theta == Approx(turn).epsilon(1e-3));
        CHECK(tight / slack == Approx(std::exp(mu * theta)).epsilon(2e-3));
        CHECK(energy_ledger(string.s.model, string.s.state).relative_error() < 1e-6);
    }
}
