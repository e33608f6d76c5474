// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pull_out.h"
#include "fracture/softening.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace grainfrac {

namespace {

/// Levels nearer than this share of a fibre's piece are one.
constexpr double same_level = 0.25;

/// Force of the matrix on the fibre against the pull, along the fibre [N].
double pull_of(const PullOut& p, const State& state, int i, int fibre)
{
    const double on_b = dot(state.slots.force[i], p.along[static_cast<std::size_t>(fibre)]);
    return state.interfaces.a[i] == fibre ? on_b : -on_b;
}

/// Pull in a bond of the fibre [N].
double tension(const State& state, int bond)
{
    const SphereBonds& s = state.sphere_bonds;
    const Vec3 branch = normalized(state.bodies.position[s.b[bond]] - state.bodies.position[s.a[bond]]);
    return -dot(state.slots.force[state.first_sphere_slot() + bond], branch);
}

/// Pull at a node: mean of its bonds; at its ends the fibre bears what the grip pulls with, or nothing [N].
double tension_at(const PullOut& p, const State& state, int i, int fibre)
{
    const InterfaceBonds& f = state.interfaces;
    double sum = 0.0;
    for (const int bond : {f.bond_before[i], f.bond_after[i]}) {
        if (bond >= 0) sum += tension(state, bond);
    }
    if (state.bodies.wall[fibre] == p.grip_wall) sum -= dot(state.bodies.force[fibre], p.direction);
    return 0.5 * sum;
}

}  // namespace

std::vector<int> fibre_interfaces(const PullOut& p, const State& state)
{
    std::vector<int> found;
    for (int i = 0; i < state.interfaces.size(); ++i) {
        const bool a = state.bodies.group[state.interfaces.a[i]] == p.fibre_group,
                   b = state.bodies.group[state.interfaces.b[i]] == p.fibre_group;
        if (a != b) found.push_back(i);
    }
    return found;
}

double slip_of(const PullOut& p, const State& state, int i, int fibre)
{
    const InterfaceBonds& f = state.interfaces;
    const Bodies& b = state.bodies;
    const Vec3 along = p.along[static_cast<std::size_t>(fibre)];
    double slip = 0.0, weight = 0.0;
    for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
        const Vec3 on_a = b.position[f.a[i]] + rotate(b.orientation[f.a[i]], state.points.position_a[q]),
                   on_b = b.position[f.b[i]] + rotate(b.orientation[f.b[i]], state.points.position_b[q]);
        slip += state.points.weight[q] * dot(on_b - on_a, along);
        weight += state.points.weight[q];
    }
    return (f.a[i] == fibre ? -1.0 : 1.0) * slip / weight;
}

int fibre_side(const PullOut& p, const State& state, int i)
{
    const InterfaceBonds& f = state.interfaces;
    return state.bodies.group[f.a[i]] == p.fibre_group ? f.a[i] : f.b[i];
}

FibreProfile fibre_profile(const PullOut& p, const State& state)
{
    struct Level {
        double area = 0.0, slip = 0.0, pull = 0.0, squares = 0.0, damage = 0.0, position = 0.0, tension = 0.0;
        bool has_bonds = false;
    };
    std::map<std::int64_t, Level> levels;
    const InterfaceBonds& f = state.interfaces;
    for (const int i : fibre_interfaces(p, state)) {
        const int fibre = fibre_side(p, state, i);
        const double z = p.place[static_cast<std::size_t>(fibre)], A = f.area[i], pull = pull_of(p, state, i, fibre);
        Level& l = levels[std::llround(z / (same_level * p.piece))];
        l.area += A;
        l.position += A * z;
        l.slip += A * slip_of(p, state, i, fibre);
        l.pull += pull;
        l.squares += pull * pull / A;
        l.damage += A * f.damage[i];
        l.tension += A * tension_at(p, state, i, fibre);
        l.has_bonds = l.has_bonds || f.bond_before[i] >= 0 || f.bond_after[i] >= 0;
    }
    FibreProfile profile;
    double carried = 0.0;  // by the shear so far [N]
    for (const auto& [key, l] : levels) {
        const double shear = l.pull / l.area;
        profile.position.push_back(l.position / l.area);
        profile.slip.push_back(l.slip / l.area);
        profile.shear.push_back(shear);
        profile.spread.push_back(std::sqrt(std::max(0.0, l.squares / l.area - shear * shear)));
        profile.damage.push_back(l.damage / l.area);
        profile.stress.push_back((l.has_bonds ? p.fibres * l.tension / l.area : carried + 0.5 * l.pull) / p.section);
        carried += l.pull;
    }
    return profile;
}

