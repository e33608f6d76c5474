// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5_skeleton.h"

#include "io/atomic_file.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace grainfrac {

void merge_ranges(std::vector<FileRange>& ranges)
{
    std::sort(ranges.begin(), ranges.end(), [](const FileRange& a, const FileRange& b) { return a.begin < b.begin; });
    std::vector<FileRange> merged;
    for (const FileRange& r : ranges) {
        if (r.size == 0) continue;
        if (!merged.empty() && r.begin <= merged.back().begin + merged.back().size)
            merged.back().size = std::max(merged.back().size, r.begin + r.size - merged.back().begin);
        else
            merged.push_back(r);
    }
    ranges = std::move(merged);
}

std::vector<FileRange> rest_of(const std::vector<FileRange>& ranges, std::int64_t length)
{
    std::vector<FileRange> rest;
    std::int64_t at = 0;
    for (const FileRange& r : ranges) {
        if (r.begin > at) rest.push_back({at, r.begin - at});
        at = r.begin + r.size;
    }
    if (at < length) rest.push_back({at, length - at});
    return rest;
}

Hdf5Skeleton take_skeleton(const std::filesystem::path& path, const std::vector<FileRange>& chunks)
{
    Hdf5Skeleton s;
    s.length = static_cast<std::int64_t>(std::filesystem::file_size(path));
    s.ranges = rest_of(chunks, s.length);
    std::ifstream in(path, std::ios::binary);
    for (const FileRange& r : s.ranges) {
        const std::size_t before = s.bytes.size();
        s.bytes.resize(before + static_cast<std::size_t>(r.size));
        if (!in.seekg(r.begin) || !in.read(s.bytes.data() + before, r.size))
            throw std::runtime_error(path.string() + ": cannot be read back");
    }
    return s;
}

std::string why_not_of(const std::filesystem::path& path, const Hdf5Skeleton& skeleton)
{
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return "cannot read: " + error.message();
    if (skeleton.length < 0 || size < static_cast<std::uintmax_t>(skeleton.length))
        return "holds less than at the checkpoint";
    std::int64_t at = 0, total = 0;
    for (const FileRange& r : skeleton.ranges) {
        if (r.begin < at || r.size <= 0 || r.size > skeleton.length - r.begin)
            return "is not what the checkpoint tells of";
        at = r.begin + r.size;
        total += r.size;
    }
    return total == static_cast<std::int64_t>(skeleton.bytes.size()) ? "" : "is not what the checkpoint tells of";
}

void put_back(const std::filesystem::path& path, const Hdf5Skeleton& skeleton)
{
    {
        std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
        const char* from = skeleton.bytes.data();
        for (const FileRange& r : skeleton.ranges) {
            file.seekp(r.begin);
            file.write(from, r.size);
            from += r.size;
        }
        file.close();
        std::error_code error;
        std::filesystem::resize_file(path, static_cast<std::uintmax_t>(skeleton.length), error);
        if (!file || error)
            throw std::runtime_error(path.string() + ": cannot write" + (error ? ": " + error.message() : ""));
    }
    sync_file(path);
}

}  // namespace grainfrac
