// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5_results.h"

#include "io/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

namespace grainfrac {

namespace {

// Entries stored together. Too few: much bookkeeping; too many: small cases pay for empty chunks, which deflate
// shrinks.
constexpr hsize_t history_chunk = 256, table_chunk = 512, grain_chunk = 2048, bond_chunk = 4096;

template <class T>
void append_rows(Hdf5Growing& column, const std::vector<T>& values, hsize_t width = 0)
{
    const hsize_t per_row = std::max<hsize_t>(width, 1);
    Hdf5Growing::Extents offset{column.rows()}, count{values.size() / per_row};
    if (width > 0) {
        offset.push_back(0);
        count.push_back(width);
    }
    column.write(offset, count, values);
    column.flush();
}

void append_vec3(std::vector<double>& values, const Vec3& v)
{
    values.insert(values.end(), {v.x, v.y, v.z});
}

/// `value` of every entry as one new column of a table.
template <class T, class Entry, class Value>
void append_column(Hdf5Growing& column, const std::vector<Entry>& entries, Value&& value)
{
    std::vector<T> values;
    for (const Entry& entry : entries) values.push_back(static_cast<T>(value(entry)));
    append_rows(column, values);
}
template <class Entry, class Value>
void append_vec3_column(Hdf5Growing& column, const std::vector<Entry>& entries, Value&& value)
{
    std::vector<double> values;
    for (const Entry& entry : entries) append_vec3(values, value(entry));
    append_rows(column, values, 3);
}

using IdPair = std::pair<std::int32_t, std::int32_t>;

/// Ids of the bodies of a bond, smaller one first.
IdPair ids_of(const State& state, const BondFacts& bond)
{
    return std::minmax({state.bodies.id[bond.a], state.bodies.id[bond.b]});
}

/// Slots of the bonds by the ids of their bodies: an order that does not change when bodies are renumbered.
std::vector<int> bond_order(const State& state, const std::vector<BondFacts>& bonds)
{
    std::vector<IdPair> key;
    key.reserve(bonds.size());
    for (const BondFacts& bond : bonds) key.push_back(ids_of(state, bond));
    std::vector<int> order(key.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int i, int j) { return key[static_cast<std::size_t>(i)] < key[static_cast<std::size_t>(j)]; });
    return order;
}

}  // namespace

Hdf5Results::Hdf5Results(const std::filesystem::path& path, const RunFacts& facts) : file_(Hdf5File::create(path))
{
    make(facts);
    file_.start_live();
}

Hdf5Results::Hdf5Results(const std::filesystem::path& path, const RunFacts& facts, const Hdf5Mark& mark) : now_(mark)
{
    put_back(path, mark.skeleton);
    file_ = Hdf5File::go_on(path);
    make(facts);
    chunks_ = rest_of(mark.skeleton.ranges, mark.skeleton.length);
    if (extents() != mark.extents) throw std::runtime_error(path.string() + ": is not what the checkpoint tells of");
    const auto grains = file_.read<std::int32_t>("/snapshots/grain_id");
    for (std::size_t row = 0; row < grains.size(); ++row) grain_rows_.emplace(grains[row], row);
    const auto a = file_.read<std::int32_t>("/bonds/grain_a"), b = file_.read<std::int32_t>("/bonds/grain_b");
    std::map<IdPair, int> seen;
    for (std::size_t row = 0; row < a.size(); ++row) {
        const IdPair pair = std::minmax({a[row], b.at(row)});
        bond_rows_.emplace(std::tuple{pair.first, pair.second, seen[pair]++}, row);
    }
    // those of the file are written over in place
    bonds_.failure_time.write({0}, {now_.bond_failure.size()}, now_.bond_failure);
    bonds_.cause.write({0}, {now_.bond_cause.size()}, now_.bond_cause);
    file_.start_live();
}

template <class Visit>
void Hdf5Results::for_each_dataset(Visit&& visit)
{
    const auto all = [&](auto&... datasets) { (visit(datasets), ...); };
    visit(history_);
    {
        auto& [a, b, c, d, e, f, g, h, i, j, k] = snapshots_;
        all(a, b, c, d, e, f, g, h, i, j, k);
    }
    {
        auto& [a, b, c, d, e, f, g, h, i, j] = bonds_;
        all(a, b, c, d, e, f, g, h, i, j);
    }
    {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l] = cracks_;
        all(a, b, c, d, e, f, g, h, i, j, k, l);
    }
    all(cluster_snapshot_, cluster_time_);
    for (Table* table : {&clusters_, &fragments_}) {
        for (auto& [name, dataset] : *table) visit(dataset);
    }
}

