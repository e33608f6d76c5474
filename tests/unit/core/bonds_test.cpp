// SPDX-License-Identifier: GPL-3.0-or-later
// Two bonded grains: stiffness in six modes, breaking loads, frame indifference, balance of momenta.
#include "motion/energy.h"
#include "motion/integrate.h"
#include "support/assembly.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double b = 1.0, d = 0.7;  // section in y and z
constexpr double k_n = 5000, k_s = 2000;

/// Two blocks of unit length along x, joined at x = 0.
Assembly pair_of_blocks(const InterfaceLaw& law, QuadratureRule rule = QuadratureRule::automatic, double density = 1.0)
{
    Assembly a = assemble(
        {grain(make_box({1, b, d}, {-0.5, 0, 0}), {-0.5, 0, 0}), grain(make_box({1, b, d}, {0.5, 0, 0}), {0.5, 0, 0})},
        density);
    bond(a, law, 0.0, k_n, k_s / k_n, rule);
    REQUIRE(a.state.interfaces.size() == 1);
    return a;
}

/// Move block 1 by a rigid motion about the face centre (the origin).
void move_about_face(Assembly& a, const Vec3& u, const Vec3& turn_vector)
{
    const Quat q = norm(turn_vector) > 0 ? from_axis_angle(normalized(turn_vector), norm(turn_vector)) : Quat{};
    set_position(a.state, 1, rotate(q, {0.5, 0, 0}) + u);
    a.state.bodies.orientation.host()[1] = q;
}

/// Resultant of the interface on block 1 about the face centre.
struct Resultant {
    Vec3 force, moment;
};
Resultant on_second(Assembly& a)
{
    evaluate_bonds(a);
    const Vec3 f = a.state.bodies.force[1];
    return {f, a.state.bodies.torque[1] + cross(a.state.bodies.position[1], f)};
}

InterfaceLaw brittle(double sigma_c, double c)
{
    InterfaceLaw l = elastic_law();
    l.tensile_strength = sigma_c;
    l.cohesion = c;
    l.failure = FailureUnit::face;
    l.softening = Softening::brittle;
    return l;
}

/// Load factor along the motion (u, turn) x factor at which the pair breaks, by bisection on fresh pairs.
double breaking_factor(const InterfaceLaw& law, const Vec3& u, const Vec3& turn_vector)
{
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double mid = 0.5 * (low + high);
        Assembly a = pair_of_blocks(law);
        move_about_face(a, mid * u, mid * turn_vector);
        evaluate_bonds(a);
        (a.state.interfaces.damage[0] > 0 ? high : low) = mid;
    }
    return high;
}

}  // namespace

TEST_CASE("two-grain stiffness in six modes")
{
    // Finite motions, for which the mean frame gives closed forms without round-off: axial and shear are linear;
    // turning by t about an axis through the face centre opens a point at distance y by 2 sin(t/2) y, on an arm y
    // cos(t/2).
    const double A = b * d, I_y = b * d * d * d / 12, I_z = d * b * b * b / 12, t = 0.2;
    for (const QuadratureRule rule : {QuadratureRule::automatic, QuadratureRule::cross, QuadratureRule::fan3,
                                      QuadratureRule::fan7, QuadratureRule::lobatto4}) {
        Assembly a = pair_of_blocks(elastic_law(), rule);
        move_about_face(a, {0.25, 0, 0}, {});
        CHECK(relative(-on_second(a).force.x, k_n * A * 0.25) < 1e-12);
        move_about_face(a, {0, 0.25, 0}, {});
        CHECK(relative(-on_second(a).force.y, k_s * A * 0.25) < 1e-12);
        move_about_face(a, {0, 0, 0.25}, {});
        CHECK(relative(-on_second(a).force.z, k_s * A * 0.25) < 1e-12);
        move_about_face(a, {}, {t, 0, 0});
        CHECK(relative(-on_second(a).moment.x, k_s * (I_y + I_z) * std::sin(t)) < 1e-12);
        move_about_face(a, {}, {0, t, 0});
        CHECK(relative(-on_second(a).moment.y, k_n * I_y * std::sin(t)) < 1e-12);
        move_about_face(a, {}, {0, 0, t});
        CHECK(relative(-on_second(a).moment.z, k_n * I_z * std::sin(t)) < 1e-12);
    }
}

