// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/split_grains.h"

#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "contact/gather.h"
#include "contact/linear_contact.h"
#include "fracture/bond_forces.h"
#include "fracture/plane_tractions.h"
#include "geometry/cut.h"
#include "geometry/mass_properties.h"
#include "model/grain_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

namespace grainfrac {

namespace {

template <class T>
T& at(Buffer<T>& buffer, int i)
{
    return buffer.host()[static_cast<std::size_t>(i)];
}

/// Arrays with the entries source[k] of `from`; default values where the source is -1. Arrays of another length (the
/// begins of ranges) are left empty.
template <class Arrays>
Arrays gathered(Arrays& from, const std::vector<int>& source)
{
    Arrays to;
    std::vector<void*> targets;
    to.for_each_array([&](const char*, auto& array) { targets.push_back(&array); });
    std::size_t k = 0;
    const int n = from.size();
    from.for_each_array([&](const char*, auto& array) {
        auto& target = *static_cast<std::remove_reference_t<decltype(array)>*>(targets[k++]);
        if (array.size() != n) return;
        const auto& values = std::as_const(array).host();
        auto& out = target.host();
        out.resize(source.size());
        for (std::size_t i = 0; i < source.size(); ++i) {
            if (source[i] >= 0) out[i] = values[static_cast<std::size_t>(source[i])];
        }
    });
    return to;
}

/// A grain that is being split.
struct Parting {
    SplitRequest request;
    Placement before;
    int part_1 = -1;  // part 2 keeps the index of the grain
    double mass = 0.0;
    Vec3 inertia;                     // principal, of the grain
    Vec3 velocity, angular_velocity;  // space
    double on_plane = 0.0;            // [m]
    std::vector<Vec3> section;