std::vector<std::int64_t> Hdf5Results::extents()
{
    std::vector<std::int64_t> all;
    for_each_dataset([&](const Hdf5Growing& dataset) {
        for (const hsize_t n : dataset.extents()) all.push_back(static_cast<std::int64_t>(n));
    });
    return all;
}

Hdf5Mark Hdf5Results::mark()
{
    file_.sync();
    sync_file(file_.path());
    for_each_dataset([&](Hdf5Growing& dataset) { dataset.add_new_chunks(chunks_); });
    merge_ranges(chunks_);
    Hdf5Mark m = now_;
    m.skeleton = take_skeleton(file_.path(), chunks_);
    m.extents = extents();
    return m;
}

void Hdf5Results::make(const RunFacts& facts)
{
    file_.set_attribute("/", "version", facts.version);
    file_.set_attribute("/", "schema", results_schema);
    file_.set_attribute("/", "seed", facts.seed);
    file_.set_attribute("/", "input", facts.input_hash);
    file_.set_attribute("/", "test", facts.test_kind);
    file_.set_attribute("/", "device", facts.device);
    file_.set_attribute("/", "threads", static_cast<std::int32_t>(facts.threads));
    std::vector<std::string> names;
    HistoryRow{}.for_each_column([&](const char* name, auto) { names.emplace_back(name); });
    history_ = file_.make_growing<double>("/history", 1, {history_chunk, names.size()}, "see columns", false);
    file_.set_attribute("/history", "columns", fmt::format("{}", fmt::join(names, ",")));
    make_snapshots();
    make_bonds();
    make_cracks();
    make_tables();
}

void Hdf5Results::make_snapshots()
{
    file_.make_group("/snapshots");
    auto& s = snapshots_;
    s.time = file_.make_growing<double>("/snapshots/time", 1, {table_chunk}, "s", false);
    s.step = file_.make_growing<std::int64_t>("/snapshots/step", 1, {table_chunk}, "1", false);
    s.grain_id = file_.make_growing<std::int32_t>("/snapshots/grain_id", 1, {grain_chunk}, "1", false);
    s.radius = file_.make_growing<double>("/snapshots/radius", 1, {grain_chunk}, "m", false);
    const auto field = [&](const char* name, hsize_t width, const char* unit) {
        return file_.make_growing<double>(std::string("/snapshots/") + name, 2, {1, grain_chunk, width}, unit, true);
    };
    s.position = field("position", 3, "m");
    s.orientation = field("orientation", 4, "1");
    s.velocity = field("velocity", 3, "m/s");
    s.stress = field("stress", 6, "Pa");
    s.cluster = file_.make_growing<std::int32_t>("/snapshots/cluster", 2, {1, grain_chunk}, "1", true);
    s.damage = file_.make_growing<double>("/snapshots/damage", 2, {1, grain_chunk}, "1", true);
    s.cleavage = file_.make_growing<double>("/snapshots/cleavage", 2, {1, grain_chunk}, "1", true);
}

void Hdf5Results::make_bonds()
{
    file_.make_group("/bonds");
    auto& b = bonds_;
    b.kind = file_.make_growing<std::int32_t>("/bonds/kind", 1, {bond_chunk}, "1", false);
    b.grain_a = file_.make_growing<std::int32_t>("/bonds/grain_a", 1, {bond_chunk}, "1", false);
    b.grain_b = file_.make_growing<std::int32_t>("/bonds/grain_b", 1, {bond_chunk}, "1", false);
    b.area = file_.make_growing<double>("/bonds/area", 1, {bond_chunk}, "m^2", false);
    b.normal = file_.make_growing<double>("/bonds/normal", 1, {bond_chunk, 3}, "1", false);
    b.normal_stiffness = file_.make_growing<double>("/bonds/normal_stiffness", 1, {bond_chunk}, "Pa/m", false);
    b.shear_stiffness = file_.make_growing<double>("/bonds/shear_stiffness", 1, {bond_chunk}, "Pa/m", false);
    b.failure_time = file_.make_growing<double>("/bonds/failure_time", 1, {bond_chunk}, "s", false);
    b.cause = file_.make_growing<std::int32_t>("/bonds/cause", 1, {bond_chunk}, "1", false);
    b.damage = file_.make_growing<double>("/bonds/damage", 2, {1, bond_chunk}, "1", true);
}