TEST_CASE("breaking loads of a brittle face: tension, shear, bending, torsion, combined")
{
    const double sigma_c = 20, c = 10;
    const InterfaceLaw law = brittle(sigma_c, c);
    const double A = b * d;
    const double corner = std::hypot(0.5 * b, 0.5 * d);
    const double e = 1e-2;
    CHECK(relative(k_n * A * e * breaking_factor(law, {e, 0, 0}, {}), sigma_c * A) < 1e-6);
    CHECK(relative(k_s * A * e * breaking_factor(law, {0, e, 0}, {}), c * A) < 1e-6);
    // bending about z: the edge at y = b/2 opens by 2 sin(t/2) b/2 in the mean frame
    const double tb = e * breaking_factor(law, {}, {0, 0, e * 10}) * 10;
    CHECK(relative(k_n * 2 * std::sin(0.5 * tb) * 0.5 * b, sigma_c) < 1e-6);
    const double tt = e * breaking_factor(law, {}, {e * 10, 0, 0}) * 10;
    CHECK(relative(k_s * 2 * std::sin(0.5 * tt) * corner, c) < 1e-6);
    // half the tension and bending to half the strength break together
    const double half = sigma_c / (2 * k_n);
    const double both = breaking_factor(law, {2 * half, 0, 0}, {0, 0, 2 * half / (0.5 * b)});
    const double turned = both * 2 * half / (0.5 * b);
    CHECK(relative(k_n * (both * 2 * half * std::cos(0.5 * turned) + 2 * std::sin(0.5 * turned) * 0.5 * b), sigma_c) <
          1e-6);
    CHECK(both == Approx(0.5).epsilon(1e-5));  // but for the sine
}

TEST_CASE("point-brittle tension and shear break at sigma_c A and c A")
{
    InterfaceLaw law = brittle(20, 10);
    law.failure = FailureUnit::point;
    CHECK(relative(k_n * 1e-2 * breaking_factor(law, {1e-2, 0, 0}, {}), 20) < 1e-6);
    CHECK(relative(k_s * 1e-2 * breaking_factor(law, {0, 1e-2, 0}, {}), 10) < 1e-6);
}

TEST_CASE("cohesive face: peak loads, and bending between elastic limit and rigid-plastic bound")
{
    InterfaceLaw law = elastic_law();
    law.failure = FailureUnit::point;
    law.softening = Softening::bilinear;
    law.tensile_strength = 20;
    law.cohesion = 10;
    const double G_least = 20.0 * 20.0 / (2 * k_n);
    law.fracture_energy_I = 10 * G_least;
    law.fracture_energy_II = 2.0;
    const auto peak_force = [&](const Vec3& u) {
        Assembly a = pair_of_blocks(law);
        double most = 0;
        for (int i = 1; i <= 40000; ++i) {
            move_about_face(a, (0.02 * i / 40000) * u, {});
            most = std::max(most, norm(on_second(a).force));
        }
        return most;
    };
    CHECK(relative(peak_force({1, 0, 0}), 20 * b * d) < 1.3e-4);  // the onset falls between two increments
    CHECK(relative(peak_force({0, 1, 0}), 10 * b * d) < 1.3e-4);

    // pure bending: the axial shift that leaves no axial force is found anew at every increment
    const auto peak_moment = [&](double until, QuadratureRule rule) {
        Assembly a = pair_of_blocks(law, rule);
        double most = 0, shift_now = 0;
        for (int i = 1; i <= 1500; ++i) {
            const double t = until * i / 1500;
            const PointHistories before = a.state.histories;
            const Buffer<std::int32_t> history = a.state.interfaces.history;
            const auto axial = [&](double shift_by) {
                a.state.histories = before;
                a.state.interfaces.history = history;
                move_about_face(a, {shift_by, 0, 0}, {0, 0, t});
                return on_second(a).force.x;
            };
            // from the last shift outwards: points must not break in a trial far from equilibrium
            double low = shift_now, high = shift_now;
            for (double reach = 1e-7 * t; axial(low) < 0; reach *= 2) low -= reach;
            for (double reach = 1e-7 * t; axial(high) > 0; reach *= 2) high += reach;
            for (int k = 0; k < 40; ++k) {
                shift_now = 0.5 * (low + high);
                (axial(shift_now) > 0 ? low : high) = shift_now;
            }
            most = std::max(most, norm(on_second(a).moment));
        }
        return most;
    };
    const double elastic = 20 * d * b * b / 6, plastic = 20 * d * b * b / 2;
    const double tough = peak_moment(0.15, QuadratureRule::gauss8);
    CHECK(tough > 1.2 * elastic);
    CHECK(tough < plastic);
    law.fracture_energy_I = 1.001 * G_least;  // all but brittle: each point is lost at its onset
    CHECK(peak_moment(0.03, QuadratureRule::gauss4) / elastic == Approx(1.16).margin(0.01));
    CHECK(peak_moment(0.03, QuadratureRule::gauss8) / elastic == Approx(1.04).margin(0.01));
}

