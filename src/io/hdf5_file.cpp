// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5_file.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace grainfrac {

namespace {

/// What the innermost failing call said.
std::string hdf5_reason()
{
    std::string reason;
    const auto keep_first = [](unsigned n, const H5E_error2_t* error, void* text) -> herr_t {
        if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
    H5Eclear2(H5E_DEFAULT);
    return reason.empty() ? "unknown HDF5 error" : reason;
}

[[noreturn]] void fail_at(const std::string& where, const std::string& what)
{
    throw std::runtime_error(where + ": cannot " + what + ": " + hdf5_reason());
}

/// Whether an attribute is one value: HDF5 reads as many as the file says, whatever room there is.
bool is_one_value(hid_t attribute)
{
    const Hdf5Id space(H5Aget_space(attribute), H5Sclose);
    return space.get() >= 0 && H5Sget_simple_extent_npoints(space.get()) == 1;
}

/// Once, before anything else is asked of HDF5.
void set_up()
{
    static const bool done = [] {
        // Its clean-up at the end of the program crashes on a file that met a full disk; ours are closed by their
        // owners.
        H5dont_atexit();
        return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
    }();
    (void)done;
}

Hdf5Id newest_format()
{
    Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
    return access;
}

Hdf5Id fixed_text(std::size_t length)
{
    Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), std::max<std::size_t>(length, 1));
    H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    return type;
}

/// How a native type lies in the file: little-endian everywhere, so that files travel between machines.
hid_t stored_type(hid_t native)
{
    if (H5Tequal(native, H5T_NATIVE_DOUBLE) > 0) return H5T_IEEE_F64LE;
    if (H5Tequal(native, H5T_NATIVE_INT32) > 0) return H5T_STD_I32LE;
    if (H5Tequal(native, H5T_NATIVE_INT64) > 0) return H5T_STD_I64LE;
    if (H5Tequal(native, H5T_NATIVE_UINT64) > 0) return H5T_STD_U64LE;
    if (H5Tequal(native, H5T_NATIVE_UINT8) > 0) return H5T_STD_U8LE;
    return native;
}

Hdf5Id simple_space(const std::vector<hsize_t>& extents)
{
    return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
}

}  // namespace

