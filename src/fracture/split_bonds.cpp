// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/split_bonds.h"

#include "model/rearrange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace grainfrac {

namespace {

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

class Interfaces {
public:
    Interfaces(const Model& model, State& state, const std::vector<Parting>& partings) : model_(model), state_(state)
    {
        for (const Parting& p : partings) before_[p.request.body] = p.before;
    }

    std::vector<Piece> pieces(const std::vector<Parting>& partings) const
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
        return pieces;
    }

    /// The arrays with pieces and surfaces in the places that their pairs have in the order; only what lies between the
    /// first and the last of them is made anew, the rest moves along.
    std::vector<int> rebuild(const std::vector<Piece>& pieces, std::vector<CutSurface>& surfaces)
    {
        InterfaceBonds& f = state_.interfaces;
        struct Entry {
            int a, b, order;
            int source = -1;
            const Piece* piece = nullptr;
            CutSurface* surface = nullptr;
        };
        const auto before = [](const Entry& x, const Entry& y) {
            return std::tie(x.a, x.b, x.order) < std::tie(y.a, y.b, y.order);
        };
        std::vector<Entry> fresh;
        for (const Piece& p : pieces) {
            const auto [low, high] = std::minmax(p.a, p.b);
            fresh.push_back({low, high, p.source, p.source, &p, nullptr});
        }
        for (CutSurface& s : surfaces) fresh.push_back({s.a, s.b, f.size(), -1, nullptr, &s});

        if (fresh.empty()) {
            std::vector<int> same(static_cast<std::size_t>(f.size()));
            std::iota(same.begin(), same.end(), 0);
            return same;
        }
        std::vector<char> divided(static_cast<std::size_t>(f.size()), 0);
        for (const Piece& p : pieces) divided[static_cast<std::size_t>(p.source)] = 1;
        std::vector<Entry> all;
        for (int i = 0; i < f.size(); ++i) all.push_back({f.a[i], f.b[i], i, i, nullptr, nullptr});
        int first = 0, last = f.size();  // of the old interfaces, what is made anew
        if (std::is_sorted(all.begin(), all.end(), before)) {
            first = f.size();
            last = 0;
            const auto include = [&](int from, int to) {
                first = std::min(first, from);
                last = std::max(last, to);
            };
            for (const Entry& e : fresh) {
                const int place = static_cast<int>(std::lower_bound(all.begin(), all.end(), e, before) - all.begin());
                include(place, place);
                if (e.source >= 0) include(e.source, e.source + 1);
            }
        }
        std::vector<Entry> entries;
        for (int i = first; i < last; ++i) {
            if (divided[static_cast<std::size_t>(i)] == 0) entries.push_back(all[static_cast<std::size_t>(i)]);
        }
        entries.insert(entries.end(), fresh.begin(), fresh.end());
        std::stable_sort(entries.begin(), entries.end(), before);

        for (Buffer<std::int32_t>* begin : {&f.point_begin, &f.corner_begin}) {
            if (begin->empty()) begin->assign(1, 0);  // never had a bond
        }
        const int first_point = f.point_begin[first], last_point = f.point_begin[last];
        const int first_corner = f.corner_begin[first], last_corner = f.corner_begin[last];
        std::vector<int> sources, points, corners, point_begin{first_point}, corner_begin{first_corner};
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
            point_begin.push_back(first_point + static_cast<int>(points.size()));
            corner_begin.push_back(first_corner + static_cast<int>(corners.size()));
        }

