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
    /// What came near to damage since then had none.
    GF_FN void operator()(int i) const { now[i] = i < then.size ? then[i] : T{}; }
};

}  // namespace

HeldFriction::HeldFriction(const State& state)
    : slip_(state.histories.slip), friction_work_(state.interfaces.friction_work)
{
}

void HeldFriction::put_back(Device device, State& state) const
{
    parallel_for(device, state.histories.size(), PutBack<Vec2>{slip_.read(device), state.histories.slip.write(device)});
    parallel_for(device, friction_work_.size(),
                 PutBack<double>{friction_work_.read(device), state.interfaces.friction_work.write(device)});
}

}  // namespace grainfrac
