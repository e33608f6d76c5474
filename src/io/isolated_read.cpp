// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/isolated_read.h"

#include "io/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <type_traits>
#include <unistd.h>

namespace grainfrac {
namespace {

// What a reader may take for a file of so many bytes: ten seconds and 2 GiB, and generously more for large files
// (compressed HDF5 is a tenth of its content at best, text is read at 10 MB/s).
constexpr rlim_t base_seconds = 10, bytes_a_second = 1 << 20;
constexpr rlim_t base_memory = rlim_t{2} << 30, memory_factor = 100;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool limits_memory = false;  // their shadow is terabytes wide
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool limits_memory = false;
#else
constexpr bool limits_memory = true;
#endif
#else
constexpr bool limits_memory = true;
#endif

enum class Outcome : char { balls, message, no_memory };

void limit(int resource, rlim_t most)
{
    rlimit now{};
    getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
    now.rlim_cur = now.rlim_max == RLIM_INFINITY ? most : std::min(most, now.rlim_max);
    setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
}

/// What this process holds of what RLIMIT_DATA counts, VmData of Linux: a child starts with the heap of its parent.
rlim_t held_data()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        rlim_t kib = 0;
        if (word == "VmData:" && status >> kib) return kib << 10;
    }
    return 0;
}

void set_limits(const std::filesystem::path& file)
{
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);
    const rlim_t bytes = unknown ? 0 : static_cast<rlim_t>(size);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, base_seconds + bytes / bytes_a_second);
    if (limits_memory) limit(RLIMIT_DATA, held_data() + base_memory + memory_factor * bytes);
}

/// Everything until the writer closes its end.
std::string read_all(int fd)
{
    std::string text;
    char block[65536];
    while (true) {
        const ssize_t n = ::read(fd, block, sizeof block);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return text;
        text.append(block, static_cast<std::size_t>(n));
    }
}

/// In the child: read, send, and end without the clean-up that belongs to the parent.
[[noreturn]] void serve(SphereReader reader, const std::filesystem::path& file, int fd)
{
    for (const int s : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGINT, SIGTERM}) std::signal(s, SIG_DFL);
    set_limits(file);
    Outcome outcome = Outcome::message;
    const std::string_view head(reinterpret_cast<const char*>(&outcome), 1);
    try {
        const std::vector<Ball> balls = reader(file);
        outcome = Outcome::balls;
        const std::string_view bytes(reinterpret_cast<const char*>(balls.data()), balls.size() * sizeof(Ball));
        _exit(write_all(fd, head) && write_all(fd, bytes) ? 0 : 1);
    } catch (const std::bad_alloc&) {
        outcome = Outcome::no_memory;
        write_all(fd, head);
    } catch (const std::exception& e) {
        write_all(fd, head);
        write_all(fd, e.what());
    }
    _exit(0);
}

}  // namespace

std::vector<Ball> read_isolated(SphereReader reader, const std::filesystem::path& file)
{
    static_assert(std::is_trivially_copyable_v<Ball>);
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(fmt::format("\"{}\": {}", file.string(), what));
    };
    int ends[2];
    if (pipe2(ends, 0) != 0) fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    const pid_t child = fork();
    if (child == 0) {
        ::close(ends[0]);
        serve(reader, file, ends[1]);
    }
    const int error = errno;
    ::close(ends[1]);
    const std::string answer = child < 0 ? "" : read_all(ends[0]);
    ::close(ends[0]);
    if (child < 0) fail(fmt::format("cannot be read: {}", std::strerror(error)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;

    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) fail("takes too long to read; it is probably damaged");
    const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !answer.empty();
    if (!whole) fail("the library that reads it crashed; the file is damaged");
    const std::string_view content = std::string_view(answer).substr(1);
    const auto outcome = static_cast<Outcome>(answer[0]);
    if (outcome == Outcome::message) throw std::runtime_error(std::string(content));
    if (outcome == Outcome::no_memory)
        fail("asks for more memory than a file of its size needs; it is probably damaged");
    std::vector<Ball> balls(content.size() / sizeof(Ball));
    if (!balls.empty()) std::memcpy(balls.data(), content.data(), balls.size() * sizeof(Ball));
    return balls;
}

}  // namespace grainfrac
