// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/device.h"

#if defined(__CUDACC__)
#include <cuda_runtime.h>
#endif

namespace grainfrac {

namespace {
Device the_default = Device::cpu;

#if defined(__CUDACC__)
void check(cudaError_t status, const char* what)
{
    if (status != cudaSuccess) throw DeviceError(std::string(what) + ": " + cudaGetErrorString(status));
}
#else
[[noreturn]] void no_cuda()
{
    throw DeviceError("this program was built without a CUDA toolkit");
}
#endif
}  // namespace

bool built_with_cuda()
{
#if defined(__CUDACC__)
    return true;
#else
    return false;
#endif
}

std::vector<DeviceInfo> cuda_devices()
{
    std::vector<DeviceInfo> found;
#if defined(__CUDACC__)
    int count = 0;
    if (cudaGetDeviceCount(&count) != cudaSuccess) {
        cudaGetLastError();  // no driver or no device: clear the error, report none
        return found;
    }
    for (int i = 0; i < count; ++i) {
        cudaDeviceProp p{};
        if (cudaGetDeviceProperties(&p, i) != cudaSuccess) continue;
        found.push_back({p.name, p.totalGlobalMem, p.major * 10 + p.minor});
    }
#endif
    return found;
}

Device parse_device(const std::string& word)
{
    if (word == "cpu") return Device::cpu;
    if (word == "auto") return cuda_devices().empty() ? Device::cpu : Device::cuda;
    if (word != "cuda") throw std::invalid_argument("device \"" + word + "\": must be auto, cpu or cuda");
    if (!built_with_cuda()) {
        throw DeviceError("device cuda: this program was built without a CUDA toolkit; use --device cpu");
    }
    if (cuda_devices().empty()) {
        throw DeviceError("device cuda: no CUDA device or no driver found on this machine; use --device cpu");
    }
    return Device::cuda;
}

const char* to_string(Device device)
{
    return device == Device::cuda ? "cuda" : "cpu";
}

Device default_device()
{
    return the_default;
}

void set_default_device(Device device)
{
    the_default = device;
}

namespace cuda_detail {

#if defined(__CUDACC__)
void* allocate(std::size_t bytes)
{
    void* p = nullptr;
    check(cudaMalloc(&p, bytes), "device memory");
    return p;
}
void release(void* p) noexcept
{
    cudaFree(p);
}
void copy_to_device(void* device, const void* host, std::size_t bytes)
{
    check(cudaMemcpy(device, host, bytes, cudaMemcpyHostToDevice), "copy to device");
}
void copy_to_host(void* host, const void* device, std::size_t bytes)
{
    check(cudaMemcpy(host, device, bytes, cudaMemcpyDeviceToHost), "copy from device");
}
#else
void* allocate(std::size_t)
{
    no_cuda();
}
void release(void*) noexcept {}
void copy_to_device(void*, const void*, std::size_t)
{
    no_cuda();
}
void copy_to_host(void*, const void*, std::size_t)
{
    no_cuda();
}
#endif

}  // namespace cuda_detail
}  // namespace grainfrac
