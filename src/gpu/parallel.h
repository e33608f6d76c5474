// SPDX-License-Identifier: GPL-3.0-or-later
// One loop for CPU threads and CUDA. A kernel is a named struct with all it reads and writes as members and
// `GF_FN void operator()(int i) const`; a file that launches one is compiled as CUDA when a toolkit is there.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/function.h"
#include "gpu/thread_pool.h"

#include <string>
#include <vector>

#if defined(__CUDACC__)
#include <cuda_runtime.h>
#endif

namespace grainfrac {

/// Below this many items the host does not wake its threads: a wake-up costs as much as the items.
inline constexpr int serial_limit = 64;

#if defined(__CUDACC__)
namespace cuda_detail {

template <class Kernel>
__global__ void entry(int n, const Kernel kernel)
{
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < n) kernel(i);
}

template <class Kernel>
void launch(int n, const Kernel& kernel)
{
    constexpr int block = 128;
    entry<<<(n + block - 1) / block, block>>>(n, kernel);
    if (const cudaError_t status = cudaGetLastError(); status != cudaSuccess) {
        throw DeviceError(std::string(Kernel::name) + ": " + cudaGetErrorString(status));
    }
}

}  // namespace cuda_detail
#endif

/// kernel(i) for a slice on the host. A kernel may have range(begin, end) that does the same for several at a time.
template <class Kernel>
void run_slice(const Kernel& kernel, int begin, int end)
{
    if constexpr (requires { kernel.range(begin, end); })
        kernel.range(begin, end);
    else
        for (int i = begin; i < end; ++i) kernel(i);
}

/// Call kernel(i) once for every i in [0, n), in any order: a kernel writes only what belongs to i.
template <class Kernel>
void parallel_for(Device device, int n, const Kernel& kernel)
{
    if (n <= 0) return;
    if (device == Device::cuda) {
#if defined(__CUDACC__)
        cuda_detail::launch(n, kernel);
        return;
#else
        throw DeviceError(std::string(Kernel::name) + ": this program was built without a CUDA toolkit");
#endif
    }
    if (n < serial_limit || threads() == 1) {
        run_slice(kernel, 0, n);
        return;
    }
    pool_detail::run([](const void* k, int begin, int end) { run_slice(*static_cast<const Kernel*>(k), begin, end); },
                     &kernel, n);
}

/// The same on the host, for some indices only: what a change of topology touched.
template <class Kernel>
void serial_for(const std::vector<int>& indices, const Kernel& kernel)
{
    for (const int i : indices) kernel(i);
}

/// Terms per partial result: fixed, so that a sum has the same bits for any thread count and device.
inline constexpr int reduction_block = 256;

struct Plus {
    GF_FN double operator()(double a, double b) const { return a + b; }
};
struct Largest {
    GF_FN double operator()(double a, double b) const { return b > a ? b : a; }
};

template <class Term, class Combine>
struct BlockReduction {
    static constexpr const char* name = "block reduction";
    Term term;
    int n;
    View<double> partial;
    GF_FN void operator()(int block) const
    {
        const int begin = block * reduction_block;
        const int end = begin + reduction_block < n ? begin + reduction_block : n;
        double r = term(begin);
        for (int i = begin + 1; i < end; ++i) r = Combine{}(r, term(i));
        partial[block] = r;
    }
};

template <class Combine, class Term>
double parallel_reduce(Device device, int n, const Term& term)
{
    if (n <= 0) return 0.0;
    const int blocks = (n + reduction_block - 1) / reduction_block;
    Buffer<double> partial;
    partial.resize(blocks);
    parallel_for(device, blocks, BlockReduction<Term, Combine>{term, n, partial.write(device)});
    const auto& results = static_cast<const Buffer<double>&>(partial).host();
    double r = results[0];
    for (std::size_t i = 1; i < results.size(); ++i) r = Combine{}(r, results[i]);
    return r;
}

/// Sum of term(i), i in [0, n), in a fixed order; 0 for n = 0.
template <class Term>
double parallel_sum(Device device, int n, const Term& term)
{
    return parallel_reduce<Plus>(device, n, term);
}
/// Largest term(i); 0 for n = 0.
template <class Term>
double parallel_max(Device device, int n, const Term& term)
{
    return parallel_reduce<Largest>(device, n, term);
}

}  // namespace grainfrac
