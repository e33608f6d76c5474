// SPDX-License-Identifier: GPL-3.0-or-later
// Flaws in a plane, the criteria, the gate; planes of hexagonal crystals.
#include "fracture/cleavage.h"

#include "fracture/plane_tractions.h"
#include "generate/crystal.h"
#include "geometry/mass_properties.h"
#include "geometry/quadrature.h"
#include "unit/geometry/shapes.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <algorithm>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double wide = 1e9;  ///< [m]
constexpr CleavageCriterion criteria[] = {CleavageCriterion::ellipse, CleavageCriterion::shetty,
                                          CleavageCriterion::energy};
constexpr FlawShape flaws[] = {FlawShape::through, FlawShape::edge, FlawShape::penny};

CleavageLaw silicon_carbide()
{
    CleavageLaw law;
    law.toughness = 2.5e6;
    law.mode_ratio = 0.816;
    law.flaw_size = 1e-4;
    law.poisson_ratio = 0.17;
    law.young_modulus = 410e9;
    law.fracture_energy = law.toughness * law.toughness * (1 - 0.17 * 0.17) / law.young_modulus;
    return law;
}

Vec3 vector_in_cube(std::mt19937_64& random)
{
    const double x = uniform(random, -1, 1), y = uniform(random, -1, 1);
    return {x, y, uniform(random, -1, 1)};
}
Mat3 symmetric(std::mt19937_64& random)
{
    const Vec3 d = vector_in_cube(random), o = vector_in_cube(random);
    return {{{d.x, o.z, o.y}, {o.z, d.y, o.x}, {o.y, o.x, d.z}}};
}

const std::vector<Vec3> pentagon{{-0.6, -0.5, 0}, {0.7, -0.6, 0}, {0.8, 0.3, 0}, {0.1, 0.7, 0}, {-0.5, 0.4, 0}};

/// Tractions of O(100 MPa) on the pentagon.
Wrench random_resultant(std::mt19937_64& random)
{
    return {1e8 * vector_in_cube(random), 3e7 * vector_in_cube(random)};
}

}  // namespace

TEST_CASE("stress intensities: through, edge and penny cracks")
{
    CleavageLaw law = silicon_carbide();
    CHECK(law(200e6, 0, wide).K_I == Approx(3.54491e6).epsilon(2e-6));
    law.flaw_size = 0.1;  // the same in mm, t, s: MPa sqrt(mm)
    CHECK(law(200, 0, wide).K_I == Approx(112.0998).epsilon(1e-6));
    law.flaw_size = 1e-4;
    const double root = std::sqrt(pi * 1e-4);

    law.flaw = FlawShape::edge;
    const Cleavage edge = law(200e6, 50e6, wide);
    CHECK(edge.K_I == Approx(1.12 * 200e6 * root).epsilon(1e-14));
    CHECK(edge.K_II == Approx(1.12 * 50e6 * root).epsilon(1e-14));
    CHECK(edge.K_III == 0.0);
    law.flaw = FlawShape::penny;
    const Cleavage penny = law(200e6, 50e6, wide);
    CHECK(penny.K_I == Approx(2.0 / pi * 200e6 * root).epsilon(1e-14));
    CHECK(penny.K_II / (50e6 * root) == Approx(4.0 / (pi * (2 - 0.17))).epsilon(1e-14));
    CHECK(penny.K_II / (50e6 * root) == Approx(0.6958).margin(5e-5));
    CHECK(penny.K_III / (50e6 * root) == Approx(0.5775).margin(5e-5));
}

TEST_CASE("stress intensity in a plane of finite width")
{
    CleavageLaw law = silicon_carbide();
    const double a = law.flaw_size, W = 4 * a;
    const double infinite = law(1e8, 3e7, W).K_I, sliding = law(1e8, 3e7, W).K_II;
    law.finite_width = true;
    CHECK(law(1e8, 3e7, W).K_I == Approx(1e8 * std::sqrt(W * std::tan(pi * a / W))).epsilon(1e-14));
    CHECK(law(1e8, 3e7, W).K_I / infinite == Approx(std::sqrt(4 / pi)).epsilon(1e-14));
    CHECK(law(1e8, 3e7, W).K_II / sliding == Approx(std::sqrt(4 / pi)).epsilon(1e-14));
    CHECK(law(1e8, 0, 1e6 * a).K_I / infinite == Approx(1.0).epsilon(1e-11));
    CHECK(std::isfinite(law(1e8, 0, 0.5 * a).K_I));
    law.flaw = FlawShape::edge;  // half of a crack in twice the width
    CHECK(law(1e8, 0, W).K_I == Approx(1.12 * 1e8 * std::sqrt(2 * W * std::tan(pi * a / (2 * W)))).epsilon(1e-14));
}

