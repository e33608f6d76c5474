// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/assemble.h"

#include "generate/crystal.h"
#include "model/random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <stdexcept>

namespace grainfrac {

namespace {

/// Entry for a new body in every array; the caller fills in what is not zero.
int new_body(Bodies& b)
{
    const int i = b.size();
    b.for_each_array([&](const char*, auto& array) { array.resize(i + 1); });
    b.id.host()[static_cast<std::size_t>(i)] = i;
    return i;
}

template <class T>
T& at(Buffer<T>& buffer, int i)
{
    return buffer.host()[static_cast<std::size_t>(i)];
}

int new_wall_body(Model& model, State& state, int wall, int group, int shape, const Vec3& position)
{
    Bodies& b = state.bodies;
    const int i = new_body(b);
    at(b.position, i) = at(b.start_position, i) = position;
    at(b.shape, i) = shape;
    at(b.group, i) = group;
    at(b.wall, i) = wall;
    at(b.origin, i) = at(b.id, i);
    at(b.parent, i) = -1;
    at(b.split_time, i) = -1.0;
    model.grain_shapes.emplace_back();
    return i;
}

}  // namespace

int add_grain(Model& model, State& state, const GrainSpec& g)
{
    if (const std::string why = why_not_convex(g.shape); !why.empty()) throw std::invalid_argument("grain: " + why);
    Bodies& b = state.bodies;
    const int i = new_body(b);
    model.grain_shapes.emplace_back();
    const double density = model.materials[static_cast<std::size_t>(g.material)].density;
    const PrincipalFrame frame = set_grain_shape(model, b, i, g.shape, {}, density, g.dilation_radius);
    at(b.start_position, i) = b.position[i];
    at(b.start_orientation, i) = b.orientation[i];
    at(b.velocity, i) = g.velocity;
    set_spin(b, i, g.angular_velocity);
    at(b.group, i) = g.group;
    at(b.wall, i) = -1;
    at(b.crystal, i) = conjugate(frame.axes) * g.crystal;
    at(b.origin, i) = g.origin >= 0 ? g.origin : b.id[i];
    at(b.parent, i) = -1;
    at(b.split_time, i) = -1.0;
    at(b.origin_volume, i) = b.mass[i] / density;
    return i;
}

int add_wall_plate(Model& model, State& state, int wall, int group, const Polyhedron& core, const Vec3& position,
                   double radius)
{
    return new_wall_body(model, state, wall, group, add_shape(model.shapes, core, radius), position);
}

int add_wall_round(Model& model, State& state, int wall, int group, const Vec3& axis, double length,
                   const Vec3& position, double radius)
{
    const int shape =
        length > 0.0 ? add_cylinder_shape(model.shapes, axis, length, radius) : add_sphere_shape(model.shapes, radius);
    return new_wall_body(model, state, wall, group, shape, position);
}

double weibull_factor(double u, double modulus, double area, double reference_area)
{
    const double mean = std::tgamma(1.0 + 1.0 / modulus);
    const double f = std::pow(reference_area / area, 1.0 / modulus) * std::pow(-std::log(u), 1.0 / modulus);
    return std::clamp(f, 0.2 * mean, 3.0 * mean);
}

namespace {

/// A face with everything that its bond is made from.
struct BondFace {
    const SharedFace* face = nullptr;
    const BondRule* rule = nullptr;
    PolygonMoments moments;
    double normal_stiffness = 0.0, shear_stiffness = 0.0;  // k_n, k_s [Pa/m]
    double strength = 1.0, toughness = 1.0;
};

class BondMaker {
public:
    BondMaker(Model& model, State& state) : model_(model), state_(state) {}

    void make(const BondFace& f)
    {
        if (f.rule->kind == BondRule::Kind::interface || f.rule->kind == BondRule::Kind::fibre) {
            interface(f);
        } else if (f.rule->kind == BondRule::Kind::parallel) {
            parallel(f, f.moments.centroid, f.rule->bond_radius.value_or(std::sqrt(f.moments.area / std::numbers::pi)));
        } else {  // Saleme Ruiz: a bond at each pair of features that meet, its radius the dilation radius
            for (const Vec3& corner : f.face->polygon) {
                const double rho = model_.shapes.radius[state_.bodies.shape[f.face->a]];
                parallel(f, corner, f.rule->bond_radius.value_or(rho));
            }
        }
    }
    /// Ends of the last bond's points and corners.
    void close()
    {
        state_.interfaces.point_begin.host().push_back(state_.points.size());
        state_.interfaces.corner_begin.host().push_back(state_.corners.size());
    }

private:
    Vec3 in_frame(int body, const Vec3& x) const
    {
        return rotate_back(state_.bodies.orientation[body], x - state_.bodies.position[body]);
    }
    Vec3 turned(int body, const Vec3& direction) const
    {
        return rotate_back(state_.bodies.orientation[body], direction);
    }
    double pair_mass(int a, int b) const
    {
        return 1.0 / (state_.bodies.inverse_mass[a] + state_.bodies.inverse_mass[b]);
    }

