// SPDX-License-Identifier: GPL-3.0-or-later
// The shear-lag pull-out in particles: a chain for the fibre and one for the matrix, both free along the pull alone,
// and patches of interface between nodes side by side (docs/theory/pull_out.md 5). The patches have the interface law
// between the section means, stiffness 1/C and yield at C tau_0, so that every number of the closed form
// must come out, but for the spacing of the nodes, of second order.
#include "experiment/pull_out.h"
#include "experiment/pull_out_path.h"
#include "generate/fibre_surface.h"
#include "io/history_csv.h"
#include "support/known_curve.h"
#include "support/spheres.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double a = 1.0, b = 6.0, V = a * a / (b * b - a * a), E_f = 50e9, yield_slip = 1e-3, failure_slip = 3e-3;
constexpr double rest = 1e-5;          // by which a state at rest is off [-]
constexpr int held_but_z = 1 + 2 + 8;  // along x and y, and its turns

/// Constants of the closed form.
struct ShearLag {
    double E_m = 5e9, L = 30.0, K0 = 1e9;
    double residual_shear = 0.0;  // [Pa]
    bool stiff_sections = false;  // no shear of fibre and matrix: the patches are the interface itself

    double C_s() const
    {
        if (stiff_sections) return 0.0;
        const double c_m =
            a / (b * b - a * a) * (std::pow(b, 4) * std::log(b / a) / (b * b - a * a) - (3 * b * b - a * a) / 4);
        return 0.25 * a * 2.4 / E_f + c_m * 2.6 / E_m;  // G = E/(2 (1 + nu)), nu 0.2 and 0.3
    }
    double C() const { return 1.0 / K0 + C_s(); }
    double c() const { return 2.0 / a * (1.0 / E_f + V / E_m); }
    /// Decay along the fibre [1/m].
    double q() const { return std::sqrt(c() / C()); }
    /// Error of nodes at this distance: of the difference quotient at an end, to second order, and of the rest [-].
    double error(double h) const { return q() * q() * h * h / 8.0 + rest; }
    double gamma() const { return V * E_f / (E_m + V * E_f); }
    /// tau over the end stress at z from the embedded end.
    double shear(double z) const
    {
        const double g = gamma();
        return 0.5 * a * q() * (g * std::cosh(q() * (L - z)) + (1.0 - g) * std::cosh(q() * z)) / std::sinh(q() * L);
    }
    /// Stress of the fibre over the end stress.
    double stress(double z) const
    {
        const double g = gamma();
        return g + ((1.0 - g) * std::sinh(q() * z) - g * std::sinh(q() * (L - z))) / std::sinh(q() * L);
    }
};

/// n pieces; nodes from the embedded end to the exit. Fibre: bodies 0 to n, matrix: n + 1 to 2n + 1.
struct Chains {
    Assembly s;
    PullOut p;
    int n;
    double h, C_s;

    Chains(const ShearLag& k, int pieces)
        : s(sphere_assembly(unbreakable_bond(false))), n(pieces), h(k.L / n), C_s(k.C_s())
    {
        s.model.groups = {{"fibre", 0, false}, {"matrix", 0, false}};
        s.model.contact_law_of.assign(4, 0);
        const double section_f = std::numbers::pi * a * a, section_m = std::numbers::pi * (b * b - a * a);
        for (const int group : {0, 1}) {
            const double section = group == 0 ? section_f : section_m, E = group == 0 ? E_f : k.E_m;
            for (int i = 0; i <= n; ++i) {
                const int body = sphere(s, {group * a, 0.0, i * h}, 0.4 * h);
                s.state.bodies.group.at(body) = group;
                s.state.bodies.held.at(body) = held_but_z;
                if (i > 0) join(s, body - 1, body, {E * section / h, 0.0, 0.0, 0.0});
            }
        }
        bond_chains(k);
        set_up(k);
    }