TEST_CASE("a rigid motion of the pair changes nothing but turns the forces")
{
    int draw = 0;
    for (int trial = 0; trial < 20; ++trial) {
        Assembly a = pair_of_blocks(elastic_law());
        move_about_face(a, 1e-2 * random_vector(draw), 1e-2 * random_vector(draw));
        const Resultant before = on_second(a);
        const double U = a.state.interfaces.stored_energy[0];
        const Vec3 axis = normalized(random_vector(draw)), shift_by = 5.0 * random_vector(draw);
        const Quat q = from_axis_angle(axis, 3.0 * random_vector(draw).x);
        for (int i = 0; i < 2; ++i) {
            set_position(a.state, i, rotate(q, a.state.bodies.position[i]) + shift_by);
            turn(a.state, i, q);
        }
        evaluate_bonds(a);
        CHECK(norm(a.state.bodies.force[1] - rotate(q, before.force)) < 1e-12 * norm(before.force));
        CHECK(relative(a.state.interfaces.stored_energy[0], U) < 1e-12);
        // both balances hold exactly
        const Vec3 F = a.state.bodies.force[0] + a.state.bodies.force[1];
        Vec3 T = a.state.bodies.torque[0] + a.state.bodies.torque[1];
        for (int i = 0; i < 2; ++i) T += cross(a.state.bodies.position[i], a.state.bodies.force[i]);
        CHECK(norm(F) < 1e-14 * norm(before.force));
        CHECK(norm(T) < 2e-14 * norm(before.force) * 10.0);
    }
}