    bool is_in_part_1(const Vec3& x) const { return dot(request.plane.normal, x) - request.plane.offset > -on_plane; }
};

struct Parts {
    SplitStatus status = SplitStatus::outside;
    CutResult cut;  // in the frame of the body
};

Parts cut_grain(const Model& model, const State& state, const SplitRequest& r)
{
    const Bodies& b = state.bodies;
    const Polyhedron& grain = model.grain_shapes.at(static_cast<std::size_t>(r.body));
    Parts p;
    if (b.generation[r.body] >= r.rules.most_generations) {
        p.status = SplitStatus::generation;
        return p;
    }
    const Vec3 n = rotate_back(b.orientation[r.body], r.plane.normal);
    p.cut = cut_exact(grain, {n, r.plane.offset - dot(r.plane.normal, b.position[r.body])});
    p.status = why_not_parted(grain, p.cut, model.shapes.radius[b.shape[r.body]], b.origin_volume[r.body], r.rules);
    return p;
}

/// Body i becomes the part (given in the frame that the grain had) with the grain's motion.
void become_part(Model& model, State& state, int i, const Parting& p, const Polyhedron& part, double density)
{
    Bodies& b = state.bodies;
    const int parent = p.request.body;
    const Placement at_start{b.start_position[parent], b.start_orientation[parent]};
    const double rho = model.shapes.radius[b.shape[parent]];
    const Quat crystal = b.crystal[parent];
    const PrincipalFrame frame = set_grain_shape(model, b, i, part, p.before, density, rho);
    at(b.velocity, i) = p.velocity + cross(p.angular_velocity, b.position[i] - p.before.position);
    set_spin(b, i, p.angular_velocity);
    at(b.start_position, i) = at_start.to_space(frame.centroid);
    at(b.start_orientation, i) = normalized(at_start.orientation * frame.axes);
    at(b.crystal, i) = normalized(conjugate(frame.axes) * crystal);
}

void make_bodies(Model& model, State& state, Parting& p, const CutResult& cut)
{
    Bodies& b = state.bodies;
    const int parent = p.request.body, fresh = b.size();
    std::int32_t next_id = 0;
    for (int i = 0; i < fresh; ++i) next_id = std::max(next_id, b.id[i] + 1);
    b.for_each_array([&](const char*, auto& array) { array.resize(fresh + 1); });
    model.grain_shapes.emplace_back();
    p.part_1 = fresh;
    at(b.group, fresh) = b.group[parent];
    at(b.wall, fresh) = -1;
    at(b.origin, fresh) = b.origin[parent];
    at(b.origin_volume, fresh) = b.origin_volume[parent];
    at(b.generation, fresh) = b.generation[parent] + 1;
    at(b.parent, fresh) = b.id[parent];
    at(b.id, fresh) = next_id;
    const double density = p.mass / mass_properties(model.grain_shapes[static_cast<std::size_t>(parent)]).volume;
    // part 1 first: part 2 overwrites what both start from
    become_part(model, state, fresh, p, cut.outside, density);
    become_part(model, state, parent, p, cut.inside, density);
    at(b.split_time, fresh) = at(b.split_time, parent) = state.time;
    at(b.saturated, fresh) = at(b.saturated, parent) = 0;  // other shapes, other limits
    at(b.generation, parent) = b.generation[fresh];
    at(b.parent, parent) = b.parent[fresh];
    at(b.id, parent) = next_id + 1;
}

/// What lies on one side of a plane, of a convex polygon.
std::vector<Vec3> polygon_on_side(const std::vector<Vec3>& polygon, const Parting& p, bool part_1)
{
    std::vector<Vec3> kept;
    const auto height = [&](const Vec3& x) {
        const double h = dot(p.request.plane.normal, x) - p.request.plane.offset;
        return part_1 ? h : -h;
    };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &x = polygon[i], &y = polygon[(i + 1) % polygon.size()];
        const double hx = height(x), hy = height(y);
        if (hx >= 0.0) kept.push_back(x);
        if ((hx > 0.0 && hy < 0.0) || (hx < 0.0 && hy > 0.0)) kept.push_back(x + (hx / (hx - hy)) * (y - x));
    }
    return kept;
}

/// A boundary interface, or the part of one that one pair of bodies gets.
struct Piece {
    int source = -1;  // interface
    int a = 0, b = 0;
    std::vector<int> points;    // of the old arrays
    std::vector<Vec3> corners;  // in space
};

/// A new surface: n from part 2 (a) to part 1 (b), so that its points' traction acts on part 2.
struct CutSurface {
    int a = 0, b = 0;
    std::vector<Vec3> polygon;
    Vec3 normal;
    std::vector<QuadraturePoint> points;
    std::vector<Vec3> traction;  // at the points, on part 2 [Pa]
    const SplitRules* rules = nullptr;
    double K_I = 0.0, K_II = 0.0;
};

class Interfaces {
public:
    Interfaces(Model& model, State& state, const std::vector<Parting>& partings) : model_(model), state_(state)
    {
        for (const Parting& p : partings) before_[p.request.body] = p.before;
    }

    /// Hand every interface of a split grain to the part that it touches, cut where it touches both.
    void divide(const std::vector<Parting>& partings)
    {
        const InterfaceBonds& f = state_.interfaces;
        std::vector<Piece> pieces;
        for (int i = 0; i < f.size(); ++i) {
            if (before_.count(f.a[i]) + before_.count(f.b[i]) > 0) pieces.push_back(whole(i));
        }
        for (const Parting& p : partings) {
            std::vector<Piece> next;
            for (Piece& piece : pieces) {
                if (piece.a != p.request.body && piece.b != p.request.body) {
                    next.push_back(std::move(piece));
                    continue;
                }
                Piece part[2];
                for (const int side : {0, 1}) {
                    part[side] = {piece.source, piece.a, piece.b, {}, polygon_on_side(piece.corners, p, side == 0)};
                    if (part[side].corners.size() < 3) part[side].corners = piece.corners;
                }
                for (const int q : piece.points)
                    part[p.is_in_part_1(point_in_space(piece.source, q)) ? 0 : 1].points.push_back(q);
                (piece.a == p.request.body ? part[0].a : part[0].b) = p.part_1;
                for (Piece& x : part) {
                    if (x.points.size() == piece.points.size()) x.corners = piece.corners;
                    if (!x.points.empty()) next.push_back(std::move(x));
                }
            }
            pieces = std::move(next);
        }
        rebuild(pieces, {});
    }