void Hdf5Results::make_cracks()
{
    file_.make_group("/cracks");
    const auto number = [&](const char* name, const char* unit) {
        return file_.make_growing<double>(std::string("/cracks/") + name, 1, {table_chunk}, unit, false);
    };
    const auto vector = [&](const char* name, const char* unit) {
        return file_.make_growing<double>(std::string("/cracks/") + name, 1, {table_chunk, 3}, unit, false);
    };
    const auto integer = [&](const char* name) {
        return file_.make_growing<std::int32_t>(std::string("/cracks/") + name, 1, {table_chunk}, "1", false);
    };
    auto& c = cracks_;
    c.time = number("time", "s");
    c.first_damage_time = number("first_damage_time", "s");
    c.mode = integer("mode");
    c.cause = integer("cause");
    c.grain_a = integer("grain_a");
    c.grain_b = integer("grain_b");
    c.area = number("area", "m^2");
    c.center = vector("center", "m");
    c.normal = vector("normal", "1");
    c.opening = number("opening", "m");
    c.k_i = number("K_I", "Pa m^0.5");
    c.k_ii = number("K_II", "Pa m^0.5");
}

template <class Row>
Hdf5Results::Table Hdf5Results::make_table(const std::string& group)
{
    Table table;
    Row{}.for_each_column([&](const char* name, const char* unit, const auto& value) {
        using Value = std::decay_t<decltype(value)>;
        const std::string path = group + "/" + name;
        if constexpr (std::is_same_v<Value, Vec3>) {
            table[name] = file_.make_growing<double>(path, 1, {table_chunk, 3}, unit, false);
        } else {
            table[name] = file_.make_growing<Value>(path, 1, {table_chunk}, unit, false);
        }
    });
    return table;
}

void Hdf5Results::make_tables()
{
    file_.make_group("/clusters");
    cluster_snapshot_ = file_.make_growing<std::int32_t>("/clusters/snapshot", 1, {table_chunk}, "1", false);
    cluster_time_ = file_.make_growing<double>("/clusters/time", 1, {table_chunk}, "s", false);
    clusters_ = make_table<Cluster>("/clusters");
    file_.make_group("/fragments");
    fragments_ = make_table<Fragment>("/fragments");
}

void Hdf5Results::append_history(const HistoryRow& row)
{
    std::vector<double> values;
    row.for_each_column([&](const char*, auto value) { values.push_back(static_cast<double>(value)); });
    append_rows(history_, values, values.size());
}

void Hdf5Results::append_snapshot(const Model& model, const State& state, const SnapshotFields& fields,
                                  const std::vector<CrackFace>& cracks)
{
    const hsize_t snapshot = snapshots_.time.rows();
    append_grains(model, state, fields);
    const std::vector<BondFacts> bonds = all_bond_facts(state);
    const std::vector<BondRow> rows = update_bonds(state, bonds);
    std::vector<double> damage(bond_rows_.size(), std::numeric_limits<double>::quiet_NaN());
    for (const BondRow& r : rows) damage[r.row] = bonds[static_cast<std::size_t>(r.slot)].damage;
    bonds_.damage.write({snapshot, 0}, {1, damage.size()}, damage);
    bonds_.damage.flush();
    append_cracks(cracks);
    append_clusters(collect_clusters(model, state, fields), state, static_cast<std::int32_t>(snapshot));
    append_rows(snapshots_.step, std::vector<std::int64_t>{state.step});
    // Last: its length tells a live reader how many snapshots are whole.
    append_rows(snapshots_.time, std::vector<double>{state.time});
    now_.last_step = state.step;
}

