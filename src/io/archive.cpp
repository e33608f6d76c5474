// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/archive.h"

#include "io/hdf5_file.h"
#include "model/checksum.h"

#include <stdexcept>

namespace grainfrac {

namespace {

constexpr std::size_t per_array = 2048;  // [B] headers; measured: under 1000

}  // namespace

void Archive::fail(const std::string& what) const
{
    throw std::runtime_error((file_ != nullptr ? file_->path().string() + ": " : "") + what);
}

void Archive::group(const std::string& name)
{
    bytes_ += per_array;
    if (way_ == Way::save) file_->make_group(name);
}

void Archive::save(const std::string& name, Extents extents, Number number, const void* data, std::size_t bytes)
{
    bytes_ += per_array + bytes;
    if (way_ != Way::save) return;
    const auto write = [&](auto type) {
        using Type = decltype(type);
        file_->write(name, {extents.rows, extents.width}, static_cast<const Type*>(data));
    };
    switch (number) {
        case Number::byte:
            write(std::uint8_t{});
            break;
        case Number::int32:
            write(std::int32_t{});
            break;
        case Number::int64:
            write(std::int64_t{});
            break;
        case Number::uint64:
            write(std::uint64_t{});
            break;
        case Number::real:
            write(double{});
            break;
    }
    file_->set_attribute(name, "fnv1a", checksum(data, bytes));
}

Archive::Extents Archive::extents(const std::string& name) const
{
    const std::vector<hsize_t> e = file_->extents(name);
    if (e.size() != 2) fail(name + " has an unexpected shape");
    return {e[0], e[1]};
}

void Archive::load(const std::string& name, Number number, void* data, std::size_t bytes) const
{
    const auto read = [&](auto type) { file_->read(name, static_cast<decltype(type)*>(data)); };
    switch (number) {
        case Number::byte:
            read(std::uint8_t{});
            break;
        case Number::int32:
            read(std::int32_t{});
            break;
        case Number::int64:
            read(std::int64_t{});
            break;
        case Number::uint64:
            read(std::uint64_t{});
            break;
        case Number::real:
            read(double{});
            break;
    }
    if (file_->attribute<std::uint64_t>(name, "fnv1a") != checksum(data, bytes)) fail(name + " is damaged (checksum)");
}

/// All letters end to end, and where each text ends.
void Archive::array(const std::string& name, std::vector<std::string>& texts)
{
    std::vector<std::int64_t> end;
    std::vector<char> letters;
    for (const std::string& text : texts) {
        letters.insert(letters.end(), text.begin(), text.end());
        end.push_back(static_cast<std::int64_t>(letters.size()));
    }
    group(name);
    array(name + "/end", end);
    array(name + "/letters", letters);
    texts.clear();
    std::int64_t begin = 0;
    for (const std::int64_t e : end) {
        if (e < begin || e > static_cast<std::int64_t>(letters.size())) fail(name + " has an unexpected shape");
        texts.emplace_back(letters.begin() + begin, letters.begin() + e);
        begin = e;
    }
}

}  // namespace grainfrac
