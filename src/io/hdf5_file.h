// SPDX-License-Identifier: GPL-3.0-or-later
// A thin owner of HDF5 files and datasets (C API). Every failure throws std::runtime_error that names the file and what
// HDF5 said; HDF5 itself prints nothing.
#pragma once

#include "io/hdf5_skeleton.h"

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace grainfrac {

/// Owns one HDF5 identifier.
class Hdf5Id {
public:
    using Close = herr_t (*)(hid_t);

    Hdf5Id() = default;
    Hdf5Id(hid_t id, Close closer) : id_(id), close_(closer) {}
    Hdf5Id(Hdf5Id&& other) noexcept;
    Hdf5Id& operator=(Hdf5Id&& other) noexcept;
    ~Hdf5Id() { close(); }

    hid_t get() const { return id_; }
    bool close();  ///< false if HDF5 could not, e.g. because the disk is full

private:
    hid_t id_ = H5I_INVALID_HID;
    Close close_ = nullptr;
};

/// HDF5's name of a C++ type.
template <class T>
hid_t hdf5_type()
{
    if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
    if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
    if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
    if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
    if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

class Hdf5File;

/// A dataset whose extents grow, up to three of them: rows are added, or a block is set anywhere.
class Hdf5Growing {
public:
    using Extents = std::vector<hsize_t>;

    Hdf5Growing() = default;
    /// Set the block of `count` entries from `offset`; the dataset grows as needed. Entries never set hold NaN or -1.
    template <class T>
    void write(const Extents& offset, const Extents& count, const std::vector<T>& values)
    {
        write_block(offset, count, hdf5_type<T>(), values.data(), values.size());
    }
    /// Readers of a live file see everything written so far.
    void flush();
    hsize_t rows() const { return extents_.empty() ? 0 : extents_[0]; }
    const Extents& extents() const { return extents_; }
    /// Adds to `ranges` where the chunks lie that were not there at the last call.
    void add_new_chunks(std::vector<FileRange>& ranges);
    /// Those that are there now are known: the next call leaves them out.
    void know_chunks();

private:
    friend class Hdf5File;
    void write_block(const Extents& offset, const Extents& count, hid_t type, const void* values, std::size_t size);

    std::string name_, where_;  // "/group/name"; "FILE: /group/name", for messages
    hid_t type_ = H5I_INVALID_HID;
    Hdf5Id dataset_;
    Extents extents_;
    hsize_t known_chunks_ = 0;
};

class Hdf5File {
public:
    /// New file, an old one is cut to nothing. Format 1.10: SWMR, and metadata carries checksums.
    static Hdf5File create(const std::filesystem::path& path);
    enum class Access { plain, live };  ///< live: another process may be writing (SWMR)
    static Hdf5File open(const std::filesystem::path& path, Access access = Access::plain);
    /// To go on writing: what is to be made and is there already is opened, attributes are written anew. The mark that
    /// a killed writer left is taken off.
    static Hdf5File go_on(const std::filesystem::path& path);
    Hdf5File() = default;

    const std::filesystem::path& path() const { return path_; }

    void make_group(const std::string& name);
    bool has(const std::string& name) const;
    std::vector<std::string> children(const std::string& group) const;

    /// Attribute of the object `name` ("/": the file). Text is stored with fixed length, as SWMR asks for.
    void set_attribute(const std::string& name, const std::string& attribute, const std::string& text);
    template <class T>
    requires std::is_arithmetic_v<T>
    void set_attribute(const std::string& name, const std::string& attribute, T value)
    {
        write_attribute(name, attribute, hdf5_type<T>(), &value);
    }
    std::string text_attribute(const std::string& name, const std::string& attribute) const;
    template <class T>
    T attribute(const std::string& name, const std::string& attribute) const
    {
        T value{};
        read_attribute(name, attribute, hdf5_type<T>(), &value);
        return value;
    }

    /// A dataset of fixed size, row by row.
    template <class T>
    void write(const std::string& name, const std::vector<hsize_t>& extents, const T* values)
    {
        write_dataset(name, extents, hdf5_type<T>(), values);
    }
    std::vector<hsize_t> extents(const std::string& name) const;
    /// Reads the whole dataset into `values`, which must hold the product of its extents.
    template <class T>
    void read(const std::string& name, T* values) const
    {
        read_dataset(name, hdf5_type<T>(), values);
    }
    template <class T>
    std::vector<T> read(const std::string& name) const
    {
        std::size_t n = 1;
        for (const hsize_t e : extents(name)) n *= e;
        std::vector<T> values(n);
        read(name, values.data());
        return values;
    }

    /// A dataset that is empty at first and grows along its first `growing` dimensions; along the others it is as wide
    /// as `chunk`, which says how much is stored together. `unit` becomes an attribute. `packed`: shuffle and deflate,
    /// for blocks that are written once.
    template <class T>
    Hdf5Growing make_growing(const std::string& name, int growing, const std::vector<hsize_t>& chunk,
                             const std::string& unit, bool packed)
    {
        const T fill = std::is_floating_point_v<T> ? std::numeric_limits<T>::quiet_NaN() : static_cast<T>(-1);
        return create_growing(name, growing, chunk, hdf5_type<T>(), &fill, unit, packed);
    }
    /// All that was written so far is on disk, not only with the operating system.
    void sync() const;
    /// From here on nothing new may be created, and other processes may read while this one writes.
    void start_live();
    /// Throws if something could not be stored; the destructor cannot.
    void close();

private:
    friend class Hdf5Growing;
    void write_attribute(const std::string& name, const std::string& attribute, hid_t type, const void* value);
    void read_attribute(const std::string& name, const std::string& attribute, hid_t type, void* value) const;
    void write_dataset(const std::string& name, const std::vector<hsize_t>& extents, hid_t type, const void* values);
    void read_dataset(const std::string& name, hid_t type, void* values) const;
    Hdf5Growing create_growing(const std::string& name, int growing, const std::vector<hsize_t>& chunk, hid_t type,
                               const void* fill, const std::string& unit, bool packed);
    [[noreturn]] void fail(const std::string& what) const;

    std::filesystem::path path_;
    Hdf5Id file_;
    bool goes_on_ = false;  // what is made may be there
};

}  // namespace grainfrac
