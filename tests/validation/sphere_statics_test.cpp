// SPDX-License-Identifier: GPL-3.0-or-later
// Bonded spheres at rest: beam, string, lattices; plane waves by the stiffness of the kernels. Closed forms:
// docs/theory/sphere_bonds.md, sections 6 and 7.
#include "generate/packings.h"
#include "support/spheres.h"

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <complex>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr int nodes = 50;
constexpr double spacing = 2.0, modulus = 1e9, weight = 2.0;  // [m], [Pa], of a node [N]

Assembly row(bool incremental, const BondSprings& k)
{
    Assembly a = sphere_assembly(unbreakable_bond(incremental));
    add_row(a, nodes, spacing, 1.0, k, [](int) { return 0; });
    return a;
}

Eigen::VectorXd weights()
{
    Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * nodes);
    for (int i = 1; i + 1 < nodes; ++i) load[6 * i + 2] = -weight;
    return load;
}

}  // namespace

TEST_CASE("a bonded chain on two supports bends as a beam, node by node")
{
    const double k_n = modulus / spacing, L = (nodes - 1) * spacing, q = weight / spacing;
    const CircularSection c(1.0);
    const double EI = modulus * c.bending;
    for (const double ratio : {1.0, 1.0 / 2.6, 0.375, 0.1}) {
        Assembly a = row(false, circular_bond(k_n, ratio * k_n, 1.0, true));
        std::vector<int> unknowns;
        for (int i = 0; i < nodes; ++i) {
            const bool end = i == 0 || i == nodes - 1;
            if (i != 0) unknowns.push_back(6 * i);
            if (!end) unknowns.push_back(6 * i + 2);
            unknowns.push_back(6 * i + 4);
        }
        relax(a, unknowns, weights(), 1e-5, 1e-12);
        double worst = 0.0, most = 0.0;
        for (int i = 0; i < nodes; ++i) {
            const double x = i * spacing;
            const double euler = q * x * (L * L * L - 2.0 * L * x * x + x * x * x) / (24.0 * EI);
            const double w = euler - q * spacing * spacing * x * (L - x) / (12.0 * EI) +
                             q * x * (L - x) / (2.0 * spacing * ratio * k_n * c.area);
            worst = std::max(worst, std::fabs(-a.state.bodies.position[i].z - w));
            most = std::max(most, w);
            if (ratio == 0.375) CHECK(w == Approx(euler).epsilon(1e-12).margin(1e-15));
        }
        CHECK(worst < 1e-6 * most);
    }
}

TEST_CASE("a chain without moments hangs as a string of links, node by node")
{
    // Rotations are free and no shear is left in equilibrium, so that the incremental form at rest is the normal law.
    struct Reference {
        double span, pull, sag;
    };
    for (const Reference& r : {Reference{98.0, 10791.172, 0.111201818}, Reference{90.0, 62.414155, 16.9298619},
                               Reference{80.0, 35.528760, 24.9860499}}) {
        const double K = circular_bond(modulus / spacing, 0.0, 1.0, false).normal;
        Assembly a = row(true, circular_bond(modulus / spacing, modulus / spacing, 1.0, false));
        // links of one length along a parabola, slightly off
        std::vector<int> unknowns;
        for (int i = 1; i + 1 < nodes; ++i) {
            for (const int k : {0, 2}) unknowns.push_back(6 * i + k);
        }
        Vec3 x;
        for (int i = 0; i < nodes; ++i) {
            set_position(a.state, i, x);
            const double V = weight * (nodes / 2.0 - (i + 1)), T = std::hypot(r.pull, V);
            const double length = spacing * (1.0 + T / (K * spacing));
            x += Vec3{length * r.pull / T, 0, -length * V / T};
        }
        const std::vector<Vec3> expected = a.state.bodies.position.host();
        CHECK(expected.back().x == Approx(r.span).epsilon(1e-6));
        CHECK(-expected[24].z == Approx(r.sag).epsilon(1e-6));
        set_position(a.state, nodes - 1, {r.span, 0, 0});
        int draw = 0;
        for (int i = 1; i + 1 < nodes; ++i) {
            const Vec3 off = 1e-4 * random_vector(draw);
            shift(a.state, i, {off.x, 0, off.z});
        }
        relax(a, unknowns, weights(), 1e-7, 1e-10, 200);
        double worst = 0.0;
        for (int i = 0; i < nodes; ++i)
            worst = std::max(worst, norm(a.state.bodies.position[i] - expected[static_cast<std::size_t>(i)]));
        CHECK(worst < 1e-6 * r.span);
        CHECK(a.state.bodies.force[0].x == Approx(r.pull).epsilon(1e-6));
    }
}