    void add(const std::vector<CutSurface>& surfaces) { rebuild({}, surfaces); }

private:
    Placement old_place(int body) const
    {
        const auto found = before_.find(body);
        return found != before_.end() ? found->second : placement(state_.bodies, body);
    }
    Vec3 point_in_space(int source, int q) const
    {
        return 0.5 * (old_place(state_.interfaces.a[source]).to_space(state_.points.position_a[q]) +
                      old_place(state_.interfaces.b[source]).to_space(state_.points.position_b[q]));
    }
    Piece whole(int i) const
    {
        const InterfaceBonds& f = state_.interfaces;
        Piece p{i, f.a[i], f.b[i], {}, {}};
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) p.points.push_back(q);
        for (int c = f.corner_begin[i]; c < f.corner_begin[i + 1]; ++c)
            p.corners.push_back(old_place(f.a[i]).to_space(state_.corners.position_a[c]));
        return p;
    }

    /// New arrays, sorted by pair: interfaces without pieces as they were, the pieces, the new surfaces.
    void rebuild(const std::vector<Piece>& pieces, const std::vector<CutSurface>& surfaces)
    {
        InterfaceBonds& f = state_.interfaces;
        struct Entry {
            int a, b, order;
            int source = -1;
            const Piece* piece = nullptr;
            const CutSurface* surface = nullptr;
        };
        std::vector<char> divided(static_cast<std::size_t>(f.size()), 0);
        for (const Piece& p : pieces) divided[static_cast<std::size_t>(p.source)] = 1;
        std::vector<Entry> entries;
        for (int i = 0; i < f.size(); ++i) {
            if (divided[static_cast<std::size_t>(i)] == 0) entries.push_back({f.a[i], f.b[i], i, i, nullptr, nullptr});
        }
        for (const Piece& p : pieces) {
            const auto [low, high] = std::minmax(p.a, p.b);
            entries.push_back({low, high, p.source, p.source, &p, nullptr});
        }
        for (const CutSurface& s : surfaces) entries.push_back({s.a, s.b, f.size(), -1, nullptr, &s});
        std::stable_sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) {
            return std::tie(x.a, x.b, x.order) < std::tie(y.a, y.b, y.order);
        });

        std::vector<int> sources, points, corners;
        for (const Entry& e : entries) {
            sources.push_back(e.source);
            if (e.piece != nullptr) {
                points.insert(points.end(), e.piece->points.begin(), e.piece->points.end());
                corners.insert(corners.end(), e.piece->corners.size(), -1);
            } else if (e.surface != nullptr) {
                points.insert(points.end(), e.surface->points.size(), -1);
                corners.insert(corners.end(), e.surface->polygon.size(), -1);
            } else {
                for (int q = f.point_begin[e.source]; q < f.point_begin[e.source + 1]; ++q) points.push_back(q);
                for (int c = f.corner_begin[e.source]; c < f.corner_begin[e.source + 1]; ++c) corners.push_back(c);
            }
        }
        const InterfaceBonds old = f;
        const InterfacePoints old_points = state_.points;
        f = gathered(f, sources);
        state_.points = gathered(state_.points, points);
        state_.corners = gathered(state_.corners, corners);
        auto &point_begin = f.point_begin.host(), &corner_begin = f.corner_begin.host();
        point_begin.assign(1, 0);
        corner_begin.assign(1, 0);
        for (std::size_t k = 0; k < entries.size(); ++k) {
            const Entry& e = entries[k];
            const int n = static_cast<int>(k), q = point_begin.back(), c = corner_begin.back();
            if (e.piece != nullptr) {
                fill(*e.piece, n, q, c, old, old_points);
            } else if (e.surface != nullptr) {
                fill(*e.surface, n, q, c);
            }
            const auto count = [&](std::size_t piece, std::size_t surface, int whole) {
                return e.piece != nullptr     ? static_cast<int>(piece)
                       : e.surface != nullptr ? static_cast<int>(surface)
                                              : whole;
            };
            point_begin.push_back(q +
                                  count(e.piece != nullptr ? e.piece->points.size() : 0,
                                        e.surface != nullptr ? e.surface->points.size() : 0,
                                        e.source < 0 ? 0 : old.point_begin[e.source + 1] - old.point_begin[e.source]));
            corner_begin.push_back(
                c + count(e.piece != nullptr ? e.piece->corners.size() : 0,
                          e.surface != nullptr ? e.surface->polygon.size() : 0,
                          e.source < 0 ? 0 : old.corner_begin[e.source + 1] - old.corner_begin[e.source]));
        }
    }

    /// Interface n from a piece: its share of what the source held, everything in the frames of its bodies.
    void fill(const Piece& p, int n, int first_point, int first_corner, const InterfaceBonds& old,
              const InterfacePoints& old_points)
    {
        InterfaceBonds& f = state_.interfaces;
        const Bodies& b = state_.bodies;
        const int i = p.source;
        const bool flipped = p.a > p.b;  // the pair is named by its lower index first
        const int a = flipped ? p.b : p.a, c = flipped ? p.a : p.b;
        const Placement from_a = old_place(old.a[i]), from_b = old_place(old.b[i]);
        const auto turn = [&](const Vec3& v, const Placement& from, int to) {
            return rotate_back(b.orientation[to], rotate(from.orientation, v));
        };
        at(f.a, n) = a;
        at(f.b, n) = c;
        const double sign = flipped ? -1.0 : 1.0;
        const Vec3 na = sign * turn(old.normal_a[i], from_a, p.a), nb = sign * turn(old.normal_b[i], from_b, p.b);
        const Vec3 ta = turn(old.tangent_a[i], from_a, p.a), tb = turn(old.tangent_b[i], from_b, p.b);
        at(f.normal_a, n) = flipped ? nb : na;
        at(f.normal_b, n) = flipped ? na : nb;
        at(f.tangent_a, n) = flipped ? tb : ta;
        at(f.tangent_b, n) = flipped ? ta : tb;

        double area = 0.0, damaged = 0.0;
        for (std::size_t k = 0; k < p.points.size(); ++k) {
            const int q = first_point + static_cast<int>(k), source = p.points[k];
            const Vec3 xa = placement(b, p.a).to_body(from_a.to_space(old_points.position_a[source]));
            const Vec3 xb = placement(b, p.b).to_body(from_b.to_space(old_points.position_b[source]));
            at(state_.points.position_a, q) = flipped ? xb : xa;
            at(state_.points.position_b, q) = flipped ? xa : xb;
            // the jump and the normal turn round, the first tangent stays: only its component changes sign
            if (flipped) at(state_.points.slip, q).x = -old_points.slip[source].x;
            area += old_points.weight[source];
            damaged += old_points.weight[source] * old_points.damage[source];
        }
        const double share = area / old.area[i];
        at(f.area, n) = area;
        at(f.damage, n) = damaged / area;
        for (Buffer<double>* extensive :
             {&f.stored_energy, &f.fracture_work, &f.friction_work, &f.viscous_work, &f.inserted_work, &f.shear_share})
            at(*extensive, n) *= share;
        std::vector<Vec3> corners = p.corners;
        if (flipped) std::reverse(corners.begin(), corners.end());
        put_corners(corners, n, first_corner);
        set_width(corners, n);
    }

    void fill(const CutSurface& s, int n, int first_point, int first_corner)
    {
        InterfaceBonds& f = state_.interfaces;
        const Bodies& b = state_.bodies;
        const PolygonMoments moments = polygon_moments(s.polygon);
        const SplitRules& r = *s.rules;
        at(f.a, n) = s.a;
        at(f.b, n) = s.b;
        at(f.law, n) = r.law;
        at(f.normal_a, n) = rotate_back(b.orientation[s.a], s.normal);
        at(f.normal_b, n) = rotate_back(b.orientation[s.b], s.normal);
        at(f.tangent_a, n) = rotate_back(b.orientation[s.a], moments.axis1);
        at(f.tangent_b, n) = rotate_back(b.orientation[s.b], moments.axis1);
        at(f.area, n) = moments.area;
        at(f.normal_stiffness, n) = r.normal_stiffness;
        at(f.shear_stiffness, n) = r.shear_stiffness;
        const double pair_mass = 1.0 / (b.inverse_mass[s.a] + b.inverse_mass[s.b]);
        at(f.normal_damping, n) = 2.0 * r.damping * std::sqrt(r.normal_stiffness * pair_mass / moments.area);
        at(f.shear_damping, n) = 2.0 * r.damping * std::sqrt(r.shear_stiffness * pair_mass / moments.area);
        at(f.strength_factor, n) = 1.0;
        at(f.toughness_factor, n) = 1.0;
        at(f.opening_limit, n) = model_.shapes.radius[b.shape[s.a]] + model_.shapes.radius[b.shape[s.b]];
        at(f.transgranular, n) = 1;
        at(f.K_I, n) = s.K_I;
        at(f.K_II, n) = s.K_II;
        at(f.first_damage_time, n) = state_.time;
        at(f.failure_time, n) = -1.0;

        // lambda* of every point, and its area mean over what opens
        const InterfaceLaw law = model_.interface_laws[r.law];
        const Vec3 t1 = moments.axis1, t2 = cross(s.normal, moments.axis1);
        std::vector<std::array<double, 3>> jumps;
        std::vector<double> onset, mix;
        double sum = 0.0, open = 0.0;
        for (std::size_t k = 0; k < s.points.size(); ++k) {
            const Vec3 t = s.traction[k];
            const std::array<double, 3> d{dot(t, s.normal) / r.normal_stiffness, dot(t, t1) / r.shear_stiffness,
                                          dot(t, t2) / r.shear_stiffness};
            const double sheared = r.shear_stiffness * (d[1] * d[1] + d[2] * d[2]);
            const double Y = (d[0] > 0.0 ? r.normal_stiffness * d[0] * d[0] : 0.0) + sheared;
            jumps.push_back(d);
            onset.push_back(std::sqrt(Y));
            mix.push_back(Y > 0.0 ? sheared / Y : 0.0);
            if (d[0] > 0.0) {
                sum += s.points[k].weight * onset.back();
                open += s.points[k].weight;
            }
        }
        double stored = 0.0;
        for (std::size_t k = 0; k < s.points.size(); ++k) {
            const int q = first_point + static_cast<int>(k);
            const auto& d = jumps[k];
            // half of the offset on either side, so that the force acts where the traction was found
            const Vec3 x = s.points[k].position,
                       half = r.cohesive ? 0.5 * (d[0] * s.normal + d[1] * t1 + d[2] * t2) : Vec3{};
            at(state_.points.position_a, q) = placement(b, s.a).to_body(x - half);
            at(state_.points.position_b, q) = placement(b, s.b).to_body(x + half);
            at(state_.points.weight, q) = s.points[k].weight;
            if (!r.cohesive) {
                at(state_.points.damage, q) = 1.0;
                at(f.shear_share, n) += s.points[k].weight * mix[k];
                continue;
            }
            stored += 0.5 * s.points[k].weight *
                      (r.normal_stiffness * d[0] * d[0] + r.shear_stiffness * (d[1] * d[1] + d[2] * d[2]));
            if (onset[k] <= 0.0) continue;
            const double mean = d[0] > 0.0 && open > 0.0 ? sum / open : onset[k];
            at(state_.points.onset, q) = onset[k];
            at(state_.points.failure, q) = onset[k] + 2.0 * law.fracture_energy(mix[k]) / mean;
            at(state_.points.slip, q) = {d[1], d[2]};
        }
        if (!r.cohesive) {  // a crack from the start, in the list for the results: contact acts in its place
            at(f.damage, n) = 1.0;
            at(f.failure_time, n) = state_.time;
            at(f.retired, n) = 1;
        }
        at(f.stored_energy, n) = stored;
        at(f.inserted_work, n) = stored;
        put_corners(s.polygon, n, first_corner);
        set_width(s.polygon, n);
    }

    void put_corners(const std::vector<Vec3>& corners, int n, int first)
    {
        const InterfaceBonds& f = state_.interfaces;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int c = first + static_cast<int>(k);
            at(state_.corners.position_a, c) = placement(state_.bodies, f.a[n]).to_body(corners[k]);
            at(state_.corners.position_b, c) = placement(state_.bodies, f.b[n]).to_body(corners[k]);
        }
    }
    /// Least width of the rectangle with the polygon's moments, as when bonds are made.
    void set_width(const std::vector<Vec3>& polygon, int n)
    {
        at(state_.interfaces.diameter, n) = least_width(polygon_moments(polygon));
    }

    Model& model_;
    State& state_;
    std::map<int, Placement> before_;
};

