// SPDX-License-Identifier: GPL-3.0-or-later
// The loop, the reductions and the arrays that both back-ends share.
#include "gpu/parallel.h"

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/select.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace grainfrac;

namespace {

struct Square {
    static constexpr const char* name = "square";
    View<const double> x;
    View<double> y;
    GF_FN void operator()(int i) const { y[i] = x[i] * x[i] + 1.0; }
};

struct Entry {
    View<const double> x;
    GF_FN double operator()(int i) const { return x[i]; }
};

struct Above {
    View<const double> x;
    double least;
    GF_FN bool operator()(int i) const { return x[i] > least; }
};

Buffer<double> numbers(int n)
{
    std::vector<double> x(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] = std::sin(i) * std::pow(10.0, i % 17 - 8);
    return Buffer<double>(std::move(x));
}

}  // namespace

TEST_CASE("parallel_for visits every index once, for any number of threads")
{
    for (const int n : {0, 1, 63, 64, 65, 1000, 100003}) {
        for (const int t : {1, 2, 3, 8}) {
            set_threads(t);
            const Buffer<double> x = numbers(n);
            Buffer<double> y;
            y.assign(n, std::numeric_limits<double>::quiet_NaN());
            parallel_for(default_device(), n, Square{x.read(default_device()), y.write(default_device())});
            bool right = true;
            for (int i = 0; i < n; ++i) right = right && y[i] == x[i] * x[i] + 1.0;
            CHECK(right);
        }
    }
    set_threads(2);
}

TEST_CASE("many short launches in a row leave no worker behind")
{
    set_threads(3);
    Buffer<double> x = numbers(500), y = numbers(500);
    for (int round = 0; round < 20000; ++round) {
        parallel_for(default_device(), 500, Square{x.read(default_device()), y.write(default_device())});
    }
    CHECK(y[499] == x[499] * x[499] + 1.0);
    set_threads(2);
}

TEST_CASE("sums and maxima have the same bits for any number of threads")
{
    const Device d = default_device();
    for (const int n : {1, 255, 256, 257, 100000}) {
        const Buffer<double> x = numbers(n);
        set_threads(1);
        const double sum = parallel_sum(d, n, Entry{x.read(d)}), most = parallel_max(d, n, Entry{x.read(d)});
        for (const int t : {2, 5}) {
            set_threads(t);
            CHECK(parallel_sum(d, n, Entry{x.read(d)}) == sum);
            CHECK(parallel_max(d, n, Entry{x.read(d)}) == most);
        }
        double largest = x[0];
        for (int i = 1; i < n; ++i) largest = std::fmax(largest, x[i]);
        CHECK(most == largest);
    }
    CHECK(parallel_sum(d, 0, Entry{}) == 0.0);
    set_threads(2);
}

TEST_CASE("few out of many come in their order, for any number of threads")
{
    const Device d = default_device();
    for (const int n : {0, 1, 255, 256, 257, 100003}) {
        const Buffer<double> x = numbers(n);
        for (const double above : {-1e300, 0.999e8, 1e300}) {
            std::vector<std::int32_t> expected;
            for (int i = 0; i < n; ++i) {
                if (x[i] > above) expected.push_back(i);
            }
            for (const int t : {1, 2, 5}) {
                set_threads(t);
                const Buffer<std::int32_t> found = select(d, n, Above{x.read(d), above});
                CHECK(found.host() == expected);
            }
        }
    }
    set_threads(2);
}

TEST_CASE("a buffer that is extended keeps what a device wrote; new entries are zero")
{
    const Device d = default_device();
    const Buffer<double> x = numbers(1000);
    Buffer<double> y;
    y.resize(10);
    for (const int n : {10, 11, 12, 500, 501, 1000}) {
        y.extend(n);
        CHECK(y.read(d).size == n);
        Buffer<double> seen = y;
        CHECK((n == 10 || seen[n - 1] == 0.0));
        parallel_for(d, n, Square{x.read(d), y.write(d)});
        CHECK(y[n - 1] == x[n - 1] * x[n - 1] + 1.0);
        parallel_for(d, n, Square{x.read(d), y.write(d)});  // the device's is the newest
    }
    bool right = true;
    for (int i = 0; i < 1000; ++i) right = right && y[i] == x[i] * x[i] + 1.0;
    CHECK(right);
}

TEST_CASE("a buffer shows what was written last, copies are its own")
{
    const Device d = default_device();
    Buffer<double> a = numbers(100);
    parallel_for(d, 100, Square{a.read(d), a.write(d)});
    const double once = a[7];
    Buffer<double> b = a;
    b.host()[7] = 5.0;
    CHECK(a[7] == once);
    CHECK(b.read(d).size == 100);
    CHECK(b[7] == 5.0);
    b.resize(200, 3.0);
    CHECK(b[199] == 3.0);
    Buffer<double> c = std::move(b);
    CHECK(c.size() == 200);
    CHECK(c[7] == 5.0);
}

TEST_CASE("a device is what it is called, or an error")
{
    CHECK(parse_device("cpu") == Device::cpu);
    CHECK_THROWS_AS(parse_device("gpu"), std::invalid_argument);
    if (cuda_devices().empty()) {
        CHECK(parse_device("auto") == Device::cpu);
        CHECK_THROWS_AS(parse_device("cuda"), DeviceError);
    } else {
        CHECK(parse_device("auto") == Device::cuda);
    }
    CHECK_THROWS_AS(set_threads(0), std::invalid_argument);
}