namespace {

/// A lattice cell: basis, vectors, and every bond that a basis sphere has, with bodies for the images.
struct Lattice {
    Assembly a;
    double volume = 0.0;
    int basis = 0;
    std::vector<int> kind;      // of each body: the basis sphere that it is an image of
    std::vector<Vec3> site;     // unstrained [m]
    std::vector<int> bonds_of;  // basis sphere that bond k belongs to; each bond is there from both its ends

    Lattice(const std::vector<Vec3>& vectors, const std::vector<Vec3>& places, const BondSprings& k, double density)
        : a(sphere_assembly(unbreakable_bond(false), density)),
          volume(std::fabs(dot(vectors[0], cross(vectors[1], vectors[2])))),
          basis(static_cast<int>(places.size()))
    {
        for (int i = 0; i < basis; ++i) add(places[static_cast<std::size_t>(i)], i);
        for (int i = 0; i < basis; ++i) {
            for (int j = 0; j < basis; ++j) {
                for (int n = 0; n < 125; ++n) {
                    const Vec3 x = places[static_cast<std::size_t>(j)] + (n % 5 - 2.0) * vectors[0] +
                                   (n / 5 % 5 - 2.0) * vectors[1] + (n / 25 - 2.0) * vectors[2];
                    const double r = norm(x - site[static_cast<std::size_t>(i)]);
                    if (r < 0.5 || r > 1.0 + 1e-9) continue;
                    const int image = add(x, j);
                    join(a, i, image, k);
                    bonds_of.push_back(i);
                }
            }
        }
        build_incidence(a.state);
    }
    int add(const Vec3& x, int k)
    {
        kind.push_back(k);
        site.push_back(x);
        return sphere(a, x, 0.5);
    }

    /// Strain, displacement and turn of every body, then the force and torque on the basis spheres and the stress
    /// times the volume, the last as it works on a strain: 6 numbers each sphere and 9.
    template <class Motion>
    Eigen::VectorXd respond(Motion&& motion)
    {
        for (int i = 0; i < a.state.bodies.size(); ++i) {
            Vec3 u, w;
            motion(site[static_cast<std::size_t>(i)], kind[static_cast<std::size_t>(i)], u, w);
            set_position(a.state, i, site[static_cast<std::size_t>(i)] + u);
            set_orientation(a.state, i, norm(w) > 0.0 ? from_axis_angle(normalized(w), norm(w)) : Quat{});
        }
        evaluate_bonds(a);
        Eigen::VectorXd r = Eigen::VectorXd::Zero(6 * basis + 9);
        for (int i = 0; i < basis; ++i) {
            for (int k = 0; k < 3; ++k) {
                r[6 * i + k] = a.state.bodies.force[i][k];
                r[6 * i + 3 + k] = a.state.bodies.torque[i][k];
            }
        }
        const SphereBonds& s = a.state.sphere_bonds;
        for (int b = 0; b < s.size(); ++b) {  // half of each bond, from the strained branch: du = strain . site
            const Vec3 d = site[static_cast<std::size_t>(s.b[b])] - site[static_cast<std::size_t>(s.a[b])];
            for (int k = 0; k < 9; ++k) r[6 * basis + k] -= 0.5 * a.state.slots.force[b][k / 3] * d[k % 3];
        }
        return r;
    }
};

Lattice fcc(const BondSprings& k, double density)
{
    const double h = std::sqrt(0.5);
    return {{{h, h, 0}, {h, 0, h}, {0, h, h}}, {{}}, k, density};
}
Lattice hcp(const BondSprings& k, double density)
{
    return {{{1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0, 0, std::sqrt(8.0 / 3.0)}},
            {{}, {0.5, std::sqrt(1.0 / 12.0), std::sqrt(2.0 / 3.0)}},
            k,
            density};
}

/// Elastic constants in Voigt order, internal displacements and turns relaxed.
Eigen::Matrix<double, 6, 6> elastic_constants(Lattice l)
{
    constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const int inner = 6 * l.basis;
    const double h = 1e-5;
    Eigen::MatrixXd K(inner + 6, inner + 6);  // derivative of -(force, torque) and of the stress
    for (int c = 0; c < inner + 6; ++c) {
        Eigen::VectorXd side[2];
        for (const int s : {0, 1}) {
            const double step = s == 0 ? h : -h;
            side[s] = l.respond([&](const Vec3& x, int kind, Vec3& u, Vec3& w) {
                if (c < inner) {
                    if (kind == c / 6) (c % 6 < 3 ? u[c % 6] : w[c % 6 - 3]) = step;
                    return;
                }
                const int p = voigt[c - inner][0], q = voigt[c - inner][1];
                u[p] += (p == q ? 1.0 : 0.5) * step * x[q];
                if (p != q) u[q] += 0.5 * step * x[p];
            });
        }
        const Eigen::VectorXd d = (side[0] - side[1]) / (2.0 * h);
        for (int r = 0; r < inner; ++r) K(r, c) = -d[r];
        for (int r = 0; r < 6; ++r) {
            const int p = voigt[r][0], q = voigt[r][1];
            K(inner + r, c) = 0.5 * (d[inner + 3 * p + q] + d[inner + 3 * q + p]);
        }
    }
    const auto Kii = K.topLeftCorner(inner, inner);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-7);  // three translations cost nothing
    solver.compute(Kii);
    return (K.bottomRightCorner(6, 6) - K.bottomLeftCorner(6, inner) * solver.solve(K.topRightCorner(inner, 6))) /
           l.volume;
}

}  // namespace

