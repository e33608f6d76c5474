// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/checkpoint.h"

#include "io/atomic_file.h"
#include "io/hdf5_file.h"
#include "model/checksum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

namespace grainfrac {

namespace {

namespace fs = std::filesystem;

constexpr int kept = 2;  // the newest, and one in case the machine fails while it is written

/// Behind the last byte that HDF5 knows of, which it leaves alone: a mark, the length of what is before it and the
/// checksum of that.
struct Seal {
    char mark[8] = {'g', 'r', 'a', 'i', 'n', 's', 'e', 'l'};
    std::uint64_t length = 0, checksum = no_bytes_checksum;
};

Seal seal_of(std::ifstream& file, std::uint64_t length)
{
    Seal seal;
    std::vector<char> block(1 << 20);
    while (seal.length < length) {
        const std::uint64_t want = std::min<std::uint64_t>(block.size(), length - seal.length);
        if (!file.read(block.data(), static_cast<std::streamsize>(want))) return {};
        seal.checksum = checksum(block.data(), want, seal.checksum);
        seal.length += want;
    }
    return seal;
}

void add_seal(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    const Seal seal = seal_of(in, fs::file_size(path));
    std::ofstream out(path, std::ios::binary | std::ios::app);
    if (!in || !out.write(reinterpret_cast<const char*>(&seal), sizeof seal) || !out.flush())
        throw std::runtime_error(path.string() + ": cannot write: " + std::strerror(errno != 0 ? errno : EIO));
}

void check_seal(const fs::path& path)
{
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    std::ifstream in(path, std::ios::binary);
    if (error || !in) throw CheckpointError(path.string() + ": cannot be read");
    Seal written;
    if (size < sizeof written) throw CheckpointError(path.string() + ": is cut short");
    const Seal found = seal_of(in, size - sizeof written);
    in.read(reinterpret_cast<char*>(&written), sizeof written);
    if (!in || std::memcmp(written.mark, Seal{}.mark, sizeof written.mark) != 0 || written.length != found.length)
        throw CheckpointError(path.string() + ": is cut short or no checkpoint of this version");
    if (written.checksum != found.checksum) throw CheckpointError(path.string() + ": is damaged (checksum)");
}

/// Arrays of bonds of spheres that may be empty; which, the laws say (why_not_valid).
bool only_some_laws_need(const std::string& name)
{
    for (const char* it : {"axis_a", "shear_force", "moment", "twist", "normal", "viscous_force", "viscous_moment"})
        if (name == it) return true;
    return false;
}

/// Arrays of one kind have one length; the lists of beginnings have one entry more, those that no bond of spheres needs
/// none, and their kinds are a table.
void check_lengths(const Archive& archive, State& state)
{
    const auto check = [&](const char* group, auto& owner) {
        owner.for_each_array([&](const std::string& name, const auto& buffer) {
            const bool beginnings = name.ends_with("_begin");
            const bool table = std::string(group) == "sphere_bonds" && name == "kinds";
            const bool unused = std::string(group) == "sphere_bonds" && buffer.empty() && only_some_laws_need(name);
            if (!table && buffer.size() != owner.size() + (beginnings && owner.size() > 0 ? 1 : 0) &&
                !(beginnings && buffer.size() == 1) && !unused)
                archive.fail(
                    fmt::format("{}/{} has {} entries, {} were expected", group, name, buffer.size(), owner.size()));
        });
    };
    check("bodies", state.bodies);
    check("interfaces", state.interfaces);
    check("points", state.points);
    check("histories", state.histories);
    check("corners", state.corners);
    check("parallels", state.parallels);
    check("sphere_bonds", state.sphere_bonds);
    check("pairs", state.pairs);
    check("contacts", state.contacts);
}

/// Polyhedra end to end.
struct FlatPolyhedra {
    std::vector<std::int32_t> vertex_count, face_count, tag_count, loop_size, loops, tags;
    std::vector<Vec3> vertices;
    std::vector<Plane> planes;

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f, g, h] = *this;
        visit("vertex_count", a);
        visit("face_count", b);
        visit("tag_count", c);
        visit("loop_size", d);
        visit("loops", e);
        visit("tags", f);
        visit("vertices", g);
        visit("planes", h);
    }
};

