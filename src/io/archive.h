// SPDX-License-Identifier: GPL-3.0-or-later
// One description of what is stored, for both directions: `archive(name, value)` writes the value into an HDF5 file,
// or reads it from there, or only counts its bytes. A struct tells its members once, in for_each_member or
// for_each_array. Bits are kept: numbers are stored as they are in memory, every array with its checksum.
#pragma once

#include "gpu/buffer.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace grainfrac {

class Hdf5File;

class Archive {
public:
    enum class Way { count, save, load };

    /// Only counts.
    Archive() = default;
    Archive(Hdf5File& file, Way way) : file_(&file), way_(way) {}

    bool loading() const { return way_ == Way::load; }
    /// Room that it all takes, a little overestimated [B].
    std::size_t bytes() const { return bytes_; }
    /// Throws std::runtime_error that names the file.
    [[noreturn]] void fail(const std::string& what) const;

    /// What follows under this name belongs together.
    void group(const std::string& name);
    template <class T>
    void operator()(const std::string& name, T& value);

private:
    /// `rows` of `width` numbers each, as the file has it.
    struct Extents {
        std::size_t rows = 0, width = 0;
    };
    enum class Number { byte, int32, int64, uint64, real };
    void save(const std::string& name, Extents extents, Number number, const void* data, std::size_t bytes);
    Extents extents(const std::string& name) const;
    void load(const std::string& name, Number number, void* data, std::size_t bytes) const;
    void array(const std::string& name, std::vector<std::string>& texts);

    template <class T>
    static constexpr Number number_of()
    {
        if constexpr (std::is_same_v<T, std::int32_t>) return Number::int32;
        if constexpr (std::is_same_v<T, std::int64_t>) return Number::int64;
        if constexpr (std::is_same_v<T, std::uint64_t>) return Number::uint64;
        // structs of doubles and others as wide: as rows of doubles, which nothing converts
        if constexpr (alignof(T) == alignof(double) && sizeof(T) % sizeof(double) == 0) return Number::real;
        return Number::byte;
    }
    template <class T>
    void array(const std::string& name, std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool> && !std::is_pointer_v<T>);
        constexpr Number number = number_of<T>();
        constexpr std::size_t width = sizeof(T) / (number == Number::byte    ? 1
                                                   : number == Number::int32 ? sizeof(std::int32_t)
                                                                             : sizeof(double));
        if (way_ == Way::load) {
            const Extents e = extents(name);
            if (e.width != width) fail(name + " has an unexpected shape");
            values.resize(e.rows);
            load(name, number, values.data(), values.size() * sizeof(T));
        } else {
            save(name, {values.size(), width}, number, values.data(), values.size() * sizeof(T));
        }
    }
    /// Vectors of anything are arrays of what is in them, or lists of what tells its members.
    template <class T>
    struct IsVector : std::false_type {
    };
    template <class T>
    struct IsVector<std::vector<T>> : std::true_type {
    };
    template <class T>
    struct IsBuffer : std::false_type {
    };
    template <class T>
    struct IsBuffer<Buffer<T>> : std::true_type {
    };
    template <class T>
    struct IsOptional : std::false_type {
    };
    template <class T>
    struct IsOptional<std::optional<T>> : std::true_type {
    };
    template <class T>
    struct IsMap : std::false_type {
    };
    template <class Value>
    struct IsMap<std::map<std::string, Value>> : std::true_type {
    };
    struct AnyVisitor {
        template <class Member>
        void operator()(const std::string&, Member&&) const
        {
        }
    };
    template <class T>
    static constexpr bool has_members = requires(T& value)
    {
        value.for_each_member(AnyVisitor{});
    };
    template <class T>
    static constexpr bool has_arrays = requires(T& value)
    {
        value.for_each_array(AnyVisitor{});
    };

    Hdf5File* file_ = nullptr;
    Way way_ = Way::count;
    std::size_t bytes_ = 0;
};

template <class T>
void Archive::operator()(const std::string& name, T& value)
{
    if constexpr (has_members<T>) {
        group(name);
        value.for_each_member([&](const std::string& member, auto& v) { (*this)(name + "/" + member, v); });
    } else if constexpr (has_arrays<T>) {
        group(name);
        value.for_each_array([&](const std::string& member, auto& v) { (*this)(name + "/" + member, v); });
    } else if constexpr (IsVector<T>::value) {
        array(name, value);
    } else if constexpr (IsBuffer<T>::value) {
        // the newest copy may be the device's, and it stays that when it is only read
        if (loading())
            array(name, value.host());
        else
            array(name, const_cast<std::decay_t<decltype(value.host())>&>(std::as_const(value).host()));
    } else if constexpr (std::is_same_v<T, std::string>) {
        std::vector<char> letters(value.begin(), value.end());
        array(name, letters);
        value.assign(letters.begin(), letters.end());
    } else if constexpr (IsOptional<T>::value) {
        bool there = value.has_value();
        group(name);
        (*this)(name + "/there", there);
        if (!there) return value.reset();
        if (!value) value.emplace();
        (*this)(name + "/value", *value);
    } else if constexpr (IsMap<T>::value) {
        std::vector<std::string> keys;
        std::vector<typename T::mapped_type> values;
        for (const auto& [key, entry] : value) {
            keys.push_back(key);
            values.push_back(entry);
        }
        group(name);
        array(name + "/keys", keys);
        array(name + "/values", values);
        if (keys.size() != values.size()) fail(name + " has an unexpected shape");
        value.clear();
        for (std::size_t i = 0; i < keys.size(); ++i) value[keys[i]] = values[i];
    } else if constexpr (std::is_same_v<T, bool>) {
        std::int32_t number = value ? 1 : 0;
        (*this)(name, number);
        value = number != 0;
    } else {
        std::vector<T> one{value};
        array(name, one);
        if (one.size() != 1) fail(name + " has an unexpected shape");
        value = one.front();
    }
}

}  // namespace grainfrac
