// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/checkpoint.h"

#include "io/atomic_file.h"
#include "io/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace grainfrac {

namespace {

constexpr int kept = 2;  // the newest, and one in case the machine fails while it is written

/// FNV-1a over the bytes: catches damage, not malice.
std::uint64_t checksum(const void* data, std::size_t bytes)
{
    const auto* p = static_cast<const unsigned char*>(data);
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 0x100000001b3u;
    return hash;
}

/// An array of integers, or of structs of doubles, which are stored as rows of so many numbers.
template <class T>
struct Layout {
    static constexpr bool integer = std::is_integral_v<T>;
    using Number = std::conditional_t<integer, T, double>;
    static constexpr hsize_t width = sizeof(T) / sizeof(Number);
    static_assert(integer || (std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T> &&
                              sizeof(T) % sizeof(double) == 0 && alignof(T) == alignof(double)));
};

class Saver {
public:
    explicit Saver(Hdf5File& file) : file_(file) {}

    template <class T>
    void operator()(const std::string& name, const std::vector<T>& values)
    {
        using Number = typename Layout<T>::Number;
        file_.write(name, {values.size(), Layout<T>::width}, reinterpret_cast<const Number*>(values.data()));
        file_.set_attribute(name, "fnv1a", checksum(values.data(), values.size() * sizeof(T)));
    }
    template <class T>
    void operator()(const std::string& name, const Buffer<T>& buffer)
    {
        (*this)(name, buffer.host());
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(const std::string& name, const T& value) { (*this)(name, std::vector<T>{value}); }
    void group(const std::string& name) { file_.make_group(name); }

private:
    Hdf5File& file_;
};

/// Room that a checkpoint will take, a little overestimated.
class Sizer {
public:
    template <class T>
    void operator()(const std::string&, const Buffer<T>& buffer)
    {
        bytes_ += per_array + static_cast<std::size_t>(buffer.size()) * sizeof(T);
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(const std::string&, const T&) { bytes_ += per_array; }
    void group(const std::string&) { bytes_ += per_array; }
    std::size_t bytes() const { return bytes_; }

private:
    static constexpr std::size_t per_array = 2048;  // [B] headers; measured: under 1000
    std::size_t bytes_ = 0;
};

class Loader {
public:
    explicit Loader(const Hdf5File& file) : file_(file) {}

    template <class T>
    void operator()(const std::string& name, std::vector<T>& values)
    {
        using Number = typename Layout<T>::Number;
        const std::vector<hsize_t> extents = file_.extents(name);
        if (extents.size() != 2 || extents[1] != Layout<T>::width) fail(name + " has an unexpected shape");
        values.resize(extents[0]);
        file_.read(name, reinterpret_cast<Number*>(values.data()));
        if (file_.attribute<std::uint64_t>(name, "fnv1a") != checksum(values.data(), values.size() * sizeof(T)))
            fail(name + " is damaged (checksum)");
    }
    template <class T>
    void operator()(const std::string& name, Buffer<T>& buffer)
    {
        (*this)(name, buffer.host());
    }
    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(const std::string& name, T& value)
    {
        std::vector<T> values;
        (*this)(name, values);
        if (values.size() != 1) fail(name + " has an unexpected shape");
        value = values.front();
    }
    void group(const std::string&) {}

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error(file_.path().string() + ": " + what);
    }
    const Hdf5File& file_;
};

/// What a stage sets in the model.
struct StageSettings {
    Buffer<WallMotion> wall_motion;
    double local_damping = 0.0;
    std::int32_t fracture_active = 1;
};

/// The one list of what a checkpoint holds, for both directions.
template <class Transfer>
void transfer_all(Transfer&& transfer, State& state, StageSettings& stage)
{
    const auto arrays = [&](const std::string& group, auto& owner) {
        transfer.group(group);
        owner.for_each_array([&](const char* name, auto& buffer) { transfer(group + "/" + name, buffer); });
    };
    arrays("/bodies", state.bodies);
    arrays("/interfaces", state.interfaces);
    arrays("/points", state.points);
    arrays("/corners", state.corners);
    arrays("/parallels", state.parallels);
    arrays("/sphere_bonds", state.sphere_bonds);
    arrays("/contacts", state.contacts);
    transfer.group("/slots");
    transfer("/slots/force", state.slots.force);
    transfer("/slots/torque_a", state.slots.torque_a);
    transfer("/slots/torque_b", state.slots.torque_b);
    transfer("/slots/bond_acts", state.slots.bond_acts);
    transfer.group("/incidence");
    transfer("/incidence/begin", state.incidence.begin);
    transfer("/incidence/entry", state.incidence.entry);
    transfer.group("/past_contacts");
    transfer("/past_contacts/friction_work", state.past_contacts.friction_work);
    transfer("/past_contacts/viscous_work", state.past_contacts.viscous_work);
    transfer("/past_contacts/hysteresis_work", state.past_contacts.hysteresis_work);
    transfer("/past_contacts/inserted_work", state.past_contacts.inserted_work);
    transfer.group("/run");
    transfer("/run/travel", state.travel);
    transfer("/run/initial_energy", state.initial_energy);
    transfer("/run/time", state.time);
    transfer("/run/step", state.step);
    transfer("/run/next_look", state.next_look);
    transfer.group("/stage");
    transfer("/stage/wall_motion", stage.wall_motion);
    transfer("/stage/local_damping", stage.local_damping);
    transfer("/stage/fracture_active", stage.fracture_active);
}

/// Arrays of one kind have one length; the lists of beginnings have one entry more.
void check_lengths(const std::filesystem::path& path, State& state)
{
    const auto check = [&](const char* group, auto& owner) {
        owner.for_each_array([&](const std::string& name, const auto& buffer) {
            const bool beginnings = name.ends_with("_begin");
            if (buffer.size() != owner.size() + (beginnings && owner.size() > 0 ? 1 : 0) &&
                !(beginnings && buffer.size() == 1))
                throw std::runtime_error(fmt::format("{}: {}/{} has {} entries, {} were expected", path.string(), group,
                                                     name, buffer.size(), owner.size()));
        });
    };
    check("bodies", state.bodies);
    check("interfaces", state.interfaces);
    check("points", state.points);
    check("corners", state.corners);
    check("parallels", state.parallels);
    check("sphere_bonds", state.sphere_bonds);
    check("contacts", state.contacts);
}

void check_fits(const std::filesystem::path& path, const Model& model, const State& state, const StageSettings& stage)
{
    const auto fail = [&] { throw std::runtime_error(path.string() + ": was made from another input"); };
    if (stage.wall_motion.size() != static_cast<int>(model.walls.size())) fail();
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.shape[i] < 0 || state.bodies.shape[i] >= model.shapes.size()) fail();
        if (state.bodies.wall[i] >= static_cast<int>(model.walls.size())) fail();
    }
}