        old_ = slice(f, first, last);
        old_points_ = slice(state_.points, first_point, last_point);
        first_ = first;
        first_point_ = first_point;
        std::vector<std::int32_t> later_points, later_corners;
        for (int i = last + 1; i <= static_cast<int>(all.size()); ++i) {
            later_points.push_back(f.point_begin[i] - last_point + point_begin.back());
            later_corners.push_back(f.corner_begin[i] - last_corner + corner_begin.back());
        }
        replace(f, first, last, sources);
        replace(state_.points, first_point, last_point, points);
        replace(state_.corners, first_corner, last_corner, corners);
        const auto put = [first](Buffer<std::int32_t>& begin, const std::vector<int>& window,
                                 const std::vector<std::int32_t>& later) {
            auto& b = begin.host();
            b.resize(static_cast<std::size_t>(first));
            b.insert(b.end(), window.begin(), window.end());
            b.insert(b.end(), later.begin(), later.end());
        };
        put(f.point_begin, point_begin, later_points);
        put(f.corner_begin, corner_begin, later_corners);

        std::vector<int> was(static_cast<std::size_t>(f.size()));
        const int end = first + static_cast<int>(entries.size());
        for (int n = 0; n < f.size(); ++n) was[static_cast<std::size_t>(n)] = n < first ? n : n - end + last;
        for (std::size_t k = 0; k < entries.size(); ++k) {
            const Entry& e = entries[k];
            const int n = first + static_cast<int>(k);
            was[static_cast<std::size_t>(n)] = e.piece != nullptr ? -1 : e.source;
            if (e.piece != nullptr) fill(*e.piece, n, point_begin[k], corner_begin[k]);
            if (e.surface != nullptr) {
                e.surface->interface = n;
                fill(*e.surface, n, point_begin[k], corner_begin[k]);
            }
        }
        return was;
    }

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

    /// Interface n from a piece: its share of what the source held, everything in the frames of its bodies.
    void fill(const Piece& p, int n, int first_point, int first_corner)
    {
        InterfaceBonds& f = state_.interfaces;
        const Bodies& b = state_.bodies;
        const int i = p.source - first_;
        const InterfaceBonds& old = old_;
        const bool flipped = p.a > p.b;  // the pair is named by its lower index first
        const int a = flipped ? p.b : p.a, c = flipped ? p.a : p.b;
        const Placement from_a = old_place(old.a[i]), from_b = old_place(old.b[i]);
        const auto turn = [&](const Vec3& v, const Placement& from, int to) {
            return rotate_back(b.orientation[to], rotate(from.orientation, v));
        };
        f.a.at(n) = a;
        f.b.at(n) = c;
        const double sign = flipped ? -1.0 : 1.0;
        const Vec3 na = sign * turn(old.normal_a[i], from_a, p.a), nb = sign * turn(old.normal_b[i], from_b, p.b);
        const Vec3 ta = turn(old.tangent_a[i], from_a, p.a), tb = turn(old.tangent_b[i], from_b, p.b);
        f.normal_a.at(n) = flipped ? nb : na;
        f.normal_b.at(n) = flipped ? na : nb;
        f.tangent_a.at(n) = flipped ? tb : ta;
        f.tangent_b.at(n) = flipped ? ta : tb;

        double area = 0.0, damaged = 0.0;
        for (std::size_t k = 0; k < p.points.size(); ++k) {
            const int q = first_point + static_cast<int>(k), source = p.points[k] - first_point_;
            const Vec3 xa = placement(b, p.a).to_body(from_a.to_space(old_points_.position_a[source]));
            const Vec3 xb = placement(b, p.b).to_body(from_b.to_space(old_points_.position_b[source]));
            state_.points.position_a.at(q) = flipped ? xb : xa;
            state_.points.position_b.at(q) = flipped ? xa : xb;
            // the jump and the normal turn round, the first tangent stays: only its component changes sign
            if (flipped) state_.points.slip.at(q).x = -old_points_.slip[source].x;
            area += old_points_.weight[source];
            damaged += old_points_.weight[source] * old_points_.damage[source];
        }
        const double share = area / old.area[i];
        f.area.at(n) = area;
        f.damage.at(n) = damaged / area;
        for (Buffer<double>* extensive :
             {&f.stored_energy, &f.fracture_work, &f.friction_work, &f.viscous_work, &f.inserted_work, &f.shear_share})
            (*extensive).at(n) *= share;
        std::vector<Vec3> corners = p.corners;
        if (flipped) std::reverse(corners.begin(), corners.end());
        put_corners(corners, n, first_corner);
        set_width(corners, n);
    }

    /// Everything but what it carries.
    void fill(const CutSurface& s, int n, int first_point, int first_corner)
    {
        InterfaceBonds& f = state_.interfaces;
        const Bodies& b = state_.bodies;
        const PolygonMoments moments = polygon_moments(s.polygon);
        const SplitRules& r = s.rules;
        f.a.at(n) = s.a;
        f.b.at(n) = s.b;
        f.law.at(n) = r.law;
        f.normal_a.at(n) = rotate_back(b.orientation[s.a], s.normal);
        f.normal_b.at(n) = rotate_back(b.orientation[s.b], s.normal);
        f.tangent_a.at(n) = rotate_back(b.orientation[s.a], moments.axis1);
        f.tangent_b.at(n) = rotate_back(b.orientation[s.b], moments.axis1);
        f.area.at(n) = moments.area;
        f.normal_stiffness.at(n) = r.normal_stiffness;
        f.shear_stiffness.at(n) = r.shear_stiffness;
        const double pair_mass = 1.0 / (b.inverse_mass[s.a] + b.inverse_mass[s.b]);
        f.normal_damping.at(n) = 2.0 * r.damping * std::sqrt(r.normal_stiffness * pair_mass / moments.area);
        f.shear_damping.at(n) = 2.0 * r.damping * std::sqrt(r.shear_stiffness * pair_mass / moments.area);
        f.strength_factor.at(n) = 1.0;
        f.toughness_factor.at(n) = 1.0;
        f.opening_limit.at(n) = model_.shapes.radius[b.shape[s.a]] + model_.shapes.radius[b.shape[s.b]];
        f.transgranular.at(n) = 1;
        f.K_I.at(n) = s.K_I;
        f.K_II.at(n) = s.K_II;
        f.first_damage_time.at(n) = state_.time;
        f.failure_time.at(n) = -1.0;

        for (std::size_t k = 0; k < s.points.size(); ++k) {
            const int q = first_point + static_cast<int>(k);
            state_.points.position_a.at(q) = placement(b, s.a).to_body(s.points[k].position);
            state_.points.position_b.at(q) = placement(b, s.b).to_body(s.points[k].position);
            state_.points.weight.at(q) = s.points[k].weight;
            if (!r.cohesive) state_.points.damage.at(q) = 1.0;
        }
        if (!r.cohesive) {  // a crack from the start, in the list for the results: contact acts in its place
            f.damage.at(n) = 1.0;
            f.failure_time.at(n) = state_.time;
            f.retired.at(n) = 1;
        }
        put_corners(s.polygon, n, first_corner);
        set_width(s.polygon, n);
    }

    void put_corners(const std::vector<Vec3>& corners, int n, int first)
    {
        const InterfaceBonds& f = state_.interfaces;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int c = first + static_cast<int>(k);
            state_.corners.position_a.at(c) = placement(state_.bodies, f.a[n]).to_body(corners[k]);
            state_.corners.position_b.at(c) = placement(state_.bodies, f.b[n]).to_body(corners[k]);
        }
    }
    /// Least width of the rectangle with the polygon's moments, as when bonds are made.
    void set_width(const std::vector<Vec3>& polygon, int n)
    {
        state_.interfaces.diameter.at(n) = least_width(polygon_moments(polygon));
    }

    const Model& model_;
    State& state_;
    std::map<int, Placement> before_;
    InterfaceBonds old_;          // from first_ on, before the rebuild
    InterfacePoints old_points_;  // from first_point_ on
    int first_ = 0, first_point_ = 0;
};

}  // namespace