TEST_CASE("spinning and vibrating cubes: energy fluctuation falls by four, no drift, momentum to round-off")
{
    const auto run = [](double dt, double time, double& fluctuation, double& drift_of_mean, double& momentum_error) {
        Assembly a = assemble({grain(make_box({1, 1, 1}, {-0.5, 0, 0}), {-0.5, 0, 0}),
                               grain(make_box({1, 1, 1}, {0.5, 0, 0}), {0.5, 0, 0})});
        bond(a, elastic_law(), 0.0, 100.0, 0.4, QuadratureRule::gauss3);
        a.model.skin = 0.5;
        const auto spin = [&](int i, const Vec3& w, const Vec3& v) {
            const Vec3 I = a.state.bodies.inertia[i];
            a.state.bodies.angular_momentum.host()[static_cast<std::size_t>(i)] = {I.x * w.x, I.y * w.y, I.z * w.z};
            a.state.bodies.velocity.host()[static_cast<std::size_t>(i)] = v;
        };
        spin(0, {0.1, 0.2, 0.31}, {0.01, -0.15, 0.1});
        spin(1, {0.12, 0.2, 0.29}, {0.0, 0.15, -0.1});
        start(a.model, a.state);
        const double E0 = a.state.initial_energy;
        const Momentum p0 = total_momentum(a.model, a.state);
        double low = 1e300, high = -1e300, mean[2] = {0, 0};
        const int n = static_cast<int>(std::lround(time / dt));
        for (int i = 0; i < n; ++i) {
            step(a.model, a.state, dt);
            const Ledger l = energy_ledger(a.model, a.state);
            const double E = l.kinetic + l.elastic_bonds;
            low = std::min(low, E);
            high = std::max(high, E);
            mean[i < n / 2 ? 0 : 1] += E / (0.5 * n);
            CHECK(l.relative_error() < 1e-3);
        }
        const Momentum p1 = total_momentum(a.model, a.state);
        fluctuation = (high - low) / E0;
        drift_of_mean = std::fabs(mean[1] - mean[0]) / E0;
        momentum_error = norm(p1.angular - p0.angular) / norm(p0.angular);
    };
    double f[3], drift_of_mean, p;
    run(0.02, 60, f[0], drift_of_mean, p);
    CHECK(drift_of_mean < 1e-4);
    CHECK(p < 1e-12);
    run(0.01, 60, f[1], drift_of_mean, p);
    run(0.005, 60, f[2], drift_of_mean, p);
    CHECK(drift_of_mean < 1e-5);
    CHECK(f[0] / f[1] == Approx(4).margin(0.15));
    CHECK(f[1] / f[2] == Approx(4).margin(0.15));
}

TEST_CASE("pulling a face apart without dashpots: work of the grips = G_c A + kinetic energy")
{
    InterfaceLaw law = elastic_law();
    law.failure = FailureUnit::point;
    law.softening = Softening::bilinear;
    law.tensile_strength = 20;
    law.cohesion = 40;
    law.fracture_energy_I = 0.4;
    law.fracture_energy_II = 1.6;
    Assembly a = pair_of_blocks(law, QuadratureRule::automatic, 1e-3);
    a.model.skin = 0.2;
    drive(a.state, 1, {0.5, 0, 0});
    drive(a.state, 0);
    start(a.model, a.state);
    while (a.state.interfaces.damage[0] < 1.0) step(a.model, a.state, 1e-6);
    const Ledger e = energy_ledger(a.model, a.state);
    CHECK(e.fracture == Approx(0.4 * b * d).epsilon(1e-10));
    CHECK(e.external == Approx(0.4 * b * d + e.kinetic).epsilon(1e-4));
}