/// Parallel bonds go whole to the part where their centre lies.
void move_parallel_bonds(State& state, const std::vector<Parting>& partings)
{
    ParallelBonds& p = state.parallels;
    if (p.size() == 0) return;
    const Bodies& b = state.bodies;
    for (int i = 0; i < p.size(); ++i) {
        for (const Parting& split : partings) {
            for (const bool side_a : {true, false}) {
                Buffer<std::int32_t>& body = side_a ? p.a : p.b;
                if (body[i] != split.request.body) continue;
                Buffer<Vec3>&position = side_a ? p.position_a : p.position_b,
                &normal = side_a ? p.normal_a : p.normal_b;
                const Vec3 x = split.before.to_space(position[i]), n = rotate(split.before.orientation, normal[i]);
                const int to = split.is_in_part_1(x) ? split.part_1 : split.request.body;
                at(body, i) = to;
                at(position, i) = placement(b, to).to_body(x);
                at(normal, i) = rotate_back(b.orientation[to], n);
            }
        }
        if (p.a[i] > p.b[i]) {
            std::swap(at(p.a, i), at(p.b, i));
            std::swap(at(p.position_a, i), at(p.position_b, i));
            const Vec3 na = p.normal_a[i], nb = p.normal_b[i];
            at(p.normal_a, i) = -nb;
            at(p.normal_b, i) = -na;
            for (Buffer<Vec3>* v : {&p.force, &p.moment, &p.normal, &p.viscous_force}) at(*v, i) = -(*v)[i];
        }
    }
    std::vector<int> order(static_cast<std::size_t>(p.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int x, int y) {
        return std::pair{p.a[x], p.b[x]} < std::pair{p.a[y], p.b[y]};
    });
    p = gathered(p, order);
}

