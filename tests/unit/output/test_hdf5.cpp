// SPDX-License-Identifier: GPL-3.0-or-later
// results.h5, also while it grows, and checkpoints.
#include "io/atomic_file.h"
#include "io/checkpoint.h"
#include "io/hdf5_results.h"
#include "sample.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

using namespace grainfrac;

namespace {

template <class T>
bool same_bits(const Buffer<T>& a, const Buffer<T>& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.host().data(), b.host().data(), a.host().size() * sizeof(T)) == 0);
}

/// Every array of both, side by side.
template <class Owner>
void check_same(Owner& a, Owner& b)
{
    std::vector<const void*> first;
    a.for_each_array([&](const char*, auto& array) { first.push_back(&array); });
    std::size_t k = 0;
    b.for_each_array([&](const char* name, auto& array) {
        INFO(name);
        CHECK(same_bits(*static_cast<const std::remove_reference_t<decltype(array)>*>(first[k++]), array));
    });
}

bool equal_states(State& a, State& b)
{
    bool equal = a.time == b.time && a.step == b.step && a.travel == b.travel && a.initial_energy == b.initial_energy &&
                 same_bits(a.slots.force, b.slots.force) && same_bits(a.slots.torque_a, b.slots.torque_a) &&
                 same_bits(a.slots.torque_b, b.slots.torque_b) && same_bits(a.incidence.begin, b.incidence.begin) &&
                 same_bits(a.incidence.entry, b.incidence.entry) &&
                 std::memcmp(&a.past_contacts, &b.past_contacts, sizeof a.past_contacts) == 0;
    const auto compare = [&](auto& x, auto& y) {
        std::vector<const void*> first;
        x.for_each_array([&](const char*, auto& array) { first.push_back(&array); });
        std::size_t k = 0;
        y.for_each_array([&](const char*, auto& array) {
            equal =
                equal && same_bits(*static_cast<const std::remove_reference_t<decltype(array)>*>(first[k++]), array);
        });
    };
    compare(a.bodies, b.bodies);
    compare(a.interfaces, b.interfaces);
    compare(a.points, b.points);
    compare(a.histories, b.histories);
    compare(a.corners, b.corners);
    compare(a.parallels, b.parallels);
    compare(a.pairs, b.pairs);
    compare(a.contacts, b.contacts);
    return equal;
}

CheckpointContent content(Model& model, State& state)
{
    return [&](Archive& archive) {
        transfer(archive, "/model", model);
        transfer(archive, "/state", state);
    };
}
void write(const std::filesystem::path& path, Model& model, State& state)
{
    write_checkpoint(path, "0.1.0", content(model, state));
}
void read(const std::filesystem::path& path, Model& model, State& state)
{
    read_checkpoint(path, "0.1.0", content(model, state));
}

/// One of each kind of thing.
struct Small {
    std::string text = "a b";
    std::vector<std::string> texts{"", "one", "two\n"};
    std::map<std::string, std::int64_t> numbers{{"x", 1}, {"y", -2}};
    std::optional<double> there = 0.1, missing;
    bool flag = true;
    std::vector<char> none;

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f, g] = *this;
        visit("text", a);
        visit("texts", b);
        visit("numbers", c);
        visit("there", d);
        visit("missing", e);
        visit("flag", f);
        visit("none", g);
    }
};

/// Runs a hidden case of this very program on `file`: HDF5 does not open a file twice in one process.
int read_in_another_process(const std::filesystem::path& file, const std::string& test)
{
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    ::setenv("GF_TEST_FILE", file.c_str(), 1);
    return std::system(("'" + program + "' '" + test + "' > /dev/null").c_str());
}

}  // namespace

