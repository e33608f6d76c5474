// SPDX-License-Identifier: GPL-3.0-or-later
// What the points of interfaces remember, on the host; faces without a history have points as they were made.
#pragma once

#include "fracture/interface_law.h"
#include "model/state.h"

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

/// Interface i gets a history behind those there are, unless it has one.
inline void begin_history(State& state, int i)
{
    InterfaceBonds& f = state.interfaces;
    if (f.history[i] >= 0) return;
    const int first = state.histories.size(), n = f.point_begin[i + 1] - f.point_begin[i];
    f.history.at(i) = first;
    state.histories.for_each_array([&](const char*, auto& array) { array.extend(first + n); });
}

inline void set_point_state(State& state, int i, int q, const InterfacePointState& s)
{
    begin_history(state, i);
    PointHistories& p = state.histories;
    const int k = state.interfaces.history[i] + q - state.interfaces.point_begin[i];
    p.damage.at(k) = s.damage;
    p.onset.at(k) = s.onset;
    p.failure.at(k) = s.failure;
    p.slip.at(k) = {s.slip1, s.slip2};
}

}  // namespace grainfrac
