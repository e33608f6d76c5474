// SPDX-License-Identifier: GPL-3.0-or-later
// Grain stress, tractions that carry a resultant, tractions on planes inside grains.
#include "fracture/grain_stress.h"
#include "fracture/plane_tractions.h"
#include "geometry/mass_properties.h"
#include "gpu/parallel.h"
#include "support/assembly.h"
#include "unit/geometry/shapes.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

double largest(const Mat3& m)
{
    double a = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a = std::max(a, std::fabs(m[i][j]));
    return a;
}

double uniform(std::mt19937_64& random)
{
    return test::uniform(random, -1.0, 1.0);
}
Vec3 vector_in_cube(std::mt19937_64& random)
{
    const double x = uniform(random), y = uniform(random);
    return {x, y, uniform(random)};
}
Mat3 symmetric(std::mt19937_64& random)
{
    const Vec3 d = vector_in_cube(random), o = vector_in_cube(random);
    return {{{d.x, o.z, o.y}, {o.z, d.y, o.x}, {o.y, o.x, d.z}}};
}
int corners_of(const std::vector<Vec3>& polygon)
{
    return static_cast<int>(polygon.size());
}

/// Irregular pentagon, anywhere and in any direction.
std::vector<Vec3> pentagon(std::mt19937_64& random)
{
    const Quat q = rotation(random);
    const Vec3 shift = vector_in_cube(random);
    std::vector<Vec3> p;
    for (int k = 0; k < 5; ++k) {
        const double angle = 2.0 * std::numbers::pi / 5.0 * (k + 0.2 * uniform(random));
        p.push_back(shift + rotate(q, {1.3 * std::cos(angle), 0.8 * std::sin(angle), 0}));
    }
    return p;
}

/// A grain with what acts on it: the arrays that the views point to.
struct LoadedGrain {
    Polyhedron shape;
    MassProperties mass;
    Shapes shapes;
    std::vector<std::vector<Vec3>> polygons;
    std::vector<FaceLoad> faces;
    std::vector<PointLoad> points;
    GrainMotion motion;

    explicit LoadedGrain(Polyhedron p) : shape(std::move(p)), mass(mass_properties(shape))
    {
        add_shape(shapes, shape, 0.0);
        for (int f = 0; f < face_count(); ++f) polygons.push_back(face_polygon(shape, f));
        motion.density = 1.0;
        motion.center = mass.centroid;
    }
    int face_count() const { return static_cast<int>(shape.faces.size()); }
    double size() const { return bounding_size(shape); }

    /// Tractions that carry `resultant` about the centroid of the face.
    void load_face(int f, const Wrench& resultant)
    {
        const auto& corners = polygons[static_cast<std::size_t>(f)];
        const PlaneMoments m = plane_moments(corners.data(), corners_of(corners));
        faces.push_back({corners.data(), corners_of(corners), fit_tractions(m, resultant)});
    }
    /// The tractions of the stress sigma(x) on every face, fitted to their resultants (sigma at most linear).
    template <class Stress>
    void load_faces(const Stress& stress)
    {
        for (int f = 0; f < face_count(); ++f) {
            const auto& corners = polygons[static_cast<std::size_t>(f)];
            const Vec3 n = shape.planes[static_cast<std::size_t>(f)].normal, centroid = polygon_centroid(corners);
            Wrench w;
            for (const QuadraturePoint& q : quadrature(corners, QuadratureRule::fan7))
                w.add(q.weight * (stress(q.position) * n), q.position - centroid);
            load_face(f, w);
        }
    }
    GrainLoads loads() const
    {
        return {{points.data(), static_cast<int>(points.size())}, {faces.data(), static_cast<int>(faces.size())}};
    }
    Wrench total() const
    {
        Wrench w;
        for (const PointLoad& p : points) {
            w.add(p.force, p.point - motion.center);
            w.moment += p.couple;
        }
        for (const FaceLoad& f : faces) w.add(resultant(f.traction, f.corners, f.count, motion.center), 1.0);
        return w;
    }
    /// Newton's and Euler's equations: accelerations that the loads and gravity cause.
    void set_free()
    {
        const Wrench w = total();
        const Vec3& spin = motion.angular_velocity;
        motion.acceleration = w.force / (motion.density * mass.volume) + motion.body_force;
        const Vec3 rest =
            rotate_back(mass.principal_axes, w.moment - motion.density * cross(spin, mass.inertia * spin));
        const Vec3 I = motion.density * mass.principal_inertia;
        motion.angular_acceleration = rotate(mass.principal_axes, {rest.x / I.x, rest.y / I.y, rest.z / I.z});
    }
    PlaneCut cut(const Plane& plane) const
    {
        return cut_by_plane(faces_view(view(shapes, Device::cpu), 0), plane, size());
    }
};

/// A plane through a random point of the inner part of the grain.
Plane plane_through(std::mt19937_64& random, const LoadedGrain& g)
{
    const Vec3 n = unit_vector(random);
    double reach = 0.0;
    for (const Vec3& v : g.shape.vertices) reach = std::max(reach, dot(n, v - g.mass.centroid));
    return {n, dot(n, g.mass.centroid) + 0.8 * reach * uniform(random)};
}

