// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/summary.h"

#include "experiment/specimen.h"
#include "model/validate.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sys/resource.h>

namespace grainfrac {

namespace {

using nlohmann::json;

/// Faces listed one by one in the order in which they broke; all of them are in results.h5.
constexpr std::size_t listed_breaks = 100;

json vector_json(const Vec3& a)
{
    return {a.x, a.y, a.z};
}

json counts(const Built& b)
{
    const BodyCounts n = count_bodies(b.model, b.state);
    return {{"grains", n.grains},
            {"gripped_grains", n.gripped_grains},
            {"spheres", n.spheres},
            {"gripped_spheres", n.gripped_spheres},
            {"nodes", 0},
            {"wall_bodies", n.walls},
            {"interfaces", b.state.interfaces.size()},
            {"interface_points", b.state.points.size()},
            {"parallel_bonds", b.state.parallels.size()},
            {"sphere_bonds", b.state.sphere_bonds.size()},
            {"bonds", b.state.bond_slots()},
            {"contact_pairs", b.state.pairs.size()}};
}

const char* kind_name(int mode, int cause)
{
    static constexpr const char* causes[] = {"intergranular_tension", "intergranular_shear", "intergranular_mixed"};
    return mode == 1 ? "transgranular" : causes[cause];
}

/// Of the history at a time between two of its rows.
json loading_at(const RunRecord& record, double time)
{
    const auto& rows = record.rows;
    const auto after = std::find_if(rows.begin(), rows.end(), [&](const HistoryRow& r) { return r.time >= time; });
    const HistoryRow& b = after == rows.end() ? rows.back() : *after;
    const HistoryRow& a = after == rows.begin() ? b : *(after - 1);
    const double share = b.time > a.time ? (time - a.time) / (b.time - a.time) : 0.0;
    const auto between = [&](double x, double y) { return x + share * (y - x); };
    return {{"time_s", time},
            {"load_N", between(a.load, b.load)},
            {"displacement_m", between(a.displacement, b.displacement)},
            {"nominal_strain", between(a.nominal_strain, b.nominal_strain)},
            {"nominal_stress_Pa", between(a.nominal_stress, b.nominal_stress)},
            {"before_peak", time <= record.peak_time}};
}

json start_json(const RunRecord& record, const CrackStart& start)
{
    json j = loading_at(record, start.time);
    j["position_m"] = vector_json(start.point);
    j["kind"] = kind_name(start.mode, start.cause);
    j["faces_at_that_time"] = start.faces;
    return j;
}

json cracks_json(const State& state, const std::vector<CrackFace>& cracks, const RunRecord& record)
{
    json j;
    for (const int kind : {0, 1, 2, 3}) j[kind_name(kind / 3, kind % 3)] = {{"number", 0}, {"area_m2", 0.0}};
    for (const CrackFace& c : cracks) {
        json& kind = j[kind_name(c.mode, c.cause)];
        kind["number"] = kind["number"].get<int>() + 1;
        kind["area_m2"] = kind["area_m2"].get<double>() + c.area;
    }
    const CrackSums sums = crack_sums(state);
    const double area = sums.intergranular_area + sums.transgranular_area, work = record.rows.back().energy.fracture;
    j["area_m2"] = area;
    j["transgranular"]["fracture_work_J"] = sums.transgranular_work;
    j["transgranular"]["share_of_area"] = area > 0.0 ? sums.transgranular_area / area : 0.0;
    j["transgranular"]["share_of_fracture_work"] = work > 0.0 ? sums.transgranular_work / work : 0.0;
    if (const auto& first = record.cracks.first()) j["first"] = start_json(record, *first);
    if (const auto& found = record.cracks.macroscopic()) {
        json large = loading_at(record, found->time);
        large["area_m2"] = found->area;
        large["faces"] = found->faces;
        j["first_macroscopic"] = {{"began", start_json(record, found->start)}, {"became_macroscopic", large}};
    }
    j["macroscopic_from_area_m2"] = record.cracks.scale().area;
    json sequence = json::array();
    for (const CrackFace& c : cracks) {
        if (sequence.size() == listed_breaks) break;
        sequence.push_back({{"time_s", c.time},
                            {"position_m", vector_json(polygon_centroid(c.polygon))},
                            {"kind", kind_name(c.mode, c.cause)}});
    }
    j["sequence"] = sequence;
    return j;
}

json splits_json(const RunRecord& record)
{
    return {{"number", record.splits},
            {"area_m2", record.split_area},
            {"inserted_J", record.split_energy},
            {"refused", record.refused_splits}};
}

json fragments_json(const Built& b, const SnapshotFields& fields)
{
    std::map<std::int32_t, double> mass;
    double total = 0.0;
    for (std::size_t i = 0; i < fields.cluster.size(); ++i) {
        if (fields.cluster[i] < 0) continue;
        mass[fields.cluster[i]] += b.state.bodies.mass[static_cast<int>(i)];
        total += b.state.bodies.mass[static_cast<int>(i)];
    }
    json largest = json::array();
    for (const auto& [cluster, m] : mass) {
        if (largest.size() < 10) largest.push_back(m / total);
    }
    return {{"number", mass.size()}, {"largest_mass_fractions", largest}};
}

json energy_json(const Ledger& e, const RunRecord& record)
{
    double worst = 0.0, worst_before_peak = 0.0;
    for (const HistoryRow& r : record.rows) {
        if (r.step == 0 || r.load < 0.1 * record.peak_load) continue;
        worst = std::max(worst, r.energy.relative_error());
        if (r.time <= record.peak_time) worst_before_peak = std::max(worst_before_peak, r.energy.relative_error());
    }
    return {{"kinetic_J", e.kinetic},
            {"elastic_bonds_J", e.elastic_bonds},
            {"elastic_contacts_J", e.elastic_contacts},
            {"fracture_J", e.fracture},
            {"friction_J", e.friction},
            {"damping_J", e.damping},
            {"external_work_J", e.external},
            {"gravity_work_J", e.gravity},
            {"inserted_J", e.inserted},
            {"inserted_over_external", e.external != 0.0 ? e.inserted / e.external : 0.0},
            {"initial_J", e.initial},
            {"residual_J", e.residual()},
            {"relative_error", e.relative_error()},
            {"largest_relative_error", worst},
            {"largest_relative_error_before_peak", worst_before_peak}};
}

/// What the test says of its curve; where it names no modulus, the slope of its nominal stress over its nominal strain.
std::vector<NamedResult> derived_results(const Experiment& e, const RunRecord& record)
{
    std::vector<CurvePoint> curve;
    for (const HistoryRow& r : record.rows) curve.push_back({r.time, r.load, r.nominal_strain, r.nominal_stress});
    std::vector<NamedResult> results = e.results != nullptr ? e.results(e, curve) : std::vector<NamedResult>{};
    const bool has_modulus = std::any_of(results.begin(), results.end(), [](const NamedResult& r) {
        return r.name.find("modulus") != std::string::npos;
    });
    if (!has_modulus && !e.pull_out && e.specimen.stress_area > 0.0 && e.specimen.length > 0.0)
        results.push_back({"modulus_Pa", secant_modulus(curve)});
    return results;
}

json quasi_static_json(const Built& b, const RunRecord& record)
{
    json j = {{"kinetic_over_elastic_to_peak", record.kinetic_over_elastic},
              {"platen_imbalance_at_peak", record.imbalance_at_peak},
              {"recommended_platen_speed_m_per_s", b.experiment.quasi_static_speed}};
    if (b.experiment.speed_of_each_wall > 0.0) j["speed_of_each_platen_m_per_s"] = b.experiment.speed_of_each_wall;
    j["fulfilled"] = record.kinetic_over_elastic < 1e-2 && record.imbalance_at_peak < 1e-2;
    return j;
}

}  // namespace

BodyCounts count_bodies(const Model& model, const State& state)
{
    BodyCounts n;
    for (int i = 0; i < state.bodies.size(); ++i) {
        const int gripped = state.bodies.wall[i] >= 0 ? 1 : 0;
        if (model.groups[static_cast<std::size_t>(state.bodies.group[i])].is_wall) {
            ++n.walls;
        } else if (is_sphere(model, state.bodies, i)) {
            ++n.spheres;
            n.gripped_spheres += gripped;
        } else {
            ++n.grains;
            n.gripped_grains += gripped;
        }
    }
    return n;
}

std::int64_t peak_memory()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

std::string summary_json(const RunFacts& facts, const Case& c, const Built& b, const RunRecord& record,
                         const Ending& ending, const SnapshotFields& fields)
{
    const Ledger e = energy_ledger(b.model, b.state);
    json j;
    j["version"] = facts.version;
    j["title"] = c.simulation.title;
    j["input_hash"] = facts.input_hash;
    j["seed"] = facts.seed;
    j["device"] = facts.device;
    j["threads"] = facts.threads;
    j["exit"] = {{"code", ending.code}, {"reason", ending.reason}};
    j["warnings"] = record.warnings;
    j["counts"] = counts(b);
    j["time_step"] = {{"dt_s", record.time_step},
                      {"stability_limit_s", record.critical_step},
                      {"bounded_by", record.limiter},
                      {"steps", b.state.step},
                      {"simulated_time_s", b.state.time}};
    j["test"] = {{"kind", c.test.kind},
                 {"peak_load_N", record.peak_load},
                 {"peak_time_s", record.peak_time},
                 {"displacement_at_peak_m", record.peak_displacement}};
    if (b.experiment.specimen.stress_area > 0.0) j["test"]["nominal_strength_Pa"] = record.peak_stress;
    for (const NamedResult& r : b.experiment.facts) j["test"][r.name] = r.value;
    for (const NamedResult& r : derived_results(b.experiment, record)) j["test"][r.name] = r.value;
    j["cracks"] = cracks_json(b.state, collect_cracks(b.model, b.state), record);
    if (!b.cleavage.empty()) j["splits"] = splits_json(record);
    j["fragments"] = fragments_json(b, fields);
    j["energy"] = energy_json(e, record);
    j["mass_kg"] = record.last_momentum.mass;
    j["momentum"] = {{"linear_start_kg_m_per_s", vector_json(record.first_momentum.linear)},
                     {"linear_end_kg_m_per_s", vector_json(record.last_momentum.linear)},
                     {"angular_start_kg_m2_per_s", vector_json(record.first_momentum.angular)},
                     {"angular_end_kg_m2_per_s", vector_json(record.last_momentum.angular)}};
    if (b.experiment.quasi_static) j["quasi_static"] = quasi_static_json(b, record);
    j["state_hash"] = fmt::format("{:016x}", state_hash(b.state));
    const double steps = static_cast<double>(b.state.step);
    j["run_time"] = {{"build_s", record.phases.build},
                     {"steps_s", record.phases.steps},
                     {"output_s", record.phases.output},
                     {"cleavage_looks_s", record.phases.looks},
                     {"splitting_s", record.phases.splitting},
                     {"steps_per_s", record.phases.steps > 0.0 ? steps / record.phases.steps : 0.0}};
    const auto cost = [&](const char* name, int number) {
        if (number > 0 && steps > 0.0) j["run_time"][name] = 1e9 * record.phases.steps / steps / number;
    };
    cost("ns_per_interface_point_and_step", b.state.points.size());
    cost("ns_per_sphere_bond_and_step", b.state.sphere_bonds.size());
    j["peak_memory_B"] = peak_memory();
    return j.dump(2) + "\n";
}

}  // namespace grainfrac
