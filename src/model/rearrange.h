// SPDX-License-Identifier: GPL-3.0-or-later
// Structs of arrays with entries put in, taken out and moved, in place.
#pragma once

#include "gpu/buffer.h"

#include <type_traits>
#include <utility>
#include <vector>

namespace grainfrac {

/// Entries [first, last) of every array that has an entry for each object; others (the begins of ranges) stay empty.
template <class Arrays>
Arrays slice(Arrays& from, int first, int last)
{
    Arrays to;
    std::vector<void*> targets;
    to.for_each_array([&](const char*, auto& array) { targets.push_back(&array); });
    std::size_t k = 0;
    const int n = from.size();
    from.for_each_array([&](const char*, auto& array) {
        auto& target = *static_cast<std::remove_reference_t<decltype(array)>*>(targets[k++]);
        if (array.size() != n) return;
        const auto& values = std::as_const(array).host();
        target.host().assign(values.begin() + first, values.begin() + last);
    });
    return to;
}

/// Puts the old entries source[k], all of [first, last), in the place of [first, last); default values where a source
/// is -1. What follows moves along.
template <class Arrays>
void replace(Arrays& arrays, int first, int last, const std::vector<int>& source)
{
    const int n = arrays.size();
    arrays.for_each_array([&](const char*, auto& array) {
        if (array.size() != n) return;
        auto& values = array.host();
        using Value = typename std::remove_reference_t<decltype(values)>::value_type;
        const std::vector<Value> old(values.begin() + first, values.begin() + last);
        if (source.size() > old.size()) {
            values.insert(values.begin() + last, source.size() - old.size(), Value{});
        } else {
            values.erase(values.begin() + first + static_cast<std::ptrdiff_t>(source.size()), values.begin() + last);
        }
        for (std::size_t k = 0; k < source.size(); ++k)
            values[static_cast<std::size_t>(first) + k] =
                source[k] >= 0 ? old[static_cast<std::size_t>(source[k] - first)] : Value{};
    });
}

}  // namespace grainfrac