CutSurface surface_of(const Parting& p)
{
    CutSurface s;
    s.a = p.request.body;
    s.b = p.part_1;
    s.polygon = p.section;
    s.normal = p.request.plane.normal;
    s.rules = p.request.rules;
    s.points = quadrature(s.polygon, s.rules.quadrature);
    s.K_I = p.request.K_I;
    s.K_II = p.request.K_II;
    return s;
}

std::vector<int> divide_interfaces(const Model& model, State& state, const std::vector<Parting>& partings,
                                   std::vector<CutSurface>& surfaces)
{
    Interfaces interfaces(model, state, partings);
    return interfaces.rebuild(interfaces.pieces(partings), surfaces);
}

void load_surface(const Model& model, State& state, const CutSurface& s, const std::vector<Vec3>& traction)
{
    InterfaceBonds& f = state.interfaces;
    const Bodies& b = state.bodies;
    const SplitRules& r = s.rules;
    const int n = s.interface, first_point = f.point_begin[n];
    // lambda* of every point, and its area mean over what opens
    const InterfaceLaw law = model.interface_laws[r.law];
    const Vec3 t1 = rotate(b.orientation[s.a], f.tangent_a[n]), t2 = cross(s.normal, t1);
    std::vector<std::array<double, 3>> jumps;
    std::vector<double> onset, mix;
    double sum = 0.0, open = 0.0;
    for (std::size_t k = 0; k < s.points.size(); ++k) {
        const Vec3 t = traction[k];
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
    if (!r.cohesive) {  // only what broke it
        for (std::size_t k = 0; k < s.points.size(); ++k) f.shear_share.at(n) += s.points[k].weight * mix[k];
        return;
    }
    double stored = 0.0;
    for (std::size_t k = 0; k < s.points.size(); ++k) {
        const int q = first_point + static_cast<int>(k);
        const auto& d = jumps[k];
        // half of the offset on either side, so that the force acts where the traction was found
        const Vec3 half = 0.5 * (d[0] * s.normal + d[1] * t1 + d[2] * t2), x = s.points[k].position;
        state.points.position_a.at(q) = placement(b, s.a).to_body(x - half);
        state.points.position_b.at(q) = placement(b, s.b).to_body(x + half);
        state.points.weight.at(q) = s.points[k].weight;
        stored += 0.5 * s.points[k].weight *
                  (r.normal_stiffness * d[0] * d[0] + r.shear_stiffness * (d[1] * d[1] + d[2] * d[2]));
        if (onset[k] <= 0.0) continue;
        const double mean = d[0] > 0.0 && open > 0.0 ? sum / open : onset[k];
        state.points.onset.at(q) = onset[k];
        state.points.failure.at(q) = onset[k] + 2.0 * law.fracture_energy(mix[k]) / mean;
        state.points.slip.at(q) = {d[1], d[2]};
    }
    f.stored_energy.at(n) = stored;
    f.inserted_work.at(n) = stored;
}

std::vector<int> divide_parallel_bonds(State& state, const std::vector<Parting>& partings)
{
    ParallelBonds& p = state.parallels;
    if (p.size() == 0) return {};
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
                body.at(i) = to;
                position.at(i) = placement(b, to).to_body(x);
                normal.at(i) = rotate_back(b.orientation[to], n);
            }
        }
        if (p.a[i] > p.b[i]) {
            std::swap(p.a.at(i), p.b.at(i));
            std::swap(p.position_a.at(i), p.position_b.at(i));
            const Vec3 na = p.normal_a[i], nb = p.normal_b[i];
            p.normal_a.at(i) = -nb;
            p.normal_b.at(i) = -na;
            for (Buffer<Vec3>* v : {&p.force, &p.moment, &p.normal, &p.viscous_force}) (*v).at(i) = -(*v)[i];
        }
    }
    std::vector<int> order(static_cast<std::size_t>(p.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int x, int y) {
        return std::pair{p.a[x], p.b[x]} < std::pair{p.a[y], p.b[y]};
    });
    replace(p, 0, p.size(), order);
    return order;
}

}  // namespace grainfrac