/// A contact of a grain that is split, as it was.
struct OldContact {
    int a = 0, b = 0;
    double pressed = 0.0;  // without its viscous part [N]
    Vec3 shear_force;      // on a [N]
};

std::vector<OldContact> take_contacts(State& state, const std::vector<Parting>& partings)
{
    Contacts& c = state.contacts;
    std::vector<OldContact> old;
    for (int i = 0; i < c.size(); ++i) {
        const bool concerned = std::any_of(partings.begin(), partings.end(), [&](const Parting& p) {
            return p.request.body == c.a[i] || p.request.body == c.b[i];
        });
        if (!concerned || c.active[i] != 1) continue;
        old.push_back({c.a[i], c.b[i], c.normal_force[i] - c.viscous_force[i], c.shear_force[i]});
        state.past_contacts.inserted_work -= c.stored_energy[i];
        at(c.stored_energy, i) = at(c.viscous_force, i) = 0.0;
        at(c.active, i) = 0;
    }
    return old;
}

/// The contacts of the parts share the force of the grain's contact by what their geometry alone would press. Returns
/// them.
std::vector<int> give_contacts(const Model& model, State& state, const std::vector<Parting>& partings,
                               const std::vector<OldContact>& old)
{
    Contacts& c = state.contacts;
    const auto parts = [&](int body) {
        std::vector<int> list{body};
        for (const Parting& p : partings) {
            if (p.request.body == body) list.push_back(p.part_1);
        }
        return list;
    };
    std::map<std::pair<int, int>, int> index;
    for (int i = 0; i < c.size(); ++i) index[{c.a[i], c.b[i]}] = i;
    std::vector<int> given;
    for (const OldContact& o : old) {
        struct Heir {
            int contact;
            double own;
            bool turned_round;  // the pair is named the other way round
        };
        std::vector<Heir> heirs;
        double sum = 0.0;
        for (const int a : parts(o.a)) {
            for (const int b : parts(o.b)) {
                const auto found = index.find(std::minmax(a, b));
                if (found == index.end() || c.point[found->second].overlap_energy <= 0.0) continue;
                const int i = found->second;
                const double own = model.contact_laws[c.law[i]].area_stiffness * c.point[i].overlap_force;
                heirs.push_back({i, own, a > b});
                sum += own;
            }
        }
        for (const auto& [i, own, turned_round] : heirs) {
            const double share = own / sum, pressed = share * o.pressed;
            given.push_back(i);
            at(c.active, i) = 1;
            at(c.normal, i) = c.point[i].normal;
            at(c.shear_force, i) = (turned_round ? -share : share) * tangential(o.shear_force, c.point[i].normal);
            at(c.twist_moment, i) = at(c.max_overlap, i) = at(c.offset_overlap, i) = 0.0;
            at(c.shear_stiffness, i) = at(c.twist_stiffness, i) = 0.0;
            at(c.stiffness_scale, i) = 1.0;
            match_force(std::fmax(0.0, pressed), own, c.point[i], at(c.offset_overlap, i), at(c.stiffness_scale, i));
        }
    }
    // Parts are eroded by smaller radii, and their sharper edges may reach what the grain's did not: no force from
    // that.
    for (int i = 0; i < c.size(); ++i) {
        const bool concerned = std::any_of(partings.begin(), partings.end(), [&](const Parting& p) {
            return p.request.body == c.a[i] || p.request.body == c.b[i] || p.part_1 == c.a[i] || p.part_1 == c.b[i];
        });
        if (!concerned || c.active[i] == 1 || c.point[i].overlap_energy <= 0.0) continue;
        at(c.active, i) = 1;
        at(c.normal, i) = c.point[i].normal;
        at(c.offset_overlap, i) = std::sqrt(2.0 * c.point[i].overlap_energy);
    }
    return given;
}

