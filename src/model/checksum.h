// SPDX-License-Identifier: GPL-3.0-or-later
// FNV-1a over bytes: catches damage, not malice.
#pragma once

#include <cstddef>
#include <cstdint>

namespace grainfrac {

inline constexpr std::uint64_t no_bytes_checksum = 0xcbf29ce484222325u;

/// `hash`: of what came before.
inline std::uint64_t checksum(const void* data, std::size_t bytes, std::uint64_t hash = no_bytes_checksum)
{
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 0x100000001b3u;
    return hash;
}

}  // namespace grainfrac