FlatPolyhedra flat(const std::vector<Polyhedron>& polyhedra)
{
    FlatPolyhedra f;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    const auto count = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
    for (const Polyhedron& p : polyhedra) {
        f.vertex_count.push_back(count(p.vertices));
        f.face_count.push_back(count(p.faces));
        f.tag_count.push_back(count(p.face_tags));
        append(f.vertices, p.vertices);
        append(f.planes, p.planes);
        append(f.tags, p.face_tags);
        for (const auto& loop : p.faces) {
            f.loop_size.push_back(count(loop));
            append(f.loops, loop);
        }
    }
    return f;
}

std::vector<Polyhedron> from_flat(const Archive& archive, const FlatPolyhedra& f)
{
    const auto take = [&](const auto& list, std::size_t& from, std::int32_t n) {
        const auto k = static_cast<std::size_t>(n);
        if (n < 0 || k > list.size() - from) archive.fail("shapes of grains do not fit together");
        const auto first = list.begin() + static_cast<std::ptrdiff_t>(from);
        from += k;
        return std::decay_t<decltype(list)>(first, first + n);
    };
    if (f.face_count.size() != f.vertex_count.size() || f.tag_count.size() != f.vertex_count.size())
        archive.fail("shapes of grains do not fit together");
    std::vector<Polyhedron> polyhedra(f.vertex_count.size());
    std::size_t vertex = 0, plane = 0, tag = 0, size = 0, loop = 0;
    for (std::size_t i = 0; i < polyhedra.size(); ++i) {
        Polyhedron& p = polyhedra[i];
        p.vertices = take(f.vertices, vertex, f.vertex_count[i]);
        p.planes = take(f.planes, plane, f.face_count[i]);
        p.face_tags = take(f.tags, tag, f.tag_count[i]);
        for (const std::int32_t n : take(f.loop_size, size, f.face_count[i])) p.faces.push_back(take(f.loops, loop, n));
    }
    return polyhedra;
}

/// A list whose length the input tells.
template <class List>
void check_count(Archive& archive, const std::string& name, const List& list)
{
    auto count = static_cast<std::int64_t>(list.size());
    archive(name, count);
    if (count != static_cast<std::int64_t>(list.size())) archive.fail("was made from another input");
}

/// N of step_N.h5, -1 for other names.
std::int64_t step_of(const fs::path& path)
{
    const std::string name = path.filename().string(), head = "step_", tail = ".h5";
    if (!name.starts_with(head) || !name.ends_with(tail) || name.size() <= head.size() + tail.size()) return -1;
    std::int64_t step = -1;
    const char* const end = name.data() + name.size() - tail.size();
    const auto result = std::from_chars(name.data() + head.size(), end, step);
    return result.ptr == end ? step : -1;
}

}  // namespace

// The names in the brackets stand for all members, in their order: a new one does not compile until it is stored too.

void transfer(Archive& archive, const std::string& name, State& state)
{
    auto& [bodies, interfaces, points, histories, corners, parallels, sphere_bonds, pairs, contacts, slots, incidence,
           past_contacts, travel, initial_energy, time, step, next_look] = state;
    auto& [force, torque_a, torque_b, dyad_a, dyad_b, bond_acts] = slots;
    auto& [begin, entry] = incidence;
    const auto add = [&](const std::string& member, auto& value) { archive(name + "/" + member, value); };
    archive.group(name);
    add("bodies", bodies);
    add("interfaces", interfaces);
    add("points", points);
    add("histories", histories);
    add("corners", corners);
    add("parallels", parallels);
    add("sphere_bonds", sphere_bonds);
    add("pairs", pairs);
    add("contacts", contacts);
    add("slot_force", force);
    add("slot_torque_a", torque_a);
    add("slot_torque_b", torque_b);
    add("slot_dyad_a", dyad_a);
    add("slot_dyad_b", dyad_b);
    add("bond_acts", bond_acts);
    add("incidence_begin", begin);
    add("incidence_entry", entry);
    add("past_contacts", past_contacts);
    add("travel", travel);
    add("initial_energy", initial_energy);
    add("time", time);
    add("step", step);
    add("next_look", next_look);
    if (archive.loading()) check_lengths(archive, state);
}