/// Random tractions of O(1) on all faces, some point loads with couples, gravity, spin: free to move.
LoadedGrain random_grain(std::mt19937_64& random)
{
    LoadedGrain g(translated(rotated(convex_polyhedron(random), rotation(random)), vector_in_cube(random)));
    for (int f = 0; f < g.face_count(); ++f) {
        const double area = norm(area_vector(g.polygons[static_cast<std::size_t>(f)]));
        g.load_face(f, {area * vector_in_cube(random), 0.2 * area * std::sqrt(area) * vector_in_cube(random)});
    }
    for (int k = 0; k < 4; ++k) {
        const Vec3& at = g.shape.vertices[random() % g.shape.vertices.size()];
        g.points.push_back({at, vector_in_cube(random), vector_in_cube(random)});
    }
    g.motion.density = 1.7;
    g.motion.body_force = {0.3, -0.2, -1.0};
    g.motion.angular_velocity = vector_in_cube(random);
    g.set_free();
    return g;
}

/// Largest difference of a field from the tractions of the stress sigma(x) at the corners of the section.
template <class Stress>
double largest_error(const PlaneCut& cut, const TractionField& field, const Stress& stress)
{
    double error = 0.0;
    for (int i = 0; i < cut.section.count; ++i) {
        const Vec3& x = cut.section.corners[i];
        error = std::max(error, norm(field.at(x) - stress(x) * cut.plane.normal));
    }
    return error;
}

}  // namespace

// ---------------------------------------------------------------------------------------------------- grain stress

namespace {

/// One free grain of an assembly with forces on it, entered as contacts with a second body far away.
struct StressedGrain {
    Assembly a;
    MassProperties mass;

    explicit StressedGrain(const Polyhedron& p)
    {
        a = assemble({grain(p, {}), grain(translated(p, {100, 0, 0}), {})}, 2.5);
        mass = mass_properties(p);
        a.state.incidence.begin.host() = {0, 0, 0};
    }
    void push(const Vec3& x, const Vec3& f)
    {
        State& s = a.state;
        const Vec3 d = x - s.bodies.position[0];
        const int slot = s.slots.size();
        s.slots.resize(slot + 1);
        s.contacts.for_each_array([&](const char*, auto& array) { array.resize(slot + 1); });
        s.contacts.active.at(slot) = 1;
        s.pairs.for_each_array([&](const char*, auto& array) { array.resize(slot + 1); });
        s.pairs.contact.at(slot) = slot;
        s.slots.force.host()[static_cast<std::size_t>(slot)] = -1.0 * f;  // on b; the grain is a
        s.slots.torque_a.host()[static_cast<std::size_t>(slot)] = cross(d, f);
        s.slots.dyad_a.host().push_back(Mat3::outer(d, f));
        s.slots.dyad_b.host().push_back({});
        s.incidence.entry.host().push_back(2 * slot);
        s.incidence.begin.host() = {0, slot + 1, slot + 1};
    }
    void spin(const Vec3& w)
    {
        const Bodies& b = a.state.bodies;
        const Vec3 body = rotate_back(b.orientation[0], w), I = b.inertia[0];
        a.state.bodies.angular_momentum.host()[0] = {I.x * body.x, I.y * body.y, I.z * body.z};
        a.state.bodies.angular_velocity.host()[0] = w;
    }
    Mat3 stress()
    {
        gather_forces(a.model, a.state);
        return grain_stress(a.model, a.state)[0];
    }
    /// (1/V) sum d (x) f, without the inertia of the grain.
    Mat3 without_inertia() const
    {
        Mat3 sum;
        for (int k = 0; k < a.state.slots.size(); ++k) sum = sum + a.state.slots.dyad_a[k];
        return (1.0 / mass.volume) * sum;
    }
    /// E A^T in world axes per volume, from the polyhedron's own Euler tensor and the torque of the forces.
    Mat3 inertia(const Vec3& w) const
    {
        const double density = a.model.materials[0].density;
        Vec3 torque;
        for (int k = 0; k < a.state.slots.size(); ++k) torque += a.state.slots.torque_a[k];
        const Vec3 rest = rotate_back(mass.principal_axes, torque - density * cross(w, mass.inertia * w));
        const Vec3 I = density * mass.principal_inertia;
        const Vec3 rate = rotate(mass.principal_axes, {rest.x / I.x, rest.y / I.y, rest.z / I.z});
        const Mat3 A = Mat3::skew(rate) + Mat3::skew(w) * Mat3::skew(w);
        return (density / mass.volume) * (mass.euler * transpose(A));
    }
};

}  // namespace

TEST_CASE("grain stress: tractions of a uniform stress on the faces of any polyhedron give it back")
{
    std::mt19937_64 random(10);
    for (int k = 0; k < 50; ++k) {
        const Polyhedron p = convex_polyhedron(random);
        const Mat3 sigma = symmetric(random);
        StressedGrain g(p);
        for (std::size_t f = 0; f < p.faces.size(); ++f) {
            const auto corners = face_polygon(p, static_cast<int>(f));
            g.push(polygon_centroid(corners), sigma * area_vector(corners));
        }
        CHECK(largest(g.stress() - sigma) < 1e-14);
    }
}

