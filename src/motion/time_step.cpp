// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/time_step.h"

#include "contact/manifold.h"
#include "model/views.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace grainfrac {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Eigen::Vector3d eigen(const Vec3& a)
{
    return {a.x, a.y, a.z};
}

/// Spring of normal and shear stiffness [N/m] with normal n at `arm` from the body's centre.
void add_spring(Matrix6& K, const Vec3& arm, const Vec3& n, double k_n, double k_s)
{
    Eigen::Matrix<double, 3, 6> G;
    const Mat3 s = Mat3::skew(arm);
    G.leftCols<3>().setIdentity();
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) G(r, c + 3) = -s[r][c];
    }
    const Eigen::Vector3d e = eigen(n);
    const Eigen::Matrix3d k = k_s * Eigen::Matrix3d::Identity() + (k_n - k_s) * e * e.transpose();
    K += G.transpose() * k * G;
}

struct Stiffness {
    std::vector<Matrix6> K;           // per body, world axes about its centre
    std::vector<Matrix6> C;           // dashpots of sphere bonds, the same way; empty without any
    std::vector<const char*> source;  // what is stiffest on it
    std::vector<double> strongest;
    std::vector<char> wanted;

    /// Of the bodies that are wanted; the others stay zero.
    explicit Stiffness(std::vector<char> wanted_bodies)
        : K(wanted_bodies.size(), Matrix6::Zero()),
          source(wanted_bodies.size(), ""),
          strongest(wanted_bodies.size(), 0.0),
          wanted(std::move(wanted_bodies))
    {
    }
    bool wants(int a, int b) const
    {
        return wanted[static_cast<std::size_t>(a)] != 0 || wanted[static_cast<std::size_t>(b)] != 0;
    }
    void add(int body, const Vec3& arm, const Vec3& n, double k_n, double k_s, const char* what)
    {
        const auto i = static_cast<std::size_t>(body);
        if (wanted[i] == 0) return;
        add_spring(K[i], arm, n, k_n, k_s);
        if (std::fmax(k_n, k_s) > strongest[i]) {  // the interface of a fibre has no k_n
            strongest[i] = std::fmax(k_n, k_s);
            source[i] = what;
        }
    }
};

void add_interfaces(const State& state, Stiffness& s)
{
    const InterfaceBonds& f = state.interfaces;
    const Bodies& b = state.bodies;
    for (int i = 0; i < f.size(); ++i) {
        if (f.retired[i] != 0 || !s.wants(f.a[i], f.b[i])) continue;
        const Quat qa = b.orientation[f.a[i]], qb = b.orientation[f.b[i]];
        const Vec3 n = normalized(rotate(qa, f.normal_a[i]) + rotate(qb, f.normal_b[i]));
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
            const double w = state.points.weight[q];
            const Vec3 arm_a = rotate(qa, state.points.position_a[q]), arm_b = rotate(qb, state.points.position_b[q]);
            // the forces act half-way between the points, which is far from both where a fibre has slid; and so does
            // the jump: its frame turns by the mean of both bodies, which takes half of the jump off each point's arm
            const Vec3 half = 0.5 * (b.position[f.b[i]] + arm_b - b.position[f.a[i]] - arm_a);
            s.add(f.a[i], arm_a + half, n, w * f.normal_stiffness[i], w * f.shear_stiffness[i], "interface");
            s.add(f.b[i], arm_b - half, n, w * f.normal_stiffness[i], w * f.shear_stiffness[i], "interface");
        }
    }
}

void add_parallels(const State& state, Stiffness& s)
{
    const ParallelBonds& p = state.parallels;
    const Bodies& b = state.bodies;
    for (int i = 0; i < p.size(); ++i) {
        if (p.cause[i] != 0 || !s.wants(p.a[i], p.b[i])) continue;
        const CircularSection c(p.radius[i]);
        const auto side = [&](int body, const Vec3& position, const Vec3& normal) {
            const Quat q = b.orientation[body];
            const Vec3 n = rotate(q, normal), arm = rotate(q, position);
            s.add(body, arm, n, p.normal_stiffness[i] * c.area, p.shear_stiffness[i] * c.area, "parallel bond");
            const Eigen::Vector3d e = eigen(n);
            const double bending = p.normal_stiffness[i] * c.bending, torsion = p.shear_stiffness[i] * c.polar;
            if (s.wanted[static_cast<std::size_t>(body)] == 0) return;
            s.K[static_cast<std::size_t>(body)].bottomRightCorner<3, 3>() +=
                bending * Eigen::Matrix3d::Identity() + (torsion - bending) * e * e.transpose();
        };
        side(p.a[i], p.position_a[i], p.normal_a[i]);
        side(p.b[i], p.position_b[i], p.normal_b[i]);
    }
}

