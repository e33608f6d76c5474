// SPDX-License-Identifier: GPL-3.0-or-later
// Few out of many, in their order, for any number of threads: counted in blocks, numbered from the sums before each.
// A file that uses it launches kernels.
#pragma once

#include "gpu/parallel.h"

#include <cstdint>
#include <utility>

namespace grainfrac {

template <class Chosen>
struct CountChosen {
    static constexpr const char* name = "count chosen";
    Chosen chosen;
    int n;
    View<std::int32_t> number;  // per block
    GF_FN void operator()(int block) const
    {
        const int begin = block * reduction_block;
        const int end = begin + reduction_block < n ? begin + reduction_block : n;
        int found = 0;
        for (int i = begin; i < end; ++i) found += chosen(i) ? 1 : 0;
        number[block] = found;
    }
};

template <class Chosen>
struct ListChosen {
    static constexpr const char* name = "list chosen";
    Chosen chosen;
    int n;
    View<const std::int32_t> first;  // per block
    View<std::int32_t> list;
    GF_FN void operator()(int block) const
    {
        const int begin = block * reduction_block;
        const int end = begin + reduction_block < n ? begin + reduction_block : n;
        int at = first[block];
        for (int i = begin; i < end; ++i) {
            if (chosen(i)) list[at++] = i;
        }
    }
};

/// The i of [0, n) with chosen(i), ascending.
template <class Chosen>
Buffer<std::int32_t> select(Device device, int n, const Chosen& chosen)
{
    const int blocks = (n + reduction_block - 1) / reduction_block;
    Buffer<std::int32_t> number, list;
    number.resize(blocks);
    parallel_for(device, blocks, CountChosen<Chosen>{chosen, n, number.write(device)});
    int found = 0;
    for (const std::int32_t k : std::as_const(number).host()) found += k;
    if (found == 0) return list;
    found = 0;
    for (std::int32_t& k : number.host()) found += std::exchange(k, found);
    list.resize(found);
    parallel_for(device, blocks, ListChosen<Chosen>{chosen, n, std::as_const(number).read(device), list.write(device)});
    return list;
}

}  // namespace grainfrac
