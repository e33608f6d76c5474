// SPDX-License-Identifier: GPL-3.0-or-later
// A patch that has slid far: its jump is measured in a frame that turns by the mean of both bodies, so that its springs
// act on the motion of the point half-way between its two points, where its forces act too.
#include "model/point_history.h"
#include "motion/time_step.h"
#include "support/spheres.h"

#include <Eigen/Eigenvalues>

using namespace grainfrac;
using namespace grainfrac::test;

TEST_CASE("the stiffness of a patch that has slid is that of springs half-way between its points")
{
    const double k_n = 5000.0, k_s = 2000.0, slid = 0.8, closed = 1e-7;
    InterfaceLaw law = elastic_law();
    law.failure = FailureUnit::point;
    law.residual_shear = 1e30;  // friction sticks
    Assembly a = assemble({grain(make_box({1, 1, 0.7}, {-0.5, 0, 0}), {-0.5, 0, 0}),
                           grain(make_box({1, 1, 0.7}, {0.5, 0, 0}), {0.5, 0, 0})});
    bond(a, law, 0.0, k_n, k_s / k_n);
    State& s = a.state;
    InterfaceBonds& f = s.interfaces;
    const InterfacePoints& p = s.points;
    REQUIRE(f.size() == 1);
    const auto in_space = [&](int body, const Vec3& v) { return rotate(s.bodies.orientation[body], v); };
    const Vec3 n = in_space(0, f.normal_a[0]), t1 = in_space(0, f.tangent_a[0]), t2 = cross(n, t1);
    const Vec3 way = {0, 0.6 * slid, 0.8 * slid};
    shift(s, 1, way - closed * n);
    f.slip_limit.at(0) = 1e30;
    f.first_damage_time.at(0) = 0.0;
    a.model.fracture_active = false;
    for (int q = 0; q < p.weight.size(); ++q) {  // broken, and without force where it has come to
        set_point_state(s, 0, q, {1.0, 1e-9, 1e-9, dot(way, t1), dot(way, t2)});
    }
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 12);
    for (int q = 0; q < p.weight.size(); ++q) {
        const Vec3 point_a = s.bodies.position[0] + in_space(0, p.position_a[q]),
                   point_b = s.bodies.position[1] + in_space(1, p.position_b[q]);
        Eigen::Matrix<double, 3, 12> B = Eigen::Matrix<double, 3, 12>::Zero();  // motion at the middle, b less a
        for (const int side : {0, 1}) {
            const Vec3 arm = 0.5 * (point_a + point_b) - s.bodies.position[side];
            for (int k = 0; k < 3; ++k) {
                Vec3 e;
                e[k] = side == 0 ? -1.0 : 1.0;
                const Vec3 turned = cross(e, arm);
                for (int r = 0; r < 3; ++r) {
                    B(r, 6 * side + k) = e[r];
                    B(r, 6 * side + 3 + k) = turned[r];
                }
            }
        }
        const Eigen::Vector3d e(n.x, n.y, n.z);
        const Eigen::Matrix3d k = k_s * Eigen::Matrix3d::Identity() + (k_n - k_s) * e * e.transpose();
        expected += p.weight[q] * B.transpose() * k * B;
    }
    std::vector<int> unknowns;
    for (int u = 0; u < 12; ++u) unknowns.push_back(u);
    const Eigen::MatrixXd found = numerical_stiffness(a, unknowns, 1e-8, 1e-8);
    CHECK((found - expected).norm() < 1e-6 * expected.norm());
    // and the stable step is a bound for it
    Eigen::VectorXd inverse_mass(12);
    for (int i = 0; i < 2; ++i) {
        const Vec3 turned = in_space(i, s.bodies.inverse_inertia[i]);  // principal axes of a box: these, in some order
        for (int k = 0; k < 3; ++k) {
            inverse_mass[6 * i + k] = s.bodies.inverse_mass[i];
            inverse_mass[6 * i + 3 + k] = std::fabs(turned[k]);
        }
    }
    const double fastest = (inverse_mass.asDiagonal() * found).eval().eigenvalues().cwiseAbs().maxCoeff();  // omega^2
    const double limit = 2.0 / std::sqrt(fastest), bound = time_step_bound(a.model, a.state).critical;
    CHECK(bound <= limit * (1.0 + 1e-6));
    CHECK(bound > 0.7 * limit);
}
