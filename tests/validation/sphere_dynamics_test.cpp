// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs and chains of bonded spheres in motion against closed forms: docs/theory/sphere_bonds.md.
#include "support/spheres.h"

#include <complex>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// Two touching spheres of mass 1 and radius 0.5 along x.
Assembly pair(const SphereBondLaw& law, const BondSprings& k)
{
    Assembly a = sphere_assembly(law);
    add_row(a, 2, 1.0, 0.5, k, [](int) { return 0; });
    for (const int i : {0, 1}) set_mass(a, i, 1.0, 0.5);
    return a;
}

void run(Assembly& a, double dt, int steps)
{
    for (int i = 0; i < steps; ++i) step(a.model, a.state, dt);
}

double largest_speed(const State& s)
{
    double v = 0.0;
    for (int i = 0; i < s.bodies.size(); ++i)
        v = std::max({v, norm(s.bodies.velocity[i]), norm(s.bodies.angular_velocity[i])});
    return v;
}

}  // namespace

TEST_CASE("a sphere on a bond swings with the period of leapfrog")
{
    // 2 pi/omega (1 - (omega dt)^2/24): the next term is 3/640 (omega dt)^4 = 3e-8
    const double K = 4.0, omega = 2.0, x0 = 1e-3;
    const auto period = [&](double dt) {
        Assembly a = pair(unbreakable_bond(false), {K, 0, 0, 0});
        drive(a.state, 0);
        shift(a.state, 1, {x0, 0, 0});
        start(a.model, a.state);
        double first = -1.0, last = 0.0, before = x0;
        int crossings = 0;
        while (crossings < 41) {
            step(a.model, a.state, dt);
            const double x = a.state.bodies.position[1].x - 1.0;
            if (before > 0.0 && x <= 0.0) {  // sine through the two points, to third order in dt
                const double v0 = a.state.bodies.velocity[1].x;
                double t = -x / v0;
                t -= omega * omega * t * t * t / 3.0;
                last = a.state.time + t;
                if (first < 0.0) first = last;
                ++crossings;
            }
            before = x;
        }
        return (last - first) / 40.0;
    };
    const double exact = 2.0 * std::numbers::pi / omega;
    const double coarse = period(0.05), fine = period(0.025);
    CHECK(relative(fine, exact * (1.0 - 0.05 * 0.05 / 24.0)) < 1e-6);
    CHECK(std::log2((exact - coarse) / (exact - fine)) == Approx(2.0).margin(0.05));
}

TEST_CASE("a pair is stable up to the step that its stiffness allows")
{
    // K_s = K_n: the shear mode sqrt(7 K/m) governs, and the bound by bodies is exact
    const double K = 3.0, limit = 2.0 / std::sqrt(7.0 * K);
    for (const bool incremental : {false, true}) {
        const auto speed_after = [&](double dt) {
            Assembly a = pair(unbreakable_bond(incremental), {K, K, 0.0, 0.0});
            a.state.bodies.velocity.at(1) = {0.0, 1e-6, 0.0};
            start(a.model, a.state);
            CHECK(time_step_bound(a.model, a.state).critical == Approx(limit).epsilon(1e-12));
            double most = 0.0;
            for (int i = 0; i < 100; ++i) {
                run(a, dt, 1);
                most = std::max(most, largest_speed(a.state));
            }
            return most;
        };
        CHECK(speed_after(0.99 * limit) < 1e-4);
        CHECK(speed_after(1.01 * limit) > 1e-2);
    }
}

TEST_CASE("dashpots shorten the stable step of a pair as in closed form")
{
    for (const double zeta : {0.1, 0.7, 1.4}) {
        const double K = 3.0, omega = std::sqrt(2.0 * K);
        const double limit = 2.0 / omega * (std::sqrt(1.0 + zeta * zeta) - zeta);
        const auto speed_after = [&](double dt) {
            Assembly a = pair(unbreakable_bond(false, zeta), {K, 0.0, 0.0, 0.0});
            a.state.bodies.velocity.at(1) = {1e-6, 0.0, 0.0};
            start(a.model, a.state);
            CHECK(time_step_bound(a.model, a.state).with_damping == Approx(limit).epsilon(1e-12));
            run(a, dt, 2000);
            return std::fabs(a.state.bodies.velocity[1].x - a.state.bodies.velocity[0].x);
        };
        CHECK(speed_after(0.99 * limit) < 1e-6);
        CHECK(!(speed_after(1.01 * limit) < 1e-3));  // or not a number
    }
}

