// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic closed forms of block and grain assemblies: cantilever, strain patch, honeycomb.
#include "experiment/laws.h"
#include "fracture/grain_stress.h"
#include "generate/hexagonal_prisms.h"
#include "support/assembly.h"

#include <map>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr Held free_body{false, false, false, false, false, false}, fixed_body{true, true, true, true, true, true};

/// N + 1 blocks of length h along x; block 0 is the base.
Assembly cantilever(int N, double h, double width, double depth, double k_n, double k_s)
{
    std::vector<GrainSpec> grains;
    for (int i = 0; i <= N; ++i)
        grains.push_back(grain(make_box({h, depth, width}, {(i - 0.5) * h, 0, 0}), {(i - 0.5) * h, 0, 0}, 0.02));
    Assembly a = assemble(std::move(grains));
    bond(a, elastic_law(), 0.0, k_n, k_s / k_n);
    return a;
}

/// Layer of hexagonal prisms of the nominal lattice with k from E and nu.
Assembly honeycomb(const Vec3& box, double r, double t, double E, double nu)
{
    HexagonalPrismSpec spec;
    spec.side = r;
    spec.thickness = t;
    spec.region.size = box;
    spec.region.center = 0.5 * box;
    std::vector<GrainSpec> grains;
    for (LatticeCell& c : hexagonal_prism_lattice(spec)) grains.push_back(grain(std::move(c.shape), c.site, 0.05 * r));
    Assembly a = assemble(std::move(grains));
    const NetworkStiffness k = network_stiffness("plane", E, nu, std::nullopt);
    bond(a, elastic_law(), k.modulus, 0.0, k.shear_ratio);
    return a;
}

/// Rows of bodies by a coordinate, lowest first.
std::vector<std::vector<int>> rows_by(const State& s, int axis)
{
    std::map<long, std::vector<int>> rows;
    for (int i = 0; i < s.bodies.size(); ++i) rows[std::lround(1e6 * s.bodies.position[i][axis])].push_back(i);
    std::vector<std::vector<int>> list;
    for (auto& [key, row] : rows) list.push_back(row);
    return list;
}

double total_force(const State& s, const std::vector<int>& bodies, int axis)
{
    double f = 0;
    for (const int i : bodies) f += s.bodies.force[i][axis];
    return f;
}

/// E_app/E of a honeycomb pulled along y by its first and last rows; `clamped`: their u_x and rotation are held too.
double modulus_along_y(int columns, int rows, double nu, bool clamped, double* poisson = nullptr)
{
    const double r = 0.6, t = 1.3, E = 410e3, strain = 1e-7, h = std::numbers::sqrt3 * r;
    Assembly a = honeycomb({h * columns * 1.0001, 1.5 * r * rows + 0.4 * r, t}, r, t, E, nu);
    REQUIRE(a.state.bodies.size() == columns * rows);
    const auto list = rows_by(a.state, 1);
    REQUIRE(static_cast<int>(list.size()) == rows);
    const double length = 1.5 * r * (rows - 1);
    std::vector<Held> held(static_cast<std::size_t>(a.state.bodies.size()),
                           Held{false, false, true, true, true, false});
    for (const int i : list.front()) held[static_cast<std::size_t>(i)] = {clamped, true, true, true, true, clamped};
    for (const int i : list.back()) {
        held[static_cast<std::size_t>(i)] = {clamped, true, true, true, true, clamped};
        shift(a.state, i, {0, strain * length, 0});
    }
    held[static_cast<std::size_t>(list.front().front())][0] = true;
    std::vector<Vec3> start = a.state.bodies.position.host();
    solve_static(a, held, Eigen::VectorXd::Zero(6 * a.state.bodies.size()), 1e-19);
    if (poisson != nullptr) {  // lateral contraction of the two middle rows between their outer grains
        double e = 0;
        for (const int k : {rows / 2 - 1, rows / 2}) {
            const auto& row = list[static_cast<std::size_t>(k)];
            const int left = row[2], right = row[row.size() - 3];
            const double before = start[static_cast<std::size_t>(right)].x - start[static_cast<std::size_t>(left)].x;
            e += 0.5 * (a.state.bodies.position[right].x - a.state.bodies.position[left].x - before) / before;
        }
        double axial = 0;  // strain over the middle half
        const int low = rows / 4, high = rows - 1 - rows / 4;
        const auto mean_y = [&](int k, const std::vector<Vec3>& x) {
            double y = 0;
            for (const int i : list[static_cast<std::size_t>(k)])
                y += x[static_cast<std::size_t>(i)].y / static_cast<double>(list[static_cast<std::size_t>(k)].size());
            return y;
        };
        const auto now = a.state.bodies.position.host();
        axial = (mean_y(high, now) - mean_y(low, now)) / (mean_y(high, start) - mean_y(low, start)) - 1;
        *poisson = -e / axial;
    }
    const double stress = -total_force(a.state, list.back(), 1) / (columns * h * t);
    return stress / strain / E;
}

}  // namespace