TEST_CASE("close-packed lattices have their closed elastic constants")
{
    const double s = std::numbers::sqrt2;
    for (const double lambda : {0.0, 0.01, 0.3, 1.0}) {
        // moments keep the turns of a lattice without shear from being free; they do not enter
        const double K = 1.0, S = lambda, tolerance = 1e-8;
        const BondSprings k{K, S, 0.2, 0.1};
        const Eigen::Matrix<double, 6, 6> F = elastic_constants(fcc(k, 1.0)), H = elastic_constants(hcp(k, 1.0));
        const auto check = [&](double found, double expected) { CHECK(std::fabs(found - expected) < tolerance); };
        check(F(0, 0), s * (K + S));
        check(F(0, 1), s * (K - S) / 2.0);
        check(F(3, 3), s * (K + S) / 2.0);
        const double q = K + 5.0 * S;
        check(H(0, 0), s * (29.0 * K * K + 170.0 * K * S + 89.0 * S * S) / (24.0 * q));
        check(H(0, 1), s * (K - S) * (11.0 * K + 49.0 * S) / (24.0 * q));
        check(H(0, 2), s * (K - S) / 3.0);
        check(H(2, 2), 2.0 * s * (2.0 * K + S) / 3.0);
        check(H(3, 3), s * (K + 2.0 * S) / 3.0);
        check(H(5, 5), 0.5 * (H(0, 0) - H(0, 1)));  // isotropic about c
        const Eigen::Matrix3d compliance = H.topLeftCorner<3, 3>().inverse();
        check(1.0 / compliance(2, 2), 6.0 * s * K * (1.0 + lambda) / (5.0 + lambda));
        check(-compliance(0, 2) / compliance(2, 2), (1.0 - lambda) / (5.0 + lambda));
    }
}

