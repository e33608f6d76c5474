// SPDX-License-Identifier: GPL-3.0-or-later
// Structs of arrays whose entries change places. Arrays that have no entry for each object (the begins of ranges) are
// left alone.
#pragma once

#include "gpu/buffer.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace grainfrac {

/// Visits every array of `to` with the same array of `from`.
template <class Arrays, class Visit>
void for_each_pair(Arrays& to, Arrays& from, Visit&& visit)
{
    std::vector<void*> arrays;
    from.for_each_array([&](const char*, auto& array) { arrays.push_back(&array); });
    std::size_t k = 0;
    to.for_each_array([&](const char*, auto& array) {
        visit(array, *static_cast<const std::remove_reference_t<decltype(array)>*>(arrays[k++]));
    });
}

/// The entries source[k]; default values where the source is -1.
template <class Arrays>
Arrays gathered(Arrays& from, const std::vector<int>& source)
{
    Arrays to;
    const int n = from.size();
    for_each_pair(to, from, [&](auto& out, const auto& array) {
        if (array.size() != n) return;
        const auto& values = array.host();
        auto& chosen = out.host();
        chosen.resize(source.size());
        for (std::size_t i = 0; i < source.size(); ++i) {
            if (source[i] >= 0) chosen[i] = values[static_cast<std::size_t>(source[i])];
        }
    });
    return to;
}

/// New places for the entries of some arrays: runs that stay in their order, and single entries from elsewhere.
struct Rearrangement {
    struct Run {
        int from = 0, to = 0, count = 0;
    };
    std::vector<Run> runs;
    std::vector<int> places, sources;  ///< of the single entries; source -1: default values
    int size = 0;                      ///< after it

    void keep(int from, int count)
    {
        if (!runs.empty() && runs.back().from + runs.back().count == from && runs.back().to + runs.back().count == size)
            runs.back().count += count;
        else
            runs.push_back({from, size, count});
        size += count;
    }
    void put(int source)
    {
        places.push_back(size++);
        sources.push_back(source);
    }
};

/// In place: what is before the first change is not touched.
template <class Arrays>
void rearrange(Arrays& arrays, const Rearrangement& plan)
{
    Arrays single = gathered(arrays, plan.sources);
    const int n = arrays.size();
    for_each_pair(arrays, single, [&](auto& array, const auto& chosen) {
        if (array.size() != n) return;
        auto& v = array.host();
        if (plan.size > n) v.resize(static_cast<std::size_t>(plan.size));
        // downwards from the front, then upwards from the back: no run lands on one that has still to move
        for (const auto& r : plan.runs) {
            if (r.to < r.from) std::copy(v.begin() + r.from, v.begin() + r.from + r.count, v.begin() + r.to);
        }
        for (auto r = plan.runs.rbegin(); r != plan.runs.rend(); ++r) {
            if (r->to > r->from)
                std::copy_backward(v.begin() + r->from, v.begin() + r->from + r->count, v.begin() + r->to + r->count);
        }
        v.resize(static_cast<std::size_t>(plan.size));
        for (std::size_t k = 0; k < plan.places.size(); ++k)
            v[static_cast<std::size_t>(plan.places[k])] = chosen.host()[k];
    });
}

}  // namespace grainfrac
