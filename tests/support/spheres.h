// SPDX-License-Identifier: GPL-3.0-or-later
// Small assemblies of bonded spheres for tests.
#pragma once

#include "generate/spheres.h"
#include "motion/energy.h"
#include "motion/integrate.h"
#include "motion/time_step.h"
#include "support/assembly.h"

namespace grainfrac::test {

SphereBondLaw unbreakable_bond(bool incremental, double damping = 0.0);

/// One material, one bond law, contacts that do nothing; bodies never come near enough to be listed anew.
Assembly sphere_assembly(const SphereBondLaw& law, double density = 1.0);

int sphere(Assembly& a, const Vec3& x, double radius, const Vec3& velocity = {});

void join(Assembly& a, int i, int j, const BondSprings& k, int law = 0);

/// Mass m and inertia 2/5 m R^2 of all spheres, whatever their density.
void set_mass(Assembly& a, int i, double m, double radius);

/// Turns at a spin that nothing changes, about a centre that does not move.
void spin_up(Assembly& a, int i, const Vec3& spin);

/// A row of n spheres along x, bonded, law `law_of(k)` for bond k.
template <class LawOf>
void add_row(Assembly& a, int n, double spacing, double radius, const BondSprings& k, LawOf&& law_of)
{
    for (int i = 0; i < n; ++i) sphere(a, {i * spacing, 0, 0}, radius);
    for (int i = 0; i + 1 < n; ++i) join(a, i, i + 1, k, law_of(i));
}

Quat random_turn(int& draw, double angle);

void set_orientation(State& s, int i, const Quat& q);

/// Move and turn everything as one body.
void move_rigidly(State& s, const Quat& q, const Vec3& centre);

/// Derivative of the resultants (force, torque of every body) by central differences of the kernels; bodies that the
/// mask holds are left out.
Eigen::MatrixXd numerical_stiffness(Assembly& a, const std::vector<int>& unknowns, double length, double angle);

/// Newton iterations on the kernels until the largest correction is below `tolerance` [m]; returns their number.
/// `load`: 6 numbers a body.
int relax(Assembly& a, const std::vector<int>& unknowns, const Eigen::VectorXd& load, double length, double tolerance,
          int most = 50);

}  // namespace grainfrac::test
