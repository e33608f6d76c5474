// SPDX-License-Identifier: GPL-3.0-or-later
// A heavy chain on a plate: what lifts it, what the plate bears. Closed forms: docs/theory/sphere_bonds.md,
// section 7, and momentum.
#include "experiment/walls.h"
#include "support/spheres.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double R = 1.0, density = 1000.0, modulus = 1e9, g = 9.81;  // [m], [kg/m^3], [Pa], [m/s^2]

/// Chain of n touching spheres along x on a plate without friction; the first is a pin that goes up.
struct LyingChain {
    Assembly a;
    int plate = 0, n = 0;
    double dt = 0.0;

    LyingChain() = default;
    LyingChain(int spheres, const SphereBondLaw& law, bool moments, double damping)
        : a(sphere_assembly(law, density)), n(spheres)
    {
        const double k_n = modulus / (2.0 * R);
        add_row(a, n, 2.0 * R, R, circular_bond(k_n, 0.4 * k_n, R, moments), [](int) { return 0; });
        a.model.contact_laws.host() = {LinearContact{1e8, 0.0, 0.0, 1.0, damping}};
        a.model.gravity = {0, 0, -g};
        a.model.skin = 0.2;
        const int wall = add_wall(a.model, "plate");
        a.model.contact_law_of = {0, 0, 0, 0};
        const double length = 2.0 * R * n;
        add_plate(a.model, a.state, wall, {0.5 * length, 0, -R}, {0, 0, 1}, {1, 0, 0}, 3.0 * length, 20.0, 4.0);
        plate = a.state.bodies.size() - 1;
        // at rest from the start: each presses in by its weight
        for (int i = 0; i < n; ++i) {
            const double sink = a.state.bodies.mass[i] * g / (1e8 * std::numbers::pi * R * R);
            shift(a.state, i, {0, 0, -sink});
        }
    }
    /// The first sphere becomes a pin.
    void grip()
    {
        a.state.bodies.inverse_mass.at(0) = 0.0;
        a.state.bodies.velocity.at(0) = {};
    }
    void begin()
    {
        start(a.model, a.state);
        dt = 0.5 * time_step_bound(a.model, a.state).with_damping;
    }
    double weight() const { return a.state.bodies.mass[1] * g; }
    double plate_force() const { return -a.state.bodies.force[plate].z; }  // up, on the chain
};

}  // namespace

TEST_CASE("a stiff chain whose end is lifted presses where it leaves the plate")
{
    // clamped at lift-off: H = q l^4/(24 E I), end force and concentrated reaction q l/2
    LyingChain c(45, unbreakable_bond(false, 0.3), true, 0.3);
    c.grip();
    c.begin();
    const double H = 1.0, q = c.weight() / (2.0 * R), EI = modulus * CircularSection(R).bending;
    const double lifted = std::pow(24.0 * EI * H / q, 0.25);
    CHECK(lifted == Approx(30.949).epsilon(1e-4));
    const double rise = 2.0;  // [s]
    const double z0 = c.a.state.bodies.position[0].z;
    c.a.model.drag_rate = 3.0;
    while (c.a.state.time < 8.0) {
        const double t = c.a.state.time + 0.5 * c.dt;
        const double next = H * smooth_rise(c.a.state.time + c.dt, 0.0, rise),
                     now = H * smooth_rise(t - 0.5 * c.dt, 0.0, rise);
        c.a.state.bodies.velocity.at(0) = {0, 0, (next - now) / c.dt};
        step(c.a.model, c.a.state, c.dt);
    }
    CHECK(c.a.state.bodies.position[0].z - z0 == Approx(H).epsilon(1e-9));
    const double end = -c.a.state.bodies.force[0].z + c.weight();  // the pin's own weight too
    INFO(end << ' ' << q * lifted / 2.0 << " plate " << c.plate_force() << " of " << c.n * c.weight());
    CHECK(end - 0.5 * c.weight() == Approx(0.5 * q * lifted).epsilon(0.02));
    CHECK(c.plate_force() + end == Approx(c.n * c.weight()).epsilon(1e-3));
}