TEST_CASE("the least width of a polygon")
{
    const std::vector<Vec3> box{{0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};
    CHECK(least_width(box.data(), 4, {0, 0, 1}) == Approx(2.0));
    const std::vector<Vec3> triangle{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
    CHECK(least_width(triangle.data(), 3, {0, 0, 1}) == Approx(2.4));  // the height over the hypotenuse
}

TEST_CASE("envelopes of the criteria")
{
    CleavageLaw law = silicon_carbide();
    const double K_c = law.toughness, C = law.mode_ratio;
    const double in_ellipse[] = {0.816, 0.70668, 0.48960}, in_shetty[] = {0.816, 0.57700, 0.36493};
    int i = 0;
    for (const double x : {0.0, 0.5, 0.8}) {
        law.criterion = CleavageCriterion::ellipse;
        const double ellipse = C * std::sqrt(1 - x * x), shetty = C * std::sqrt(1 - x);
        CHECK(ellipse == Approx(in_ellipse[i]).margin(5e-6));
        CHECK(law.load_factor(x * K_c, ellipse * K_c, 0) == Approx(1.0).epsilon(1e-9));
        law.criterion = CleavageCriterion::shetty;
        CHECK(shetty == Approx(in_shetty[i]).margin(5e-6));
        CHECK(law.load_factor(x * K_c, shetty * K_c, 0) == Approx(1.0).epsilon(1e-9));
        ++i;
    }
    for (const CleavageCriterion c : criteria) {  // K_c and G_c of one plane: the same in tension
        law.criterion = c;
        CHECK(law.load_factor(K_c, 0, 0) == Approx(1.0).epsilon(1e-14));
        CHECK(law.threshold_stress() == Approx(K_c / std::sqrt(pi * 1e-4)).epsilon(1e-14));
        CHECK(law(law.threshold_stress(), 0, wide).f == Approx(1.0).epsilon(1e-14));
    }
}

TEST_CASE("energy criterion: the largest release along the front of a penny")
{
    CleavageLaw law = silicon_carbide();
    law.flaw = FlawShape::penny;
    law.criterion = CleavageCriterion::energy;
    const double nu = law.poisson_ratio;
    for (const double tau : {0.0, 20e6, 90e6}) {
        const Cleavage c = law(80e6, tau, wide);
        double release = 0;
        for (int k = 0; k < 3600; ++k) {
            const double angle = k * pi / 1800, K_II = c.K_II * std::cos(angle), K_III = c.K_III * std::sin(angle);
            const double G = ((1 - nu * nu) * (c.K_I * c.K_I + K_II * K_II) + (1 + nu) * K_III * K_III) / 410e9;
            release = std::max(release, G);
        }
        CHECK(c.f == Approx(std::sqrt(release / law.fracture_energy)).epsilon(1e-9));
    }
}

TEST_CASE("f is proportional to the load, whatever the criterion, the flaw and the friction")
{
    std::mt19937_64 random(30);
    for (const CleavageCriterion criterion : criteria) {
        for (const FlawShape flaw : flaws) {
            CleavageLaw law = silicon_carbide();
            law.criterion = criterion;
            law.flaw = flaw;
            law.friction = 0.4;
            for (int k = 0; k < 50; ++k) {
                const double sigma = 1e8 * uniform(random, -1, 1), tau = 1e8 * uniform(random, 0, 1);
                const double f = law(sigma, tau, wide).f, times = uniform(random, 0.1, 10);
                CHECK(law(times * sigma, times * tau, wide).f == Approx(times * f).epsilon(1e-13));
                if (f > 0) CHECK(law(sigma / f, tau / f, wide).f == Approx(1.0).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("a closed flaw: pressure never opens it, friction holds what it can")
{
    for (const CleavageCriterion criterion : criteria) {
        for (const FlawShape flaw : flaws) {
            CleavageLaw law = silicon_carbide();
            law.criterion = criterion;
            law.flaw = flaw;
            CHECK(law(-1e12, 0, wide).f == 0.0);
            CHECK(law(-1e12, 0, wide).K_I == 0.0);
            CHECK(law(-1e8, 5e7, wide).f == law(0, 5e7, wide).f);  // no friction: the shear alone
            law.friction = 0.4;
            CHECK(law(-1e8, 3.9e7, wide).f == 0.0);
            CHECK(law(-1e8, 9e7, wide).f == Approx(law(0, 5e7, wide).f).epsilon(1e-13));
            CHECK(law(1e8, 5e7, wide).K_II == law(0, 5e7, wide).K_II);  // open: no friction
        }
    }
}

TEST_CASE("pure compression never splits a grain, along any plane")
{
    std::mt19937_64 random(31);
    for (int k = 0; k < 20; ++k) {
        const Polyhedron p = convex_polyhedron(random);
        Shapes shapes;
        add_shape(shapes, p, 0.0);
        const Mat3 sigma = -1e10 * Mat3::identity();
        std::vector<std::vector<Vec3>> polygons;
        std::vector<FaceLoad> faces;
        for (std::size_t f = 0; f < p.faces.size(); ++f) polygons.push_back(face_polygon(p, static_cast<int>(f)));
        for (const auto& corners : polygons) {
            const int count = static_cast<int>(corners.size());
            faces.push_back({corners.data(), count,
                             fit_tractions(plane_moments(corners.data(), count), {sigma * area_vector(corners), {}})});
        }
        const Vec3 n = unit_vector(random);
        const PlaneCut cut = cut_by_plane(faces_view(view(shapes, Device::cpu), 0),
                                          {n, dot(n, mass_properties(p).centroid)}, bounding_size(p));
        REQUIRE(cut.status == CutStatus::ok);
        GrainMotion rest;
        rest.density = 3100;
        const TractionField field =
            plane_tractions(cut, rest, {{}, {faces.data(), static_cast<int>(faces.size())}}).field;
        for (const CleavageCriterion criterion : criteria) {
            CleavageLaw law = silicon_carbide();
            law.criterion = criterion;
            // the shear is round-off of 1e10 Pa; at 200 MPa it would split
            CHECK(surface_flaw(law, field, cut.section.corners, cut.section.count).f < 1e-12 * 1e10 / 1e8);
            CHECK(buried_flaw(law, field, cut.section.corners, cut.section.count).K_I == 0.0);
            law.friction = 1e-3;
            CHECK(surface_flaw(law, field, cut.section.corners, cut.section.count).f == 0.0);
        }
    }
}

TEST_CASE("f is blind to the frame of the plane and to turning everything")
{
    std::mt19937_64 random(32);
    for (const CleavageCriterion criterion : criteria) {
        CleavageLaw law = silicon_carbide();
        law.criterion = criterion;
        law.friction = 0.3;
        for (int k = 0; k < 50; ++k) {
            const Wrench w = random_resultant(random);
            const Vec3 n{0, 0, 1}, e1 = normalized(Vec3{uniform(random, -1, 1), uniform(random, -1, 1), 0});
            const PlaneMoments m = plane_moments(pentagon.data(), 5, n, e1);
            const PlaneMoments swapped = plane_moments(pentagon.data(), 5, n, m.e2);
            const Cleavage c = surface_flaw(law, fit_tractions(m, w), pentagon.data(), 5);
            const Cleavage other = surface_flaw(law, fit_tractions(swapped, w), pentagon.data(), 5);
            CHECK(other.f == Approx(c.f).epsilon(1e-13));

            // e1 and e2 change places: the plane is seen from its other side, which the same stress acts on
            std::vector<Vec3> reversed(pentagon.rbegin(), pentagon.rend());
            const PlaneMoments behind = plane_moments(reversed.data(), 5, -n, m.e2);
            CHECK(norm(behind.e2 - m.e1) < 1e-15);
            const Cleavage from_behind =
                surface_flaw(law, fit_tractions(behind, {-w.force, -w.moment}), reversed.data(), 5);
            CHECK(from_behind.f == Approx(c.f).epsilon(1e-13));

            const Quat q = rotation(random);
            std::vector<Vec3> turned;
            for (const Vec3& x : pentagon) turned.push_back(rotate(q, x));
            const TractionField field =
                fit_tractions(plane_moments(turned.data(), 5), {rotate(q, w.force), rotate(q, w.moment)});
            const Cleavage there = surface_flaw(law, field, turned.data(), 5);
            CHECK(there.f == Approx(c.f).epsilon(1e-13));
            CHECK(norm(there.where - rotate(q, c.where)) < 1e-13);
            CHECK(buried_flaw(law, field, turned.data(), 5).f ==
                  Approx(buried_flaw(law, fit_tractions(m, w), pentagon.data(), 5).f).epsilon(1e-13));
        }
    }
}

TEST_CASE("a plane in bending only fails from its tension edge")
{
    for (const FlawShape flaw : flaws) {
        CleavageLaw law = silicon_carbide();
        law.flaw = flaw;
        const PlaneMoments m = plane_moments(pentagon.data(), 5);
        const Vec3 slope{0.6, 0.8, 0};
        double reach = 0;
        Vec3 far;
        for (const Vec3& x : pentagon) {
            if (dot(slope, x - m.centroid) > reach) far = x;
            reach = std::max(reach, dot(slope, x - m.centroid));
        }
        const double a = law.toughness / (law.mode_I_factor() * std::sqrt(pi * law.flaw_size)) / reach;
        Wrench w;  // the moment of the normal stress a slope . xi
        for (const QuadraturePoint& q : quadrature(pentagon, QuadratureRule::fan7))
            w.add(q.weight * a * dot(slope, q.position - m.centroid) * m.n, q.position - m.centroid);
        for (const CleavageCriterion criterion : criteria) {
            law.criterion = criterion;
            const Cleavage c = surface_flaw(law, fit_tractions(m, w), pentagon.data(), 5);
            CHECK(c.f == Approx(1.0).epsilon(1e-12));
            CHECK(c.where == far);
            CHECK(buried_flaw(law, fit_tractions(m, w), pentagon.data(), 5).f < 1e-12);
        }
    }
}

TEST_CASE("the worst surface flaw is the worst anywhere in the polygon")
{
    std::mt19937_64 random(33);
    int on_edges = 0;
    for (const CleavageCriterion criterion : criteria) {
        CleavageLaw law = silicon_carbide();
        law.criterion = criterion;
        for (int k = 0; k < 300; ++k) {
            law.friction = k % 2 == 0 ? 0.0 : 0.6;
            const TractionField field = fit_tractions(plane_moments(pentagon.data(), 5), random_resultant(random));
            const Cleavage worst = surface_flaw(law, field, pentagon.data(), 5);
            double inside = 0, at_corners = 0;
            for (int n = 0; n < 200; ++n) {
                double weights[5], sum = 0;
                for (double& w : weights) sum += (w = std::pow(uniform(random, 0, 1), 4));
                Vec3 x;
                for (int i = 0; i < 5; ++i) x += (weights[i] / sum) * pentagon[static_cast<std::size_t>(i)];
                inside = std::max(inside, flaw_at(law, field, x, wide).f);
            }
            for (const Vec3& x : pentagon) at_corners = std::max(at_corners, flaw_at(law, field, x, wide).f);
            CHECK(inside <= worst.f * (1 + 1e-13));
            if (law.friction == 0.0) CHECK(worst.f == at_corners);
            on_edges += worst.f > at_corners * (1 + 1e-9);
        }
    }
    CHECK(on_edges > 0);  // corners alone would miss some
}

TEST_CASE("equal corners: the first one counts")
{
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const TractionField field = fit_tractions(plane_moments(square.data(), 4, {0, 0, 1}), {{0, 0, 1e8}, {}});
    CHECK(surface_flaw(silicon_carbide(), field, square.data(), 4).where == square[0]);
}

TEST_CASE("principal values")
{
    std::mt19937_64 random(34);
    const auto compare = [](const Mat3& m) {
        Eigen::Matrix3d e;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) e(i, j) = m[i][j];
        const Eigen::Vector3d expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(e).eigenvalues();
        const Vec3 found = principal_values(m);
        for (int i = 0; i < 3; ++i) CHECK(found[i] == Approx(expected[2 - i]).margin(1e-14));
    };
    for (int k = 0; k < 200; ++k) compare(symmetric(random));
    compare({});
    compare(Mat3::identity());
    compare(Mat3::outer({1, 2, 3}, {1, 2, 3}));
    compare({{{1, 1e-9, 0}, {1e-9, 1, 1e-12}, {0, 1e-12, 1}}});
}

TEST_CASE("the gate lets every uniformly stressed grain through that has a plane to split along")
{
    std::mt19937_64 random(35);
    int split = 0, held_back = 0;
    for (const CleavageCriterion criterion : criteria) {
        for (const FlawShape flaw : flaws) {
            for (const double C : {0.816, 2.0}) {
                CleavageLaw law = silicon_carbide();
                law.criterion = criterion;
                law.flaw = flaw;
                law.mode_ratio = C;
                CleavageGate gate;
                gate.tension_threshold = law.threshold_stress();
                gate.shear_threshold = C * law.threshold_stress();
                for (int k = 0; k < 100; ++k) {
                    const Mat3 sigma = 1.5 * law.threshold_stress() * uniform(random, 0, 1) * symmetric(random);
                    double f = 0;
                    for (int n = 0; n < 200; ++n) {
                        const Vec3 normal = unit_vector(random), t = sigma * normal;
                        f = std::max(f, law(dot(normal, t), norm(tangential(t, normal)), wide).f);
                    }
                    split += f >= 1;
                    held_back += !gate(sigma);
                    if (f >= 1) CHECK(gate(sigma));
                }
            }
        }
    }
    CHECK(split > 200);
    CHECK(held_back > 100);
}

TEST_CASE("gates: the hydrostatic one keeps axial cleavage out, none but none sees bending")
{
    const CleavageLaw law = silicon_carbide();
    const Mat3 axial = Mat3::diagonal({0, 0, -3 * law.threshold_stress()});  // uniaxial compression
    CleavageGate gate;
    gate.tension_threshold = law.threshold_stress();
    gate.shear_threshold = law.mode_ratio * law.threshold_stress();
    CHECK(gate(axial));
    CHECK_FALSE(gate(Mat3{}));  // a grain in bending, whose mean stress is zero, needs `none`
    gate.kind = CleavageGate::Kind::hydrostatic;
    gate.hydrostatic_threshold = 0.0;
    CHECK_FALSE(gate(axial));
    CHECK(gate(Mat3::diagonal({1e6, 1e6, -1e6})));
    gate.kind = CleavageGate::Kind::none;
    CHECK(gate(Mat3{}));
}

// ----------------------------------------------------------------------------------------------------- crystal planes

namespace {

std::vector<double> angles(const std::vector<Vec3>& normals)
{
    std::vector<double> a;
    for (const Vec3& n : normals) a.push_back(std::atan2(n.y, n.x) * 180 / pi);
    return a;
}

}  // namespace

TEST_CASE("planes of hexagonal crystals: normals of the families")
{
    const auto prism = angles(plane_normals(parse_crystal_planes("{10-10}")));
    REQUIRE(prism.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(prism[i] == Approx(30.0 + 60.0 * static_cast<double>(i)).epsilon(1e-14));
    const auto second = angles(plane_normals(parse_crystal_planes("{11-20}")));
    REQUIRE(second.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(second[i] == Approx(60.0 * static_cast<double>(i)).epsilon(1e-14).margin(1e-14));
    for (const char* text : {"(0001)", "{0001}", "{000-1}"}) {
        const auto basal = plane_normals(parse_crystal_planes(text));
        REQUIRE(basal.size() == 1);
        CHECK(basal[0] == Vec3{0, 0, 1});
    }
    CHECK(plane_normals(parse_crystal_planes("{10-12}")).size() == 6);
    CHECK(plane_normals(parse_crystal_planes("{11-21}")).size() == 6);
    CHECK(plane_normals(parse_crystal_planes("{21-30}")).size() == 6);
    CHECK(plane_normals(parse_crystal_planes("{21-31}")).size() == 12);

    // one variant
    const auto single = plane_normals(parse_crystal_planes("(01-10)"));
    REQUIRE(single.size() == 1);
    CHECK(norm(single[0] - Vec3{0, 1, 0}) < 1e-15);
    CHECK(norm(plane_normals(parse_crystal_planes("(0-110)"))[0] - Vec3{0, 1, 0}) < 1e-15);
}

TEST_CASE("planes of hexagonal crystals: families are closed under the crystal's symmetry, normals lie on [hki0]")
{
    for (const char* text : {"{10-10}", "{11-20}", "(0001)", "{10-12}", "{21-31}"}) {
        const auto normals = plane_normals(parse_crystal_planes(text));
        for (const Vec3& n : normals) {
            CHECK(norm(n) == Approx(1.0).epsilon(1e-15));
            for (int k = 0; k < 6; ++k) {
                for (const bool half_turn : {false, true}) {
                    Vec3 m = rotate(from_axis_angle({0, 0, 1}, k * pi / 3), n);
                    if (half_turn) m = rotate(from_axis_angle({1, 0, 0}, pi), m);
                    const bool there = std::any_of(normals.begin(), normals.end(), [&](const Vec3& o) {
                        return norm(o - m) < 1e-14 || norm(o + m) < 1e-14;
                    });
                    CHECK(there);
                }
            }
        }
    }
    // the angle of {10-12} to the basal plane: tan = 2 c/(sqrt(3) a) l^-1 of (10-11) halved
    const Vec3 n = plane_normals(parse_crystal_planes("{10-12}"), 1.6)[0];
    CHECK(std::acos(n.z) == Approx(std::atan(1.6 / std::sqrt(3.0))).epsilon(1e-14));
}

TEST_CASE("crystal planes as text")
{
    const CrystalPlanes p = parse_crystal_planes("{ 1, 1, -2, 3 }");
    CHECK((p.h == 1 && p.k == 1 && p.i == -2 && p.l == 3 && p.all_variants));
    CHECK_FALSE(parse_crystal_planes("(-1010)").all_variants);
    CHECK(parse_crystal_planes("(-1010)").h == -1);
    for (const char* wrong : {"", "10-10", "{10-10)", "{1010}", "{10-1}", "{10-100}", "{0000}", "{10--10}", "{10-1x}",
                              "{1 0 - 1 0}", "{10-1-}", "{"}) {
        INFO(wrong);
        CHECK_THROWS_AS(parse_crystal_planes(wrong), std::invalid_argument);
    }
    CHECK_THROWS_WITH(parse_crystal_planes("{1010}"),
                      "\"{1010}\" is no crystal plane: the first three indices do not add up to zero; expected "
                      "Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"");
}

TEST_CASE("candidate planes cut the undisturbed prism along its diagonals")
{
    const double r = 0.6, t = 1.3;
    const Quat crystal = from_axis_angle({0, 0, 1}, pi / 6);  // a_1 along a vertex of the prism
    const Polyhedron prism = make_hexagonal_prism(r, t);
    Shapes shapes;
    add_shape(shapes, prism, 0.0);
    const auto cuts = [&](const char* family, double side) {
        std::vector<PlaneCut> all;
        for (const Plane& p : cleavage_planes(parse_crystal_planes(family), side)) {
            all.push_back(cut_by_plane(faces_view(view(shapes, Device::cpu), 0), {rotate(crystal, p.normal), p.offset},
                                       bounding_size(prism)));
            REQUIRE(all.back().status == CutStatus::ok);
            CHECK(all.back().section.count == (std::string(family) == "(0001)" ? 6 : 4));
        }
        return all;
    };
    const double volume = mass_properties(prism).volume;
    const auto m_cuts = cuts("{10-10}", r);
    REQUIRE(m_cuts.size() == 3);
    for (const PlaneCut& c : m_cuts) {
        CHECK(c.section.moments.area == Approx(2 * r * t).epsilon(1e-14));
        CHECK(c.part[0].volume == Approx(0.5 * volume).epsilon(1e-14));
    }
    const auto a_cuts = cuts("{11-20}", r);
    REQUIRE(a_cuts.size() == 9);
    for (std::size_t i = 0; i < 9; ++i) {
        CHECK(a_cuts[i].section.moments.area == Approx(std::sqrt(3.0) * r * t).epsilon(1e-14));
        const double beyond = i < 3 ? 0.5 : (i < 6 ? 5.0 / 6.0 : 1.0 / 6.0);
        CHECK(a_cuts[i].part[0].volume == Approx(beyond * volume).epsilon(1e-14));
    }
    CHECK(cuts("{11-20}", 0.0).size() == 3);
    const auto basal = cuts("(0001)", r);
    REQUIRE(basal.size() == 1);
    CHECK(basal[0].section.moments.area == Approx(1.5 * std::sqrt(3.0) * r * r).epsilon(1e-14));
}