void add_sphere_bonds(const Model& model, const State& state, Stiffness& s)
{
    const SphereBonds& p = state.sphere_bonds;
    const Bodies& b = state.bodies;
    if (p.size() > 0) s.C.assign(s.K.size(), Matrix6::Zero());
    for (int i = 0; i < p.size(); ++i) {
        if (p.cause[i] != 0 || !s.wants(p.a[i], p.b[i])) continue;
        const int bodies[2] = {p.a[i], p.b[i]};
        const Vec3 branch = b.position[bodies[1]] - b.position[bodies[0]];
        BondGeometry g;
        g.length = norm(branch);
        g.e = branch / g.length;
        const SphereBondKind& kind = p.kind_of(i);
        g.rest = kind.length;
        g.share = kind.share;
        const BondSprings k{kind.normal_stiffness, kind.shear_stiffness, kind.bending_stiffness, kind.twist_stiffness};
        const BondMasses m(g, b.inverse_mass[bodies[0]], b.inverse_mass[bodies[1]], b.inverse_inertia[bodies[0]].x,
                           b.inverse_inertia[bodies[1]].x);
        const double zeta = model.dashpots_active ? model.sphere_bond_laws[p.law[i]].damping : 0.0;
        const BondDashpots c(zeta, k, m);
        const Vec3 arms[2] = {g.arm_a() * g.e, -g.arm_b() * g.e};
        const Eigen::Vector3d e = eigen(g.e);
        const Eigen::Matrix3d ee = e * e.transpose(), rest = Eigen::Matrix3d::Identity() - ee;
        for (const int side : {0, 1}) {
            const auto body = static_cast<std::size_t>(bodies[side]);
            if (s.wanted[body] == 0) continue;
            s.add(bodies[side], arms[side], g.e, k.normal, k.shear, "bond");
            s.K[body].bottomRightCorner<3, 3>() += k.bending * rest + k.twist * ee;
            if (zeta == 0.0) continue;
            add_spring(s.C[body], arms[side], g.e, c.normal, c.shear);
            s.C[body].bottomRightCorner<3, 3>() += c.bending * rest + c.twist * ee;
        }
    }
}

/// Active contacts with their manifold. A grain near a wall counts as touching it with a whole face: platens touch
/// first and are the stiffest. `nearby`: every pair of the neighbour list counts, with its reference area.
void add_contacts(const Model& model, const State& state, Stiffness& s, bool nearby = false)
{
    const CandidatePairs& pairs = state.pairs;
    const Contacts& c = state.contacts;
    const Bodies& b = state.bodies;
    for (int i = 0; i < pairs.size(); ++i) {
        const int bodies[2] = {pairs.a[i], pairs.b[i]}, contact = pairs.contact[i];
        if (!s.wants(bodies[0], bodies[1])) continue;
        if (contact >= 0 ? c.found[contact] == held_by_bonds : contact == no_contact::held) continue;
        const LinearContact law = model.contact_laws[pairs.law[i]];
        const ContactPoint p = contact >= 0 ? c.point[contact] : ContactPoint{};
        const bool with_wall = b.inverse_mass[bodies[0]] == 0.0 || b.inverse_mass[bodies[1]] == 0.0;
        if (p.overlap_energy <= 0.0 && !with_wall && !nearby) continue;
        double area = p.area;
        Vec3 arm[2] = {p.position - b.position[bodies[0]], p.position - b.position[bodies[1]]}, normal = p.normal;
        if (with_wall)
            area = std::fmax(
                area, model.shapes.largest_face[b.shape[b.inverse_mass[bodies[0]] > 0.0 ? bodies[0] : bodies[1]]]);
        if (nearby) {
            area = std::fmax(area, std::fmin(model.shapes.point_area[b.shape[bodies[0]]],
                                             model.shapes.point_area[b.shape[bodies[1]]]));
        }
        if (p.overlap_energy <= 0.0) {  // where it will touch is not known yet: through the centre, square to the gap
            const ShapesView shapes = view(model.shapes, Device::cpu);
            const ContactBody x{shapes, b.shape[bodies[0]], b.position[bodies[0]], b.orientation[bodies[0]]};
            const ContactBody y{shapes, b.shape[bodies[1]], b.position[bodies[1]], b.orientation[bodies[1]]};
            const ClosestPoints near = closest_points(x.core(), y.core(), y.position - x.position);
            if (near.distance <= 0.0 || near.distance - x.radius() - y.radius() > model.skin) continue;
            normal = (near.b - near.a) * (1.0 / near.distance);
            arm[0] = arm[1] = Vec3{};
        }
        const double scale = contact >= 0 ? c.stiffness_scale[contact] : 1.0;
        const double k = law.area_stiffness * scale * area * law.unload_factor;
        for (const int side : {0, 1}) {
            // a force next to nothing beside a couple has its line of action far away; a whole face has not
            const double reach = model.shapes.bounding_radius[b.shape[bodies[side]]], length = norm(arm[side]);
            if (length > reach) arm[side] *= reach / length;
            if (b.inverse_mass[bodies[side]] > 0.0) {
                s.add(bodies[side], arm[side], normal, k, law.shear_ratio * k,
                      with_wall ? "contact with a wall" : "contact");
            }
        }
    }
}

