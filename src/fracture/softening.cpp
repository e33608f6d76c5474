// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/softening.h"

#include "fracture/interface_frame.h"
#include "model/point_history.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

constexpr int bisections = 60;
/// A friction spring is that much longer than the way that it is to go back, so that it loses one in as many.
constexpr double soft_springs = 1e4;

/// Calls visit(point index, jump, state of the point) for the points of an interface that have not yet broken.
template <class Visit>
void for_each_live_point(const State& state, int i, Visit&& visit)
{
    const InterfaceBonds& f = state.interfaces;
    const InterfacePoints& p = state.points;
    const Bodies& b = state.bodies;
    if (f.retired[i] != 0) return;
    const InterfaceFrame frame(b.orientation[f.a[i]], b.orientation[f.b[i]], b.position[f.b[i]] - b.position[f.a[i]],
                               f.normal_a[i], f.normal_b[i], f.tangent_a[i], f.tangent_b[i]);
    for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
        const InterfacePointState s = point_state(state, i, q);
        if (s.damage >= 1.0) continue;
        const Vec3 jump = frame.between + frame.rotation_b * p.position_b[q] - frame.rotation_a * p.position_a[q];
        visit(q, frame.in_frame(jump), s);
    }
}

InterfaceResponse softened(const Model& model, const InterfaceBonds& f, int i, const InterfaceJump& jump,
                           InterfacePointState& p)
{
    return model.interface_laws[f.law[i]](jump, jump, f.normal_stiffness[i], f.shear_stiffness[i], f.strength_factor[i],
                                          f.toughness_factor[i], true, false, p, true, f.pressure[i]);
}

InterfaceJump scaled(const InterfaceJump& d, double s)
{
    return {s * d.n, s * d.s1, s * d.s2};
}

bool softens(const Model& model, const InterfaceBonds& f, int i)
{
    return model.interface_laws[f.law[i]].failure == FailureUnit::point;
}

/// Twice the elastic energy per area of an interface not damaged [J/m^2].
double stored(const InterfaceBonds& f, int i, const InterfaceJump& d)
{
    const double open = std::fmax(d.n, 0.0);
    return f.normal_stiffness[i] * open * open + f.shear_stiffness[i] * (d.s1 * d.s1 + d.s2 * d.s2);
}

/// 1 where the point begins to soften, or goes on with it [-].
double use_of_strength(const Model& model, const InterfaceBonds& f, int i, const InterfaceJump& d,
                       const InterfacePointState& p)
{
    const InterfaceLaw law = model.interface_laws[f.law[i]];
    if (p.onset > 0.0) return std::sqrt(stored(f, i, d)) / law.softening_threshold(p);
    return law.onset_factor(f.normal_stiffness[i] * d.n, f.shear_stiffness[i] * std::sqrt(d.s1 * d.s1 + d.s2 * d.s2),
                            f.strength_factor[i]);
}

}  // namespace

double factor_to_softening(const Model& model, const State& state, const std::vector<int>& interfaces)
{
    double nearest = 0.0;  // largest use of the strength
    for (const int i : interfaces) {
        if (!softens(model, state.interfaces, i)) continue;
        for_each_live_point(state, i, [&](int, const InterfaceJump& d, const InterfacePointState& p) {
            nearest = std::max(nearest, use_of_strength(model, state.interfaces, i, d, p));
        });
    }
    return nearest > 0.0 ? 1.0 / nearest : 0.0;
}

double factor_to_balance(const Model& model, const State& state, const std::vector<int>& interfaces, double reach)
{
    double takes = 0.0, releases = 0.0;
    for (const int i : interfaces) {
        if (!softens(model, state.interfaces, i)) continue;
        for_each_live_point(state, i, [&](int q, const InterfaceJump& d, InterfacePointState p) {
            const double before = p.damage, used = use_of_strength(model, state.interfaces, i, d, p);
            softened(model, state.interfaces, i, scaled(d, reach), p);
            if (p.damage == before) return;
            const double released = state.points.weight[q] * (p.damage - before) * stored(state.interfaces, i, d);
            releases += released;
            takes += released / (used * used);
        });
    }
    return releases > 0.0 ? std::sqrt(takes / releases) : 1.0;
}

double mean_damage(const State& state, const std::vector<int>& interfaces)
{
    double damaged = 0.0, area = 0.0;
    for (const int i : interfaces) {
        damaged += state.interfaces.area[i] * state.interfaces.damage[i];
        area += state.interfaces.area[i];
    }
    return area > 0.0 ? damaged / area : 0.0;
}