    void interface(const BondFace& f)
    {
        InterfaceBonds& i = state_.interfaces;
        const int n = i.size(), a = f.face->a, b = f.face->b;
        i.for_each_array([&](const char*, auto& array) { array.resize(n + 1); });
        at(i.a, n) = a;
        at(i.b, n) = b;
        at(i.law, n) = f.rule->law;
        at(i.normal_a, n) = turned(a, f.face->normal);
        at(i.normal_b, n) = turned(b, f.face->normal);
        at(i.tangent_a, n) = turned(a, f.moments.axis1);
        at(i.tangent_b, n) = turned(b, f.moments.axis1);
        at(i.area, n) = f.moments.area;
        const double k_n = f.normal_stiffness, k_s = f.shear_stiffness;
        at(i.normal_stiffness, n) = k_n;
        at(i.shear_stiffness, n) = k_s;
        const double per_area = 2.0 * f.rule->damping / f.moments.area;
        at(i.normal_damping, n) = per_area * std::sqrt(k_n * f.moments.area * pair_mass(a, b));
        at(i.shear_damping, n) = per_area * std::sqrt(k_s * f.moments.area * pair_mass(a, b));
        at(i.strength_factor, n) = f.strength;
        at(i.toughness_factor, n) = f.toughness;
        at(i.opening_limit, n) =
            model_.shapes.radius[state_.bodies.shape[a]] + model_.shapes.radius[state_.bodies.shape[b]];
        at(i.first_damage_time, n) = at(i.failure_time, n) = -1.0;
        at(i.history, n) = no_history::none;
        at(i.point_begin, n) = state_.points.size();
        at(i.corner_begin, n) = state_.corners.size();

        InterfacePoints& p = state_.points;
        for (const QuadraturePoint& q : quadrature(f.face->polygon, f.rule->quadrature)) {
            const int k = p.size();
            p.for_each_array([&](const char*, auto& array) { array.resize(k + 1); });
            at(p.position_a, k) = in_frame(a, q.position);
            at(p.position_b, k) = in_frame(b, q.position);
            at(p.weight, k) = q.weight;
        }
        for (const Vec3& corner : f.face->polygon) {
            state_.corners.position_a.host().push_back(in_frame(a, corner));
            state_.corners.position_b.host().push_back(in_frame(b, corner));
        }
        // of the rectangle with these moments: a face that is long in one direction has slid off after its short one
        at(i.slip_limit, n) = retirement_slip * least_width(f.moments);
    }

    void parallel(const BondFace& f, const Vec3& center, double radius)
    {
        ParallelBonds& p = state_.parallels;
        const int n = p.size(), a = f.face->a, b = f.face->b;
        p.for_each_array([&](const char*, auto& array) { array.resize(n + 1); });
        at(p.a, n) = a;
        at(p.b, n) = b;
        at(p.law, n) = f.rule->law;
        at(p.position_a, n) = in_frame(a, center);
        at(p.position_b, n) = in_frame(b, center);
        at(p.normal_a, n) = turned(a, f.face->normal);
        at(p.normal_b, n) = turned(b, f.face->normal);
        at(p.radius, n) = radius;
        const double k_n = f.normal_stiffness, k_s = f.shear_stiffness, area = CircularSection(radius).area;
        at(p.normal_stiffness, n) = k_n;
        at(p.shear_stiffness, n) = k_s;
        at(p.normal_damping, n) = 2.0 * f.rule->damping * std::sqrt(k_n * area * pair_mass(a, b));
        at(p.shear_damping, n) = 2.0 * f.rule->damping * std::sqrt(k_s * area * pair_mass(a, b));
        at(p.strength_factor, n) = f.strength;
        at(p.failure_time, n) = -1.0;
    }