TEST_CASE("grain stress: a prism under pressure on all faces")
{
    const Polyhedron p = make_hexagonal_prism(0.6, 1.3);
    StressedGrain g(p);
    for (int f = 0; f < 8; ++f) g.push(polygon_centroid(face_polygon(p, f)), -3.0 * area_vector(face_polygon(p, f)));
    CHECK(largest(g.stress() + 3.0 * Mat3::identity()) < 3e-14);
}

TEST_CASE("grain stress: symmetric for a free spinning grain only because of its inertia")
{
    std::mt19937_64 random(11);
    for (int k = 0; k < 30; ++k) {
        const Polyhedron p = convex_polyhedron(random);
        StressedGrain g(p);
        const Vec3 w = vector_in_cube(random);
        g.spin(w);
        double scale = 0.0;
        for (int n = 0; n < 6; ++n) {
            const Vec3 f = vector_in_cube(random);
            g.push(p.vertices[random() % p.vertices.size()], f);
            scale += norm(f);
        }
        const Mat3 bare = g.without_inertia(), whole = bare - g.inertia(w), stress = g.stress();
        CHECK(largest(whole - transpose(whole)) < 1e-13 * scale);
        CHECK(largest(bare - transpose(bare)) > 1e-3 * scale);
        CHECK(largest(stress - whole) < 1e-13 * scale);
    }
}

TEST_CASE("grain stress: centrifugal tension of a grain that spins about a principal axis")
{
    const Polyhedron p = make_hexagonal_prism(0.6, 1.3);
    StressedGrain g(p);
    for (const Vec3& w : {Vec3{0, 0, 3}, Vec3{2, 0, 0}}) {
        g.spin(w);
        const double density = g.a.model.materials[0].density;
        const Mat3 W = Mat3::skew(w);
        const Mat3 expected = (-density / g.mass.volume) * (g.mass.euler * (W * W));
        const Mat3 stress = g.stress();
        CHECK(largest(stress - expected) < 1e-13 * largest(expected));
        CHECK(dot(w, stress * w) == Approx(0.0).margin(1e-13));  // none along the axis
        CHECK(trace(stress) > 0.0);
    }
}

TEST_CASE("grain stress: the mean over grains in equilibrium is that of the loads on them")
{
    // four blocks in a row, held by nothing but loads that balance
    std::mt19937_64 random(12);
    std::vector<GrainSpec> blocks;
    for (int i = 0; i < 4; ++i) blocks.push_back(grain(make_box({1, 1, 1}, {1.0 * i, 0, 0}), {1.0 * i, 0, 0}));
    Assembly a = assemble(blocks);
    bond(a, elastic_law(), 1e6, 0.0, 0.7);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(24);
    std::vector<Held> held(4, Held{false, false, false, false, false, false});
    held[0] = {true, true, true, true, true, true};  // what holds it is a load like the others
    for (int i = 1; i < 4; ++i)
        for (int k = 0; k < 3; ++k) load[6 * i + k] = uniform(random);
    solve_static(a, held, load);
    a.state.slots.dyad_a.resize(a.state.slots.size());
    a.state.slots.dyad_b.resize(a.state.slots.size());
    evaluate_bonds(a);
    Mat3 loads, grains;
    const std::vector<Mat3> stress = grain_stress(a.model, a.state);
    double error = 0.0;
    for (int i = 0; i < 4; ++i) {
        const Vec3 f = -a.state.bodies.force[i], t = -a.state.bodies.torque[i];  // the load balances the bonds
        loads = loads + Mat3::outer(a.state.bodies.position[i], f);
        if (i > 0) {
            for (int k = 0; k < 3; ++k) error = std::max(error, std::fabs(f[k] - load[6 * i + k]));
            error = std::max(error, norm(t));
        } else {
            loads = loads + 0.5 * Mat3::skew(t);  // a couple: the antisymmetric dyad with its torque
        }
        grains = grains + grain_volume(a.model, a.state, i) * stress[static_cast<std::size_t>(i)];
    }
    CHECK(error < 1e-9);  // of the static solver
    CHECK(largest(grains - 0.5 * (loads + transpose(loads))) < 1e-13);
    CHECK(largest(grains) > 0.1);
}

// ------------------------------------------------------------------------------------------------- tractions of a face

TEST_CASE("face tractions carry the force and the moment they are made from")
{
    std::mt19937_64 random(1);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k) {
        const auto p = pentagon(random);
        const PlaneMoments m = plane_moments(p.data(), 5);
        const Wrench w{vector_in_cube(random), vector_in_cube(random)};
        const Wrench r = resultant(fit_tractions(m, w), p.data(), 5, m.centroid);
        const double scale = norm(w.force) + norm(w.moment);  // the polygon's size is 1
        worst = std::max({worst, norm(r.force - w.force) / scale, norm(r.moment - w.moment) / scale});
    }
    CAPTURE(worst);
    CHECK(worst < 1e-15);
}