namespace {

/// The three slowest plane waves of a lattice along a unit vector, of 20 spacings [m/s].
std::array<double, 3> wave_speeds(Lattice l, const Vec3& direction)
{
    const double k = 2.0 * std::numbers::pi / 20.0, h = 1e-6;
    const int n = 6 * l.basis;
    Eigen::MatrixXcd D(n, n);
    for (int c = 0; c < n; ++c) {
        for (const int part : {0, 1}) {  // real and imaginary part of exp(i k x)
            const Eigen::VectorXd r = l.respond([&](const Vec3& x, int kind, Vec3& u, Vec3& w) {
                if (kind != c / 6) return;
                const double phase = k * dot(direction, x);
                (c % 6 < 3 ? u[c % 6] : w[c % 6 - 3]) = h * (part == 0 ? std::cos(phase) : std::sin(phase));
            });
            for (int i = 0; i < n; ++i) {
                const std::complex<double> back =
                    std::exp(std::complex<double>(0.0, -k * dot(direction, l.site[static_cast<std::size_t>(i / 6)])));
                const auto value = -r[i] / h * back * (part == 0 ? 1.0 : std::complex<double>(0.0, 1.0));
                D(i, c) = part == 0 ? value : D(i, c) + value;
            }
        }
    }
    const Bodies& b = l.a.state.bodies;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const auto mass = [&](int u) { return u % 6 < 3 ? b.mass[u / 6] : b.inertia[u / 6].x; };
            D(i, j) /= std::sqrt(mass(i) * mass(j));
        }
    }
    const Eigen::VectorXd squares =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(0.5 * (D + D.adjoint())).eigenvalues();
    return {std::sqrt(squares[0]) / k, std::sqrt(squares[1]) / k, std::sqrt(squares[2]) / k};
}

}  // namespace

TEST_CASE("plane waves in close-packed lattices have their closed speeds")
{
    // dispersion (k d)^2/24 = 0.4 % at 20 spacings a wave
    const double K = 3.0, S = 0.9, m = 1.0;
    const double density = m / (4.0 / 3.0 * std::numbers::pi * 0.125);
    const BondSprings k{K, S, 0.0, 0.0};
    const std::array<double, 3> f = wave_speeds(fcc(k, density), {1, 0, 0});
    CHECK(f[0] == Approx(std::sqrt((K + S) / (2.0 * m))).epsilon(5e-3));
    CHECK(f[1] == Approx(f[0]).epsilon(1e-6));
    CHECK(f[2] == Approx(std::sqrt((K + S) / m)).epsilon(5e-3));
    const std::array<double, 3> h = wave_speeds(hcp(k, density), {0, 0, 1});
    CHECK(h[0] == Approx(std::sqrt((K + 2.0 * S) / (3.0 * m))).epsilon(5e-3));
    CHECK(h[1] == Approx(h[0]).epsilon(1e-6));
    CHECK(h[2] == Approx(std::sqrt(2.0 * (2.0 * K + S) / (3.0 * m))).epsilon(5e-3));
}