namespace {

/// A tangle of seven spheres that swings freely.
Assembly tangle(const SphereBondLaw& law)
{
    Assembly a = sphere_assembly(law, 2.0);
    int draw = 50;
    for (int i = 0; i < 7; ++i) {
        const double angle = i * std::numbers::pi / 3.0;
        sphere(a, i == 6 ? Vec3{} : Vec3{std::cos(angle), std::sin(angle), 0.1 * i}, 0.4 + 0.02 * i,
               0.05 * random_vector(draw));
    }
    for (int i = 0; i < 6; ++i) {
        if (i < 5) join(a, i, i + 1, {2.0, 0.9, 0.1, 0.07});
        if (i == 0) join(a, 0, 5, {1.5, 0.9, 0.1, 0.07});
        join(a, i, 6, {2.0, 0.8, 0.1, 0.05});
    }
    return a;
}

struct Books {
    double work_error = 0.0;     ///< change of leapfrog kinetic energy less the work, over the largest energy
    double elastic_error = 0.0;  ///< work of the bonds less the change of what they store
    double ledger_error = 0.0;   ///< of the program's own account
};

/// Work balance of leapfrog: kinetic energy of the two half steps next to t, work (F_t + F_t+1)/2 dx.
Books keep_books(Assembly a, double dt, int steps)
{
    start(a.model, a.state);
    const Bodies& b = a.state.bodies;
    const int n = b.size();
    const auto stored = [&] { return energy_ledger(a.model, a.state).elastic_bonds; };
    std::vector<Vec3> v(static_cast<std::size_t>(n)), w(v), f(v), t(v);
    double kinetic_0 = 0.0, kinetic = 0.0, work = 0.0, stored_0 = 0.0, scale = 0.0;
    Books books;
    for (int k = 0; k < steps; ++k) {
        for (std::size_t i = 0; i < v.size(); ++i) {
            f[i] = b.force[static_cast<int>(i)];
            t[i] = b.torque[static_cast<int>(i)];
        }
        if (k == 1) stored_0 = stored();
        step(a.model, a.state, dt);
        kinetic = 0.0;
        double done = 0.0;
        for (int i = 0; i < n; ++i) {
            const auto s = static_cast<std::size_t>(i);
            const double j = b.inverse_inertia[i].x;
            const Vec3 half = b.velocity[i] - (0.5 * dt * b.inverse_mass[i]) * b.force[i];
            const Vec3 spin = b.angular_velocity[i] - (0.5 * dt * j) * b.torque[i];
            kinetic += 0.5 * b.mass[i] * dot(v[s], half) + 0.5 / j * dot(w[s], spin);
            // the mid-step velocity of this step goes with the forces at both its ends
            done += 0.5 * dt * (dot(f[s] + b.force[i], half) + dot(t[s] + b.torque[i], spin));
            v[s] = half;
            w[s] = spin;
        }
        if (k == 0) continue;
        // kinetic belongs to the beginning of this step, like the work summed so far
        if (k == 1) kinetic_0 = kinetic;
        scale = std::max(scale, std::fabs(kinetic) + stored());
        books.work_error = std::max(books.work_error, std::fabs(kinetic - kinetic_0 - work));
        work += done;
        books.elastic_error = std::max(books.elastic_error, std::fabs(work + stored() - stored_0));
    }
    books.work_error /= scale;
    books.elastic_error /= scale;
    books.ledger_error = energy_ledger(a.model, a.state).relative_error();
    return books;
}

}  // namespace