TEST_CASE("face tractions: moments of the polygon agree with the principal ones, in any frame")
{
    std::mt19937_64 random(2);
    for (int k = 0; k < 50; ++k) {
        const auto p = pentagon(random);
        const PolygonMoments principal = polygon_moments(p);
        const PlaneMoments m = plane_moments(p.data(), 5);
        CHECK(m.area == Approx(principal.area).epsilon(1e-14));
        CHECK(norm(m.centroid - principal.centroid) < 1e-14);
        CHECK(norm(m.n - principal.normal) < 1e-14);
        CHECK(norm(cross(m.e1, m.e2) - m.n) < 1e-15);
        CHECK(m.i11 + m.i22 == Approx(principal.i1 + principal.i2).epsilon(1e-13));
        CHECK(m.i11 * m.i22 - m.i12 * m.i12 == Approx(principal.i1 * principal.i2).epsilon(1e-13));
        const PlaneMoments same = plane_moments(p.data(), 5, principal.normal, principal.axis1);
        CHECK(same.i11 == Approx(principal.i1).epsilon(1e-13));
        CHECK(same.i12 == Approx(0.0).margin(1e-14));
    }
}

TEST_CASE("face tractions: a uniform traction at the quadrature points comes back as it was")
{
    std::mt19937_64 random(3);
    for (int k = 0; k < 50; ++k) {
        const auto p = pentagon(random);
        const PlaneMoments m = plane_moments(p.data(), 5);
        const Vec3 t = vector_in_cube(random);
        Wrench w;
        for (const QuadraturePoint& q : quadrature(p, QuadratureRule::fan7))
            w.add(q.weight * t, q.position - m.centroid);
        const TractionField field = fit_tractions(m, w);
        CHECK(norm(field.mean - t) < 1e-14);
        CHECK(std::fabs(field.a1) < 1e-14);
        CHECK(std::fabs(field.a2) < 1e-14);
        CHECK(std::fabs(field.twist) < 1e-14);
        for (const Vec3& x : p) CHECK(norm(field.at(x) - t) < 2e-14);
    }
}

TEST_CASE("face tractions: a linear normal stress and a twist come back as they were")
{
    std::mt19937_64 random(4);
    for (int k = 0; k < 50; ++k) {
        const auto p = pentagon(random);
        const PlaneMoments m = plane_moments(p.data(), 5);
        const double c = uniform(random), twist = uniform(random);
        Wrench w;
        for (const QuadraturePoint& q : quadrature(p, QuadratureRule::fan7)) {
            const Vec3 xi = q.position - m.centroid;
            w.add(q.weight * (c * dot(m.e1, xi) * m.n + twist * cross(m.n, xi)), xi);
        }
        const TractionField field = fit_tractions(m, w);
        CHECK(field.a1 == Approx(c).margin(1e-14));
        CHECK(field.a2 == Approx(0.0).margin(1e-14));
        CHECK(field.twist == Approx(twist).margin(1e-14));
        CHECK(norm(field.mean) < 1e-14);
    }
}

TEST_CASE("face tractions turn with the face")
{
    std::mt19937_64 random(5);
    for (int k = 0; k < 50; ++k) {
        auto p = pentagon(random);
        const Wrench w{vector_in_cube(random), vector_in_cube(random)};
        const TractionField field = fit_tractions(plane_moments(p.data(), 5), w);
        const Quat q = rotation(random);
        std::vector<Vec3> turned;
        for (const Vec3& x : p) turned.push_back(rotate(q, x));
        const TractionField there =
            fit_tractions(plane_moments(turned.data(), 5), {rotate(q, w.force), rotate(q, w.moment)});
        for (std::size_t i = 0; i < 5; ++i) CHECK(norm(there.at(turned[i]) - rotate(q, field.at(p[i]))) < 2e-14);
    }
}

TEST_CASE("face tractions of a single eccentric force")
{
    const std::vector<Vec3> p{{-1, -0.5, 2}, {1, -0.5, 2}, {1, 0.5, 2}, {-1, 0.5, 2}};
    const PlaneMoments m = plane_moments(p.data(), 4, {0, 0, 1}, {1, 0, 0});
    const double f = 3.0, xi = 0.4;
    Wrench w;
    w.add({0, 0, f}, {xi, 0, 0});
    const TractionField t = fit_tractions(m, w);
    CHECK(t.normal_stress(m.centroid) == Approx(f / 2.0).epsilon(1e-15));
    CHECK(t.a1 == Approx(f * xi / m.i11).epsilon(1e-15));
    CHECK(t.a2 == Approx(0.0).margin(1e-15));
    CHECK(m.i11 == Approx(8.0 / 12.0).epsilon(1e-15));
}

