// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/lanes.h"

namespace grainfrac {

namespace {
VectorUnit in_use = widest_vector_unit();
}

VectorUnit widest_vector_unit()
{
#if defined(GF_VECTOR_UNITS)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return VectorUnit::avx512;
    if (__builtin_cpu_supports("avx2")) return VectorUnit::avx2;
#endif
    return VectorUnit::base;
}

VectorUnit vector_unit()
{
    return in_use;
}

void use_vector_unit(VectorUnit unit)
{
    in_use = unit <= widest_vector_unit() ? unit : widest_vector_unit();
}

}  // namespace grainfrac
