// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/spheres.h"

#include <Eigen/LU>

#include <stdexcept>

namespace grainfrac::test {

SphereBondLaw unbreakable_bond(bool incremental, double damping)
{
    return {{1e30, 1e30, 0.0, 1.0, false, false}, damping, incremental};
}

Assembly sphere_assembly(const SphereBondLaw& law, double density)
{
    Assembly a = assemble({}, density);
    a.model.contact_laws.host() = {LinearContact{0.0, 0.0, 0.0, 1.0, 0.0}};
    a.model.sphere_bond_laws.host() = {law};
    a.model.skin = 1e-3;
    return a;
}

int sphere(Assembly& a, const Vec3& x, double radius, const Vec3& velocity)
{
    SphereSpec s;
    s.position = x;
    s.radius = radius;
    s.velocity = velocity;
    return add_sphere(a.model, a.state, s);
}

void join(Assembly& a, int i, int j, const BondSprings& k, int law)
{
    add_sphere_bond(a.model, a.state, {i, j, 1.0, k, law, 1.0});
}

void set_mass(Assembly& a, int i, double m, double radius)
{
    Bodies& b = a.state.bodies;
    const double I = 0.4 * m * radius * radius;
    b.mass.at(i) = m;
    b.inverse_mass.at(i) = 1.0 / m;
    b.inertia.at(i) = {I, I, I};
    b.inverse_inertia.at(i) = {1.0 / I, 1.0 / I, 1.0 / I};
}

void spin_up(Assembly& a, int i, const Vec3& spin)
{
    constexpr double huge = 1e30;  // moment of inertia [kg m^2]
    Bodies& b = a.state.bodies;
    b.inverse_mass.at(i) = 0.0;
    b.velocity.at(i) = {};
    b.inertia.at(i) = {huge, huge, huge};
    b.inverse_inertia.at(i) = {1.0 / huge, 1.0 / huge, 1.0 / huge};
    set_spin(b, i, spin);
}

Quat random_turn(int& draw, double angle)
{
    const Vec3 w = angle * random_vector(draw);
    return from_axis_angle(normalized(w), norm(w));
}

void set_orientation(State& s, int i, const Quat& q)
{
    s.bodies.orientation.at(i) = q;
}

void move_rigidly(State& s, const Quat& q, const Vec3& centre)
{
    for (int i = 0; i < s.bodies.size(); ++i) {
        set_position(s, i, centre + rotate(q, s.bodies.position[i] - centre));
        turn(s, i, q);
    }
}

Eigen::MatrixXd numerical_stiffness(Assembly& a, const std::vector<int>& unknowns, double length, double angle)
{
    const auto n = static_cast<Eigen::Index>(unknowns.size());
    Eigen::MatrixXd K(n, n);
    const auto resultant = [&](int u) {
        const int i = u / 6, k = u % 6;
        return k < 3 ? a.state.bodies.force[i][k] : a.state.bodies.torque[i][k - 3];
    };
    for (Eigen::Index c = 0; c < n; ++c) {
        const int u = unknowns[static_cast<std::size_t>(c)], i = u / 6, k = u % 6;
        const Vec3 x = a.state.bodies.position[i];
        const Quat q = a.state.bodies.orientation[i];
        Eigen::VectorXd sides[2] = {Eigen::VectorXd(n), Eigen::VectorXd(n)};
        const double step = k < 3 ? length : angle;
        for (const int side : {0, 1}) {
            Vec3 e;
            e[k % 3] = side == 0 ? -1.0 : 1.0;
            if (k < 3)
                set_position(a.state, i, x + step * e);
            else
                set_orientation(a.state, i, normalized(from_axis_angle(e, step) * q));
            evaluate_bonds(a);
            for (Eigen::Index r = 0; r < n; ++r) sides[side][r] = resultant(unknowns[static_cast<std::size_t>(r)]);
        }
        set_position(a.state, i, x);
        set_orientation(a.state, i, q);
        K.col(c) = (sides[0] - sides[1]) / (2.0 * step);
    }
    evaluate_bonds(a);
    return K;
}

int relax(Assembly& a, const std::vector<int>& unknowns, const Eigen::VectorXd& load, double length, double tolerance,
          int most)
{
    for (int round = 1; round <= most; ++round) {
        const Eigen::MatrixXd K = numerical_stiffness(a, unknowns, length, 1e-6);
        Eigen::VectorXd r(K.rows());
        for (Eigen::Index c = 0; c < r.size(); ++c) {
            const int u = unknowns[static_cast<std::size_t>(c)], i = u / 6, k = u % 6;
            r[c] = load[u] + (k < 3 ? a.state.bodies.force[i][k] : a.state.bodies.torque[i][k - 3]);
        }
        const Eigen::VectorXd d = K.partialPivLu().solve(r);
        for (Eigen::Index c = 0; c < r.size(); ++c) {
            const int u = unknowns[static_cast<std::size_t>(c)], i = u / 6, k = u % 6;
            Vec3 e;
            e[k % 3] = d[c];
            if (k < 3)
                shift(a.state, i, e);
            else if (d[c] != 0.0)
                turn(a.state, i, from_axis_angle(normalized(e), norm(e)));
        }
        evaluate_bonds(a);
        if (d.lpNorm<Eigen::Infinity>() < tolerance) return round;
    }
    throw std::runtime_error("relax: no equilibrium found");
}

}  // namespace grainfrac::test