TEST_CASE("cantilever of blocks: static tip deflection")
{
    const double h = 1, width = 0.8, depth = 0.6, k_n = 3e5, k_s = 1.2e5;
    for (const int N : {1, 5, 20}) {
        Assembly a = cantilever(N, h, width, depth, k_n, k_s);
        const double I = width * std::pow(depth, 3) / 12, A = width * depth;
        const double flexibility = h * h * N * (N + 1) * (2 * N + 1) / (6 * k_n * I) + N / (k_s * A);
        const double u = 1e-5 * h, P = u / flexibility;
        Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * (N + 1));
        load[6 * N + 1] = P;
        load[6 * N + 5] = 0.5 * h * P;  // P acts at the free end of the last block
        std::vector<Held> held(static_cast<std::size_t>(N + 1), free_body);
        held[0] = fixed_body;
        solve_static(a, held, load, 1e-19);
        const Vec3 tip = a.state.bodies.position[N] + rotate(a.state.bodies.orientation[N], {0.5 * h, 0, 0});
        CHECK(relative(tip.y, u) < 1e-9);
    }
}

TEST_CASE("cantilever under its weight: dynamic relaxation finds the static solution")
{
    const int N = 6;
    const double k_n = 3e5, k_s = 1.2e5;
    Assembly s = cantilever(N, 1, 0.8, 0.6, k_n, k_s);
    std::vector<Held> held(static_cast<std::size_t>(N + 1), free_body);
    held[0] = fixed_body;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * (N + 1));
    const double weight = 0.05;
    for (int i = 1; i <= N; ++i) load[6 * i + 1] = -weight * s.state.bodies.mass[i];
    solve_static(s, held, load, 1e-17);

    Assembly d = cantilever(N, 1, 0.8, 0.6, k_n, k_s);
    d.model.gravity = {0, -weight, 0};
    d.model.local_damping = 0.7;
    drive(d.state, 0);
    start(d.model, d.state);
    for (int i = 0; i < 60000; ++i) step(d.model, d.state, 3e-4);
    CHECK(relative(d.state.bodies.position[N].y, s.state.bodies.position[N].y) < 1e-3);
}