/// Largest eigenvalue of M^-1 K of one body [1/s^2].
double largest_eigenvalue(const Bodies& b, int i, const Matrix6& K)
{
    // turn the rotational part to the principal frame, where M is diagonal
    const Mat3 r = to_matrix(b.orientation[i]);
    Matrix6 T = Matrix6::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int col = 0; col < 3; ++col) T(row + 3, col + 3) = r[row][col];
    }
    Eigen::Matrix<double, 6, 1> half;  // M^-1/2
    const double m = std::sqrt(b.inverse_mass[i]);
    const Vec3 j = b.inverse_inertia[i];
    half << m, m, m, std::sqrt(j.x), std::sqrt(j.y), std::sqrt(j.z);
    const Matrix6 A = half.asDiagonal() * (T.transpose() * K * T) * half.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Matrix6>(A, Eigen::EigenvaluesOnly).eigenvalues()[5];
}

/// Largest zeta at the highest frequency: a dashpot of ratio zeta at its own frequency has zeta omega/omega_own there.
double damping_at(const State& state, const Model& model, double omega)
{
    double worst = 0.0;
    const InterfaceBonds& f = state.interfaces;
    for (int i = 0; i < f.size(); ++i) {
        if (f.normal_stiffness[i] > 0.0 && f.retired[i] == 0)
            worst = std::fmax(worst, 0.5 * omega * f.normal_damping[i] / f.normal_stiffness[i]);
        if (f.shear_stiffness[i] > 0.0 && f.retired[i] == 0)
            worst = std::fmax(worst, 0.5 * omega * f.shear_damping[i] / f.shear_stiffness[i]);
    }
    const ParallelBonds& p = state.parallels;
    for (int i = 0; i < p.size(); ++i) {
        const double k = p.normal_stiffness[i] * CircularSection(p.radius[i]).area;
        if (p.cause[i] == 0) worst = std::fmax(worst, 0.5 * omega * p.normal_damping[i] / k);
    }
    // a contact's dashpot is 2 zeta sqrt(K m*): whatever its area, its ratio at omega >= sqrt(K/m*) is at most zeta
    for (const std::int32_t law : state.pairs.law.host())
        worst = std::fmax(worst, model.contact_laws[law].damping_ratio);
    return worst;
}

/// Steps that the collision of a loose body takes at least; fewer, and its rebound is wrong though the run is stable.
constexpr double steps_per_collision = 50.0;
/// Part of its dilation radius that a loose body may move in a step; more, and it may pass into the other's core.
constexpr double travel_per_step = 0.1;

/// Bodies without bonds live on impacts: resolve half the period of the stiffest contact they may have, and their
/// speed. Of what broke off only where the test is about impacts: else a splinter would slow the rest down for a
/// rebound that nobody asks for; it stays stable like all contacts.
void limit_for_loose_bodies(const Model& model, const State& state, const std::vector<char>& wanted,
                            TimeStepBound& bound)
{
    const Bodies& b = state.bodies;
    enum : char { loose, fragment, bonded };  // never had a bond, has none left, has one
    std::vector<char> held(static_cast<std::size_t>(b.size()), loose);
    const auto mark = [&](const auto& bonds, const auto& gone) {
        for (int i = 0; i < bonds.size(); ++i) {
            for (const int body : {bonds.a[i], bonds.b[i]}) {
                char& h = held[static_cast<std::size_t>(body)];
                h = std::max<char>(h, gone[i] != 0 ? fragment : bonded);
            }
        }
    };
    mark(state.interfaces, state.interfaces.retired);
    mark(state.parallels, state.parallels.cause);
    mark(state.sphere_bonds, state.sphere_bonds.cause);
    double stiffest = 0.0;
    for (const LinearContact& law : model.contact_laws.host())
        stiffest = std::fmax(stiffest, law.area_stiffness * law.unload_factor);
    for (int i = 0; i < b.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (b.inverse_mass[i] == 0.0 || held[k] == bonded || wanted[k] == 0) continue;
        const bool rebounds = held[k] == loose || model.resolve_impacts;
        const double K = stiffest * model.shapes.largest_face[b.shape[i]];
        const double collision =
            K > 0.0 && rebounds ? std::numbers::pi / std::sqrt(K * b.inverse_mass[i]) / steps_per_collision : 0.0;
        const double speed = norm(b.velocity[i]);
        const double passage = speed > 0.0 ? travel_per_step * model.shapes.radius[b.shape[i]] / speed : 0.0;
        for (const double limit : {collision, passage}) {
            if (limit <= 0.0 || (bound.critical > 0.0 && limit >= bound.critical)) continue;
            bound.critical = limit;
            bound.body = i;
            bound.limiter =
                "body " + std::to_string(b.id[i]) + (limit == collision ? ", its collisions" : ", its speed");
        }
    }
}

