// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/assembly.h"

#include "generate/assemble.h"
#include "model/random.h"

#include <Eigen/Sparse>

#include <cmath>
#include <stdexcept>

namespace grainfrac::test {

InterfaceLaw elastic_law()
{
    InterfaceLaw l{};
    l.tensile_strength = l.cohesion = 1e30;
    l.failure = FailureUnit::unbreakable;
    l.mixed_mode_exponent = 2.0;
    return l;
}

GrainSpec grain(Polyhedron shape, const Vec3& site, double dilation)
{
    GrainSpec g;
    g.shape = std::move(shape);
    g.site = site;
    g.dilation_radius = dilation;
    return g;
}

Assembly assemble(std::vector<GrainSpec> grains, double density)
{
    Assembly a;
    a.model.device = default_device();
    a.model.materials = {{"solid", density, 1.0, 0.0}};
    a.model.groups = {{"part", 0, false}};
    a.model.contact_laws.host() = {LinearContact{1.0, 0.0, 0.0, 1.0, 0.0}};
    a.model.contact_law_of = {0};
    a.model.nominal_length = 1.0;
    a.model.skin = 0.1;
    for (const GrainSpec& g : grains) add_grain(a.model, a.state, g);
    a.grains = std::move(grains);
    return a;
}

void bond(Assembly& a, const InterfaceLaw& law, double modulus, double k_n, double shear_ratio, QuadratureRule rule,
          double damping)
{
    a.model.interface_laws.host() = {law};
    BondRule r;
    r.quadrature = rule;
    r.modulus = modulus;
    if (k_n > 0.0) r.normal_stiffness = k_n;
    r.shear_ratio = shear_ratio;
    r.damping = damping;
    bond_shared_faces(a.model, a.state, a.grains, 1, [&](int, int) { return &r; });
    find_face_moments(a.state);
}

void set_position(State& s, int i, const Vec3& x)
{
    s.bodies.position.host()[static_cast<std::size_t>(i)] = x;
}

void shift(State& s, int i, const Vec3& u)
{
    set_position(s, i, s.bodies.position[i] + u);
}

void turn(State& s, int i, const Quat& q)
{
    auto& o = s.bodies.orientation.host()[static_cast<std::size_t>(i)];
    o = normalized(q * o);
}

void drive(State& s, int i, const Vec3& velocity, const Vec3& spin)
{
    const auto k = static_cast<std::size_t>(i);
    s.bodies.inverse_mass.host()[k] = 0.0;
    s.bodies.inverse_inertia.host()[k] = {};
    s.bodies.velocity.host()[k] = velocity;
    s.bodies.angular_velocity.host()[k] = spin;
}

void evaluate_bonds(Assembly& a)
{
    if (a.state.incidence.begin.empty()) build_incidence(a.state);
    bond_forces(a.model, a.state, 0.0);
    gather_forces(a.model, a.state);
}

void solve_static(Assembly& a, const std::vector<Held>& held, const Eigen::VectorXd& load, double tolerance, int most)
{
    State& s = a.state;
    const int n = s.bodies.size();
    std::vector<int> number(static_cast<std::size_t>(6 * n), -1);
    int unknowns = 0;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < 6; ++k) {
            if (!held[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)])
                number[static_cast<std::size_t>(6 * i + k)] = unknowns++;
        }
    }
    const InterfaceBonds& f = s.interfaces;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    for (int round = 0; round < most; ++round) {
        if (round < 2) {
            std::vector<Eigen::Triplet<double>> entries;
            for (int i = 0; i < f.size(); ++i) {
                const Quat qa = s.bodies.orientation[f.a[i]], qb = s.bodies.orientation[f.b[i]];
                const Vec3 m = normalized(rotate(qa, f.normal_a[i]) + rotate(qb, f.normal_b[i]));
                const Eigen::Vector3d e(m.x, m.y, m.z);
                Eigen::Matrix<double, 12, 12> K = Eigen::Matrix<double, 12, 12>::Zero();
                for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
                    const Mat3 ra = Mat3::skew(rotate(qa, s.points.position_a[q])),
                               rb = Mat3::skew(rotate(qb, s.points.position_b[q]));
                    Eigen::Matrix<double, 3, 12> G;
                    for (int r = 0; r < 3; ++r) {
                        for (int c = 0; c < 3; ++c) {
                            G(r, c) = r == c ? -1.0 : 0.0;
                            G(r, c + 3) = ra[r][c];
                            G(r, c + 6) = r == c ? 1.0 : 0.0;
                            G(r, c + 9) = -rb[r][c];
                        }
                    }
                    const double k_n = f.normal_stiffness[i], k_s = f.shear_stiffness[i];
                    K += s.points.weight[q] * G.transpose() *
                         (k_s * Eigen::Matrix3d::Identity() + (k_n - k_s) * e * e.transpose()) * G;
                }
                const auto at = [&](int k) {
                    return number[static_cast<std::size_t>(6 * (k < 6 ? f.a[i] : f.b[i]) + k % 6)];
                };
                for (int r = 0; r < 12; ++r) {
                    for (int c = 0; c < 12; ++c) {
                        if (at(r) >= 0 && at(c) >= 0) entries.emplace_back(at(r), at(c), K(r, c));
                    }
                }
            }
            Eigen::SparseMatrix<double> K(unknowns, unknowns);
            K.setFromTriplets(entries.begin(), entries.end());
            solver.compute(K);
            if (solver.info() != Eigen::Success) throw std::runtime_error("solve_static: singular stiffness");
        }
        evaluate_bonds(a);
        Eigen::VectorXd r = Eigen::VectorXd::Zero(unknowns);
        for (int i = 0; i < n; ++i) {
            const Vec3 force = s.bodies.force[i], torque = s.bodies.torque[i];
            for (int k = 0; k < 6; ++k) {
                const int u = number[static_cast<std::size_t>(6 * i + k)];
                if (u >= 0) r[u] = (k < 3 ? force[k] : torque[k - 3]) + load[6 * i + k];
            }
        }
        const Eigen::VectorXd d = solver.solve(r);
        for (int i = 0; i < n; ++i) {
            Vec3 u, w;
            for (int k = 0; k < 6; ++k) {
                const int at = number[static_cast<std::size_t>(6 * i + k)];
                if (at >= 0) (k < 3 ? u[k] : w[k - 3]) = d[at];
            }
            shift(s, i, u);
            if (norm(w) > 0.0) turn(s, i, from_axis_angle(normalized(w), norm(w)));
        }
        if (d.lpNorm<Eigen::Infinity>() < tolerance) break;
    }
    evaluate_bonds(a);
}

double relative(double found, double expected)
{
    return std::fabs(found - expected) / std::fabs(expected);
}

Vec3 random_vector(int& draw)
{
    const auto u = [&] {
        return 2.0 * uniform_random(7, RandomPurpose::test, static_cast<std::uint32_t>(draw++)) - 1.0;
    };
    const double x = u(), y = u();
    return {x, y, u()};
}

}  // namespace grainfrac::test
