// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/grain_stress.h"

#include "model/grain_body.h"
#include "model/views.h"

#include <stdexcept>

namespace grainfrac {

namespace {

/// Euler tensor int x x^T dm in the principal frame, from the principal moments.
Vec3 euler_moments(const Vec3& I)
{
    return {0.5 * (I.y + I.z - I.x), 0.5 * (I.z + I.x - I.y), 0.5 * (I.x + I.y - I.z)};
}

/// E A^T in world axes [N m].
Mat3 inertia_term(const Bodies& b, int i)
{
    const Mat3 r = to_matrix(b.orientation[i]);
    const Vec3 I = b.inertia[i], j = b.inverse_inertia[i], L = b.angular_momentum[i];
    const Vec3 w{L.x * j.x, L.y * j.y, L.z * j.z};
    const Vec3 rate = angular_acceleration(I, w, rotate_back(b.orientation[i], b.torque[i]));
    const Mat3 W = Mat3::skew(w);
    const Mat3 A = Mat3::skew(rate) + W * W;
    return r * (Mat3::diagonal(euler_moments(I)) * transpose(A)) * transpose(r);
}

}  // namespace

double grain_volume(const Model& model, const State& state, int body)
{
    const auto group = static_cast<std::size_t>(state.bodies.group[body]);
    const auto material = static_cast<std::size_t>(model.groups[group].material);
    return state.bodies.mass[body] / model.materials[material].density;
}

std::vector<Mat3> grain_stress(const Model& model, const State& state)
{
    const Slots& s = state.slots;
    if (s.size() > 0 && s.dyad_a.size() != s.size())
        throw std::logic_error("grain_stress: the last step kept no dyads");
    const SlotOf slots = slot_of(state, Device::cpu);
    std::vector<Mat3> stress(static_cast<std::size_t>(state.bodies.size()));
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.inverse_mass[i] == 0.0) continue;
        Mat3 sum;
        for (int k = state.incidence.begin[i]; k < state.incidence.begin[i + 1]; ++k) {
            const int entry = state.incidence.entry[k], slot = slots(entry / 2);
            if (slot >= 0) sum = sum + (entry % 2 == 0 ? s.dyad_a[slot] : s.dyad_b[slot]);
        }
        sum = (1.0 / grain_volume(model, state, i)) * (sum - inertia_term(state.bodies, i));
        stress[static_cast<std::size_t>(i)] = 0.5 * (sum + transpose(sum));
    }
    return stress;
}

}  // namespace grainfrac
