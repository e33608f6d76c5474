// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace grainfrac {

namespace {

/// Polls of the job counter before a worker sleeps: about 20 us, longer than the gap between two stages of a step. More
/// steals time from whoever shares the core, less pays a wake-up per stage.
constexpr int spin_polls = 400;

class ThreadPool {
public:
    explicit ThreadPool(int workers)
    {
        for (int i = 1; i <= workers; ++i) {
            workers_.emplace_back([this, i](const std::stop_token& stop) { work(i, stop); });
        }
    }
    ~ThreadPool()
    {
        for (auto& worker : workers_) worker.request_stop();
        job_.fetch_add(1, std::memory_order_release);
        job_.notify_all();
    }

    int size() const { return static_cast<int>(workers_.size()) + 1; }

    void run(pool_detail::Slice slice, const void* kernel, int n)
    {
        slice_ = slice;
        kernel_ = kernel;
        n_ = n;
        pending_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
        job_.fetch_add(1, std::memory_order_release);
        job_.notify_all();
        run_slice(0);
        for (int polls = 0; pending_.load(std::memory_order_acquire) != 0; ++polls) {
            if (polls > spin_polls) std::this_thread::yield();
        }
    }

private:
    void run_slice(int i) const
    {
        const auto begin = static_cast<int>(static_cast<std::int64_t>(n_) * i / size());
        const auto end = static_cast<int>(static_cast<std::int64_t>(n_) * (i + 1) / size());
        if (begin < end) slice_(kernel_, begin, end);
    }
    void work(int i, const std::stop_token& stop)
    {
        std::uint64_t seen = 0;
        while (true) {
            int polls = 0;
            std::uint64_t now = job_.load(std::memory_order_acquire);
            while (now == seen) {
                if (++polls > spin_polls) job_.wait(seen, std::memory_order_acquire);
                now = job_.load(std::memory_order_acquire);
            }
            if (stop.stop_requested()) return;
            seen = now;
            run_slice(i);
            pending_.fetch_sub(1, std::memory_order_release);
        }
    }

    pool_detail::Slice slice_ = nullptr;
    const void* kernel_ = nullptr;
    int n_ = 0;
    std::atomic<std::uint64_t> job_{0};
    std::atomic<int> pending_{0};
    std::vector<std::jthread> workers_;  // last: joined before what they use goes
};

std::unique_ptr<ThreadPool> the_pool;
int the_threads = 1;

}  // namespace

void set_threads(int n)
{
    if (n < 1) throw std::invalid_argument("threads: must be >= 1");
    if (n == the_threads) return;
    the_pool = n > 1 ? std::make_unique<ThreadPool>(n - 1) : nullptr;
    the_threads = n;
}

int threads()
{
    return the_threads;
}

void pool_detail::run(Slice slice, const void* kernel, int n)
{
    the_pool->run(slice, kernel, n);
}

}  // namespace grainfrac
