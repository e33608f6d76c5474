// SPDX-License-Identifier: GPL-3.0-or-later
// What was found against a curve that is known at some points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace grainfrac::test {

/// Of y over x, which grows; straight beyond the ends.
inline double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at)
{
    const auto above = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()), 1, x.size() - 1);
    return y[above - 1] + (at - x[above - 1]) / (x[above] - x[above - 1]) * (y[above] - y[above - 1]);
}

/// Over the range of what is known.
struct OffCurve {
    double mean = 0.0, worst = 0.0;  ///< root mean square; largest [-]
    int points = 0;
};

/// Of the points between 0 and `most` or, nearer, the end of the curve.
inline OffCurve off_curve(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& at,
                          const std::vector<double>& found, double most = 1e300)
{
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    OffCurve o;
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (at[i] <= 0.0 || at[i] > std::min(most, x.back())) continue;
        const double off = (found[i] - interpolated(x, y, at[i])) / (*high - *low);
        o.mean += off * off;
        o.worst = std::max(o.worst, std::fabs(off));
        ++o.points;
    }
    o.mean = std::sqrt(o.mean / o.points);
    return o;
}

}  // namespace grainfrac::test