void bring_up_to_date(const Model& model, State& state)
{
    contact_forces(model, state, 0.0);
    bond_forces(model, state, 0.0);
    gather_forces(model, state);
}

/// The traction that the plane carried: §12, from the loads on part 1 as they are shared out now.
CutSurface cut_surface(const State& state, const Parting& p)
{
    const Bodies& b = state.bodies;
    const int one = p.part_1, two = p.request.body;
    // the grain's acceleration from all loads on both parts
    const Vec3 c = p.before.position, force = b.force[one] + b.force[two];
    const Vec3 torque = b.torque[one] + b.torque[two] + cross(b.position[one] - c, b.force[one]) +
                        cross(b.position[two] - c, b.force[two]);
    const Quat q = p.before.orientation;
    const Vec3 w = p.angular_velocity;
    const Vec3 w_rate = rotate(q, angular_acceleration(p.inertia, rotate_back(q, w), rotate_back(q, torque)));

    const Vec3 r = b.position[one] - c;
    const Vec3 a_1 = force / p.mass + cross(w_rate, r) + cross(w, cross(w, r));
    const Quat q1 = b.orientation[one];
    const auto by_inertia = [&](const Vec3& v) {
        const Vec3 x = rotate_back(q1, v), J = b.inertia[one];
        return rotate(q1, {J.x * x.x, J.y * x.y, J.z * x.z});
    };
    CutSurface s;
    s.a = two;
    s.b = one;
    s.rules = &p.request.rules;
    s.K_I = p.request.K_I;
    s.K_II = p.request.K_II;
    s.polygon = p.section;
    s.normal = p.request.plane.normal;
    const PlaneMoments m = plane_moments(s.polygon.data(), static_cast<int>(s.polygon.size()), s.normal);
    // F*, M*: part 2 on part 1, about the centroid of the plane
    const Vec3 F = b.mass[one] * a_1 - b.force[one];
    const Vec3 M =
        by_inertia(w_rate) + cross(w, by_inertia(w)) - b.torque[one] + cross(b.position[one] - m.centroid, F);

    // it acts on part 2; the quadrature integrates its products with the arms exactly
    const TractionField field = fit_tractions(m, {-F, -M});
    s.points = quadrature(s.polygon, s.rules->quadrature);
    for (const QuadraturePoint& q_point : s.points) s.traction.push_back(field.at(q_point.position));
    return s;
}

}  // namespace