TEST_CASE("live reader of results.h5", "[.live]")
{
    const Hdf5File file = Hdf5File::open(std::getenv("GF_TEST_FILE"), Hdf5File::Access::live);
    REQUIRE(file.extents("/history")[0] == 3);
    CHECK(file.read<double>("/history")[file.extents("/history")[1] + 1] == 1e-7);
    REQUIRE(file.extents("/snapshots/time") == std::vector<hsize_t>{2});
    CHECK(file.read<std::int64_t>("/snapshots/step") == std::vector<std::int64_t>{300, 400});
    CHECK(file.extents("/snapshots/position") == std::vector<hsize_t>{2, 3, 3});
    CHECK(file.read<double>("/snapshots/position")[0] == std::sqrt(3.0) * sample::side);
    CHECK(file.read<double>("/cracks/time") == std::vector<double>{2e-6});
}

TEST_CASE("results.h5 is read while it is written", "[output][hdf5]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    Hdf5Results results(folder / "results.h5", sample::facts());
    for (int k = 0; k < 3; ++k) results.append_history(sample::history_row(k));
    results.append_snapshot(w.model, w.state, w.fields, collect_cracks(w.model, w.state));
    w.state.step = 400;
    results.append_snapshot(w.model, w.state, w.fields, collect_cracks(w.model, w.state));
    CHECK(read_in_another_process(folder / "results.h5", "live reader of results.h5") == 0);
    results.close();
}

namespace {

/// What a disk may hold after a power failure: pages of 512 B written since `synced`, each new or still as it was; the
/// end perhaps never written (zeros) or never added.
std::string after_power_failure(const std::string& synced, const std::vector<std::string>& later, std::mt19937& random)
{
    constexpr std::size_t page = 512;
    std::string disk = later[random() % later.size()];
    for (std::size_t at = 0; at < disk.size(); at += page) {
        const std::string& version = later[random() % later.size()];
        const bool old = random() % 2 == 0;
        for (std::size_t i = at; i < std::min(at + page, disk.size()); ++i) {
            if (old)
                disk[i] = i < synced.size() ? synced[i] : '\0';
            else if (i < version.size())
                disk[i] = version[i];
        }
    }
    if (random() % 2 == 0) disk.resize(synced.size() + random() % (disk.size() - synced.size() + 1));
    return disk;
}

struct Contents {
    std::vector<double> history, position, failure, cluster_time, damage;
    std::vector<std::int32_t> grain_id, cause, bond_a;
    bool operator==(const Contents& o) const
    {
        const auto same = [](const auto& a, const auto& b) {  // NaN too
            return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
        };
        return same(history, o.history) && same(position, o.position) && same(failure, o.failure) &&
               same(cluster_time, o.cluster_time) && same(damage, o.damage) && same(grain_id, o.grain_id) &&
               same(cause, o.cause) && same(bond_a, o.bond_a);
    }
};

Contents contents(const std::filesystem::path& path)
{
    const Hdf5File f = Hdf5File::open(path);
    return {f.read<double>("/history"),
            f.read<double>("/snapshots/position"),
            f.read<double>("/bonds/failure_time"),
            f.read<double>("/clusters/time"),
            f.read<double>("/snapshots/damage"),
            f.read<std::int32_t>("/snapshots/grain_id"),
            f.read<std::int32_t>("/bonds/cause"),
            f.read<std::int32_t>("/bonds/grain_a")};
}

}  // namespace