double mean_damage_at(const Model& model, const State& state, const std::vector<int>& interfaces, double reach)
{
    double damaged = 0.0, area = 0.0;
    for (const int i : interfaces) {
        double whole = 0.0;
        for_each_live_point(state, i, [&](int q, const InterfaceJump& d, InterfacePointState p) {
            softened(model, state.interfaces, i, scaled(d, reach), p);
            whole += state.points.weight[q] * (1.0 - p.damage);
        });
        damaged += state.interfaces.area[i] - whole;
        area += state.interfaces.area[i];
    }
    return area > 0.0 ? damaged / area : 0.0;
}

double overshoot(const Model& model, const State& state, const std::vector<int>& interfaces, double surface,
                 double wanted)
{
    double low = 0.0, high = 1.0;
    while (mean_damage_at(model, state, interfaces, surface * (1.0 + high)) < wanted && high < 1e6) high *= 2.0;
    for (int k = 0; k < bisections; ++k) {
        const double middle = 0.5 * (low + high);
        (mean_damage_at(model, state, interfaces, surface * (1.0 + middle)) < wanted ? low : high) = middle;
    }
    return high;
}

void soften(const Model& model, State& state, const std::vector<int>& interfaces, double reach)
{
    InterfaceBonds& f = state.interfaces;
    for (const int i : interfaces) {
        if (!softens(model, f, i)) continue;
        const double k_n = f.normal_stiffness[i], k_s = f.shear_stiffness[i];
        double work = 0.0, released = 0.0, sheared = 0.0;
        bool started = false;
        for_each_live_point(state, i, [&](int q, const InterfaceJump& d, InterfacePointState p) {
            const InterfacePointState was = p;
            const InterfaceResponse r = softened(model, f, i, scaled(d, reach), p);
            if (p.onset == 0.0) return;
            // friction begins, and has got to, where the point is, not where the reach is
            p.slip1 = was.onset > 0.0 ? was.slip1 : d.s1;
            p.slip2 = was.onset > 0.0 ? was.slip2 : d.s2;
            started = started || was.onset == 0.0;
            const double w = state.points.weight[q], open = std::fmax(d.n, 0.0);
            const double s1 = d.s1 - p.slip1, s2 = d.s2 - p.slip2;
            work += w * r.fracture_work;
            sheared += w * r.shear_share;
            released += 0.5 * w * (p.damage - was.damage) *
                        (k_n * open * open + k_s * (d.s1 * d.s1 + d.s2 * d.s2 - s1 * s1 - s2 * s2));
            set_point_state(state, i, q, p);
        });
        f.fracture_work.at(i) += work;
        f.inserted_work.at(i) += work - released;
        f.shear_share.at(i) += sheared;
        if (started && f.first_damage_time[i] < 0.0) f.first_damage_time.at(i) = state.time;
    }
}

Sliding::Sliding(const Model& model, State& state, const std::vector<int>& interfaces, double way)
    : model_(model), state_(state), interfaces_(interfaces), way_(way)
{
    for (const int i : interfaces) stiffness_.push_back(state.interfaces.shear_stiffness[i]);
    set(true);
}

Sliding::~Sliding()
{
    set(false);
}

void Sliding::renew()
{
    set(true);
}

void Sliding::set(bool soft)
{
    InterfaceBonds& f = state_.interfaces;
    const InterfacePoints& p = state_.points;
    const Bodies& b = state_.bodies;
    for (std::size_t k = 0; k < interfaces_.size(); ++k) {
        const int i = interfaces_[k];
        const InterfaceLaw law = model_.interface_laws[f.law[i]];
        const InterfaceFrame frame(b.orientation[f.a[i]], b.orientation[f.b[i]],
                                   b.position[f.b[i]] - b.position[f.a[i]], f.normal_a[i], f.normal_b[i],
                                   f.tangent_a[i], f.tangent_b[i]);
        const double was = f.shear_stiffness[i];
        double is = stiffness_[k];
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
            InterfacePointState point = point_state(state_, i, q);
            if (f.retired[i] != 0 || point.damage < 1.0) continue;
            const InterfaceJump d =
                frame.in_frame(frame.between + frame.rotation_b * p.position_b[q] - frame.rotation_a * p.position_a[q]);
            const double s1 = d.s1 - point.slip1, s2 = d.s2 - point.slip2, length = std::sqrt(s1 * s1 + s2 * s2);
            const double cap = law.friction_cap(std::fmax(0.0, -f.normal_stiffness[i] * d.n), f.pressure[i]);
            if (length == 0.0 || cap == 0.0) continue;
            if (soft) is = cap / (way_ * soft_springs);
            const double now = soft ? cap / is : was * length / is;
            point.slip1 = d.s1 - now / length * s1;
            point.slip2 = d.s2 - now / length * s2;
            set_point_state(state_, i, q, point);
            f.friction_work.at(i) += 0.5 * p.weight[q] * (was * length * length - is * now * now);
        }
        f.shear_stiffness.at(i) = is;
    }
}

}  // namespace grainfrac