TEST_CASE("parallel bond: stiffness and breaking loads of the circular section")
{
    const double R = 0.5, sigma_c = 20, c = 10;
    const auto fresh = [&](bool separate) {
        Assembly a = assemble({grain(make_box({1, 2, 2}, {-0.5, 0, 0}), {-0.5, 0, 0}),
                               grain(make_box({1, 2, 2}, {0.5, 0, 0}), {0.5, 0, 0})});
        a.model.parallel_laws.host() = {{sigma_c, c, 0.0, 1.0, separate, true}};
        BondRule r;
        r.kind = BondRule::Kind::parallel;
        r.normal_stiffness = 5000;
        r.shear_ratio = 0.4;
        r.bond_radius = R;
        bond_shared_faces(a.model, a.state, a.grains, 1, [&](int, int) { return &r; });
        start_bonds(a.model, a.state);
        build_incidence(a.state);
        return a;
    };
    // one increment of unit time: velocity is displacement
    const auto apply = [](Assembly& a, const Vec3& u, const Vec3& turn_by) {
        a.state.bodies.velocity.host()[1] = u + cross(turn_by, Vec3{0.5, 0, 0});
        a.state.bodies.angular_velocity.host()[1] = turn_by;
        bond_forces(a.model, a.state, 1.0);
    };
    const auto stiffness = [&](const Vec3& u, const Vec3& t, bool moment, int component) {
        Assembly a = fresh(false);
        apply(a, 1e-6 * u, 1e-6 * t);
        return (moment ? a.state.parallels.moment[0][component] : a.state.parallels.force[0][component]) / 1e-6;
    };
    CHECK(stiffness({1, 0, 0}, {}, false, 0) == Approx(3926.990817).epsilon(1e-9));
    CHECK(stiffness({0, 1, 0}, {}, false, 1) == Approx(1570.796327).epsilon(1e-9));
    CHECK(stiffness({}, {0, 1, 0}, true, 1) == Approx(245.436926).epsilon(1e-9));
    CHECK(stiffness({}, {1, 0, 0}, true, 0) == Approx(196.349541).epsilon(1e-9));
    const auto breaks = [&](const Vec3& u, const Vec3& t, bool separate) {
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
            const double mid = 0.5 * (low + high);
            Assembly a = fresh(separate);
            apply(a, mid * u, mid * t);
            (a.state.parallels.cause[0] != 0 ? high : low) = mid;
        }
        return high;
    };
    for (const bool separate : {false, true}) {
        CHECK(3926.990817 * breaks({1, 0, 0}, {}, separate) == Approx(15.707963).epsilon(1e-6));
        CHECK(1570.796327 * breaks({0, 1, 0}, {}, separate) == Approx(7.853982).epsilon(1e-6));
        CHECK(245.436926 * breaks({}, {0, 1, 0}, separate) == Approx(1.963495).epsilon(1e-6));
        CHECK(196.349541 * breaks({}, {1, 0, 0}, separate) == Approx(1.963495).epsilon(1e-6));
    }
    // tension to half of sigma_c A and bending to half of sigma_c I/R break only by the combined law
    const Vec3 u{15.707963 / 3926.990817, 0, 0}, t{0, 1.963495 / 245.436926, 0};
    CHECK(breaks(u, t, false) == Approx(0.5).epsilon(1e-6));
    CHECK(breaks(u, t, true) == Approx(1.0).epsilon(1e-6));
}

TEST_CASE("a sheared face that retires hands over to contact: no jump of the force, and the account closes")
{
    for (const double k_c :
         {0.5 * k_n, k_n, 2.0 * k_n}) {  // shares less area: a contact weaker or stronger than the face
        InterfaceLaw law = brittle(1.0, 1.0);
        law.failure = FailureUnit::point;
        law.friction = 0.5;
        law.residual_friction = 0.4;
        Assembly a = pair_of_blocks(law);
        a.model.contact_laws.host() = {{k_c, 0.4, 0.4, 1.0, 0.0}};
        a.model.fracture_active = true;
        drive(a.state, 0);
        drive(a.state, 1, {0, 0.01, 0});
        a.state.bodies.inverse_mass.host()[1] = 1e-30;  // held all the same, but a pair of driven bodies has no contact
        set_position(a.state, 1, {0.5 - 1e-3, 0, 0});
        start(a.model, a.state);
        const double dt = 2e-3, start_energy = energy_ledger(a.model, a.state).elastic_bonds;
        double work = 0, jump = 0, largest = 0;
        Vec3 last = a.state.bodies.force[1];
        bool handed_over = false;
        for (int i = 0; i < 16000; ++i) {
            step(a.model, a.state, dt);
            const Vec3 now = a.state.bodies.force[1];
            work -= 0.5 * dt * 0.01 * (now.y + last.y);
            largest = std::max(largest, norm(now));
            if (a.state.interfaces.retired[0] != 0) jump = std::max(jump, norm(now - last));
            handed_over = handed_over || (a.state.contacts.size() > 0 && a.state.contacts.active[0] == 1);
            last = now;
        }
        const Ledger e = energy_ledger(a.model, a.state);
        CAPTURE(k_c, jump, largest, work, e.inserted);
        CHECK(handed_over);
        CHECK(jump < 2e-3 * largest);
        CHECK(std::fabs(start_energy + work + e.inserted - e.elastic_bonds - e.elastic_contacts - e.fracture -
                        e.friction) < 1e-3 * work);
    }
}