TEST_CASE("results.h5 goes on after a power failure", "[output][hdf5]")
{
    sample::World w = sample::make_world();
    sample::add_parallel_bond(w.state);
    const sample::TemporaryFolder folder;
    const std::filesystem::path file = folder / "results.h5";
    int row = 0;
    const auto write_part = [&](Hdf5Results& r, sample::World& world) {  // rows, a bond that breaks, a new grain
        for (int k = 0; k < 8; ++k) r.append_history(sample::history_row(row++));
        ++world.state.step;
        world.state.time += 1e-6;
        r.append_snapshot(world.model, world.state, world.fields, collect_cracks(world.model, world.state));
    };
    const auto change = [](sample::World& world) {
        world.state.interfaces.damage.host()[1] = 1.0;
        world.state.interfaces.failure_time.host()[1] = world.state.time + 1e-7;
        world.state.bodies.id.host()[0] = 7;
    };
    const auto finish = [&](Hdf5Results& r, sample::World& world) {
        change(world);
        for (int k = 0; k < 12; ++k) write_part(r, world);
        r.finish(world.model, world.state, world.fields, collect_cracks(world.model, world.state));
        r.close();
    };
    Hdf5Mark mark;
    std::string synced;
    std::vector<std::string> later;
    sample::World at_mark;
    int row_at_mark = 0;
    {
        Hdf5Results r(file, sample::facts());
        for (int k = 0; k < 40; ++k) write_part(r, w);
        (void)r.mark();  // an earlier checkpoint
        for (int k = 0; k < 15; ++k) write_part(r, w);
        mark = r.mark();
        synced = read_file(file);
        at_mark = w;
        row_at_mark = row;
        change(w);
        for (int k = 0; k < 12; ++k) {
            write_part(r, w);
            later.push_back(read_file(file));
        }
        r.finish(w.model, w.state, w.fields, collect_cracks(w.model, w.state));
        r.close();
    }
    const Contents whole = contents(file);
    CHECK(mark.skeleton.bytes.size() < synced.size());
    std::mt19937 random(3);
    for (int k = 0; k < 50; ++k) {
        {
            std::ofstream out(file, std::ios::binary);
            out << after_power_failure(synced, later, random);
        }
        row = row_at_mark;
        sample::World again = at_mark;
        INFO("sample " << k);
        {
            Hdf5Results r(file, sample::facts(), mark);
            if (k % 3 == 0) (void)r.mark();
            finish(r, again);
        }
        REQUIRE(contents(file) == whole);
    }
    // going on is broken off by another failure, at the same checkpoint
    {
        Hdf5Results r(file, sample::facts(), mark);
        write_part(r, at_mark);
    }
    CHECK(why_not_of(file, mark.skeleton).empty());
    std::filesystem::resize_file(file, static_cast<std::uintmax_t>(mark.skeleton.length) - 1);
    CHECK(why_not_of(file, mark.skeleton) == "holds less than at the checkpoint");
}