TEST_CASE("the field over the two sides of a line adds up to the whole, and is that of the clipped polygon")
{
    std::mt19937_64 random(6);
    for (int k = 0; k < 200; ++k) {
        const auto p = pentagon(random);
        const PlaneMoments m = plane_moments(p.data(), 5);
        const TractionField t = fit_tractions(m, {vector_in_cube(random), vector_in_cube(random)});
        const Vec3 n = unit_vector(random), about = vector_in_cube(random);
        const Plane plane{n, dot(n, m.centroid) + 0.5 * uniform(random)};
        const Wrench one = resultant_beyond(t, p.data(), 5, plane, 1e-12, about),
                     two = resultant_beyond(t, p.data(), 5, {-plane.normal, -plane.offset}, 1e-12, about),
                     all = resultant(t, p.data(), 5, about);
        CHECK(norm(one.force + two.force - all.force) < 2e-14);
        CHECK(norm(one.moment + two.moment - all.moment) < 5e-14);

        // by the cut of a prism that stands on the polygon, and a rule of a higher degree
        std::vector<Vec3> vertices = p;
        for (const Vec3& x : p) vertices.push_back(x - m.n);
        std::vector<std::vector<int>> faces{{0, 1, 2, 3, 4}, {9, 8, 7, 6, 5}};
        for (int i = 0; i < 5; ++i) faces.push_back({i, i + 5, (i + 1) % 5 + 5, (i + 1) % 5});
        // the plane stands upright on the polygon, along the line in which it met it
        const Vec3 across = normalized(tangential(n, m.n));
        const double slant = dot(n, across);
        const Plane upright{across, (plane.offset - dot(n, m.centroid)) / slant + dot(across, m.centroid)};
        const Polyhedron part = cut(make_polyhedron(vertices, faces, 7), upright).outside;
        Wrench expected;
        for (std::size_t f = 0; f < part.faces.size(); ++f) {
            if (norm(part.planes[f].normal - m.n) > 1e-9) continue;
            for (const QuadraturePoint& q : quadrature(face_polygon(part, static_cast<int>(f)), QuadratureRule::fan7))
                expected.add(q.weight * t.at(q.position), q.position - about);
        }
        CHECK(norm(one.force - expected.force) < 5e-14);
        CHECK(norm(one.moment - expected.moment) < 1e-13);
    }
}

// -------------------------------------------------------------------------------------------------- planes in a grain

TEST_CASE("cut by a plane without building the parts: the same moments and polygon as the parts that cut() builds")
{
    std::mt19937_64 random(20);
    int both = 0;
    for (int k = 0; k < 300; ++k) {
        const LoadedGrain g(translated(convex_polyhedron(random), vector_in_cube(random)));
        const Plane plane = plane_through(random, g);
        const PlaneCut c = g.cut(plane);
        const CutResult built = cut(g.shape, plane);
        REQUIRE(c.status == built.status);
        if (c.status != CutStatus::ok) continue;
        ++both;
        for (int side = 0; side < 2; ++side) {
            const PartMoments& m = c.part[side];
            const MassProperties p = mass_properties(side == 0 ? built.outside : built.inside);
            const Vec3 arm = p.centroid - c.origin;
            CHECK(m.volume == Approx(p.volume).margin(1e-14));
            CHECK(norm(m.first - p.volume * arm) < 1e-14);
            CHECK(largest(m.second - (p.euler + p.volume * Mat3::outer(arm, arm))) < 1e-14);
        }
        const PlaneMoments& s = c.section.moments;
        CHECK(norm(s.area * s.n - area_vector(built.section)) < 1e-13);
        CHECK(norm(s.centroid - polygon_centroid(built.section)) < 1e-12);
        for (int i = 0; i < c.section.count; ++i)
            CHECK(std::fabs(dot(plane.normal, c.section.corners[i]) - plane.offset) < 1e-14);
    }
    CHECK(both > 290);
}

TEST_CASE("planes through vertices and edges of any polyhedron")
{
    std::mt19937_64 random(27);
    int compared = 0;
    for (int k = 0; k < 400; ++k) {
        const LoadedGrain g(rotated(convex_polyhedron(random), rotation(random)));
        const auto vertex = [&] { return g.shape.vertices[random() % g.shape.vertices.size()]; };
        const Vec3 a = vertex(), b = vertex(), c = vertex(), across = cross(b - a, c - a);
        if (norm(across) < 1e-3) continue;
        const Plane plane{normalized(across), dot(normalized(across), a)};
        const PlaneCut found = g.cut(plane);
        const CutResult built = cut(g.shape, plane);
        CHECK(found.status == built.status);
        if (found.status != CutStatus::ok || built.status != CutStatus::ok) continue;
        ++compared;
        CHECK(found.part[0].volume == Approx(mass_properties(built.outside).volume).margin(1e-13));
        CHECK(found.part[1].volume == Approx(mass_properties(built.inside).volume).margin(1e-13));
        CHECK(found.section.count == static_cast<int>(built.section.size()));
        CHECK(norm(found.section.moments.centroid - polygon_centroid(built.section)) < 1e-12);
    }
    CHECK(compared > 200);
}

