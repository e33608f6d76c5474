// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/split_bonds.h"

#include "fracture/face_moments.h"
#include "model/point_history.h"
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
        std::vector<char> concerned(static_cast<std::size_t>(state_.bodies.size()), 0);
        for (const Parting& p : partings) concerned[static_cast<std::size_t>(p.request.body)] = 1;
        for (int i = 0; i < f.size(); ++i) {
            if (concerned[static_cast<std::size_t>(f.a[i])] + concerned[static_cast<std::size_t>(f.b[i])] > 0)
                pieces.push_back(whole(i));
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

    /// The arrays with pieces and surfaces in the places that their pairs have in the order.
    std::vector<int> rebuild(const std::vector<Piece>& pieces, std::vector<CutSurface>& surfaces)
    {
        InterfaceBonds& f = state_.interfaces;
        struct Entry {
            int a, b, order;
            const Piece* piece = nullptr;
            CutSurface* surface = nullptr;
        };
        std::vector<Entry> fresh;
        std::vector<char> divided(static_cast<std::size_t>(f.size()), 0);
        for (const Piece& p : pieces) {
            const auto [low, high] = std::minmax(p.a, p.b);
            fresh.push_back({low, high, p.source, &p, nullptr});
            divided[static_cast<std::size_t>(p.source)] = 1;
        }
        for (CutSurface& s : surfaces) fresh.push_back({s.a, s.b, f.size(), nullptr, &s});
        std::stable_sort(fresh.begin(), fresh.end(), [](const Entry& x, const Entry& y) {
            return std::tie(x.a, x.b, x.order) < std::tie(y.a, y.b, y.order);
        });

        Rearrangement interfaces, points, corners;
        std::vector<int> was;
        std::vector<std::int32_t> point_begin{0}, corner_begin{0};
        const auto close = [&](int source) {
            was.push_back(source);
            point_begin.push_back(points.size);
            corner_begin.push_back(corners.size);
        };
        const auto put = [&](const Entry& e) {
            interfaces.put(e.piece != nullptr ? e.piece->source : -1);
            if (e.piece != nullptr) {
                for (const int q : e.piece->points) points.put(q);
            } else {
                for (std::size_t k = 0; k < e.surface->points.size(); ++k) points.put(-1);
            }
            const std::size_t sides = e.piece != nullptr ? e.piece->corners.size() : e.surface->polygon.size();
            for (std::size_t k = 0; k < sides; ++k) corners.put(-1);
            close(-1);
        };
        std::vector<int> places;
        auto next = fresh.begin();
        for (int i = 0; i <= f.size(); ++i) {
            const auto comes_first = [&](const Entry& e) {
                return i == f.size() || std::tie(e.a, e.b) < std::tie(f.a[i], f.b[i]);
            };
            for (; next != fresh.end() && comes_first(*next); ++next) {
                places.push_back(interfaces.size);
                put(*next);
            }
            if (i == f.size() || divided[static_cast<std::size_t>(i)] != 0) continue;
            interfaces.keep(i, 1);
            points.keep(f.point_begin[i], f.point_begin[i + 1] - f.point_begin[i]);
            corners.keep(f.corner_begin[i], f.corner_begin[i + 1] - f.corner_begin[i]);
            close(i);
        }

        std::vector<int> sources, source_points;  // of the pieces
        std::vector<InterfacePointState> old_states;
        for (const Entry& e : fresh) {
            if (e.piece == nullptr) continue;
            sources.push_back(e.piece->source);
            source_points.insert(source_points.end(), e.piece->points.begin(), e.piece->points.end());
            for (const int q : e.piece->points) old_states.push_back(point_state(state_, e.piece->source, q));
        }
        const InterfaceBonds old = gathered(f, sources);
        const InterfacePoints old_points = gathered(state_.points, source_points);
        rearrange(f, interfaces);
        rearrange(state_.points, points);
        rearrange(state_.corners, corners);
        f.point_begin.host() = point_begin;
        f.corner_begin.host() = corner_begin;
        keep_histories(places);
        int piece = 0, point = 0;
        for (std::size_t k = 0; k < fresh.size(); ++k) {
            const auto n = static_cast<std::size_t>(places[k]);
            if (fresh[k].piece != nullptr) {
                fill(*fresh[k].piece, places[k], point_begin[n], corner_begin[n], old, piece++, old_points, old_states,
                     point);
                point += static_cast<int>(fresh[k].piece->points.size());
            } else {
                fresh[k].surface->interface = places[k];
                fill(*fresh[k].surface, places[k], point_begin[n], corner_begin[n]);
            }
        }
        return was;
    }

private:
    /// In the order of the interfaces; those that are new begin without.
    void keep_histories(const std::vector<int>& fresh)
    {
        InterfaceBonds& f = state_.interfaces;
        for (const int n : fresh) f.history.at(n) = no_history::none;
        std::vector<int> source;
        for (int n = 0; n < f.size(); ++n) {
            const int first = f.history[n];
            if (first < 0) continue;
            f.history.at(n) = static_cast<int>(source.size());
            for (int k = 0; k < f.point_begin[n + 1] - f.point_begin[n]; ++k) source.push_back(first + k);
        }
        state_.histories = gathered(state_.histories, source);
    }
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

    /// Interface n from a piece: its share of what its source, old[i], held, everything in the frames of its bodies.
    void fill(const Piece& p, int n, int first_point, int first_corner, const InterfaceBonds& old, int i,
              const InterfacePoints& old_points, const std::vector<InterfacePointState>& old_states,
              int first_old_point)
    {
        InterfaceBonds& f = state_.interfaces;
        const Bodies& b = state_.bodies;
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
            const int q = first_point + static_cast<int>(k), source = first_old_point + static_cast<int>(k);
            const Vec3 xa = placement(b, p.a).to_body(from_a.to_space(old_points.position_a[source]));
            const Vec3 xb = placement(b, p.b).to_body(from_b.to_space(old_points.position_b[source]));
            state_.points.position_a.at(q) = flipped ? xb : xa;
            state_.points.position_b.at(q) = flipped ? xa : xb;
            InterfacePointState point = old_states[static_cast<std::size_t>(source)];
            area += old_points.weight[source];
            damaged += old_points.weight[source] * point.damage;
            // the jump and the normal turn round, the first tangent stays: only its component changes sign
            if (flipped) point.slip1 = -point.slip1;
            if (old.history[i] >= 0) set_point_state(state_, n, q, point);
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
        f.moments.at(n) = face_moments(state_, n);
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
            if (!r.cohesive) set_point_state(state_, n, q, {.damage = 1.0});
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
        state_.interfaces.slip_limit.at(n) = retirement_slip * least_width(polygon_moments(polygon));
    }

    const Model& model_;
    State& state_;
    std::map<int, Placement> before_;
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
        set_point_state(state, n, q, {0.0, onset[k], onset[k] + 2.0 * law.fracture_energy(mix[k]) / mean, d[1], d[2]});
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
    p = gathered(p, order);
    return order;
}

}  // namespace grainfrac