TEST_CASE("results.h5 holds what was appended", "[output][hdf5]")
{
    sample::World w = sample::make_world();
    sample::add_parallel_bond(w.state);
    const sample::TemporaryFolder folder;
    {
        Hdf5Results results(folder / "results.h5", sample::facts());
        for (int k = 0; k < 3; ++k) results.append_history(sample::history_row(k));
        results.append_snapshot(w.model, w.state, w.fields, collect_cracks(w.model, w.state));
        w.state.interfaces.damage.host()[1] = 1.0;
        w.state.interfaces.failure_time.host()[1] = 4e-6;
        w.state.interfaces.shear_share.host()[1] = 0.5 * w.state.interfaces.area[1];
        w.state.time = 5e-6;
        w.state.step = 500;
        results.finish(w.model, w.state, w.fields, collect_cracks(w.model, w.state));
        results.close();
    }
    const Hdf5File file = Hdf5File::open(folder / "results.h5");
    CHECK(file.attribute<std::int64_t>("/", "seed") == 42);
    CHECK(file.attribute<std::int64_t>("/", "schema") == results_schema);
    CHECK(file.text_attribute("/", "version") == "0.1.0");
    CHECK(file.text_attribute("/snapshots/stress", "unit") == "Pa");
    const std::string columns = file.text_attribute("/history", "columns");
    CHECK(columns.substr(0, 19) == "step,time_s,displac");
    const auto extents = file.extents("/history");
    REQUIRE(extents == std::vector<hsize_t>{3, 25});
    CHECK(file.read<double>("/history")[2 * extents[1]] == 2e6);

    // Rows by grain id, whatever the order of the bodies.
    CHECK(file.read<std::int32_t>("/snapshots/grain_id") == std::vector<std::int32_t>{0, 1, 2});
    CHECK(file.read<std::int32_t>("/snapshots/cluster") == std::vector<std::int32_t>{0, 0, 1});
    const double face = sample::side * sample::thickness, disc = std::numbers::pi * 0.2e-3 * 0.2e-3;
    CHECK(file.read<double>("/snapshots/damage")[1] == Approx((0.25 * face + disc) / (face + disc)).epsilon(1e-12));
    CHECK(file.extents("/snapshots/stress") == std::vector<hsize_t>{1, 3, 6});
    CHECK(file.read<double>("/snapshots/stress")[2 * 6 + 1] == -30e6);
    CHECK(file.extents("/snapshots/orientation") == std::vector<hsize_t>{1, 3, 4});

    // Bonds by the ids of their grains: (0, 1), then (0, 2) and (1, 2) which is the parallel one.
    CHECK(file.read<std::int32_t>("/bonds/kind") == std::vector<std::int32_t>{0, 0, 1});
    CHECK(file.read<std::int32_t>("/bonds/grain_a") == std::vector<std::int32_t>{0, 2, 2});
    CHECK(file.read<std::int32_t>("/bonds/grain_b") == std::vector<std::int32_t>{1, 0, 1});
    CHECK(file.read<double>("/bonds/damage") == std::vector<double>{0.25, 1.0, 1.0});
    CHECK(file.read<double>("/bonds/failure_time") == std::vector<double>{4e-6, 2e-6, 2.5e-6});
    CHECK(file.read<std::int32_t>("/bonds/cause") == std::vector<std::int32_t>{2, 0, 1});

    CHECK(file.read<double>("/cracks/time") == std::vector<double>{2e-6, 2.5e-6, 4e-6});
    CHECK(file.extents("/cracks/center") == std::vector<hsize_t>{3, 3});
    CHECK(file.read<double>("/cracks/center")[0] ==
          Approx(0.5 * std::sqrt(3.0) * sample::side - 0.5 * sample::crack_opening));
    CHECK(file.read<std::int32_t>("/clusters/snapshot") == std::vector<std::int32_t>{0, 0, -1, -1});
    CHECK(file.read<std::int32_t>("/clusters/fragments") == std::vector<std::int32_t>{2, 1, 2, 1});
    CHECK(file.read<double>("/clusters/volume")[0] == Approx(2.0 * sample::prism_volume).epsilon(1e-12));
    CHECK(file.extents("/clusters/axes") == std::vector<hsize_t>{4, 3});
    CHECK(file.read<std::int32_t>("/fragments/id") == std::vector<std::int32_t>{0, 1, 2});
    CHECK(file.read<std::int32_t>("/fragments/cluster") == std::vector<std::int32_t>{0, 0, 1});
    CHECK(file.text_attribute("/fragments/volume", "unit") == "m^3");
}

TEST_CASE("spheres and their bonds are rows of results.h5", "[output][hdf5]")
{
    const sample::World w = sample::make_spheres();
    const sample::TemporaryFolder folder;
    Hdf5Results results(folder / "results.h5", sample::facts());
    results.append_snapshot(w.model, w.state, w.fields, collect_cracks(w.model, w.state));
    results.close();
    const Hdf5File file = Hdf5File::open(folder / "results.h5");
    CHECK(file.read<std::int32_t>("/snapshots/grain_id") == std::vector<std::int32_t>{0, 1, 2});  // 2 is held
    CHECK(file.read<double>("/snapshots/radius") == std::vector<double>(3, sample::sphere_radius));
    CHECK(file.read<std::int32_t>("/bonds/kind") == std::vector<std::int32_t>{2, 2});
    CHECK(file.read<double>("/bonds/damage") == std::vector<double>{0.0, 1.0});
    CHECK(file.read<std::int32_t>("/bonds/cause") == std::vector<std::int32_t>{-1, 0});
    for (const double k : file.read<double>("/bonds/normal_stiffness")) CHECK(k == Approx(1e9).epsilon(1e-14));
    for (const double k : file.read<double>("/bonds/shear_stiffness")) CHECK(k == Approx(4e8).epsilon(1e-14));
    CHECK(file.read<double>("/cracks/time") == std::vector<double>{2e-6});
    CHECK(file.read<std::int32_t>("/clusters/fragments") == std::vector<std::int32_t>{2, 1});
}