TEST_CASE("planes through edges of a prism: slabs of the undisturbed prism")
{
    const double r = 0.6, t = 1.3, volume = 1.5 * std::sqrt(3.0) * r * r * t;
    const Quat turn = from_axis_angle(normalized(Vec3{1, 2, 3}), 0.7);
    const LoadedGrain g(translated(rotated(make_hexagonal_prism(r, t), turn), {0.3, -0.4, 5}));
    for (int k = 0; k < 6; ++k) {
        const double vertex = std::numbers::pi / 6 + k * std::numbers::pi / 3, face = k * std::numbers::pi / 3;
        const Vec3 e = rotate(turn, {std::cos(vertex), std::sin(vertex), 0}),
                   m = rotate(turn, {std::cos(face), std::sin(face), 0});
        const PlaneCut a = g.cut({e, dot(e, g.mass.centroid) + 0.5 * r}), b = g.cut({m, dot(m, g.mass.centroid)});
        REQUIRE(a.status == CutStatus::ok);
        REQUIRE(b.status == CutStatus::ok);
        CHECK(a.part[0].volume / volume == Approx(1.0 / 6.0).epsilon(1e-12));
        CHECK(a.part[1].volume / volume == Approx(5.0 / 6.0).epsilon(1e-12));
        CHECK(a.section.moments.area == Approx(std::sqrt(3.0) * r * t).epsilon(1e-12));
        CHECK(a.section.count == 4);
        CHECK(b.part[0].volume / volume == Approx(0.5).epsilon(1e-12));
        CHECK(b.section.moments.area == Approx(2.0 * r * t).epsilon(1e-12));
        CHECK(b.section.count == 4);
    }
    // in a face, beside the grain
    CHECK(g.cut({rotate(turn, {0, 0, 1}), dot(rotate(turn, {0, 0, 1}), g.mass.centroid) + 0.5 * t}).status ==
          CutStatus::all_inside);
    CHECK(g.cut({{0, 0, 1}, 0.0}).status == CutStatus::all_outside);
}

TEST_CASE("plane tractions, patch: a uniform stress is found on every plane of any polyhedron")
{
    std::mt19937_64 random(21);
    double worst = 0.0, worst_slope = 0.0;
    for (int k = 0; k < 300; ++k) {
        LoadedGrain g(translated(rotated(convex_polyhedron(random), rotation(random)), vector_in_cube(random)));
        const Mat3 sigma = symmetric(random);
        const auto stress = [&](const Vec3&) { return sigma; };
        g.load_faces(stress);
        for (int n = 0; n < 10; ++n) {
            const Plane plane = plane_through(random, g);
            const PlaneCut c = g.cut(plane);
            if (c.status != CutStatus::ok) continue;
            const TractionField field = plane_tractions(c, g.motion, g.loads()).field;
            worst = std::max(worst, largest_error(c, field, stress));
            for (int i = 0; i < c.section.count; ++i)  // what a_1, a_2 and M_n make where they make most
                worst_slope = std::max(worst_slope, norm(field.at(c.section.corners[i]) - field.mean));
            const double normal = dot(plane.normal, sigma * plane.normal);
            worst = std::max(worst, std::fabs(field.normal_stress(c.section.moments.centroid) - normal));
        }
    }
    CAPTURE(worst, worst_slope);
    CHECK(worst < 1e-13);
    CHECK(worst_slope < 1e-13);
}

TEST_CASE("plane tractions: bending of a prism")
{
    std::mt19937_64 random(22);
    const double c = 2.0;
    const auto bending = [&](const Vec3& x) { return Mat3::diagonal({c * x.y, 0, 0}); };
    // along x, over an irregular polygon
    const Polyhedron upright =
        make_prism({{-0.6, -0.5, 0}, {0.7, -0.6, 0}, {0.8, 0.3, 0}, {0.1, 0.7, 0}, {-0.5, 0.4, 0}}, -1.0, 1.0);
    LoadedGrain g(rotated(upright, from_axis_angle({0, 1, 0}, std::numbers::pi / 2)));
    g.load_faces(bending);
    for (const double at : {-0.9, -0.3, 0.0, 0.6}) {
        const PlaneCut cut = g.cut({{1, 0, 0}, at});
        REQUIRE(cut.status == CutStatus::ok);
        const TractionField t = plane_tractions(cut, g.motion, g.loads()).field;
        CHECK(t.a1 * t.e1.y + t.a2 * t.e2.y == Approx(c).epsilon(1e-13));
        CHECK(t.a1 * t.e1.z + t.a2 * t.e2.z == Approx(0.0).margin(1e-13));
        CHECK(largest_error(cut, t, bending) < 1e-13);
    }
    for (int k = 0; k < 200; ++k) {
        // planes that leave the loaded ends whole, and planes that cut them
        const Plane plane = plane_through(random, g);
        const PlaneCut cut = g.cut(plane);
        if (cut.status != CutStatus::ok) continue;
        const PlaneTractions t = plane_tractions(cut, g.motion, g.loads());
        const Vec3& n = plane.normal;
        Wrench exact;  // of the stress on the plane, which acts on part 2
        const PlaneSection& s = cut.section;
        const std::vector<Vec3> polygon(s.corners, s.corners + s.count);
        for (const QuadraturePoint& q : quadrature(polygon, QuadratureRule::fan7))
            exact.add(q.weight * (bending(q.position) * n), q.position - s.moments.centroid);
        CHECK(norm(t.on_part1.force + exact.force) < 1e-13);
        CHECK(norm(t.on_part1.moment + exact.moment) < 1e-13);
        double error = 0.0;  // of the normal stress, which is linear
        for (const Vec3& x : polygon)
            error = std::max(error, std::fabs(t.field.normal_stress(x) - c * x.y * n.x * n.x));
        CHECK(error < 1e-13);
    }
}