void Hdf5Results::append_grains(const Model& model, const State& state, const SnapshotFields& fields)
{
    const Bodies& bodies = state.bodies;
    std::vector<std::pair<std::int32_t, int>> grains;  // id, body
    for (int i = 0; i < bodies.size(); ++i) {
        if (bodies.wall[i] < 0 || is_sphere(model, bodies, i)) grains.emplace_back(bodies.id[i], i);
    }
    std::sort(grains.begin(), grains.end());
    std::vector<std::int32_t> fresh;
    std::vector<double> radius;
    for (const auto& [id, body] : grains) {
        if (!grain_rows_.emplace(id, grain_rows_.size()).second) continue;
        fresh.push_back(id);
        radius.push_back(is_sphere(model, bodies, body) ? model.shapes.radius[bodies.shape[body]] : 0.0);
    }
    append_rows(snapshots_.grain_id, fresh);
    append_rows(snapshots_.radius, radius);

    const hsize_t n = grain_rows_.size(), snapshot = snapshots_.time.rows();
    constexpr double absent = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> position(3 * n, absent), orientation(4 * n, absent), velocity(3 * n, absent),
        stress(6 * n, absent), damage(n, absent), cleavage(n, absent);
    std::vector<std::int32_t> cluster(n, -1);
    const std::vector<double> bond_damage = mean_bond_damage(state);
    const auto put = [](std::vector<double>& values, hsize_t row, std::initializer_list<double> entries) {
        std::copy(entries.begin(), entries.end(), values.begin() + static_cast<std::ptrdiff_t>(row * entries.size()));
    };
    for (const auto& [id, body] : grains) {
        const auto i = static_cast<std::size_t>(body);
        const hsize_t row = grain_rows_.at(id);
        const Vec3 p = bodies.position[body], v = bodies.velocity[body];
        const Quat q = bodies.orientation[body];
        const Mat3& s = fields.stress.at(i);
        put(position, row, {p.x, p.y, p.z});
        put(orientation, row, {q.w, q.x, q.y, q.z});
        put(velocity, row, {v.x, v.y, v.z});
        put(stress, row,
            {s[0].x, s[1].y, s[2].z, 0.5 * (s[0].y + s[1].x), 0.5 * (s[1].z + s[2].y), 0.5 * (s[0].z + s[2].x)});
        damage[row] = bond_damage[i];
        cleavage[row] = fields.cleavage.empty() ? 0.0 : fields.cleavage.at(i).worst.f;
        cluster[row] = fields.cluster.at(i);
    }
    const auto store = [&](Hdf5Growing& field, const auto& values, hsize_t width) {
        if (width == 0) field.write({snapshot, 0}, {1, n}, values);
        if (width > 0) field.write({snapshot, 0, 0}, {1, n, width}, values);
        field.flush();
    };
    store(snapshots_.position, position, 3);
    store(snapshots_.orientation, orientation, 4);
    store(snapshots_.velocity, velocity, 3);
    store(snapshots_.stress, stress, 6);
    store(snapshots_.damage, damage, 0);
    store(snapshots_.cleavage, cleavage, 0);
    store(snapshots_.cluster, cluster, 0);
}

void Hdf5Results::write_bond_table(const State& state, const std::vector<BondFacts>& bonds,
                                   const std::vector<int>& slots)
{
    std::vector<std::int32_t> kind, grain_a, grain_b;
    std::vector<double> area, normal, normal_stiffness, shear_stiffness;
    for (const int slot : slots) {
        const BondFacts& bond = bonds[static_cast<std::size_t>(slot)];
        kind.push_back(static_cast<std::int32_t>(bond.kind));
        grain_a.push_back(state.bodies.id[bond.a]);
        grain_b.push_back(state.bodies.id[bond.b]);
        area.push_back(bond.area);
        append_vec3(normal, bond_face(state, slot).normal);
        normal_stiffness.push_back(bond.normal_stiffness);
        shear_stiffness.push_back(bond.shear_stiffness);
    }
    append_rows(bonds_.kind, kind);
    append_rows(bonds_.grain_a, grain_a);
    append_rows(bonds_.grain_b, grain_b);
    append_rows(bonds_.area, area);
    append_rows(bonds_.normal, normal, 3);
    append_rows(bonds_.normal_stiffness, normal_stiffness);
    append_rows(bonds_.shear_stiffness, shear_stiffness);
}

/// Rows of the bonds that there are, new ones at the end; a bond whose grain was split keeps its row as it was last.
std::vector<Hdf5Results::BondRow> Hdf5Results::update_bonds(const State& state, const std::vector<BondFacts>& bonds)
{
    std::vector<BondRow> rows;
    std::vector<int> fresh;
    std::map<IdPair, int> seen;
    for (const int slot : bond_order(state, bonds)) {
        const IdPair pair = ids_of(state, bonds[static_cast<std::size_t>(slot)]);
        const auto [found, is_new] =
            bond_rows_.emplace(std::tuple{pair.first, pair.second, seen[pair]++}, bond_rows_.size());
        if (is_new) fresh.push_back(slot);
        rows.push_back({slot, found->second});
    }
    write_bond_table(state, bonds, fresh);
    now_.bond_failure.resize(bond_rows_.size(), -1.0);
    now_.bond_cause.resize(bond_rows_.size(), 0);
    for (const BondRow& r : rows) {
        const BondFacts& bond = bonds[static_cast<std::size_t>(r.slot)];
        now_.bond_failure[r.row] = bond.failure_time;
        now_.bond_cause[r.row] = static_cast<std::int32_t>(bond.cause);
    }
    bonds_.failure_time.write({0}, {now_.bond_failure.size()}, now_.bond_failure);
    bonds_.failure_time.flush();
    bonds_.cause.write({0}, {now_.bond_cause.size()}, now_.bond_cause);
    bonds_.cause.flush();
    return rows;
}

