// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace grainfrac {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int error)
{
    throw std::runtime_error(path.string() + ": cannot " + what + ": " + std::strerror(error));
}

/// A file descriptor that is closed in the end.
class Descriptor {
public:
    Descriptor(const std::filesystem::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~Descriptor()
    {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int get() const { return fd_; }
    /// Some file systems report a full disk only here.
    bool close()
    {
        const int fd = fd_;
        fd_ = -1;
        return ::close(fd) == 0;
    }

private:
    int fd_;
};

void sync_folder(const std::filesystem::path& folder)
{
    // Not every file system lets a folder be synced; the rename itself has succeeded by now.
    const Descriptor file(folder.empty() ? std::filesystem::path(".") : folder, O_RDONLY | O_DIRECTORY);
    if (file.get() >= 0) (void)::fsync(file.get());
}

}  // namespace

bool write_all(int fd, std::string_view content)
{
    while (!content.empty()) {
        const ssize_t n = ::write(fd, content.data(), content.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        content.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

std::filesystem::path aside(const std::filesystem::path& path)
{
    return path.string() + ".tmp";
}

void write_file(const std::filesystem::path& path, std::string_view content)
{
    const std::filesystem::path temporary = aside(path);
    int error = 0;
    {
        Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
        if (file.get() < 0) fail(path, "write", errno);
        if (!write_all(file.get(), content) || !file.close()) error = errno;
    }
    if (error != 0) {
        ::unlink(temporary.c_str());
        fail(path, "write", error);
    }
    commit_file(path);
}

void reserve_room(const std::filesystem::path& path, std::size_t bytes)
{
    int error = 0;
    {
        const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
        error = file.get() < 0 ? errno : ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes));
    }
    ::unlink(path.c_str());
    if (error != 0) fail(path, "write", error);
}

void commit_file(const std::filesystem::path& path)
{
    const std::filesystem::path temporary = aside(path);
    int error = 0;
    {
        const Descriptor file(temporary, O_RDONLY);
        if (file.get() < 0 || ::fsync(file.get()) != 0) error = errno;
    }
    if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        fail(path, "write", error);
    }
    sync_folder(path.parent_path());
}

void sync_file(const std::filesystem::path& path)
{
    const Descriptor file(path, O_RDONLY);
    if (file.get() < 0 || ::fsync(file.get()) != 0) fail(path, "write", errno);
}

std::string read_file(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, "read", errno);
    std::string content{std::istreambuf_iterator<char>(file), {}};
    if (file.bad()) fail(path, "read", EIO);
    return content;
}

}  // namespace grainfrac