TEST_CASE("plane tractions: both parts of a free grain tell the same")
{
    std::mt19937_64 random(23);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k) {
        const LoadedGrain g = random_grain(random);
        for (int n = 0; n < 5; ++n) {
            const PlaneCut c = g.cut(plane_through(random, g));
            if (c.status != CutStatus::ok) continue;
            const Wrench one = resultant_on_part1(GrainPart::one, c, g.motion, g.loads()),
                         two = resultant_on_part1(GrainPart::two, c, g.motion, g.loads());
            double scale = 0.0;  // what the terms of the balance add up to
            for (const PointLoad& l : g.points) scale += norm(l.force) + norm(l.couple);
            for (const FaceLoad& l : g.faces)
                scale += norm(resultant(l.traction, l.corners, l.count, g.motion.center).force);
            worst = std::max({worst, norm(one.force - two.force) / scale, norm(one.moment - two.moment) / scale});
        }
    }
    CAPTURE(worst);
    CHECK(worst < 1e-14);
}

TEST_CASE("plane tractions: the inertia of the part written out about its own centroid gives the same")
{
    std::mt19937_64 random(24);
    for (int k = 0; k < 100; ++k) {
        const LoadedGrain g = random_grain(random);
        const Plane plane = plane_through(random, g);
        const PlaneCut c = g.cut(plane);
        if (c.status != CutStatus::ok) continue;
        const MassProperties p = mass_properties(cut(g.shape, plane).outside);
        const Vec3 &w = g.motion.angular_velocity, &rate = g.motion.angular_acceleration,
                   &section = c.section.moments.centroid;
        const Vec3 r1 = p.centroid - g.motion.center;
        const Vec3 a1 = g.motion.acceleration + cross(rate, r1) + cross(w, cross(w, r1));
        const double m1 = g.motion.density * p.volume;
        const Mat3 I1 = g.motion.density * p.inertia;
        Vec3 force = m1 * (a1 - g.motion.body_force);
        Vec3 moment = I1 * rate + cross(w, I1 * w) + cross(p.centroid - section, force);
        for (const PointLoad& l : g.points) {
            if (dot(plane.normal, l.point) < plane.offset) continue;
            force -= l.force;
            moment -= cross(l.point - section, l.force) + l.couple;
        }
        for (const FaceLoad& f : g.faces) {
            const Wrench on = resultant_beyond(f.traction, f.corners, f.count, plane, 1e-12, section);
            force -= on.force;
            moment -= on.moment;
        }
        const Wrench found = resultant_on_part1(GrainPart::one, c, g.motion, g.loads());
        CHECK(norm(found.force - force) < 1e-13);
        CHECK(norm(found.moment - moment) < 1e-13);
    }
}

TEST_CASE("plane tractions: a free grain pushed on one face")
{
    LoadedGrain g(make_hexagonal_prism(0.6, 1.3, {0.2, 0.1, -0.3}));
    const double F = 5.0, top = -0.3 + 0.65;
    g.load_face(7, {{0, 0, -F}, {}});
    g.motion.density = 3.0;
    g.set_free();
    CHECK(norm(g.motion.angular_acceleration) < 1e-13);
    for (const double share : {0.1, 0.5, 0.8}) {
        const PlaneCut c = g.cut({{0, 0, 1}, top - 1.3 * share});
        REQUIRE(c.status == CutStatus::ok);
        const TractionField t = plane_tractions(c, g.motion, g.loads()).field;
        const double expected = -(1.0 - share) * F / c.section.moments.area;
        for (int i = 0; i < c.section.count; ++i)
            CHECK(norm(t.at(c.section.corners[i]) - Vec3{0, 0, expected}) < 1e-13 * F);
    }
}

