// SPDX-License-Identifier: GPL-3.0-or-later
// An array that lives on the host and, once a device asked for it, there too. Who writes owns the newest copy; the
// other side is refreshed when it next asks.
#pragma once

#include "gpu/device.h"
#include "gpu/function.h"

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace grainfrac {

/// What a kernel sees of a Buffer: a pointer and a length.
template <class T>
struct View {
    T* data = nullptr;
    int size = 0;
    GF_FN T& operator[](int i) const { return data[i]; }
};

template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Buffer() = default;
    explicit Buffer(std::vector<T> values) : host_(std::move(values)) {}
    Buffer(const Buffer& other) : host_(other.host()) {}
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer other) noexcept
    {
        swap(other);
        return *this;
    }
    ~Buffer()
    {
        if (device_ != nullptr) cuda_detail::release(device_);
    }

    int size() const { return static_cast<int>(host_.size()); }
    bool empty() const { return host_.empty(); }

    /// The host copy, brought up to date; writing through the non-const one makes it the newest.
    const std::vector<T>& host() const
    {
        refresh_host();
        return host_;
    }
    std::vector<T>& host()
    {
        refresh_host();
        device_stale_ = true;
        return host_;
    }
    const T& operator[](int i) const { return host()[static_cast<std::size_t>(i)]; }
    /// An entry to be changed on the host.
    T& at(int i) { return host()[static_cast<std::size_t>(i)]; }

    void resize(int n, const T& value = T{}) { host().resize(static_cast<std::size_t>(n), value); }
    /// More entries at the end, T{}: what is on a device stays there as long as it has room for them.
    void extend(int n)
    {
        const std::size_t before = host_.size(), now = static_cast<std::size_t>(n);
        if (device_stale_ || now > capacity_) {
            host().resize(now);
            return;
        }
        host_.resize(now);
        if (now > before)
            cuda_detail::copy_to_device(device_ + before, host_.data() + before, (now - before) * sizeof(T));
    }
    void assign(int n, const T& value) { host().assign(static_cast<std::size_t>(n), value); }

    View<const T> read(Device device) const
    {
        if (device == Device::cpu) return {host().data(), size()};
        refresh_device();
        return {device_, size()};
    }
    /// Contents are kept; the caller may change any part.
    View<T> write(Device device)
    {
        if (device == Device::cpu) return {host().data(), size()};
        refresh_device();
        host_stale_ = true;
        return {device_, size()};
    }

private:
    void swap(Buffer& other) noexcept
    {
        std::swap(host_, other.host_);
        std::swap(device_, other.device_);
        std::swap(capacity_, other.capacity_);
        std::swap(host_stale_, other.host_stale_);
        std::swap(device_stale_, other.device_stale_);
    }
    void refresh_host() const
    {
        if (!host_stale_) return;
        cuda_detail::copy_to_host(host_.data(), device_, host_.size() * sizeof(T));
        host_stale_ = false;
    }
    void refresh_device() const
    {
        if (!device_stale_) return;
        if (capacity_ < host_.size()) {
            if (device_ != nullptr) cuda_detail::release(device_);
            device_ = nullptr;
            device_ = static_cast<T*>(cuda_detail::allocate(host_.capacity() * sizeof(T)));
            capacity_ = host_.capacity();
        }
        if (!host_.empty()) cuda_detail::copy_to_device(device_, host_.data(), host_.size() * sizeof(T));
        device_stale_ = false;
    }

    mutable std::vector<T> host_;
    mutable T* device_ = nullptr;
    mutable std::size_t capacity_ = 0;  // elements allocated on the device
    mutable bool host_stale_ = false;   // the device wrote last
    mutable bool device_stale_ = true;  // the host wrote last, or the device never had it
};

}  // namespace grainfrac