void transfer(Archive& archive, const std::string& name, Model& model)
{
    auto& [materials, groups, walls, wall_motion, shapes, grain_shapes, interface_laws, parallel_laws, sphere_bond_laws,
           contact_laws, contact_law_of, gravity, local_damping, resolve_impacts, fracture_active, dashpots_active,
           drag_rate, fibres_contract, spread_bodies, spread_area, spread_direction, skin, nominal_length, device] =
        model;
    (void)device;  // of this machine
    archive.group(name);
    const auto add = [&](const std::string& member, auto& value) { archive(name + "/" + member, value); };
    check_count(archive, name + "/materials", materials);
    check_count(archive, name + "/groups", groups);
    check_count(archive, name + "/walls", walls);
    add("wall_motion", wall_motion);
    add("shapes", shapes);
    FlatPolyhedra grains = flat(grain_shapes);
    add("grain_shapes", grains);
    if (archive.loading()) grain_shapes = from_flat(archive, grains);
    add("interface_laws", interface_laws);
    add("parallel_laws", parallel_laws);
    add("sphere_bond_laws", sphere_bond_laws);
    add("contact_laws", contact_laws);
    add("contact_law_of", contact_law_of);
    add("gravity", gravity);
    add("local_damping", local_damping);
    add("resolve_impacts", resolve_impacts);
    add("fracture_active", fracture_active);
    add("dashpots_active", dashpots_active);
    add("drag_rate", drag_rate);
    add("fibres_contract", fibres_contract);
    add("spread_bodies", spread_bodies);
    add("spread_area", spread_area);
    add("spread_direction", spread_direction);
    add("skin", skin);
    add("nominal_length", nominal_length);
}

void write_checkpoint(const fs::path& path, const std::string& version, const CheckpointContent& content)
{
    const fs::path temporary = aside(path);
    Archive counter;
    content(counter);
    reserve_room(temporary, counter.bytes() + sizeof(Seal));
    try {
        Hdf5File file = Hdf5File::create(temporary);
        file.set_attribute("/", "version", version);
        file.set_attribute("/", "schema", checkpoint_schema);
        Archive archive(file, Archive::Way::save);
        content(archive);
        file.close();
        add_seal(temporary);
    } catch (...) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw;
    }
    commit_file(path);
}

void read_checkpoint(const fs::path& path, const std::string& version, const CheckpointContent& content)
{
    check_seal(path);
    try {
        Hdf5File file = Hdf5File::open(path);
        const auto schema = file.attribute<std::int64_t>("/", "schema");
        if (schema != checkpoint_schema)
            throw CheckpointError(fmt::format("{}: checkpoint format {}; this program reads format {}", path.string(),
                                              schema, checkpoint_schema));
        if (const std::string by = file.text_attribute("/", "version"); by != version)
            throw CheckpointError(
                fmt::format("{}: was written by grainfrac {}; this is {}", path.string(), by, version));
        Archive archive(file, Archive::Way::load);
        content(archive);
    } catch (const CheckpointError&) {
        throw;
    } catch (const std::runtime_error& e) {
        throw CheckpointError(e.what());
    } catch (const std::exception& e) {  // bad_alloc, length_error, out_of_range: it tells impossible sizes
        throw CheckpointError(fmt::format("{}: holds what cannot be ({})", path.string(), e.what()));
    }
}

std::vector<fs::path> list_checkpoints(const fs::path& folder)
{
    std::vector<fs::path> found;
    std::error_code absent;
    for (const auto& entry : fs::directory_iterator(folder, absent)) {
        if (step_of(entry.path()) >= 0) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return step_of(a) > step_of(b); });
    return found;
}

void write_next_checkpoint(const fs::path& folder, std::int64_t step, const std::string& version,
                           const CheckpointContent& content)
{
    write_checkpoint(folder / fmt::format("step_{}.h5", step), version, content);
    const std::vector<fs::path> all = list_checkpoints(folder);
    for (std::size_t i = kept; i < all.size(); ++i) {
        std::error_code ignored;  // an old checkpoint that cannot be removed harms nobody
        fs::remove(all[i], ignored);
    }
}

void set_aside(const fs::path& checkpoint)
{
    std::error_code ignored;  // it is refused again the next time
    fs::rename(checkpoint, checkpoint.string() + ".refused", ignored);
}

}  // namespace grainfrac