TEST_CASE("the work of sphere bonds is the change of energy")
{
    for (const bool incremental : {false, true}) {
        const Books coarse = keep_books(tangle(unbreakable_bond(incremental)), 0.02, 500);
        const Books fine = keep_books(tangle(unbreakable_bond(incremental)), 0.01, 1000);
        CHECK(fine.work_error < 1e-12);
        CHECK(coarse.elastic_error / fine.elastic_error == Approx(4.0).margin(0.4));  // turning bonds: O(dt^2)
        CHECK(coarse.ledger_error < 1e-3);
        CHECK(fine.ledger_error < 3e-4);
    }
    CHECK(keep_books(tangle(unbreakable_bond(false)), 1e-3, 10000).elastic_error < 1e-6);
    Assembly line = pair(unbreakable_bond(false), {2.0, 0.0, 0.0, 0.0});
    line.state.bodies.velocity.at(1) = {0.01, 0.0, 0.0};
    CHECK(keep_books(line, 0.1, 1000).elastic_error < 1e-12);  // a linear spring: exact
}

TEST_CASE("bonded spheres fall freely, and with local damping by 1 - beta of it")
{
    for (const double beta : {0.0, 0.3, 0.7}) {
        Assembly a = tangle(unbreakable_bond(false, 0.3));
        a.model.gravity = {1.0, -3.0, 2.0};
        a.model.local_damping = beta;
        const Vec3 v0 = 0.5 * a.model.gravity;  // already falling: what is at rest knows no direction
        for (int i = 0; i < 7; ++i) a.state.bodies.velocity.at(i) = v0;
        start(a.model, a.state);
        run(a, 0.01, 100);
        const Vec3 expected = v0 + (1.0 - beta) * a.model.gravity;
        for (int i = 0; i < 7; ++i) CHECK(norm(a.state.bodies.velocity[i] - expected) < 1e-12 * norm(expected));
    }
}

namespace {

/// Damped oscillator released at x0, v0.
double released(double t, double omega, double zeta, double x0, double v0)
{
    if (zeta == 1.0) return std::exp(-omega * t) * (x0 + (v0 + omega * x0) * t);
    const double w = omega * std::sqrt(1.0 - zeta * zeta);
    return std::exp(-zeta * omega * t) * (x0 * std::cos(w * t) + (v0 + zeta * omega * x0) / w * std::sin(w * t));
}

/// m = 1000 kg, K = 1e7 N/m, pulled by 2 mm and then free at 0.1 m/s; largest error over x0 within 0.2 s.
struct Release {
    double omega = 100.0, x0 = 2e-3, v0 = 0.1;

    Assembly at_start(double zeta, double beta) const
    {
        Assembly a = pair(unbreakable_bond(false, zeta), {1e7, 0, 0, 0});
        for (const int i : {0, 1}) set_mass(a, i, 1000.0, 0.5);
        drive(a.state, 0);
        a.model.local_damping = beta;
        shift(a.state, 1, {x0, 0, 0});
        a.state.bodies.velocity.at(1) = {v0, 0, 0};
        start(a.model, a.state);
        return a;
    }
    std::vector<double> path(double zeta, double beta, double dt) const
    {
        Assembly a = at_start(zeta, beta);
        const int every = static_cast<int>(std::lround(1e-3 / dt));
        std::vector<double> x{x0};
        for (int i = 0; i < 200; ++i) {
            run(a, dt, every);
            x.push_back(a.state.bodies.position[1].x - 1.0);
        }
        return x;
    }
};

}  // namespace

TEST_CASE("a released sphere follows the damped oscillator")
{
    // Dashpots see the velocity half a step ago: first order in dt, so the limit dt -> 0 is taken from two steps.
    const Release r;
    for (const double zeta : {0.1, 0.3, 0.7, 1.0}) {
        const auto coarse = r.path(zeta, 0.0, 0.02 / r.omega), fine = r.path(zeta, 0.0, 0.01 / r.omega);
        double first = 0.0, second = 0.0, limit = 0.0;
        for (std::size_t i = 0; i < fine.size(); ++i) {
            const double exact = released(1e-3 * static_cast<double>(i), r.omega, zeta, r.x0, r.v0);
            first = std::max(first, std::fabs(coarse[i] - exact) / r.x0);
            second = std::max(second, std::fabs(fine[i] - exact) / r.x0);
            limit = std::max(limit, std::fabs(2.0 * fine[i] - coarse[i] - exact) / r.x0);
        }
        CHECK(first / second == Approx(2.0).margin(0.05));
        CHECK(limit < 1e-4);
    }
}