    void bond_chains(const ShearLag& k)
    {
        std::vector<SharedFace> faces;
        for (int i = 0; i <= n; ++i) {
            const double length = i == 0 || i == n ? 0.5 * h : h;
            faces.push_back(
                fibre_patch(i, n + 1 + i, {a, 0.0, i * h}, {1, 0, 0}, {0, 0, 1}, length, 2.0 * std::numbers::pi * a));
        }
        InterfaceLaw law{};
        law.tensile_strength = 1e300;
        law.cohesion = k.K0 * yield_slip;
        law.fracture_energy_I = law.fracture_energy_II = 0.5 * law.cohesion * failure_slip;
        law.mixed_mode_exponent = 2.0;
        law.residual_shear = k.residual_shear;
        law.softening = Softening::bilinear;
        law.failure = FailureUnit::point;
        s.model.interface_laws.host() = {law};
        BondRule rule;
        rule.kind = BondRule::Kind::fibre;
        rule.quadrature = QuadratureRule::centroid;
        rule.shear_stiffness = 1.0 / k.C();
        bond_faces(
            s.model, s.state, faces, [&](const SharedFace&) { return a; }, 1, [&](int, int) { return &rule; });
        InterfaceBonds& f = s.state.interfaces;
        for (int i = 0; i < f.size(); ++i) f.slip_limit.at(i) = f.opening_limit.at(i) = 1e300;
    }

    void set_up(const ShearLag& k)
    {
        p.fibre_group = 0;
        p.matrix_group = 1;
        p.grip_wall = 0;
        p.support_wall = 1;
        s.model.walls = {"grip", "support"};
        s.model.wall_motion.host().assign(2, {});
        p.direction = {0, 0, 1};
        p.length = k.L;
        p.piece = h;
        p.section = std::numbers::pi * a * a;
        p.young_modulus = E_f;
        const auto bodies = static_cast<std::size_t>(s.state.bodies.size());
        p.place.assign(bodies, -1.0);
        p.along.assign(bodies, p.direction);
        p.at_end.assign(bodies, 0);
        for (int i = 0; i <= n; ++i) p.place[static_cast<std::size_t>(i)] = i * h;
        p.at_end[0] = first_in_matrix;
        p.at_end[static_cast<std::size_t>(n)] = last_in_matrix;
        hold(n, p.grip_wall);
        hold(n + 1, p.support_wall);
        start(s.model, s.state);
    }
    void hold(int body, int wall)
    {
        s.state.bodies.wall.at(body) = wall;
        s.state.bodies.held.at(body) = held_but_z | 4;
    }

    double pull(int link) const { return -s.state.slots.force[s.state.first_sphere_slot() + link].z; }
    PullOutState now() const { return pull_out_state(p, s.state); }
    /// The patches slip by the difference of the section means; the interface by C_s tau less.
    double exit_slip() const { return now().exit_slip - C_s * fibre_profile(p, s.state).shear.back(); }
};

struct Elastic {
    double shear = 0.0, stress = 0.0;  ///< largest error over the largest value [-]
};

/// The grip moved a little, against the closed form at the same end stress.
Elastic elastic_error(const ShearLag& k, int pieces)
{
    Chains c(k, pieces);
    PathSettings settings;
    settings.shift = 1e-3;
    settings.relax.tolerance = 1e-6;
    PullOutPath path(c.p, settings, c.s.model, c.s.state);
    REQUIRE(path.next(c.s.model, c.s.state, {}) == PullOutPath::Found::equilibrium);
    const FibreProfile f = fibre_profile(c.p, c.s.state);
    const double load = c.now().end_stress, most = std::max(k.shear(0.0), k.shear(k.L));
    REQUIRE(f.position.size() == static_cast<std::size_t>(pieces + 1));
    Elastic e;
    for (std::size_t i = 0; i < f.position.size(); ++i) {
        e.shear = std::max(e.shear, std::fabs(f.shear[i] / load - k.shear(f.position[i])) / most);
        if (i == 0) continue;
        const double between = 0.5 * (f.position[i - 1] + f.position[i]);  // the bond's, not the mean of two
        e.stress =
            std::max(e.stress, std::fabs(c.pull(static_cast<int>(i) - 1) / c.p.section / load - k.stress(between)));
    }
    // first yield: the point of the path where the first patch reaches its strength
    CHECK(load == Approx(k.K0 * yield_slip / most).epsilon(1.1 * k.error(c.h)));
    return e;
}

}  // namespace

TEST_CASE("coupled chains: elastic shear and stress of the closed form", "[pull_out]")
{
    CHECK(ShearLag{}.shear(0.0) / ShearLag{}.shear(30.0) == Approx(0.294172).epsilon(2e-6));  // known beforehand
    CHECK(1e6 / ShearLag{}.shear(30.0) == Approx(14.30568e6).epsilon(1e-6));
    for (const ShearLag& k :
         {ShearLag{}, ShearLag{500e9}, ShearLag{0.5e9}, ShearLag{5e9, 10.0}, ShearLag{5e9, 30.0, 1e7}}) {
        CAPTURE(k.E_m, k.L, k.K0);
        const int pieces = static_cast<int>(k.L / 0.25);
        const Elastic fine = elastic_error(k, pieces);
        CHECK(fine.shear < 1.05 * k.error(0.25));  // 2.5e-4 in the base case
        CHECK(fine.stress < 1.05 * k.error(0.25));
    }
    const Elastic coarse = elastic_error({}, 30), fine = elastic_error({}, 60);
    CHECK(std::log2(coarse.shear / fine.shear) == Approx(2.0).margin(0.1));
}

