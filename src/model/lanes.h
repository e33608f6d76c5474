// SPDX-License-Identifier: GPL-3.0-or-later
// Records side by side on the host: one array for each of their numbers, so that the compiler works on several records
// at once. What is done to a record is written once, for this and for a GPU; the bits are the same.
#pragma once

#include "geometry/quat.h"

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define GF_VECTOR_UNITS 1
/// Everything that the function calls is compiled into it.
#define GF_FLATTEN __attribute__((flatten))
#else
#define GF_FLATTEN
#endif

namespace grainfrac {

template <class Visit>
constexpr void for_each_number(double& x, Visit&& visit)
{
    visit(x);
}
template <class Visit>
constexpr void for_each_number(Vec3& v, Visit&& visit)
{
    visit(v.x);
    visit(v.y);
    visit(v.z);
}
template <class Visit>
constexpr void for_each_number(Quat& q, Visit&& visit)
{
    visit(q.w);
    visit(q.x);
    visit(q.y);
    visit(q.z);
}

/// Records in one block: few enough for a cache of 32 kB, enough to hide what a block costs by itself.
inline constexpr int lanes = 16;

/// `Record`: numbers only; for_each_number(visit) names each once.
template <class Record>
class Lanes {
public:
    void put(int lane, Record r)
    {
        int k = 0;
        r.for_each_number([&](double& x) { number_[k++][lane] = x; });
    }
    Record get(int lane) const
    {
        Record r;
        int k = 0;
        r.for_each_number([&](double& x) { x = number_[k++][lane]; });
        return r;
    }

private:
    static constexpr int count()
    {
        int n = 0;
        Record r{};
        r.for_each_number([&](double&) { ++n; });
        return n;
    }
    double number_[count()][lanes];
};

/// Widest vectors in use; results do not depend on it.
enum class VectorUnit { base, avx2, avx512 };
/// What this processor has, and this compiler can make use of.
VectorUnit widest_vector_unit();
/// The widest unless told otherwise (tests).
VectorUnit vector_unit();
void use_vector_unit(VectorUnit unit);

namespace lanes_detail {

// Flattened: with a call left in it a loop would take one record at a time. `ivdep`: what lane k writes is not read by
// another.
#if defined(GF_VECTOR_UNITS)
template <class Body>
__attribute__((flatten, target("avx512f,avx512dq,avx512vl,prefer-vector-width=512"))) void on_avx512(int n,
                                                                                                     const Body& body)
{
#pragma GCC ivdep
    for (int k = 0; k < n; ++k) body(k);
}
template <class Body>
__attribute__((flatten, target("avx2"))) void on_avx2(int n, const Body& body)
{
#pragma GCC ivdep
    for (int k = 0; k < n; ++k) body(k);
}
template <class Body>
__attribute__((flatten)) void on_base(int n, const Body& body)
{
#pragma GCC ivdep
    for (int k = 0; k < n; ++k) body(k);
}
#else
template <class Body>
void on_base(int n, const Body& body)
{
    for (int k = 0; k < n; ++k) body(k);
}
#endif

}  // namespace lanes_detail

/// body(k) for every lane k < n, several at once.
template <class Body>
void for_lanes(int n, const Body& body)
{
#if defined(GF_VECTOR_UNITS)
    switch (vector_unit()) {
        case VectorUnit::avx512:
            return lanes_detail::on_avx512(n, body);
        case VectorUnit::avx2:
            return lanes_detail::on_avx2(n, body);
        case VectorUnit::base:
            break;
    }
#endif
    lanes_detail::on_base(n, body);
}

}  // namespace grainfrac