TEST_CASE("local damping is a stiffer spring outwards and a softer one inwards")
{
    // where the velocity turns within a step the drag is late: second order, 1.2e-4 x0 at 0.02/omega
    const Release r;
    for (const double beta : {0.1, 0.7}) {
        const double dt = 0.01 / r.omega;
        Assembly a = r.at_start(0.0, beta);
        std::vector<double> turns;
        double before = r.x0, last = r.x0 - r.v0 * dt;
        for (int i = 0; i < 1600 && turns.size() < 4; ++i) {
            run(a, dt, 1);
            const double x = a.state.bodies.position[1].x - 1.0;
            if ((before - last) * (x - before) < 0.0) {  // parabola through three points
                const double c = 0.5 * (x - 2.0 * before + last), b = 0.5 * (x - last);
                turns.push_back(std::fabs(before - 0.25 * b * b / c));
            }
            last = before;
            before = x;
        }
        REQUIRE(turns.size() == 4);
        const double first = std::hypot(r.x0, r.v0 / (r.omega * std::sqrt(1.0 + beta)));
        CHECK(std::fabs(turns[0] - first) < 1e-4 * r.x0);
        for (std::size_t i = 1; i < turns.size(); ++i) {
            const double expected = first * std::pow((1.0 - beta) / (1.0 + beta), 0.5 * static_cast<double>(i));
            CHECK(std::fabs(turns[i] - expected) < 1e-4 * r.x0);
        }
    }
}

TEST_CASE("local damping does not know the axes")
{
    const Quat q = from_axis_angle(normalized(Vec3{1, 2, -2}), 0.9);
    const auto end_of = [&](bool turned) {
        Assembly a = tangle(unbreakable_bond(false));
        a.model.local_damping = 0.5;
        a.model.gravity = {0.3, -1.0, 0.2};
        int draw = 300;  // spins too: the direction of a spin that is nothing but round-off is no one's
        for (int i = 0; i < 7; ++i) a.state.bodies.angular_velocity.at(i) = 0.05 * random_vector(draw);
        if (turned) {
            move_rigidly(a.state, q, {});
            a.model.gravity = rotate(q, a.model.gravity);
            for (int i = 0; i < 7; ++i) {
                a.state.bodies.velocity.at(i) = rotate(q, a.state.bodies.velocity[i]);
                a.state.bodies.angular_velocity.at(i) = rotate(q, a.state.bodies.angular_velocity[i]);
            }
        }
        for (int i = 0; i < 7; ++i) set_spin(a.state.bodies, i, a.state.bodies.angular_velocity[i]);
        start(a.model, a.state);
        run(a, 0.02, 200);
        return a.state.bodies.position.host();
    };
    const std::vector<Vec3> straight = end_of(false), turned = end_of(true);
    for (std::size_t i = 0; i < straight.size(); ++i) CHECK(norm(turned[i] - rotate(q, straight[i])) < 1e-11);
}