namespace {

/// Forces while a chain is picked up, over lambda v^2: its pull above the plate less the weight that hangs, the plate's
/// force less the weight that rests, and their sum by the momentum of all spheres.
struct PickUp {
    double pull = 0.0, reaction = 0.0, momentum = 0.0;
    double taken = 0.0;  ///< chain that leaves the plate in a second over v
};

/// Folded in rows. Of a straight chain all would be 1: T_C + R_x = lambda v^2, taken = 1. What is lifted is inclined
/// and wavy, so that more than v leaves the plate in a second.
PickUp pick_up(const SphereBondLaw& law, bool moments, double E, double contact_stiffness)
{
    constexpr double v = 40.0, ramp = 0.5;  // [m/s], [s]
    LyingChain c;
    Assembly& a = c.a;
    a = sphere_assembly(law, density);
    std::vector<Vec3> places{{}};
    for (int row = 0; row < 14; ++row) {
        const double step = row % 2 == 0 ? 2.0 * R : -2.0 * R;
        for (int k = 0; k < 8; ++k) places.push_back(places.back() + Vec3{step, 0, 0});
        for (int k = 0; k < 2; ++k) places.push_back(places.back() + Vec3{0, 2.0 * R, 0});
    }
    c.n = static_cast<int>(places.size());
    const double m = density * 4.0 / 3.0 * std::numbers::pi, k_n = E / (2.0 * R);
    for (const Vec3& x : places) sphere(a, x - Vec3{0, 0, m * g / (contact_stiffness * std::numbers::pi)}, R);
    for (int i = 0; i + 1 < c.n; ++i) join(a, i, i + 1, circular_bond(k_n, 0.4 * k_n, R, moments));
    a.model.contact_laws.host() = {LinearContact{contact_stiffness, 0.0, 0.0, 1.0, 0.3}};
    a.model.contact_law_of = {0, 0, 0, 0};
    a.model.gravity = {0, 0, -g};
    a.model.skin = 0.5;
    add_plate(a.model, a.state, add_wall(a.model, "plate"), {8, 28, -R}, {0, 0, 1}, {1, 0, 0}, 200.0, 200.0, 4.0);
    c.plate = a.state.bodies.size() - 1;
    c.grip();
    c.begin();
    const Bodies& b = a.state.bodies;
    const auto momentum = [&] {
        double p = 0.0;
        for (int i = 0; i < c.n; ++i) p += b.mass[i] * b.velocity[i].z;
        return p;
    };
    double push = 0.0, pull = 0.0, from = 0.0, p0 = 0.0, lifted = 0.0, up0 = 0.0, up = 0.0;
    const double length = 2.0 * R * (c.n - 1);
    while (b.position[0].z < 0.8 * length) {
        a.state.bodies.velocity.at(0) = {0, 0, v * smooth_rise(a.state.time + 0.5 * c.dt, 0.0, ramp)};
        step(a.model, a.state, c.dt);
        if (b.position[0].z < 0.3 * length) continue;
        if (from == 0.0) {
            from = a.state.time;
            p0 = momentum();
            for (int i = 0; i < c.n; ++i) up0 += b.position[i].z > 0.1 * R ? 1 : 0;
            continue;
        }
        push += c.plate_force() * c.dt;
        pull += (c.weight() - b.force[0].z) * c.dt;
        for (int i = 0; i < c.n; ++i) lifted += (b.position[i].z > 0.1 * R ? 2.0 * R : 0.0) * c.dt;
    }
    const double time = a.state.time - from, weight = c.n * c.weight(), q = c.weight() / (2.0 * R);
    for (int i = 0; i < c.n; ++i) up += b.position[i].z > 0.1 * R ? 1 : 0;
    const double lambda = m / (2.0 * R), rate = (up - up0) * m / time, unit = lambda * v * v;
    return {(pull - q * lifted) / time / unit, (push / time - (weight - q * lifted / time)) / unit,
            (momentum() - p0) / time / unit, rate / (lambda * v)};
}

}  // namespace

TEST_CASE("a chain without moments is picked up from its heap without a push of the plate", "[slow]")
{
    const PickUp p = pick_up(unbreakable_bond(true, 0.1), false, modulus, 1e8);
    INFO("taken " << p.taken << ", T_C " << p.pull << ", R_x " << p.reaction);
    CHECK(p.momentum == Approx(p.pull + p.reaction).epsilon(3e-4));
    CHECK(p.taken > 1.0);
    CHECK(p.taken < 1.2);
    // nothing draws its folds straight: it rises as it lay, all of it at v, so that lambda v^2 grows by what is taken
    CHECK(p.pull + p.reaction == Approx(p.taken).epsilon(0.03));
    CHECK(std::fabs(p.reaction) < 0.02);
}

TEST_CASE("a chain with moments is pushed by the plate, and what pulls and pushes is what its momentum takes", "[slow]")
{
    const PickUp p = pick_up(unbreakable_bond(false, 0.1), true, 1e8, 1e6);  // examples/chain_fountain
    INFO("taken " << p.taken << ", T_C " << p.pull << ", R_x " << p.reaction << ", momentum " << p.momentum);
    CHECK(p.momentum == Approx(p.pull + p.reaction).epsilon(3e-4));
    CHECK(p.taken > 1.0);
    CHECK(p.taken < 1.2);
    // it is drawn along its path at v: the more path there is to the height, the slower it rises, and the momentum,
    // lambda v times the height, grows by lambda v^2 however much is taken
    CHECK(p.pull + p.reaction == Approx(1.0).epsilon(0.03));
    CHECK(p.reaction > 0.02);
}