TEST_CASE("a grain that comes later gets its own row", "[output][hdf5]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    Hdf5Results results(folder / "results.h5", sample::facts());
    results.append_snapshot(w.model, w.state, w.fields, {});
    w.state.bodies.id.host()[0] = 7;  // 2 is gone, 7 is new
    results.append_snapshot(w.model, w.state, w.fields, {});
    results.close();
    const Hdf5File file = Hdf5File::open(folder / "results.h5");
    CHECK(file.read<std::int32_t>("/snapshots/grain_id") == std::vector<std::int32_t>{0, 1, 2, 7});
    CHECK(file.read<std::int32_t>("/snapshots/cluster") == std::vector<std::int32_t>{0, 0, 1, -1, 0, 0, -1, 1});
    CHECK(std::isnan(file.read<double>("/snapshots/damage")[3]));
}

TEST_CASE("a run without any grain makes a valid results.h5", "[output][hdf5]")
{
    const sample::TemporaryFolder folder;
    Hdf5Results results(folder / "results.h5", sample::facts());
    results.append_snapshot({}, {}, {}, {});
    results.finish({}, {}, {}, {});
    results.close();
    CHECK(Hdf5File::open(folder / "results.h5").extents("/snapshots/position") == std::vector<hsize_t>{1, 0, 3});
}

TEST_CASE("a checkpoint comes back bit for bit", "[output][checkpoint]")
{
    sample::World w = sample::make_world();
    sample::add_parallel_bond(w.state);
    w.state.bodies.torque.host()[0] = {-0.0, std::nan(""), 5e-324};
    w.model.local_damping = 0.7;
    w.model.fracture_active = false;
    const sample::TemporaryFolder folder;
    write(folder / "a.h5", w.model, w.state);
    CHECK_FALSE(std::filesystem::exists(folder / "a.h5.tmp"));

    sample::World other = sample::make_world();
    other.model.wall_motion.host()[1] = {};
    read(folder / "a.h5", other.model, other.state);
    check_same(w.state.bodies, other.state.bodies);
    check_same(w.state.interfaces, other.state.interfaces);
    check_same(w.state.points, other.state.points);
    check_same(w.state.histories, other.state.histories);
    check_same(w.state.corners, other.state.corners);
    check_same(w.state.parallels, other.state.parallels);
    check_same(w.state.pairs, other.state.pairs);
    check_same(w.state.contacts, other.state.contacts);
    CHECK(equal_states(w.state, other.state));
    CHECK(same_bits(w.model.wall_motion, other.model.wall_motion));
    CHECK(other.model.local_damping == 0.7);
    CHECK_FALSE(other.model.fracture_active);
}

TEST_CASE("every array of the state is on the list that checkpoints walk", "[output][checkpoint]")
{
    const auto check_all = [](auto owner) {
        std::size_t listed = 0;
        owner.for_each_array([&](const char*, auto& array) { listed += sizeof array; });
        CHECK(listed == sizeof owner);  // structs of Buffers and nothing else
    };
    check_all(Bodies{});
    check_all(InterfaceBonds{});
    check_all(InterfacePoints{});
    check_all(PointHistories{});
    check_all(InterfaceCorners{});
    check_all(ParallelBonds{});
    check_all(SphereBonds{});
    check_all(CandidatePairs{});
    check_all(Contacts{});
    check_all(Shapes{});
}