/// N of step_N.h5, -1 for other names.
std::int64_t step_of(const std::filesystem::path& path)
{
    const std::string name = path.filename().string(), head = "step_", tail = ".h5";
    if (!name.starts_with(head) || !name.ends_with(tail) || name.size() <= head.size() + tail.size()) return -1;
    std::int64_t step = -1;
    const char* const end = name.data() + name.size() - tail.size();
    const auto result = std::from_chars(name.data() + head.size(), end, step);
    return result.ptr == end ? step : -1;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Model& model, const State& state,
                      const std::string& version)
{
    const std::filesystem::path temporary = aside(path);
    StageSettings stage{model.wall_motion, model.local_damping, model.fracture_active ? 1 : 0};
    // The list of arrays is told once, for writing too; sizing and saving only read.
    State& arrays = const_cast<State&>(state);
    Sizer sizer;
    transfer_all(sizer, arrays, stage);
    reserve_room(temporary, sizer.bytes());
    try {
        Hdf5File file = Hdf5File::create(temporary);
        file.set_attribute("/", "version", version);
        file.set_attribute("/", "schema", checkpoint_schema);
        transfer_all(Saver(file), arrays, stage);
        file.close();
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
    commit_file(path);
}

void read_checkpoint(const std::filesystem::path& path, Model& model, State& state)
{
    const Hdf5File file = Hdf5File::open(path);
    const auto schema = file.attribute<std::int64_t>("/", "schema");
    if (schema != checkpoint_schema)
        throw std::runtime_error(fmt::format("{}: checkpoint format {}; this program reads format {}", path.string(),
                                             schema, checkpoint_schema));
    State loaded;
    StageSettings stage;
    transfer_all(Loader(file), loaded, stage);
    check_lengths(path, loaded);
    check_fits(path, model, loaded, stage);
    state = std::move(loaded);
    model.wall_motion = std::move(stage.wall_motion);
    model.local_damping = stage.local_damping;
    model.fracture_active = stage.fracture_active != 0;
}

std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> found;
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) {
        if (step_of(entry.path()) >= 0) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return step_of(a) > step_of(b); });
    return found;
}

void write_next_checkpoint(const std::filesystem::path& folder, const Model& model, const State& state,
                           const std::string& version)
{
    write_checkpoint(folder / fmt::format("step_{}.h5", state.step), model, state, version);
    const std::vector<std::filesystem::path> all = list_checkpoints(folder);
    for (std::size_t i = kept; i < all.size(); ++i) {
        std::error_code ignored;  // an old checkpoint that cannot be removed harms nobody
        std::filesystem::remove(all[i], ignored);
    }
}

}  // namespace grainfrac
