// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/clusters.h"

#include <algorithm>
#include <numeric>

namespace grainfrac {

namespace {

class UnionFind {
public:
    explicit UnionFind(int n) : parent_(static_cast<std::size_t>(n)) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int i)
    {
        while (parent_[static_cast<std::size_t>(i)] != i) {
            int& p = parent_[static_cast<std::size_t>(i)];
            p = parent_[static_cast<std::size_t>(p)];
            i = p;
        }
        return i;
    }
    void join(int i, int j)
    {
        const int a = root(i), b = root(j);
        parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<int> parent_;
};

}  // namespace

std::vector<std::int32_t> bonded_clusters(const State& state)
{
    const Bodies& b = state.bodies;
    const int n = b.size();
    UnionFind sets(n);
    for (int i = 0; i < state.interfaces.size(); ++i) {
        if (state.interfaces.failure_time[i] < 0.0) sets.join(state.interfaces.a[i], state.interfaces.b[i]);
    }
    const auto join_whole = [&](const auto& bonds) {
        for (int i = 0; i < bonds.size(); ++i) {
            if (bonds.cause[i] == 0) sets.join(bonds.a[i], bonds.b[i]);
        }
    };
    join_whole(state.parallels);
    join_whole(state.sphere_bonds);
    std::vector<double> mass(static_cast<std::size_t>(n), 0.0);
    std::vector<int> roots;
    for (int i = 0; i < n; ++i) {
        if (b.inverse_mass[i] == 0.0) continue;
        const int r = sets.root(i);
        if (mass[static_cast<std::size_t>(r)] == 0.0) roots.push_back(r);
        mass[static_cast<std::size_t>(r)] += b.mass[i];
    }
    std::stable_sort(roots.begin(), roots.end(), [&](int x, int y) {
        return mass[static_cast<std::size_t>(x)] > mass[static_cast<std::size_t>(y)];
    });
    std::vector<std::int32_t> number(static_cast<std::size_t>(n), -1), cluster(static_cast<std::size_t>(n), -1);
    for (std::size_t k = 0; k < roots.size(); ++k)
        number[static_cast<std::size_t>(roots[k])] = static_cast<std::int32_t>(k);
    for (int i = 0; i < n; ++i) {
        if (b.inverse_mass[i] > 0.0)
            cluster[static_cast<std::size_t>(i)] = number[static_cast<std::size_t>(sets.root(i))];
    }
    return cluster;
}

}  // namespace grainfrac