TEST_CASE("a damaged checkpoint is refused", "[output][checkpoint]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write(folder / "a.h5", w.model, w.state);
    std::string bytes;
    {
        std::ifstream in(folder / "a.h5", std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    int refused = 0;
    // A prime stride reaches data, headers, unused space and the seal.
    for (std::size_t at = 11; at < bytes.size(); at += 211) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        {
            std::ofstream out(folder / "b.h5", std::ios::binary);
            out << damaged;
        }
        sample::World other = sample::make_world();
        other.state.time = -1.0;
        INFO("flipped byte " << at << " of " << bytes.size());
        CHECK_THROWS_AS(read(folder / "b.h5", other.model, other.state), CheckpointError);
        CHECK(other.state.time == -1.0);  // nothing half read
        ++refused;
    }
    CHECK(refused > 200);
    for (std::size_t length = 0; length < bytes.size(); length += 1999) {
        std::filesystem::copy_file(folder / "a.h5", folder / "b.h5", std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(folder / "b.h5", length);
        INFO("cut to " << length << " of " << bytes.size());
        CHECK_THROWS_AS(read(folder / "b.h5", w.model, w.state), CheckpointError);
    }
    // Data is told by name: the position of the first body.
    const double x = w.state.bodies.position[1].x;
    const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(&x), sizeof x));
    REQUIRE(place != std::string::npos);
    bytes[place] = static_cast<char>(bytes[place] ^ 1);
    {
        std::ofstream out(folder / "b.h5", std::ios::binary);
        out << bytes;
    }
    REQUIRE_THROWS_WITH(read(folder / "b.h5", w.model, w.state), Catch::Contains("damaged"));
    // A cut file.
    std::filesystem::resize_file(folder / "b.h5", bytes.size() / 2);
    REQUIRE_THROWS_AS(read(folder / "b.h5", w.model, w.state), std::runtime_error);
    REQUIRE_THROWS_AS(read(folder / "none.h5", w.model, w.state), std::runtime_error);
}

TEST_CASE("a checkpoint of another input is refused", "[output][checkpoint]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write(folder / "a.h5", w.model, w.state);
    Model other;
    State state;
    REQUIRE_THROWS_WITH(read(folder / "a.h5", other, state), Catch::Contains("another input"));
}

TEST_CASE("a checkpoint of another version is refused", "[output][checkpoint]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write(folder / "a.h5", w.model, w.state);
    REQUIRE_THROWS_WITH(read_checkpoint(folder / "a.h5", "0.2.0", content(w.model, w.state)),
                        Catch::Contains("was written by grainfrac 0.1.0; this is 0.2.0"));
}

TEST_CASE("an archive gives everything back", "[output][checkpoint]")
{
    const sample::TemporaryFolder folder;
    Small written, read{"", {"?"}, {{"z", 3}}, {}, 7.0, false, {'q'}};
    write_checkpoint(folder / "a.h5", "0.1.0", [&](Archive& archive) { archive("/small", written); });
    read_checkpoint(folder / "a.h5", "0.1.0", [&](Archive& archive) { archive("/small", read); });
    CHECK(read.text == written.text);
    CHECK(read.texts == written.texts);
    CHECK(read.numbers == written.numbers);
    CHECK(read.there == written.there);
    CHECK_FALSE(read.missing);
    CHECK(read.flag);
    CHECK(read.none.empty());
    Small wanted;
    CHECK_THROWS_AS(read_checkpoint(folder / "a.h5", "0.1.0", [&](Archive& archive) { archive("/other", wanted); }),
                    CheckpointError);
    // whole, but telling impossible sizes
    const auto fails = [&](const auto& exception) {
        CHECK_THROWS_AS(read_checkpoint(folder / "a.h5", "0.1.0", [&](Archive&) { throw exception; }), CheckpointError);
    };
    fails(std::bad_alloc());
    fails(std::length_error("vector"));
    fails(std::out_of_range("at"));
}

TEST_CASE("an empty state makes a checkpoint", "[output][checkpoint]")
{
    const sample::TemporaryFolder folder;
    Model model;
    State state, back;
    state.time = 7.0;
    write(folder / "a.h5", model, state);
    read(folder / "a.h5", model, back);
    CHECK(back.time == 7.0);
    CHECK(back.bodies.size() == 0);
}

TEST_CASE("the newest two checkpoints are kept", "[output][checkpoint]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    for (const std::int64_t step : {9, 10, 100}) {
        write_next_checkpoint(folder.path(), step, "0.1.0", content(w.model, w.state));
    }
    std::ofstream(folder / "notes.h5") << "mine";
    const auto all = list_checkpoints(folder.path());
    REQUIRE(all.size() == 2);
    CHECK(all[0].filename() == "step_100.h5");
    CHECK(all[1].filename() == "step_10.h5");
    CHECK(list_checkpoints(folder / "nowhere").empty());
}