    Model& model_;
    State& state_;
};

/// Scatter of one face: Weibull per face, misorientation of the two crystals.
void scatter(const Model& model, const State& state, std::int64_t seed, double mean_area, BondFace& f)
{
    const BondRule& rule = *f.rule;
    const Bodies& b = state.bodies;
    const int i = f.face->a, j = f.face->b;
    if (rule.weibull_modulus) {
        const auto [low, high] = std::minmax(b.id[i], b.id[j]);
        const double u = uniform_random(seed, RandomPurpose::strength, static_cast<std::uint32_t>(low),
                                        static_cast<std::uint32_t>(high));
        double factor = weibull_factor(u, *rule.weibull_modulus, f.moments.area, rule.weibull_area.value_or(mean_area));
        if (rule.kind == BondRule::Kind::interface) {
            // A bilinear point must keep lambda_f > lambda_0: sigma_c <= sqrt(1.8 k_n G_I) when G_c does not scale too.
            const InterfaceLaw& law = model.interface_laws[rule.law];
            if (law.softening == Softening::bilinear && !rule.weibull_scales_energy) {
                const double k_s = f.shear_stiffness;
                factor = std::min({factor,
                                   std::sqrt(1.8 * f.normal_stiffness * law.fracture_energy_I) / law.tensile_strength,
                                   std::sqrt(1.8 * k_s * law.fracture_energy_II) / law.cohesion});
            }
        }
        f.strength *= factor;
        if (rule.weibull_scales_energy) f.toughness *= factor * factor;
    }
    if (rule.misorientation_angle) {
        const double theta = hexagonal_misorientation(b.orientation[i] * b.crystal[i], b.orientation[j] * b.crystal[j]);
        const double g = boundary_toughness_factor(theta, *rule.misorientation_angle, rule.misorientation_effect);
        f.strength *= std::sqrt(g);  // sigma_c ~ sqrt(G) keeps the process zone
        f.toughness *= g;
    }
}

}  // namespace

int bond_shared_faces(Model& model, State& state, const std::vector<GrainSpec>& grains, std::int64_t seed,
                      const std::function<const BondRule*(int, int)>& rule_of, std::vector<SharedFace> patches)
{
    std::vector<Polyhedron> shapes;
    shapes.reserve(grains.size());
    for (const GrainSpec& g : grains) shapes.push_back(g.shape);
    const auto distance = [&](const SharedFace& face) {
        const Vec3 between =
            grains[static_cast<std::size_t>(face.b)].site - grains[static_cast<std::size_t>(face.a)].site;
        return std::fabs(dot(between, face.normal));
    };
    std::vector<SharedFace> faces = find_shared_faces(shapes);
    faces.insert(faces.end(), std::make_move_iterator(patches.begin()), std::make_move_iterator(patches.end()));
    std::stable_sort(faces.begin(), faces.end(), [](const SharedFace& x, const SharedFace& y) {
        return std::pair{x.a, x.b} < std::pair{y.a, y.b};
    });
    return bond_faces(model, state, faces, distance, seed, rule_of);
}

int bond_faces(Model& model, State& state, const std::vector<SharedFace>& faces,
               const std::function<double(const SharedFace&)>& distance, std::int64_t seed,
               const std::function<const BondRule*(int, int)>& rule_of)
{
    std::vector<BondFace> bonds;
    std::map<const BondRule*, std::pair<double, int>> areas;  // sum and number
    for (const SharedFace& face : faces) {
        const BondRule* rule = rule_of(face.a, face.b);
        if (rule == nullptr) continue;
        BondFace f{&face, rule, polygon_moments(face.polygon)};
        if (rule->kind == BondRule::Kind::fibre) {
            f.normal_stiffness = rule->normal_stiffness.value_or(0.0);
            f.shear_stiffness = rule->shear_stiffness;
        } else {
            f.normal_stiffness = rule->normal_stiffness.value_or(rule->modulus / distance(face));
            f.shear_stiffness = f.normal_stiffness * rule->shear_ratio;
        }
        areas[rule].first += f.moments.area;
        areas[rule].second += 1;
        bonds.push_back(f);
    }
    BondMaker maker(model, state);
    for (BondFace& f : bonds) {
        const auto& [sum, count] = areas[f.rule];
        scatter(model, state, seed, sum / count, f);
        maker.make(f);
    }
    maker.close();
    return static_cast<int>(bonds.size());
}

}  // namespace grainfrac