PullOutState pull_out_state(const PullOut& p, const State& state)
{
    PullOutState s;
    const Bodies& b = state.bodies;
    double pull = 0.0, others = 0.0, grip = 0.0, support = 0.0;
    int grips = 0, supports = 0;
    for (int i = 0; i < b.size(); ++i) {
        const double shift = dot(b.position[i] - b.start_position[i], p.direction),
                     force = dot(b.force[i], p.direction);
        const bool of_support = b.wall[i] == p.support_wall;
        if (b.wall[i] == p.grip_wall) {
            pull -= force;
            grip += shift;
            ++grips;
        } else if (!of_support || b.held[i] == 0) {
            others += force;
        }
        if (of_support) {
            support += shift;
            ++supports;
        }
    }
    s.end_stress = pull / p.section;
    s.support_stress = (pull - others) / p.section;  // all inner forces add up to nothing
    // where no matrix holds it, the fibre is stretched by what it is pulled with
    const double strain = s.end_stress / p.young_modulus;
    s.end_displacement = grip / std::max(grips, 1) - support / std::max(supports, 1) + p.beyond_grip * strain;
    double slip[2] = {}, area[2] = {};
    const std::vector<int> interfaces = fibre_interfaces(p, state);
    for (const int i : interfaces) {
        const int fibre = fibre_side(p, state, i);
        const char ends = p.at_end[static_cast<std::size_t>(fibre)];
        for (const int k : {0, 1}) {
            if ((ends & (k == 0 ? first_in_matrix : last_in_matrix)) == 0) continue;
            slip[k] += state.interfaces.area[i] * slip_of(p, state, i, fibre);
            area[k] += state.interfaces.area[i];
        }
    }
    if (area[0] > 0.0) s.embedded_slip = slip[0] / area[0];
    if (area[1] > 0.0) s.exit_slip = slip[1] / area[1] + p.before_exit * strain;
    s.mean_damage = mean_damage(state, interfaces);
    return s;
}

std::vector<NamedResult> pull_out_results(const Experiment& e, const std::vector<CurvePoint>&)
{
    const std::vector<PullOutState>& path = e.pull_out->path;
    if (path.empty()) return {};
    const auto largest = [&](double PullOutState::*what) {
        return std::max_element(path.begin(), path.end(),
                                [&](const PullOutState& x, const PullOutState& y) { return x.*what < y.*what; });
    };
    const auto peak = largest(&PullOutState::end_stress), slip = largest(&PullOutState::exit_slip),
               shift = largest(&PullOutState::end_displacement);
    double work = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        work += 0.5 * (path[i].end_stress + path[i - 1].end_stress) *
                (path[i].end_displacement - path[i - 1].end_displacement);
    }
    std::vector<NamedResult> r = {{"peak_stress_Pa", peak->end_stress},
                                  {"exit_slip_at_peak_m", peak->exit_slip},
                                  {"end_displacement_at_peak_m", peak->end_displacement},
                                  {"largest_exit_slip_m", slip->exit_slip},
                                  {"stress_at_largest_slip_Pa", slip->end_stress},
                                  {"largest_end_displacement_m", shift->end_displacement},
                                  {"stress_at_largest_displacement_Pa", shift->end_stress},
                                  {"work_J_per_m2", work},
                                  {"last_mean_damage", path.back().mean_damage}};
    if (!e.pull_out->quasi_static) {
        double most = 0.0;
        for (auto s = path.begin(); s <= peak; ++s)
            most = std::max(most, std::fabs(s->end_stress - s->support_stress) / peak->end_stress);
        r.push_back({"inertia_stress_Pa", e.pull_out->young_modulus * e.speed_of_each_wall / e.wave_speed});
        r.push_back({"largest_imbalance_to_peak", most});
    }
    const auto yield =
        std::find_if(path.begin(), path.end(), [](const PullOutState& s) { return s.mean_damage > 0.0; });
    if (yield != path.begin() && yield != path.end()) {
        const PullOutState& y = *(yield - 1);
        r.push_back({"first_yield_stress_Pa", y.end_stress});
        r.push_back({"first_yield_exit_slip_m", y.exit_slip});
        r.push_back({"first_yield_embedded_slip_m", y.embedded_slip});
        r.push_back({"first_yield_end_displacement_m", y.end_displacement});
    }
    return r;
}

}  // namespace grainfrac