TEST_CASE("coupled chains: the debonding path of the closed form", "[pull_out]")
{
    const ShearLag k;
    Chains c(k, 60);
    PathSettings settings;
    settings.shift = 1e-4;
    settings.damage_step = 0.02;
    settings.relax.tolerance = 1e-7;
    PullOutPath path(c.p, settings, c.s.model, c.s.state);
    double peak = 0.0, slip = 0.0, displacement = 0.0, work = 0.0;
    PullOutState before;
    int states = 0;
    while (path.next(c.s.model, c.s.state, {}) == PullOutPath::Found::equilibrium) {
        const PullOutState now = c.now();
        peak = std::max(peak, now.end_stress);
        slip = std::max(slip, c.exit_slip());
        displacement = std::max(displacement, now.end_displacement);
        work += 0.5 * (now.end_stress + before.end_stress) * (now.end_displacement - before.end_displacement);
        before = now;
        ++states;
    }
    INFO(states << " states, to " << before.end_stress << " Pa at " << before.exit_slip << " m");
    CHECK(peak == Approx(19.5614e6).epsilon(1e-3));
    CHECK(slip == Approx(8.9886e-3).epsilon(2e-3));
    CHECK(displacement == Approx(9.4879e-3).epsilon(2e-3));
    CHECK(work == Approx(90000.0).epsilon(1e-3));
    CHECK(energy_ledger(c.s.model, c.s.state).fracture ==
          Approx(1500.0 * 2.0 * std::numbers::pi * a * k.L).epsilon(1e-6));
}

TEST_CASE("coupled chains: the debonding path with friction, back where the free part slips backwards", "[pull_out]")
{
    // The same problem by the arc-length method, 1200 elements (tests/data/fibre/README.md). The events are off by
    // their first order where the free part slips back: 0.39 % of the range of the stress in the mean with 0.02, 0.21 %
    // with 0.01, 0.17 % with 0.005, where the 60 pieces show.
    ShearLag k;
    k.residual_shear = 0.1e6;
    k.stiff_sections = true;
    Chains c(k, 60);
    PathSettings settings;
    settings.shift = 1e-4;
    settings.damage_step = 0.02;
    settings.relax.tolerance = 1e-7;
    PullOutPath path(c.p, settings, c.s.model, c.s.state);
    std::vector<double> damage, stress, displacement, slip;
    double work = 0.0;  // of the states, not of the ways between them
    PullOutState before;
    Ledger e;
    while (path.next(c.s.model, c.s.state, {}) == PullOutPath::Found::equilibrium) {
        const PullOutState now = c.now();
        e = energy_ledger(c.s.model, c.s.state);
        damage.push_back(now.mean_damage);
        stress.push_back(now.end_stress);
        displacement.push_back(now.end_displacement);
        slip.push_back(now.exit_slip);
        work += 0.5 * (now.end_stress + before.end_stress) * (now.end_displacement - before.end_displacement);
        before = now;
    }
    const HistoryTable known =
        read_history_csv(std::string(GF_SOURCE_DIR) + "/tests/data/fibre/chains_path_friction.csv");
    const auto off = [&](const char* name, const std::vector<double>& found) {
        const OffCurve o = off_curve(known.column("mean_damage"), known.column(name), damage, found);
        INFO(name << ": mean " << o.mean << ", worst " << o.worst);
        CHECK(o.points > 50);
        CHECK(o.mean < 0.005);
        CHECK(o.worst < 0.012);
    };
    off("end_stress_Pa", stress);
    off("end_displacement_m", displacement);
    off("end_slip_m", slip);
    CHECK(damage.back() > 0.998);
    CHECK(stress.back() < -0.5e6);
    CHECK(e.relative_error() < 1e-5);
    // 0.6 % low with events of 0.02, 0.23 % with 0.01, 0.07 % with 0.005
    CHECK(work * c.p.section == Approx(e.fracture + e.friction + e.elastic_bonds).epsilon(0.008));
}