namespace {

/// Stiffness of one bond from its kernel: 12 x 12, first body a.
Eigen::Matrix<double, 12, 12> bond_stiffness(const Vec3& branch, const BondSprings& k)
{
    Assembly a = sphere_assembly(unbreakable_bond(false));
    sphere(a, {}, 0.5 * norm(branch));
    sphere(a, branch, 0.5 * norm(branch));
    join(a, 0, 1, k);
    std::vector<int> all(12);
    for (int i = 0; i < 12; ++i) all[static_cast<std::size_t>(i)] = i;
    const Eigen::Matrix<double, 12, 12> K = numerical_stiffness(a, all, 1e-5, 1e-5);
    return 0.5 * (K + K.transpose());
}

struct Pulled {
    double modulus = 0.0, poisson = 0.0;
};

/// Cylinder of hcp spheres, R = 6, L = 30, whose end levels are moved apart along the axis and slide across it.
Pulled pull_cylinder(double d, const BondSprings& k)
{
    Case c;
    c.materials.push_back({"solid", 1.0, 1.0, 0.0, {}});
    PartSpec part;
    part.name = "rod";
    part.kind = "spheres";
    part.material = "solid";
    part.generator = "hcp";
    part.diameter = d;
    part.region.shape = "cylinder";
    part.region.diameter = 12.0;
    part.region.height = 30.0;
    c.parts.push_back(part);
    const std::vector<SphereSpec> all = generate_spheres(c);
    const int n = static_cast<int>(all.size());
    double low = 1e300, high = -1e300;
    for (const SphereSpec& s : all) {
        low = std::min(low, s.position.z);
        high = std::max(high, s.position.z);
    }
    std::vector<int> number(static_cast<std::size_t>(6 * n));  // -1: low end, -2: high end
    int unknowns = 0;
    for (int i = 0; i < n; ++i) {
        const double z = all[static_cast<std::size_t>(i)].position.z;
        const bool is_low = z<low + 0.1 * d, is_high = z> high - 0.1 * d;
        for (int u = 0; u < 6; ++u)
            number[static_cast<std::size_t>(6 * i + u)] =
                u == 2 && (is_low || is_high) ? (is_low ? -1 : -2) : unknowns++;
    }
    std::vector<std::pair<Vec3, Eigen::Matrix<double, 12, 12>>> known;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
    const auto pairs = touching_spheres(all, 1e-6);
    std::vector<int> stiffness_of;
    for (const auto& [i, j] : pairs) {
        const Vec3 branch = all[static_cast<std::size_t>(j)].position - all[static_cast<std::size_t>(i)].position;
        std::size_t at = 0;
        while (at < known.size() && norm(known[at].first - branch) > 1e-6 * d) ++at;
        if (at == known.size()) known.emplace_back(branch, bond_stiffness(branch, k));
        stiffness_of.push_back(static_cast<int>(at));
        const auto& K = known[at].second;
        const auto dof = [&, i = i, j = j](int u) {
            return number[static_cast<std::size_t>(6 * (u < 6 ? i : j) + u % 6)];
        };
        for (int r = 0; r < 12; ++r) {
            if (dof(r) < 0) continue;
            for (int s = 0; s < 12; ++s) {
                if (dof(s) >= 0) entries.emplace_back(dof(r), dof(s), K(r, s));
                if (dof(s) == -2) load[dof(r)] -= K(r, s);  // the high end goes by 1 m
            }
        }
    }
    Eigen::SparseMatrix<double, Eigen::RowMajor> K(unknowns, unknowns);
    K.setFromTriplets(entries.begin(), entries.end());
    // what is left free as a whole, across and about the axis, is not loaded: the iteration leaves it alone
    Eigen::ConjugateGradient<decltype(K), Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(1e-8);
    solver.compute(K);
    const Eigen::VectorXd x = solver.solve(load);
    REQUIRE(solver.info() == Eigen::Success);
    const auto moved = [&](int i, int u) {
        const int at = number[static_cast<std::size_t>(6 * i + u)];
        return at >= 0 ? x[at] : (at == -2 ? 1.0 : 0.0);
    };
    double force = 0.0;  // on the high end
    for (std::size_t b = 0; b < pairs.size(); ++b) {
        const auto& [i, j] = pairs[b];
        const auto& S = known[static_cast<std::size_t>(stiffness_of[b])].second;
        for (const int r : {2, 8}) {
            const int body = r < 6 ? i : j;
            if (number[static_cast<std::size_t>(6 * body + 2)] != -2) continue;
            for (int s = 0; s < 12; ++s) force += S(r, s) * moved(s < 6 ? i : j, s % 6);
        }
    }
    const double length = high - low, strain = 1.0 / length;
    Pulled p;
    const double levels = 1.0 + std::round(length / (std::sqrt(2.0 / 3.0) * d));
    p.modulus = force / (n / levels * std::sqrt(0.75) * d * d * strain);
    double sum_x = 0.0, sum_r = 0.0;
    for (int i = 0; i < n; ++i) {
        const Vec3 r = all[static_cast<std::size_t>(i)].position;
        // in the middle, without the skin, which bulges
        if (std::fabs(r.z - 0.5 * (low + high)) > length / 6.0 || std::hypot(r.x, r.y) > 4.5) continue;
        sum_x += moved(i, 0) * r.x + moved(i, 1) * r.y;
        sum_r += r.x * r.x + r.y * r.y;
    }
    p.poisson = -sum_x / (strain * sum_r);
    return p;
}

}  // namespace

TEST_CASE("a cylinder of hcp spheres is softer than its lattice by its skin", "[slow]")
{
    // cylinders of d = R/6: softer at the skin, about 1 - 0.5 d/R (docs/theory/sphere_bonds.md, section 6)
    const double d = 1.0, K = 1.0;
    for (const auto& [lambda, share] : {std::pair(0.01, 0.914), std::pair(0.3, 0.926)}) {
        const double E = 6.0 * std::numbers::sqrt2 / d * K * (1.0 + lambda) / (5.0 + lambda);
        const Pulled p = pull_cylinder(d, {K, lambda * K, 0.0, 0.0});
        CHECK(p.modulus == Approx(share * E).epsilon(3e-3));
        CHECK(std::fabs(p.poisson - (1.0 - lambda) / (5.0 + lambda)) < 0.003);
    }
}