Hdf5Id::Hdf5Id(Hdf5Id&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(std::exchange(other.close_, nullptr))
{
}

Hdf5Id& Hdf5Id::operator=(Hdf5Id&& other) noexcept
{
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
}

bool Hdf5Id::close()
{
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id < 0 || close_ == nullptr || close_(id) >= 0;
}

void Hdf5Growing::write_block(const Extents& offset, const Extents& count, hid_t type, const void* values,
                              std::size_t size)
{
    std::size_t entries = 1;
    bool grows = false;
    for (std::size_t d = 0; d < extents_.size(); ++d) {
        entries *= count.at(d);
        const hsize_t end = offset.at(d) + count.at(d);
        grows = grows || end > extents_[d];
        extents_[d] = std::max(extents_[d], end);
    }
    if (entries != size) throw std::logic_error(where_ + ": block of another size than its values");
    if (grows && H5Dset_extent(dataset_.get(), extents_.data()) < 0) fail_at(where_, "grow");
    if (entries == 0) return;
    const Hdf5Id memory = simple_space(count);
    const Hdf5Id file(H5Dget_space(dataset_.get()), H5Sclose);
    if (H5Sselect_hyperslab(file.get(), H5S_SELECT_SET, offset.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dwrite(dataset_.get(), type, memory.get(), file.get(), H5P_DEFAULT, values) < 0)
        fail_at(where_, "write");
}

void Hdf5Growing::add_new_chunks(std::vector<FileRange>& ranges)
{
    // new ones come last: an index is in the order of rows
    const hsize_t before = known_chunks_;
    know_chunks();
    std::vector<hsize_t> offset(extents_.size());
    const Hdf5Id space(H5Dget_space(dataset_.get()), H5Sclose);
    for (hsize_t i = before; i < known_chunks_; ++i) {
        unsigned mask = 0;
        haddr_t address = HADDR_UNDEF;
        hsize_t bytes = 0;
        if (H5Dget_chunk_info(dataset_.get(), space.get(), i, offset.data(), &mask, &address, &bytes) < 0)
            fail_at(where_, "find the chunks");
        if (address != HADDR_UNDEF)
            ranges.push_back({static_cast<std::int64_t>(address), static_cast<std::int64_t>(bytes)});
    }
}

void Hdf5Growing::know_chunks()
{
    const Hdf5Id space(H5Dget_space(dataset_.get()), H5Sclose);
    if (H5Dget_num_chunks(dataset_.get(), space.get(), &known_chunks_) < 0) fail_at(where_, "count the chunks");
}

void Hdf5Growing::flush()
{
    if (H5Dflush(dataset_.get()) < 0) fail_at(where_, "flush");
}

Hdf5File Hdf5File::create(const std::filesystem::path& path)
{
    set_up();
    Hdf5File file;
    file.path_ = path;
    const Hdf5Id access = newest_format();
    file.file_ = Hdf5Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
    if (file.file_.get() < 0) file.fail("create");
    return file;
}

Hdf5File Hdf5File::open(const std::filesystem::path& path, Access access)
{
    set_up();
    Hdf5File file;
    file.path_ = path;
    const Hdf5Id properties = newest_format();
    const unsigned flags = access == Access::live ? H5F_ACC_RDONLY | H5F_ACC_SWMR_READ : H5F_ACC_RDONLY;
    file.file_ = Hdf5Id(H5Fopen(path.c_str(), flags, properties.get()), H5Fclose);
    if (file.file_.get() < 0) file.fail("open");
    return file;
}

Hdf5File Hdf5File::go_on(const std::filesystem::path& path)
{
    set_up();
    Hdf5File file;
    file.path_ = path;
    file.goes_on_ = true;
    const Hdf5Id access = newest_format();
    const hbool_t clear = true;  // what h5clear does
    if (H5Pset(access.get(), "clear_status_flags", &clear) < 0) file.fail("open");
    file.file_ = Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
    if (file.file_.get() < 0) file.fail("open");
    return file;
}

void Hdf5File::make_group(const std::string& name)
{
    if (goes_on_ && has(name)) return;
    const Hdf5Id group(H5Gcreate2(file_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    if (group.get() < 0) fail("create group " + name);
}

bool Hdf5File::has(const std::string& name) const
{
    const bool there = H5Lexists(file_.get(), name.c_str(), H5P_DEFAULT) > 0;
    H5Eclear2(H5E_DEFAULT);
    return there;
}

std::vector<std::string> Hdf5File::children(const std::string& group) const
{
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* names) -> herr_t {
        static_cast<std::vector<std::string>*>(names)->emplace_back(name);
        return 0;
    };
    std::vector<std::string> names;
    if (H5Literate_by_name(file_.get(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names, H5P_DEFAULT) <
        0)
        fail("list " + group);
    return names;
}

void Hdf5File::set_attribute(const std::string& name, const std::string& attribute, const std::string& text)
{
    const Hdf5Id type = fixed_text(text.size());
    write_attribute(name, attribute, type.get(), text.empty() ? "\0" : text.c_str());
}

std::string Hdf5File::text_attribute(const std::string& name, const std::string& attribute) const
{
    const Hdf5Id object(H5Aopen_by_name(file_.get(), name.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
    const Hdf5Id type(object.get() < 0 ? H5I_INVALID_HID : H5Aget_type(object.get()), H5Tclose);
    if (type.get() < 0 || H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0 ||
        !is_one_value(object.get()))
        fail("read attribute " + attribute + " of " + name);
    std::string text(H5Tget_size(type.get()) + 1, '\0');
    if (H5Aread(object.get(), type.get(), text.data()) < 0) fail("read attribute " + attribute + " of " + name);
    text.resize(std::strlen(text.c_str()));
    return text;
}

void Hdf5File::write_attribute(const std::string& name, const std::string& attribute, hid_t type, const void* value)
{
    if (goes_on_ && H5Aexists_by_name(file_.get(), name.c_str(), attribute.c_str(), H5P_DEFAULT) > 0 &&
        H5Adelete_by_name(file_.get(), name.c_str(), attribute.c_str(), H5P_DEFAULT) < 0)
        fail("replace attribute " + attribute + " of " + name);
    const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Id object(H5Acreate_by_name(file_.get(), name.c_str(), attribute.c_str(), stored_type(type), space.get(),
                                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
    if (object.get() < 0 || H5Awrite(object.get(), type, value) < 0)
        fail("write attribute " + attribute + " of " + name);
}

void Hdf5File::read_attribute(const std::string& name, const std::string& attribute, hid_t type, void* value) const
{
    const Hdf5Id object(H5Aopen_by_name(file_.get(), name.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
    if (object.get() < 0 || !is_one_value(object.get()) || H5Aread(object.get(), type, value) < 0)
        fail("read attribute " + attribute + " of " + name);
}

void Hdf5File::write_dataset(const std::string& name, const std::vector<hsize_t>& extents, hid_t type,
                             const void* values)
{
    const Hdf5Id space = simple_space(extents);
    const Hdf5Id dataset(
        H5Dcreate2(file_.get(), name.c_str(), stored_type(type), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    if (dataset.get() < 0) fail("create " + name);
    if (H5Sget_simple_extent_npoints(space.get()) == 0) return;
    if (H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail("write " + name);
}

std::vector<hsize_t> Hdf5File::extents(const std::string& name) const
{
    const Hdf5Id dataset(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (dataset.get() < 0) fail("open " + name);
    const Hdf5Id space(H5Dget_space(dataset.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 0) fail("read the extents of " + name);
    std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
    return extents;
}

void Hdf5File::read_dataset(const std::string& name, hid_t type, void* values) const
{
    const Hdf5Id dataset(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (dataset.get() < 0) fail("open " + name);
    const Hdf5Id space(H5Dget_space(dataset.get()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.get()) == 0) return;
    if (H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail("read " + name);
}

Hdf5Growing Hdf5File::create_growing(const std::string& name, int growing, const std::vector<hsize_t>& chunk,
                                     hid_t type, const void* fill, const std::string& unit, bool packed)
{
    constexpr unsigned deflate_level = 1;  // higher ones take several times as long for a few per cent
    Hdf5Growing result;
    result.name_ = name;
    result.where_ = path_.string() + ": " + name;
    result.type_ = type;
    result.extents_ = chunk;
    std::fill_n(result.extents_.begin(), growing, 0);
    if (goes_on_) {
        result.extents_ = extents(name);
        result.dataset_ = Hdf5Id(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
        if (result.dataset_.get() < 0 || result.extents_.size() != chunk.size()) fail("open " + name);
        result.know_chunks();
        return result;
    }
    std::vector<hsize_t> most = chunk;
    std::fill_n(most.begin(), growing, H5S_UNLIMITED);
    const Hdf5Id space(H5Screate_simple(static_cast<int>(chunk.size()), result.extents_.data(), most.data()), H5Sclose);
    const Hdf5Id layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(layout.get(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_fill_value(layout.get(), type, fill);
    if (packed) {
        H5Pset_shuffle(layout.get());
        H5Pset_deflate(layout.get(), deflate_level);
    }
    result.dataset_ = Hdf5Id(
        H5Dcreate2(file_.get(), name.c_str(), stored_type(type), space.get(), H5P_DEFAULT, layout.get(), H5P_DEFAULT),
        H5Dclose);
    if (result.dataset_.get() < 0) fail("create " + name);
    set_attribute(name, "unit", unit);
    return result;
}

void Hdf5File::sync() const
{
    if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail("flush");
}

void Hdf5File::start_live()
{
    if (H5Fstart_swmr_write(file_.get()) < 0) fail("open for live reading");
}

void Hdf5File::close()
{
    if (!file_.close()) fail("close");
}

void Hdf5File::fail(const std::string& what) const
{
    fail_at(path_.string(), what);
}

}  // namespace grainfrac