TEST_CASE("a whole face acts as its points do, one by one")
{
    InterfaceLaw law = elastic_law();
    law.tensile_strength = law.cohesion = 20;
    law.failure = FailureUnit::point;
    law.fracture_energy_I = law.fracture_energy_II = 10;
    int draw = 0, by_moments = 0;
    for (int k = 0; k < 200; ++k) {
        const QuadratureRule rule = k % 2 == 0 ? QuadratureRule::gauss2 : QuadratureRule::fan7;
        Assembly whole = assemble({grain(make_hexagonal_prism(0.6, 1.3), {}),
                                   grain(translated(make_hexagonal_prism(0.6, 1.3), {0, 0, 1.3}), {0, 0, 1.3})});
        bond(whole, law, 0.0, k_n, k_s / k_n, rule, 0.1);
        REQUIRE(whole.state.interfaces.moments[0].area == Approx(1.5 * std::sqrt(3.0) * 0.36));
        State& s = whole.state;
        build_incidence(s);
        s.slots.dyad_a.resize(1);
        s.slots.dyad_b.resize(1);
        const double size = std::pow(10.0, -4.0 + 2.5 * std::fabs(random_vector(draw).x));
        for (int i = 0; i < 2; ++i) {
            shift(s, i, size * random_vector(draw));
            const Vec3 w = random_vector(draw);
            turn(s, i, from_axis_angle(normalized(w), size * norm(w)));
            s.bodies.velocity.at(i) = random_vector(draw);
            s.bodies.angular_velocity.at(i) = random_vector(draw);
        }
        // everything turned: no axis is special
        const Vec3 turned = 3.0 * random_vector(draw);
        for (int i = 0; i < 2; ++i) {
            set_position(s, i, rotate(from_axis_angle(normalized(turned), norm(turned)), s.bodies.position[i]));
            turn(s, i, from_axis_angle(normalized(turned), norm(turned)));
        }
        Assembly points = whole;
        points.state.interfaces.moments.at(0).area = 0.0;
        bond_forces(whole.model, whole.state, 1e-3);
        bond_forces(points.model, points.state, 1e-3);
        const State& p = points.state;
        const InterfaceBonds &f = s.interfaces, &g = p.interfaces;
        // some point has met the surface: then both have gone through the points, and agree to the bit
        const bool damaged = g.first_damage_time[0] >= 0.0;
        if (!damaged) ++by_moments;
        const double off = damaged ? 0.0 : 1e-14 / size;  // round-off of positions of about 1 in jumps of `size`
        CHECK((f.first_damage_time[0] >= 0.0) == damaged);
        const auto same = [&](const Vec3& x, const Vec3& y) { CHECK(norm(x - y) <= off * (norm(x) + norm(y))); };
        same(s.slots.force[0], p.slots.force[0]);
        same(s.slots.torque_a[0], p.slots.torque_a[0]);
        same(s.slots.torque_b[0], p.slots.torque_b[0]);
        same(f.viscous_force[0], g.viscous_force[0]);
        same(f.viscous_torque_a[0], g.viscous_torque_a[0]);
        same(f.viscous_torque_b[0], g.viscous_torque_b[0]);
        for (int r = 0; r < 3; ++r) {
            const double scale =
                off * (norm(p.slots.dyad_a[0][0]) + norm(p.slots.dyad_a[0][1]) + norm(p.slots.dyad_a[0][2]));
            CHECK(norm(s.slots.dyad_a[0][r] - p.slots.dyad_a[0][r]) <= scale);
            CHECK(norm(s.slots.dyad_b[0][r] - p.slots.dyad_b[0][r]) <= scale);
        }
        CHECK(std::fabs(f.stored_energy[0] - g.stored_energy[0]) <= off * g.stored_energy[0]);
        CHECK(std::fabs(f.viscous_work[0] - g.viscous_work[0]) <= off * g.viscous_work[0]);
    }
    CHECK(by_moments > 50);
    CHECK(by_moments < 150);
}
