// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/held_friction.h"

#include "gpu/parallel.h"

#include <cstdint>
#include <utility>

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

/// What retired since then has come to its end, which is not undone.
struct PutBackWork {
    static constexpr const char* name = "put friction work back";
    View<const double> then;
    View<const std::int32_t> retired;
    View<double> now;
    GF_FN void operator()(int i) const
    {
        if (retired[i] == 0) now[i] = then[i];
    }
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
                 PutBackWork{friction_work_.read(device), std::as_const(state.interfaces).retired.read(device),
                             state.interfaces.friction_work.write(device)});
}

}  // namespace grainfrac
