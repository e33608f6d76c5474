// SPDX-License-Identifier: GPL-3.0-or-later
// Which devices there are, and raw memory on them.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace grainfrac {

enum class Device { cpu, cuda };

struct DeviceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct DeviceInfo {
    std::string name;
    std::size_t memory = 0;      ///< [B]
    int compute_capability = 0;  ///< major * 10 + minor
};

/// True if this program holds CUDA code.
bool built_with_cuda();
/// CUDA devices that can run this program's kernels; empty without a driver. Never throws.
std::vector<DeviceInfo> cuda_devices();
/// "cpu", "cuda", or "auto" (cuda if a device is there). Throws DeviceError, with the reason, for a device that is not
/// there and std::invalid_argument for any other word.
Device parse_device(const std::string& word);
const char* to_string(Device device);

/// Device that code without an opinion uses: tests, mostly.
Device default_device();
void set_default_device(Device device);

namespace cuda_detail {
void* allocate(std::size_t bytes);
void release(void* p) noexcept;
void copy_to_device(void* device, const void* host, std::size_t bytes);
void copy_to_host(void* host, const void* device, std::size_t bytes);
}  // namespace cuda_detail

}  // namespace grainfrac
