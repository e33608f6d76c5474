// SPDX-License-Identifier: GPL-3.0-or-later
// What the points of interfaces remember, on the host; faces without a history have points as they were made.
#pragma once

#include "fracture/interface_law.h"
#include "model/state.h"

#include <array>

namespace grainfrac {

/// Of point q (into State::points) of interface i.
inline InterfacePointState point_state(const State& state, int i, int q)
{
    const InterfaceBonds& f = state.interfaces;
    if (f.history[i] < 0) return {};
    const PointHistories& p = state.histories;
    const int k = f.history[i] + q - f.point_begin[i];
    return {p.damage[k], p.onset[k], p.failure[k], p.slip[k].x, p.slip[k].y};
}

/// Each of these interfaces gets a history behind those there are, unless it has one.
template <class Interfaces>
void begin_histories(State& state, const Interfaces& interfaces)
{
    InterfaceBonds& f = state.interfaces;
    int n = state.histories.size();
    for (const int i : interfaces) {
        if (f.history[i] >= 0) continue;
        f.history.at(i) = n;
        n += f.point_begin[i + 1] - f.point_begin[i];
    }
    state.histories.for_each_array([n](const char*, auto& array) { array.extend(n); });
}

inline void set_point_state(State& state, int i, int q, const InterfacePointState& s)
{
    begin_histories(state, std::array{i});
    PointHistories& p = state.histories;
    const int k = state.interfaces.history[i] + q - state.interfaces.point_begin[i];
    p.damage.at(k) = s.damage;
    p.onset.at(k) = s.onset;
    p.failure.at(k) = s.failure;
    p.slip.at(k) = {s.slip1, s.slip2};
}

}  // namespace grainfrac