void Hdf5Results::append_cracks(const std::vector<CrackFace>& cracks)
{
    // Cracks do not heal and come in the order of their times: fresh ones are later than all that are stored. (A split
    // grain shares out its broken faces too; those are no new cracks.)
    std::vector<CrackFace> fresh;
    for (const CrackFace& crack : cracks) {
        if (crack.time > now_.last_crack) fresh.push_back(crack);
    }
    if (fresh.empty()) return;
    now_.last_crack = fresh.back().time;
    auto& c = cracks_;
    append_column<double>(c.first_damage_time, fresh, [](const CrackFace& f) { return f.first_damage_time; });
    append_column<std::int32_t>(c.mode, fresh, [](const CrackFace& f) { return f.mode; });
    append_column<std::int32_t>(c.cause, fresh, [](const CrackFace& f) { return f.cause; });
    append_column<std::int32_t>(c.grain_a, fresh, [](const CrackFace& f) { return f.grain_a; });
    append_column<std::int32_t>(c.grain_b, fresh, [](const CrackFace& f) { return f.grain_b; });
    append_column<double>(c.area, fresh, [](const CrackFace& f) { return f.area; });
    append_vec3_column(c.center, fresh, [](const CrackFace& f) { return polygon_centroid(f.polygon); });
    append_vec3_column(c.normal, fresh, [](const CrackFace& f) { return f.normal; });
    append_column<double>(c.opening, fresh, [](const CrackFace& f) { return f.opening; });
    append_column<double>(c.k_i, fresh, [](const CrackFace& f) { return f.K_I; });
    append_column<double>(c.k_ii, fresh, [](const CrackFace& f) { return f.K_II; });
    append_column<double>(c.time, fresh, [](const CrackFace& f) { return f.time; });
}

template <class Row>
void Hdf5Results::append_table(Table& table, const std::vector<Row>& rows)
{
    std::map<std::string, std::vector<double>> numbers;
    std::map<std::string, std::vector<std::int32_t>> integers;
    for (const Row& row : rows) {
        row.for_each_column([&](const char* name, const char*, const auto& value) {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, Vec3>) {
                append_vec3(numbers[name], value);
            } else if constexpr (std::is_same_v<Value, double>) {
                numbers[name].push_back(value);
            } else {
                integers[name].push_back(value);
            }
        });
    }
    for (const auto& [name, values] : numbers)
        append_rows(table.at(name), values, values.size() / rows.size() == 3 ? 3 : 0);
    for (const auto& [name, values] : integers) append_rows(table.at(name), values);
}

void Hdf5Results::append_clusters(const std::vector<Cluster>& clusters, const State& state, std::int32_t snapshot)
{
    append_rows(cluster_snapshot_, std::vector<std::int32_t>(clusters.size(), snapshot));
    append_table(clusters_, clusters);
    append_rows(cluster_time_, std::vector<double>(clusters.size(), state.time));
}

void Hdf5Results::finish(const Model& model, const State& state, const SnapshotFields& fields,
                         const std::vector<CrackFace>& cracks)
{
    append_table(fragments_, collect_fragments(model, state, fields));
    if (now_.last_step == state.step) return;
    constexpr std::int32_t after_the_last = -1;
    update_bonds(state, all_bond_facts(state));
    append_cracks(cracks);
    append_clusters(collect_clusters(model, state, fields), state, after_the_last);
}

void Hdf5Results::close()
{
    // The datasets first: a file with open ones stays open.
    history_ = {};
    snapshots_ = {};
    bonds_ = {};
    cracks_ = {};
    cluster_snapshot_ = {};
    cluster_time_ = {};
    clusters_.clear();
    fragments_.clear();
    file_.close();
}

}  // namespace grainfrac