TEST_CASE("homogeneous strain of a Voronoi tiling is exact with k_n = k_s = E/h")
{
    int draw = 0;
    std::vector<Vec3> sites;
    while (sites.size() < 120) {
        const Vec3 x = 2.0 * random_vector(draw);
        bool far = true;
        for (const Vec3& y : sites) far = far && norm(x - y) > 0.35;
        if (far) sites.push_back(x);
    }
    std::vector<GrainSpec> grains;
    std::vector<char> interior;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        Polyhedron cell = make_box({4, 4, 4});
        for (std::size_t j = 0; j < sites.size(); ++j) {
            if (j == i) continue;
            const Vec3 n = normalized(sites[j] - sites[i]);
            cell = clip(cell, {Plane{n, dot(n, 0.5 * (sites[i] + sites[j]))}}, 100 + static_cast<int>(j));
        }
        bool inside = true;
        for (const int tag : cell.face_tags) inside = inside && tag >= 100;
        interior.push_back(inside ? 1 : 0);
        grains.push_back(grain(std::move(cell), sites[i], 0.01));
    }
    const double E = 410e3;
    Assembly a = assemble(std::move(grains));
    bond(a, elastic_law(), E, 0.0, 1.0);
    build_incidence(a.state);
    const Mat3 e = {{{0.7, 0.2, -0.3}, {0.2, -0.5, 0.4}, {-0.3, 0.4, 0.1}}};

    // The dyads have a part of second order in the strain, even in its sign: half the difference of +e and -e is free
    // of it.
    const double size = 1e-3;
    std::vector<Mat3> stress[2];
    const std::vector<Vec3> rest = a.state.bodies.position.host();
    for (const int k : {0, 1}) {
        for (std::size_t i = 0; i < sites.size(); ++i) {
            set_position(a.state, static_cast<int>(i), rest[i] + (k == 0 ? size : -size) * (e * sites[i]));
        }
        a.state.slots.dyad_a.resize(a.state.slots.size());
        a.state.slots.dyad_b.resize(a.state.slots.size());
        evaluate_bonds(a);
        stress[k] = grain_stress(a.model, a.state);
        for (std::size_t i = 0; i < sites.size(); ++i) {
            if (interior[i] == 0) continue;
            const double scale = E * size;               // a face of unit area at unit strain
            const double round_off = 2e-16 * 10 / size;  // sum of a dozen faces, positions of up to 10
            CHECK(norm(a.state.bodies.force[static_cast<int>(i)]) < round_off * scale);
            CHECK(norm(a.state.bodies.torque[static_cast<int>(i)]) < round_off * scale);
        }
    }
    int inside = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (interior[i] == 0) continue;
        ++inside;
        const Mat3 mean = (0.5 / size) * (stress[0][i] - stress[1][i]);
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) CHECK(std::fabs(mean[r][c] - E * e[r][c]) < 1e-12 * E);
        }
    }
    CHECK(inside > 5);
}

TEST_CASE("honeycomb: modulus along y, 4 x 11 and 16 x 41 grains")
{
    CHECK(modulus_along_y(4, 11, 0.0, true) == Approx(0.875).epsilon(1e-6));
    CHECK(modulus_along_y(4, 11, 0.0, false) == Approx(0.87076).margin(1e-5));
    CHECK(modulus_along_y(4, 11, 0.17, false) == Approx(0.86781).margin(1e-5));
    double poisson = 0;
    CHECK(modulus_along_y(16, 41, 0.0, false) == Approx(0.96848).margin(1e-5));
    CHECK(modulus_along_y(16, 41, 0.17, false, &poisson) == Approx(0.96753).margin(1e-5));
    CHECK(poisson == Approx(0.17).epsilon(0.005));
}

TEST_CASE("honeycomb: modulus along x is 1 - 1/(3 n) of E, 5/6 of the stress in the zigzag rows")
{
    const double r = 0.6, t = 1.3, E = 410e3, strain = 1e-7, h = std::numbers::sqrt3 * r;
    for (const int n : {5, 10}) {
        Assembly a = honeycomb({12 * h * 1.0001, 1.5 * r * n + 0.4 * r, t}, r, t, E, 0.0);
        const auto rows = rows_by(a.state, 1);
        REQUIRE(static_cast<int>(rows.size()) == n);
        std::vector<Held> held(static_cast<std::size_t>(a.state.bodies.size()),
                               Held{false, false, true, true, true, false});
        std::vector<int> last;
        for (const auto& row : rows) {
            for (const int i : {row.front(), row.back()}) {
                held[static_cast<std::size_t>(i)] = fixed_body;
                shift(a.state, i, {strain * a.state.bodies.position[i].x, 0, 0});
            }
            last.push_back(row.back());
        }
        a.state.slots.dyad_a.resize(a.state.interfaces.size());
        a.state.slots.dyad_b.resize(a.state.interfaces.size());
        build_incidence(a.state);
        solve_static(a, held, Eigen::VectorXd::Zero(6 * a.state.bodies.size()), 1e-19);
        const double stress = -total_force(a.state, last, 0) / (1.5 * r * n * t);
        CHECK(stress / strain / E == Approx(1 - 1.0 / (3 * n)).epsilon(1e-6));
        const auto grains = grain_stress(a.model, a.state);
        const auto middle = [&](int k) {
            return grains[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)][6])][0].x / (E * strain);
        };
        CHECK(middle(n / 2) == Approx(1.0).epsilon(1e-6));
        CHECK(middle(0) == Approx(5.0 / 6).epsilon(1e-6));
    }
}

