// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pulled_sample.h"

#include "fracture/bond_strength.h"
#include "fracture/grain_stress.h"
#include "motion/step.h"
#include "motion/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace grainfrac {

namespace {

/// Grips take what is within this many spacings of the end: one layer of a close packing, both of a staggered pair.
constexpr double grip_depth = 0.6;
constexpr double skin_depth = 1.0;  ///< left out of a core, in spacings
constexpr double edge_width = 2.5;  ///< over which the weight falls, in spacings
constexpr double one_plane = 1.5;   ///< thinner than this many spacings is one layer
constexpr double flat = 1e-4;       ///< spread across a layer over that along it, both squared [-]
constexpr double rest = 1e-7;       ///< residual over mean force in equilibrium [-]
constexpr int most_steps = 50000;

constexpr double strain_growth = 0.01;  ///< of the strain, from one equilibrium of the strength test to the next [-]
constexpr double broken_share = 0.5;    ///< of the largest force: below, the sample has failed [-]
constexpr int most_stretches = 400;
/// Interfaces are judged by their mean tractions: their worst points begin to fail a little before.
constexpr double begin_of_interfaces = 0.7;

}  // namespace

Range1D range_along(const State& state, int axis)
{
    Range1D r{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (int i = 0; i < state.bodies.size(); ++i) {
        r.low = std::min(r.low, state.bodies.position[i][axis]);
        r.high = std::max(r.high, state.bodies.position[i][axis]);
    }
    return r;
}

double Window::Edge::at(double distance) const
{
    if (distance <= flat) return 1.0;
    if (distance >= end) return 0.0;
    const double c = std::cos(0.5 * std::numbers::pi * (distance - flat) / (end - flat));
    return c * c;
}

double Window::weight(const Vec3& x) const
{
    const Vec3 d = x - middle_;
    const int e = (axis_ + 1) % 3, f = (axis_ + 2) % 3;
    const double along = along_.at(std::fabs(d[axis_]));
    if (round_) return along * across_[0].at(std::hypot(d[e], d[f]));
    return along * across_[0].at(std::fabs(d[e])) * across_[1].at(std::fabs(d[f]));
}

double Window::volume() const
{
    const double along = along_.flat + along_.end;  // cos^2 has the mean 1/2, on both sides
    if (round_) {
        const double R = across_[0].flat, w = across_[0].end - R, pi = std::numbers::pi;
        // int over the edge of (R + s) cos^2(pi s/2w) ds = R w/2 + w^2 (1/4 - 1/pi^2)
        return along * pi * (R * R + 2.0 * (0.5 * R * w + w * w * (0.25 - 1.0 / (pi * pi))));
    }
    double section = 1.0;
    for (int k = 0; k < 2; ++k) {
        const bool plane = thickness_ > 0.0 && (axis_ + 1 + k) % 3 == 2;
        section *= plane ? thickness_ : across_[k].flat + across_[k].end;
    }
    return along * section;
}

std::optional<Window> core_window(const State& state, int axis, double size, double thickness)
{
    Window w;
    w.axis_ = axis;
    w.thickness_ = thickness;
    w.round_ = thickness == 0.0;
    Vec3 half;
    for (int k = 0; k < 3; ++k) {
        const Range1D r = range_along(state, k);
        w.middle_[k] = 0.5 * (r.low + r.high);
        half[k] = 0.5 * (r.high - r.low);
    }
    if (w.round_) {  // centres of a cylinder need not reach as far to all sides
        double widest = 0.0;
        for (int i = 0; i < state.bodies.size(); ++i) {
            Vec3 d = state.bodies.position[i] - w.middle_;
            d[axis] = 0.0;
            widest = std::max(widest, norm(d));
        }
        half[(axis + 1) % 3] = half[(axis + 2) % 3] = widest;
    }
    const auto edge = [&](double reach) {
        const double end = reach - skin_depth * size;
        return Window::Edge{std::max(0.0, end - edge_width * size), end};
    };
    const auto open = Window::Edge{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    w.along_ = edge(half[axis]);
    bool enough = w.along_.end > 0.0;
    for (int k = 0; k < 2; ++k) {
        const int across = (axis + 1 + k) % 3;
        const bool plane = thickness > 0.0 && across == 2 && half[across] < one_plane * thickness;
        w.across_[k] = plane || size == 0.0 ? open : edge(half[across]);
        if (!plane && size > 0.0) enough = enough && w.across_[k].end > size;
    }
    if (size == 0.0) {  // a fibre: all of its section, away from the ends
        w.along_ = {0.25 * half[axis], 0.75 * half[axis]};
        w.across_[0] = w.round_ ? Window::Edge{half[(axis + 1) % 3], half[(axis + 1) % 3] * (1.0 + 1e-9)} : open;
        if (w.round_ && w.across_[0].end == 0.0) w.across_[0].flat = w.across_[0].end = 1e-300;
        return w;
    }
    if (!enough) return std::nullopt;
    return w;
}

PulledSample::PulledSample(Model& model, State& state, int axis) : model_(model), state_(state), axis_(axis)
{
    start(model, state);
    Bodies& b = state.bodies;
    const Range1D r = range_along(state, axis);
    middle_ = 0.5 * (r.low + r.high);
    const double depth = grip_depth * model.nominal_length;
    for (int k = 0; k < 2; ++k) {  // no group: no body is of a wall alone
        walls_[k] = static_cast<int>(model.walls.size());
        model.walls.emplace_back(k == 0 ? "grip_top" : "grip_bottom");
        model.wall_motion.host().push_back({});
    }
    double top = 0.0, bottom = 0.0;
    int tops = 0, bottoms = 0;
    for (int i = 0; i < b.size(); ++i) {
        const double z = b.position[i][axis];
        const bool high = z > r.high - depth, low = !high && z < r.low + depth;
        if (!high && !low) continue;
        b.wall.at(i) = walls_[high ? 0 : 1];
        b.held.at(i) = 1 << axis;
        (high ? top : bottom) += z;
        (high ? tops : bottoms) += 1;
    }
    length_ = tops > 0 && bottoms > 0 ? top / tops - bottom / bottoms : 0.0;
}

void PulledSample::move_by(double axial, double lateral)
{
    Bodies& b = state_.bodies;
    double farthest = 0.0;
    for (int i = 0; i < b.size(); ++i) {
        Vec3 way;
        const Vec3 from = b.start_position[i];
        for (int k = 0; k < 3; ++k) way[k] = k == axis_ ? axial * (from[k] - middle_) : lateral * from[k];
        b.position.at(i) += way;
        farthest = std::max(farthest, norm(way));
    }
    state_.travel += farthest;  // what was apart may have met
}

Relaxed PulledSample::stretch_to(double strain, double poisson_ratio, double largest)
{
    poisson_ratio_ = poisson_ratio;
    move_by(strain - strain_, -poisson_ratio * (strain - strain_));
    strain_ = strain;
    RelaxSettings settings;
    settings.tolerance = rest;
    settings.most_steps = most_steps;
    settings.fracture = largest >= 0.0;
    const auto failed = [&] { return force() < broken_share * largest; };  // loose pieces would never come to rest
    return Relaxation(model_, state_)
        .relax(model_, state_, settings, settings.fracture ? std::function<bool()>(failed) : nullptr);
}

double PulledSample::force() const
{
    double sum = 0.0;
    const Bodies& b = state_.bodies;
    for (int i = 0; i < b.size(); ++i) {
        if (b.wall[i] == walls_[0]) sum -= b.force[i][axis_];
        if (b.wall[i] == walls_[1]) sum += b.force[i][axis_];
    }
    return 0.5 * sum;
}

double PulledSample::strain_of_ends() const
{
    return strain_;
}

Vec3 PulledSample::mean_stress(const Window& window, double solid_fraction)
{
    const double dt = 1e-9 * time_step_bound(model_, state_).with_damping;  // nothing moves; only to have the dyads
    step(model_, state_, dt, true);
    const std::vector<Mat3> stress = grain_stress(model_, state_);
    Vec3 sum;
    double solid = 0.0;
    for (int i = 0; i < state_.bodies.size(); ++i) {
        const Mat3& s = stress[static_cast<std::size_t>(i)];
        const double w = window.weight(state_.bodies.start_position[i]) * grain_volume(model_, state_, i);
        sum += w * Vec3{s[0].x, s[1].y, s[2].z};
        solid += w;
    }
    return sum / (solid_fraction > 0.0 ? solid / solid_fraction : window.volume());
}

Strains PulledSample::strains(const Window* window) const
{
    const Bodies& b = state_.bodies;
    const auto weight = [&](int i) { return window != nullptr ? window->weight(b.start_position[i]) : 1.0; };
    double total = 0.0;
    Vec3 x, u;
    for (int i = 0; i < b.size(); ++i) {
        const double w = weight(i);
        total += w;
        x += w * b.start_position[i];
        u += w * (b.position[i] - b.start_position[i]);
    }
    if (!(total > 0.0)) return {};
    x *= 1.0 / total;
    u *= 1.0 / total;
    Vec3 slope, spread;
    for (int i = 0; i < b.size(); ++i) {
        const double w = weight(i);
        const Vec3 dx = b.start_position[i] - x, du = b.position[i] - b.start_position[i] - u;
        for (int k = 0; k < 3; ++k) {
            slope[k] += w * dx[k] * du[k];
            spread[k] += w * dx[k] * dx[k];
        }
    }
    Strains s;
    const double widest = std::max({spread.x, spread.y, spread.z});
    for (int k = 0; k < 3; ++k) {
        s.has_width[k] = spread[k] > flat * widest;
        if (s.has_width[k]) s.normal[k] = slope[k] / spread[k];
    }
    return s;
}

double Strains::lateral(int axis) const
{
    double sum = 0.0;
    int directions = 0;
    for (int k = 0; k < 3; ++k) {
        if (k == axis || !has_width[k]) continue;
        sum += normal[k];
        ++directions;
    }
    return directions > 0 ? sum / directions : 0.0;
}

CoreElasticity core_elasticity(const Vec3& stress, const Strains& strains, int axis)
{
    int directions = 0;
    double across = 0.0;
    for (int k = 0; k < 3; ++k) {
        if (k == axis || !strains.has_width[k]) continue;
        across += stress[k];
        ++directions;
    }
    if (directions > 0) across /= directions;
    // e_a = (s - n nu t)/E, e_l = (t (1 - (n - 1) nu) - nu s)/E with n lateral directions; r = e_l/e_a
    const double n = directions, s = stress[axis], t = across, e = strains.normal[axis], r = strains.lateral(axis) / e;
    const double nu = (t - r * s) / (s + (n - 1.0) * t - n * r * t);
    return {(s - n * nu * t) / e, nu};
}

double PulledSample::utilisation() const
{
    double most = most_used_bond(model_, state_).share;
    const InterfaceBonds& f = state_.interfaces;
    for (int i = 0; i < f.size(); ++i) {
        const InterfaceLaw law = model_.interface_laws[f.law[i]];
        if (law.failure == FailureUnit::unbreakable) continue;
        const Vec3 n = rotate(state_.bodies.orientation[f.a[i]], f.normal_a[i]), t = -state_.slots.force[i] / f.area[i];
        const double sigma = dot(t, n), tau = norm(tangential(t, n)), strength = f.strength_factor[i];
        most = std::max({most, sigma / (strength * law.tensile_strength),
                         (tau + law.friction * sigma) / (strength * law.cohesion)});
    }
    return most;
}

double PulledSample::largest_force()
{
    const double used = utilisation();
    if (!(used > 0.0)) return 0.0;
    for (SphereBondLaw& law : model_.sphere_bond_laws.host()) {
        law.strength.tensile_strength *= used;
        law.strength.cohesion *= used;
    }
    for (InterfaceLaw& law : model_.interface_laws.host()) {
        law.tensile_strength *= used;
        law.cohesion *= used;
        law.fracture_energy_I *= used * used;
        law.fracture_energy_II *= used * used;
    }
    const double nu = poisson_ratio_;
    // Where bonds break at once, the first does so right now: this force is carried whatever follows.
    const bool at_once = state_.interfaces.size() == 0;
    double largest = at_once ? force() : 0.0, strain = strain_ * (at_once ? 1.0 : begin_of_interfaces);
    for (int k = 0; k < most_stretches; ++k) {
        stretch_to(strain, nu, largest);
        largest = std::max(largest, force());
        if (force() < broken_share * largest) break;
        strain *= 1.0 + strain_growth;
    }
    return largest / used;
}

}  // namespace grainfrac