const char* to_string(SplitStatus status)
{
    switch (status) {
        case SplitStatus::done:
            return "done";
        case SplitStatus::generation:
            return "split too often";
        case SplitStatus::small_part:
            return "a part would be too small";
        case SplitStatus::thin_part:
            return "a part would be too thin";
        case SplitStatus::small_section:
            return "the plane only chips the grain";
        case SplitStatus::outside:
            return "the plane misses the grain";
        case SplitStatus::degenerate:
            return "the cut is not clean";
    }
    return "";
}

SplitStatus why_not_parted(const Polyhedron& grain, const CutResult& cut, double radius, double whole_volume,
                           const SplitRules& rules)
{
    if (cut.status == CutStatus::all_inside || cut.status == CutStatus::all_outside) return SplitStatus::outside;
    if (cut.status != CutStatus::ok) return SplitStatus::degenerate;
    for (const Polyhedron* part : {&cut.inside, &cut.outside}) {
        if (mass_properties(*part).volume < rules.least_volume * whole_volume) return SplitStatus::small_part;
        if (inscribed_ball(*part).radius < rules.least_inradius * radius) return SplitStatus::thin_part;
    }
    if (norm(area_vector(cut.section)) < rules.least_section * surface_area(grain)) return SplitStatus::small_section;
    return SplitStatus::done;
}