TEST_CASE("plane tractions: a free prism spinning about an axis in its mid plane")
{
    const double r = 0.6, t = 1.3, density = 3.0, spin = 7.0;
    LoadedGrain g(make_hexagonal_prism(r, t, {0.2, 0.1, -0.3}));
    g.motion.density = density;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
        g.motion.angular_velocity = spin * axis;
        g.set_free();
        const PlaneCut c = g.cut({{0, 0, 1}, -0.3});
        REQUIRE(c.status == CutStatus::ok);
        // int over the half of s dV = A t^2/8
        const double expected = spin * spin * density * t * t / 8.0;
        const TractionField field = plane_tractions(c, g.motion, g.loads()).field;
        CHECK(norm(field.mean - Vec3{0, 0, expected}) < 1e-13 * expected);
    }
    // about the prism's axis: the plane through two opposite edges, int s dV over the half = V/2 (2 r/(3 sqrt 3))
    g.motion.angular_velocity = {0, 0, spin};
    g.set_free();
    const PlaneCut c = g.cut({{1, 0, 0}, 0.2});
    REQUIRE(c.status == CutStatus::ok);
    const double expected =
        spin * spin * density * 0.5 * g.mass.volume * 2.0 * r / (3.0 * std::sqrt(3.0)) / (2.0 * r * t);
    const TractionField field = plane_tractions(c, g.motion, g.loads()).field;
    CHECK(field.normal_stress(c.section.moments.centroid) == Approx(expected).epsilon(1e-13));
}

TEST_CASE("plane tractions turn with the grain")
{
    std::mt19937_64 random(25);
    for (int k = 0; k < 50; ++k) {
        const LoadedGrain g = random_grain(random);
        const Plane plane = plane_through(random, g);
        const PlaneCut c = g.cut(plane);
        if (c.status != CutStatus::ok) continue;
        const TractionField field = plane_tractions(c, g.motion, g.loads()).field;

        const Quat q = rotation(random);
        LoadedGrain turned(rotated(g.shape, q));
        turned.motion = g.motion;
        for (Vec3* v : {&turned.motion.center, &turned.motion.acceleration, &turned.motion.angular_velocity,
                        &turned.motion.angular_acceleration, &turned.motion.body_force})
            *v = rotate(q, *v);
        for (const PointLoad& l : g.points)
            turned.points.push_back({rotate(q, l.point), rotate(q, l.force), rotate(q, l.couple)});
        for (int f = 0; f < g.face_count(); ++f) {
            const FaceLoad& l = g.faces[static_cast<std::size_t>(f)];
            const Wrench w = resultant(l.traction, l.corners, l.count, l.traction.centroid);
            turned.load_face(f, {rotate(q, w.force), rotate(q, w.moment)});
        }
        const PlaneCut there = turned.cut({rotate(q, plane.normal), plane.offset});
        REQUIRE(there.section.count == c.section.count);
        const TractionField turned_field = plane_tractions(there, turned.motion, turned.loads()).field;
        double scale = 1.0;
        for (int i = 0; i < c.section.count; ++i) scale = std::max(scale, norm(field.at(c.section.corners[i])));
        for (int i = 0; i < c.section.count; ++i) {
            const Vec3& x = c.section.corners[i];
            CHECK(norm(turned_field.at(rotate(q, x)) - rotate(q, field.at(x))) < 1e-13 * scale);
        }
    }
}

TEST_CASE("a plane that sweeps over a loaded face changes nothing in jumps")
{
    LoadedGrain g(make_box({2, 1, 1}));
    g.load_face(5, {{0.3, 0.2, -4.0}, {0.1, 0.4, 0.2}});
    g.set_free();
    double before = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const double at = -0.9 + 1.8e-3 * i;
        const PlaneTractions t = plane_tractions(GrainPart::one, g.cut({{1, 0, 0}, at}), g.motion, g.loads());
        const double force = t.on_part1.force.z;
        if (i > 0) CHECK(std::fabs(force - before) < 1.8e-3 * 10.0);
        before = force;
    }
}

namespace {

struct MeanStressOnPlanes {
    static constexpr const char* name = "mean stress on planes";
    ShapesView shapes;
    View<const Plane> planes;
    View<const PointLoad> points;
    GrainMotion motion;
    double size;
    View<double> mean;

    GF_FN void operator()(int i) const
    {
        const PlaneCut c = cut_by_plane(faces_view(shapes, 0), planes[i], size);
        mean[i] = 0.0;
        if (c.status != CutStatus::ok) return;
        const TractionField t = plane_tractions(c, motion, {points, {}}).field;
        mean[i] = t.normal_stress(c.section.corners[0]);
    }
};

}  // namespace

TEST_CASE("plane tractions in a kernel are those of the host")
{
    std::mt19937_64 random(26);
    const LoadedGrain g = random_grain(random);
    const Device d = default_device();
    Buffer<Plane> planes;
    for (int i = 0; i < 200; ++i) planes.host().push_back(plane_through(random, g));
    const Buffer<PointLoad> points(g.points);
    Buffer<double> mean;
    mean.assign(200, -1.0);
    const MeanStressOnPlanes on_host{
        view(g.shapes, Device::cpu), planes.read(Device::cpu), points.read(Device::cpu), g.motion, g.size(),
        mean.write(Device::cpu)};
    for (int i = 0; i < 200; ++i) on_host(i);
    const std::vector<double> expected = mean.host();
    mean.assign(200, -1.0);
    parallel_for(
        d, 200,
        MeanStressOnPlanes{view(g.shapes, d), planes.read(d), points.read(d), g.motion, g.size(), mean.write(d)});
    CHECK(mean.host() == expected);
}
