// SPDX-License-Identifier: GPL-3.0-or-later
// Small assemblies for tests, and a static solver that drives the real force kernels to equilibrium.
#pragma once

#include "contact/gather.h"
#include "fracture/bond_forces.h"
#include "fracture/face_moments.h"
#include "generate/assemble.h"
#include "geometry/cut.h"
#include "gpu/device.h"
#include "motion/step.h"

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace grainfrac::test {

struct Assembly {
    Model model;
    State state;
    std::vector<GrainSpec> grains;
};

InterfaceLaw elastic_law();

GrainSpec grain(Polyhedron shape, const Vec3& site, double dilation = 0.05);

/// Grains of one material (density 1 unless told) in one part.
Assembly assemble(std::vector<GrainSpec> grains, double density = 1.0);

/// Interfaces of one law on all shared faces; k_n = modulus/h, or `k_n` if > 0.
void bond(Assembly& a, const InterfaceLaw& law, double modulus, double k_n, double shear_ratio,
          QuadratureRule rule = QuadratureRule::automatic, double damping = 0.0);

void set_position(State& s, int i, const Vec3& x);
void shift(State& s, int i, const Vec3& u);
void turn(State& s, int i, const Quat& q);
/// Driven from now on: keeps its velocity whatever acts on it.
void drive(State& s, int i, const Vec3& velocity = {}, const Vec3& spin = {});

/// Forces at the present configuration, without moving (bonds only).
void evaluate_bonds(Assembly& a);

/// Which of the six degrees of freedom of a body are held.
using Held = std::array<bool, 6>;

/// Newton iterations on the real kernels with the analytic stiffness of undamaged interfaces, until the largest
/// correction is below `tolerance` [m]. `load`: force and torque on each body, 6 numbers a body.
void solve_static(Assembly& a, const std::vector<Held>& held, const Eigen::VectorXd& load, double tolerance = 1e-14,
                  int most = 30);

double relative(double found, double expected);

Vec3 random_vector(int& draw);

}  // namespace grainfrac::test