namespace {

/// So slow that the chain, which has no stiffness across, does not buckle while it is compressed [m/s].
constexpr double driven_speed = 1e-6;

/// 50 spheres of mass 1 on springs of 1 N/m, the first driven. Bond dashpots c = 2 zeta sqrt(K m) everywhere:
/// a free pair has half the mass, so its zeta is sqrt(2) larger.
Assembly driven_chain(double zeta)
{
    Assembly a = sphere_assembly(unbreakable_bond(false, zeta));
    a.model.sphere_bond_laws.host().push_back(unbreakable_bond(false, std::numbers::sqrt2 * zeta));
    add_row(a, 50, 1.0, 0.5, {1, 0, 0, 0}, [](int k) { return k == 0 ? 0 : 1; });
    for (int i = 0; i < 50; ++i) set_mass(a, i, 1.0, 0.5);
    drive(a.state, 0, {driven_speed, 0, 0});
    return a;
}

/// Kinetic energy over that of rigid motion, driver included, and the driver's force, by modes.
struct ChainState {
    double kinetic = 1.0, force = 0.0;
};
ChainState modal_chain(double t, double zeta)
{
    constexpr int n = 49;
    std::vector<double> x(n), v(n);
    for (int k = 1; k <= n; ++k) {
        const double th = (2 * k - 1) * std::numbers::pi / (2 * n + 1), w = 2.0 * std::sin(0.5 * th), zk = zeta * w;
        double a = 0.0;
        for (int j = 1; j <= n; ++j) a += std::sin(j * th);
        a *= 4.0 / (2 * n + 1);
        const std::complex<double> r = std::sqrt(std::complex<double>(zk * zk - 1.0)), s1 = w * (-zk + r),
                                   s2 = w * (-zk - r);
        const double q = ((std::exp(s1 * t) - std::exp(s2 * t)) / (s1 - s2)).real();
        const double dq = ((s1 * std::exp(s1 * t) - s2 * std::exp(s2 * t)) / (s1 - s2)).real();
        for (int j = 1; j <= n; ++j) {
            x[static_cast<std::size_t>(j - 1)] -= a * q * std::sin(j * th);
            v[static_cast<std::size_t>(j - 1)] -= a * dq * std::sin(j * th);
        }
    }
    ChainState s;
    for (const double u : v) s.kinetic += (1.0 + u) * (1.0 + u);
    s.kinetic /= n + 1;
    s.force = -x[0] - 2.0 * zeta * v[0];
    return s;
}

ChainState state_of(const Assembly& a)
{
    ChainState s;
    for (int i = 1; i < 50; ++i) s.kinetic += norm2(a.state.bodies.velocity[i] / driven_speed);
    s.kinetic /= 50.0;
    s.force = -a.state.bodies.force[0].x / driven_speed;
    return s;
}

}  // namespace

TEST_CASE("a driven chain with dashpots follows its modes")
{
    CHECK(modal_chain(100.0, 0.3).kinetic == Approx(3.5426).epsilon(2e-5));  // figures known beforehand
    CHECK(modal_chain(5000.0, 0.1).kinetic == Approx(1.01155).epsilon(1e-5));
    for (const double zeta : {0.1, 0.3, 0.7}) {
        Assembly coarse = driven_chain(zeta), fine = driven_chain(zeta);
        start(coarse.model, coarse.state);
        start(fine.model, fine.state);
        run(coarse, 0.02, 5000);
        run(fine, 0.01, 10000);
        const ChainState exact = modal_chain(100.0, zeta), x = state_of(coarse), y = state_of(fine);
        CHECK(std::fabs(2.0 * y.kinetic - x.kinetic - exact.kinetic) < 1e-4);  // dashpots: first order, see above
        CHECK(std::fabs(2.0 * y.force - x.force - exact.force) < 1e-4);
    }
}

TEST_CASE("a driven chain with dashpots ends in rigid motion", "[slow]")
{
    Assembly a = driven_chain(0.7);
    start(a.model, a.state);
    run(a, 0.02, 250000);  // the lag of dashpots turns the slowest mode by 1e-3 until then
    CHECK(state_of(a).kinetic == Approx(0.99963).epsilon(1e-4));
    run(a, 0.25, 80000);
    CHECK(std::fabs(state_of(a).kinetic - 1.0) < 1e-6);
    CHECK(std::fabs(state_of(a).force) < 1e-6);
}

TEST_CASE("local damping keeps a driven chain from rigid motion", "[slow]")
{
    // Vibration slower than the chain itself is not braked, the chain is: the figures are indicative.
    const double beta[4] = {0.1, 0.3, 0.5, 0.7}, drag[4] = {0.12, 0.58, 1.25, 2.63};
    for (int k = 0; k < 4; ++k) {
        Assembly a = driven_chain(0.0);
        a.model.local_damping = beta[k];
        start(a.model, a.state);
        run(a, 0.1, 180000);
        double kinetic = 0.0, force = 0.0;
        constexpr int samples = 20000;
        for (int i = 0; i < samples; ++i) {
            run(a, 0.1, 1);
            const ChainState s = state_of(a);
            kinetic += s.kinetic / samples;
            force += s.force / samples;
        }
        CHECK(kinetic > 1.02);
        CHECK(force == Approx(drag[k]).epsilon(0.5));
    }
}