TEST_CASE("honeycomb: facet tractions and first failure under uniaxial stress")
{
    const double r = 0.6, t = 1.3, E = 410e3, h = std::numbers::sqrt3 * r;
    for (const double nu : {0.0, 0.17}) {
        // interior grains of a uniform field: every grain moves with the mean strain and none turns
        const auto deform = [&](Assembly& a, double p_x, double p_y) {
            for (int i = 0; i < a.state.bodies.size(); ++i) {
                const Vec3 x = a.grains[static_cast<std::size_t>(i)].site;
                set_position(a.state, i, x + Vec3{(p_x - nu * p_y) / E * x.x, (p_y - nu * p_x) / E * x.y, 0});
            }
            evaluate_bonds(a);
        };
        const auto tractions = [&](double p_x, double p_y, double* t_n, double* t_s) {
            Assembly a = honeycomb({3 * h * 1.0001, 1.5 * r * 3 + 0.4 * r, t}, r, t, E, nu);
            deform(a, p_x, p_y);
            for (int i = 0; i < a.state.interfaces.size(); ++i) {
                const Vec3 n = a.state.interfaces.normal_a[i],
                           f = -a.state.slots.force[i] * (1 / a.state.interfaces.area[i]);
                const int facet = std::fabs(n.x) > 0.9 ? 0 : 1;
                t_n[facet] = dot(f, n);
                t_s[facet] = norm(tangential(f, n));
            }
        };
        const double p = 1e-2;
        double t_n[2], t_s[2];
        tractions(p, 0, t_n, t_s);
        CHECK(t_n[0] / p == Approx(1 / (1 - nu)).epsilon(1e-6));
        CHECK(t_n[1] / p == Approx((1 - 3 * nu) / (4 * (1 - nu))).epsilon(1e-6));
        CHECK(t_s[1] / p == Approx(std::sqrt(3.0) * (1 - 3 * nu) / (4 * (1 - nu))).epsilon(1e-6));
        tractions(0, p, t_n, t_s);
        CHECK(t_n[0] / p == Approx(-nu / (1 - nu)).margin(1e-6));
        CHECK(t_n[1] / p == Approx((3 - nu) / (4 * (1 - nu))).epsilon(1e-6));

        const auto first_failure = [&](double along_x, double along_y) {
            double low = 0, high = 3000;
            for (int i = 0; i < 40; ++i) {
                const double mid = 0.5 * (low + high);
                Assembly a = honeycomb({3 * h * 1.0001, 1.5 * r * 3 + 0.4 * r, t}, r, t, E, nu);
                InterfaceLaw law = elastic_law();
                law.failure = FailureUnit::point;
                law.softening = Softening::brittle;
                law.tensile_strength = 100;
                law.cohesion = 200;
                law.friction = 0.5;
                a.model.interface_laws.host() = {law};
                deform(a, mid * along_x, mid * along_y);
                double damaged = 0;
                for (const double D : a.state.interfaces.damage.host()) damaged = std::max(damaged, D);
                (damaged > 0 ? high : low) = mid;
            }
            return high;
        };
        CHECK(first_failure(1, 0) == Approx(100 * (1 - nu)).epsilon(1e-2));
        CHECK(first_failure(-1, 0) ==
              Approx(4 * 200 * (1 - nu) / ((1 - 3 * nu) * (std::sqrt(3.0) - 0.5))).epsilon(1e-2));
        if (nu > 0) {
            const double splitting = 100 * (1 - nu) / nu;
            const double denominator = std::sqrt(3.0) * (1 - 3 * nu) - (3 - nu) * 0.5;
            const double sliding = denominator > 0 ? 4 * 200 * (1 - nu) / denominator : 1e300;
            CHECK(first_failure(0, -1) == Approx(std::min(splitting, sliding)).epsilon(1e-2));
        }
    }
}
