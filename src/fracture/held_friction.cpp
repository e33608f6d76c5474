// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/held_friction.h"

#include "gpu/parallel.h"

namespace grainfrac {

namespace {

template <class T>
struct PutBack {
    static constexpr const char* name = "put friction back";
    View<const T> then;
    View<T> now;
    GF_FN void operator()(int i) const { now[i] = then[i]; }
};

}  // namespace

HeldFriction::HeldFriction(const State& state)
    : slip_(state.points.slip), friction_work_(state.interfaces.friction_work)
{
}

void HeldFriction::put_back(Device device, State& state) const
{
    parallel_for(device, slip_.size(), PutBack<Vec2>{slip_.read(device), state.points.slip.write(device)});
    parallel_for(device, friction_work_.size(),
                 PutBack<double>{friction_work_.read(device), state.interfaces.friction_work.write(device)});
}

}  // namespace grainfrac