namespace {

/// Spins of two touching spheres, a turned at Omega in place, after a while; rate of the branch.
struct Orbit {
    double spin = 0.0, branch = 0.0, stretch = 0.0;
};
Orbit orbit(const SphereBondLaw& law, const BondSprings& k, double omega, double time)
{
    Assembly a = pair(law, k);
    spin_up(a, 0, {0, 0, omega});
    start(a.model, a.state);
    const double dt = 0.2 * time_step_bound(a.model, a.state).with_damping;
    run(a, dt, static_cast<int>(time / dt));
    const auto angle = [&] {
        const Vec3 d = a.state.bodies.position[1] - a.state.bodies.position[0];
        return std::atan2(d.y, d.x);
    };
    const double from = angle(), start_time = a.state.time;
    double spin = 0.0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) {
        run(a, dt, 1);
        spin += a.state.bodies.angular_velocity[1].z / steps;
    }
    const double turned = std::remainder(angle() - from, 2.0 * std::numbers::pi);
    return {spin, turned / (a.state.time - start_time),
            norm(a.state.bodies.position[1] - a.state.bodies.position[0]) - 1.0};
}

}  // namespace

TEST_CASE("a turning sphere rolls a spring-dashpot partner and carries a bonded one")
{
    const double omega = 1e-3;  // slow against sqrt(K/m) = 1: corrections are (Omega/omega_0)^2
    const Orbit lsdp = orbit(unbreakable_bond(true, 0.5), {1.0, 0.4, 0.0, 0.0}, omega, 300.0);
    CHECK(lsdp.spin == Approx(-5.0 / 7.0 * omega).epsilon(1e-5));
    CHECK(lsdp.branch == Approx(omega / 7.0).epsilon(1e-5));
    for (const bool incremental : {false, true}) {
        const Orbit parallel = orbit(unbreakable_bond(incremental, 0.5), {1.0, 0.4, 0.2, 0.2}, omega, 4000.0);
        CHECK(parallel.spin == Approx(omega).epsilon(1e-5));
        CHECK(parallel.branch == Approx(omega).epsilon(1e-5));
        // m Omega^2 l/K: 2 R m Omega^2/K_n
        CHECK(parallel.stretch == Approx(omega * omega).epsilon(1e-3));
    }
}

TEST_CASE("a standing wave in a chain has the lattice's speed")
{
    // held at both ends, four half waves of ten spacings
    constexpr int n = 41;
    const double k = 2.0 * std::numbers::pi / 20.0, omega = 2.0 * std::sin(0.5 * k);
    Assembly a = sphere_assembly(unbreakable_bond(false));
    add_row(a, n, 1.0, 0.5, {1, 0, 0, 0}, [](int) { return 0; });
    for (int i = 0; i < n; ++i) set_mass(a, i, 1.0, 0.5);
    drive(a.state, 0);
    drive(a.state, n - 1);
    for (int i = 0; i < n; ++i) shift(a.state, i, {1e-6 * std::sin(k * i), 0, 0});
    start(a.model, a.state);
    const double dt = 0.01, quarter = 0.5 * std::numbers::pi / omega;
    const int steps = static_cast<int>(std::lround(41.0 * quarter / dt));  // a zero of the cosine
    run(a, dt, steps);
    const double x = a.state.bodies.position[5].x - 5.0, v = a.state.bodies.velocity[5].x;
    const double found = (41.0 * 0.5 * std::numbers::pi + std::atan(x * omega / v)) / a.state.time;
    CHECK(found == Approx(omega).epsilon(1e-5));
    CHECK(found / k == Approx(1.0).epsilon(5e-3));  // c = d sqrt(K/m), dispersion (k d)^2/24 = 0.4 %
}