TimeStepBound bound_of(const Model& model, const State& state, const std::vector<char>& wanted)
{
    Stiffness s(wanted);
    add_interfaces(state, s);
    add_parallels(state, s);
    add_sphere_bonds(model, state, s);
    add_contacts(model, state, s);
    double largest = 0.0, damped = 0.0;  // [1/s^2]; shortest step by a body's own dashpots [s]
    TimeStepBound bound;
    for (int i = 0; i < state.bodies.size(); ++i) {
        const bool moves = state.bodies.inverse_mass[i] > 0.0 || norm2(state.bodies.inverse_inertia[i]) > 0.0;
        if (!moves || s.strongest[static_cast<std::size_t>(i)] == 0.0) continue;
        const double lambda = largest_eigenvalue(state.bodies, i, s.K[static_cast<std::size_t>(i)]);
        if (lambda > largest) {
            largest = lambda;
            bound.body = i;
        }
        if (s.C.empty() || s.C[static_cast<std::size_t>(i)].isZero()) continue;
        // dt^2 K + 2 dt C <= 4 M, each sum over pairs bounded by twice the blocks on the diagonal
        const double c = largest_eigenvalue(state.bodies, i, s.C[static_cast<std::size_t>(i)]);
        const double step = (std::sqrt(c * c + 2.0 * lambda) - c) / lambda;
        damped = damped > 0.0 ? std::fmin(damped, step) : step;
    }
    if (bound.body >= 0) {
        bound.critical = std::sqrt(2.0 / largest);
        bound.limiter = "body " + std::to_string(state.bodies.id[bound.body]) +
                        ", stiffest spring: " + s.source[static_cast<std::size_t>(bound.body)];
    }
    limit_for_loose_bodies(model, state, wanted, bound);
    if (bound.body < 0) return bound;
    const double zeta = damping_at(state, model, 2.0 / bound.critical);
    bound.with_damping = bound.critical * (std::sqrt(1.0 + zeta * zeta) - zeta);
    if (damped > 0.0) bound.with_damping = std::fmin(bound.with_damping, damped);
    return bound;
}

}  // namespace

TimeStepBound time_step_bound(const Model& model, const State& state)
{
    return bound_of(model, state, std::vector<char>(static_cast<std::size_t>(state.bodies.size()), 1));
}

std::vector<FictitiousMass> fictitious_masses(const Model& model, const State& state, double dt, double safety)
{
    const Bodies& b = state.bodies;
    Stiffness s(std::vector<char>(static_cast<std::size_t>(b.size()), 1));
    add_interfaces(state, s);
    add_parallels(state, s);
    add_sphere_bonds(model, state, s);
    add_contacts(model, state, s, true);
    std::vector<FictitiousMass> masses(s.K.size());
    for (int i = 0; i < b.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (s.strongest[k] == 0.0) continue;
        // each block by itself, then both together with their coupling
        Matrix6 K = s.K[k];
        const double t = s.K[k].topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
        const Vec3 I = b.inertia[i];
        const double least = std::min({I.x, I.y, I.z});
        const double r =
            s.K[k].bottomRightCorner<3, 3>().selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff() / least;
        Eigen::Matrix<double, 6, 1> half;
        const double m = 1.0 / std::sqrt(t), j = r > 0.0 ? 1.0 / std::sqrt(r * least) : 0.0;
        half << m, m, m, j, j, j;
        K = half.asDiagonal() * K * half.asDiagonal();
        const double both = Eigen::SelfAdjointEigenSolver<Matrix6>(K, Eigen::EigenvaluesOnly).eigenvalues()[5];
        const double scale = 0.5 * dt * dt / (safety * safety) * both;
        masses[k] = {scale * t, scale * r};
    }
    return masses;
}

TimeStepBound time_step_bound(const Model& model, const State& state, const std::vector<int>& bodies)
{
    std::vector<char> wanted(static_cast<std::size_t>(state.bodies.size()), 0);
    for (const int i : bodies) wanted[static_cast<std::size_t>(i)] = 1;
    return bound_of(model, state, wanted);
}

}  // namespace grainfrac