SplitStatus why_not_split(const Model& model, const State& state, const SplitRequest& request)
{
    return cut_grain(model, state, request).status;
}

std::vector<SplitReport> split_grains(Model& model, State& state, std::vector<SplitRequest> requests)
{
    std::sort(requests.begin(), requests.end(),
              [](const SplitRequest& x, const SplitRequest& y) { return x.body < y.body; });
    std::vector<SplitReport> reports;
    std::vector<Parting> partings;
    std::vector<CutResult> cuts;
    std::vector<std::size_t> report_of;
    const Bodies& b = state.bodies;
    for (const SplitRequest& r : requests) {
        if (!reports.empty() && reports.back().body == r.body)
            throw std::logic_error("split_grains: two planes for one grain");
        SplitReport report;
        report.body = r.body;
        report.parent_id = b.id[r.body];
        Parts parts = cut_grain(model, state, r);
        report.status = parts.status;
        if (parts.status == SplitStatus::done) {
            Parting p;
            p.request = r;
            p.before = placement(b, r.body);
            p.mass = b.mass[r.body];
            p.inertia = b.inertia[r.body];
            p.velocity = b.velocity[r.body];
            p.angular_velocity = b.angular_velocity[r.body];
            p.on_plane = point_on_plane_tolerance * bounding_size(model.grain_shapes[static_cast<std::size_t>(r.body)]);
            for (const Vec3& x : parts.cut.section) p.section.push_back(p.before.to_space(x));
            report.area = norm(area_vector(p.section));
            partings.push_back(std::move(p));
            cuts.push_back(std::move(parts.cut));
            report_of.push_back(reports.size());
        } else {
            const bool for_good = parts.status == SplitStatus::generation;
            at(state.bodies.saturated, r.body) |= for_good ? ~std::int64_t{0} : candidate_bit(r.candidate);
        }
        reports.push_back(report);
    }
    if (partings.empty()) return reports;

    state.slots.dyad_a.resize(0);  // of the interactions that were; the next step that is asked for stresses makes room
    state.slots.dyad_b.resize(0);
    const std::vector<OldContact> contacts = take_contacts(state, partings);
    Interfaces interfaces(model, state, partings);
    for (std::size_t k = 0; k < partings.size(); ++k) {
        make_bodies(model, state, partings[k], cuts[k]);
        reports[report_of[k]].new_body = partings[k].part_1;
    }
    interfaces.divide(partings);
    move_parallel_bonds(state, partings);
    find_pairs(model, state);
    find_contacts(model, state);
    const std::vector<int> given = give_contacts(model, state, partings, contacts);
    // what they hold, or lose at once to a tighter cap, is put in without work
    const auto held_and_lost = [&](int i) {
        const Contacts& c = state.contacts;
        return c.stored_energy[i] + c.friction_work[i] + c.hysteresis_work[i];
    };
    for (const int i : given) at(state.contacts.inserted_work, i) -= held_and_lost(i);
    bring_up_to_date(model, state);
    for (const int i : given) at(state.contacts.inserted_work, i) += held_and_lost(i);

    std::vector<CutSurface> surfaces;
    for (const Parting& p : partings) surfaces.push_back(cut_surface(state, p));
    interfaces.add(surfaces);
    find_pairs(model, state);
    find_contacts(model, state);
    bring_up_to_date(model, state);
    for (int i = 0; i < state.interfaces.size(); ++i) {
        for (std::size_t k = 0; k < partings.size(); ++k) {
            if (state.interfaces.a[i] == partings[k].request.body && state.interfaces.b[i] == partings[k].part_1)
                reports[report_of[k]].inserted_energy = state.interfaces.inserted_work[i];
        }
    }
    return reports;
}

}  // namespace grainfrac
