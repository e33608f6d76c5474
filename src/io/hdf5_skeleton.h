// SPDX-License-Identifier: GPL-3.0-or-later
// What an HDF5 file of growing datasets is beside the data of their chunks: headers, indices, all that HDF5 writes over
// in place. Put back, it makes the file what it was, whatever became of those parts since: rows of chunks are only
// added, so that the ones that were there still are. It is what saves the file from a power failure, which leaves parts
// of different ages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace grainfrac {

/// Bytes of a file.
struct FileRange {
    std::int64_t begin = 0, size = 0;
};

struct Hdf5Skeleton {
    std::int64_t length = 0;        ///< of the whole file [B]
    std::vector<FileRange> ranges;  ///< ascending, without overlap
    std::vector<char> bytes;        ///< of all ranges, one after the other

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c] = *this;
        visit("length", a);
        visit("ranges", b);
        visit("bytes", c);
    }
};

/// Sorted, and those that touch or overlap made one.
void merge_ranges(std::vector<FileRange>& ranges);
/// What `ranges`, merged, leave of a file of this length; they must lie inside.
std::vector<FileRange> rest_of(const std::vector<FileRange>& ranges, std::int64_t length);

/// Of a file that nothing writes to meanwhile; `chunks`: where the data is, merged. Throws std::runtime_error.
Hdf5Skeleton take_skeleton(const std::filesystem::path& path, const std::vector<FileRange>& chunks);

/// "" if the file and the skeleton can belong together, else why not.
std::string why_not_of(const std::filesystem::path& path, const Hdf5Skeleton& skeleton);
/// Cuts the file to its length and writes the skeleton into it; on disk when this returns. Broken off, it can be done
/// again.
void put_back(const std::filesystem::path& path, const Hdf5Skeleton& skeleton);

}  // namespace grainfrac
