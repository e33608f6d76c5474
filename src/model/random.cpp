// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/random.h"

#include <Random123/philox.h>
#include <cmath>
#include <numbers>

namespace grainfrac {

double uniform_random(std::int64_t seed, RandomPurpose purpose, std::uint32_t entity_a, std::uint32_t entity_b,
                      int draw)
{
    const auto key = static_cast<std::uint64_t>(seed);
    const r123::Philox4x32::ctr_type counter{
        {entity_a, entity_b, static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(draw)}};
    const r123::Philox4x32::key_type k{{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)}};
    const auto bits = r123::Philox4x32{}(counter, k);
    const std::uint64_t mantissa = ((static_cast<std::uint64_t>(bits[0]) << 32U) | bits[1]) >> 12U;  // 52 bits
    return (static_cast<double>(mantissa) + 0.5) * 0x1p-52;
}

Quat uniform_rotation(std::int64_t seed, RandomPurpose purpose, std::uint32_t entity)
{
    const double u = uniform_random(seed, purpose, entity, 0, 0);
    const double a = 2.0 * std::numbers::pi * uniform_random(seed, purpose, entity, 0, 1);
    const double b = 2.0 * std::numbers::pi * uniform_random(seed, purpose, entity, 0, 2);
    const double s = std::sqrt(1.0 - u), t = std::sqrt(u);
    return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
}

}  // namespace grainfrac
