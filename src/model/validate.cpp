// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/validate.h"

#include "model/checksum.h"
#include "model/point_history.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace grainfrac {

namespace {

bool finite(const Vec3& a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Unit length within this [-]; drift renormalises each step, so that more means a corrupted state.
constexpr double unit_tolerance = 1e-9;

std::string bodies_problem(const Model& model, const Bodies& b)
{
    for (int i = 0; i < b.size(); ++i) {
        const Quat q = b.orientation[i];
        const auto problem = [&](const char* what) { return fmt::format("body {}: {}", b.id[i], what); };
        if (!finite(b.position[i])) return problem("position is not finite");
        if (!finite(b.velocity[i])) return problem("velocity is not finite");
        if (!finite(b.force[i]) || !finite(b.torque[i])) return problem("force or torque is not finite");
        if (!finite(b.angular_momentum[i])) return problem("angular momentum is not finite");
        if (!(std::fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < unit_tolerance))
            return problem("orientation is not of unit length");
        if (b.shape[i] < 0 || b.shape[i] >= model.shapes.size()) return problem("has no shape");
        if (b.group[i] < 0 || b.group[i] >= static_cast<int>(model.groups.size()))
            return problem("belongs to no part or wall");
        if (b.inverse_mass[i] > 0.0 && !(b.mass[i] > 0.0)) return problem("has no mass");
    }
    return {};
}

template <class Bonds>
std::string bonds_problem(const char* kind, const Bonds& bonds, int bodies)
{
    for (int i = 0; i < bonds.size(); ++i) {
        const int a = bonds.a[i], b = bonds.b[i];
        if (a < 0 || b <= a || b >= bodies) return fmt::format("{} {}: bodies {} and {} are no pair", kind, i, a, b);
        if (i > 0 && (bonds.a[i - 1] > a || (bonds.a[i - 1] == a && bonds.b[i - 1] > b)))
            return fmt::format("{} {}: not sorted", kind, i);
        if (!std::isfinite(bonds.stored_energy[i])) return fmt::format("{} {}: energy is not finite", kind, i);
    }
    return {};
}

/// A contact and its pair name each other.
std::string contacts_problem(const State& state)
{
    const CandidatePairs& pairs = state.pairs;
    const Contacts& c = state.contacts;
    for (int i = 0; i < c.size(); ++i) {
        const int pair = c.pair[i];
        if (pair < 0 || pair >= pairs.size() || pairs.contact[pair] != i)
            return fmt::format("contact {}: is not that of its pair", i);
    }
    for (int i = 0; i < pairs.size(); ++i) {
        const int contact = pairs.contact[i];
        if (contact >= c.size() || (contact >= 0 && c.pair[contact] != i))
            return fmt::format("pair {}: has the contact of another", i);
    }
    return {};
}

/// Entries of tables that are not there.
std::string tables_problem(const Model& model, const State& state)
{
    const InterfaceBonds& f = state.interfaces;
    for (int i = 0; i < f.size(); ++i) {
        if (f.history[i] >= 0 && f.history[i] + f.point_begin[i + 1] - f.point_begin[i] > state.histories.size())
            return fmt::format("interface {}: its points have no history", i);
    }
    const SphereBonds& s = state.sphere_bonds;
    for (int i = 0; i < s.size(); ++i) {
        if (s.kind[i] < 0 || s.kind[i] >= s.kinds.size()) return fmt::format("sphere bond {}: is of no kind", i);
        if (s.law[i] < 0 || s.law[i] >= model.sphere_bond_laws.size())
            return fmt::format("sphere bond {}: has no law", i);
        const SphereBondLaw law = model.sphere_bond_laws[s.law[i]];
        const bool history = !s.shear_force.empty() && !s.moment.empty() && !s.twist.empty() && !s.normal.empty();
        if (law.incremental ? !history : s.axis_a.empty())
            return fmt::format("sphere bond {}: lacks what its law needs", i);
        if (law.damping > 0.0 && (s.viscous_force.empty() || s.viscous_moment.empty()))
            return fmt::format("sphere bond {}: lacks what its dashpots need", i);
    }
    return {};
}

class Fnv {
public:
    void add(const void* data, std::size_t bytes) { hash_ = checksum(data, bytes, hash_); }
    template <class T>
    void add(const Buffer<T>& buffer)
    {
        add(buffer.host().data(), buffer.host().size() * sizeof(T));
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = no_bytes_checksum;
};

/// What contacts remember in the order of their pairs, whenever they met; T{} for pairs without one.
template <class T>
Buffer<T> of_pairs(const State& state, const Buffer<T>& values)
{
    Buffer<T> listed;
    listed.resize(state.pairs.size());
    for (int i = 0; i < state.pairs.size(); ++i) {
        if (const int contact = state.pairs.contact[i]; contact >= 0) listed.at(i) = values[contact];
    }
    return listed;
}

}  // namespace

std::string why_not_valid(const Model& model, const State& state)
{
    if (auto why = bodies_problem(model, state.bodies); !why.empty()) return why;
    if (auto why = bonds_problem("interface", state.interfaces, state.bodies.size()); !why.empty()) return why;
    if (auto why = bonds_problem("parallel bond", state.parallels, state.bodies.size()); !why.empty()) return why;
    if (auto why = bonds_problem("sphere bond", state.sphere_bonds, state.bodies.size()); !why.empty()) return why;
    if (auto why = contacts_problem(state); !why.empty()) return why;
    if (auto why = tables_problem(model, state); !why.empty()) return why;
    for (const double damage : state.histories.damage.host()) {
        if (!(damage >= 0.0 && damage <= 1.0)) return fmt::format("an interface point has a damage of {}", damage);
    }
    return {};
}

std::uint64_t state_hash(const State& state)
{
    Fnv h;
    h.add(state.bodies.position);
    h.add(state.bodies.orientation);
    h.add(state.bodies.velocity);
    h.add(state.bodies.angular_momentum);
    Buffer<double> damage;
    Buffer<Vec2> slip;
    damage.resize(state.points.size());
    slip.resize(state.points.size());
    for (int i = 0; i < state.interfaces.size(); ++i) {
        for (int q = state.interfaces.point_begin[i]; q < state.interfaces.point_begin[i + 1]; ++q) {
            const InterfacePointState p = point_state(state, i, q);
            damage.at(q) = p.damage;
            slip.at(q) = {p.slip1, p.slip2};
        }
    }
    h.add(damage);
    h.add(slip);
    h.add(state.parallels.force);
    Buffer<Vec3> shear = state.sphere_bonds.shear_force;  // empty where no law needs it
    shear.resize(state.sphere_bonds.size());
    h.add(shear);
    h.add(state.sphere_bonds.cause);
    h.add(of_pairs(state, state.contacts.shear_force));
    h.add(of_pairs(state, state.contacts.max_overlap));
    return h.value();
}

}  // namespace grainfrac
