// SPDX-License-Identifier: GPL-3.0-or-later
// What a run with splits leaves behind agrees with itself and with the specimen.
#include "cleaving_run.h"
#include "io/hdf5_file.h"
#include "io/history_csv.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

using namespace grainfrac;
using nlohmann::json;

namespace {

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

void check_fragments(const HistoryTable& fragments, const HistoryTable& clusters, const json& summary)
{
    const double prism =
        1.5 * std::sqrt(3.0) * sample::cleaving_side * sample::cleaving_side * sample::cleaving_thickness;
    const double whole = sample::cleaving_grains * prism, density = 3100.0;
    const std::size_t n = fragments.rows();
    const std::vector<double>&mass = fragments.column("mass_kg"), &volume = fragments.column("volume_m3"),
          &of = fragments.column("fragment_of"), &parent = fragments.column("parent"),
          &generation = fragments.column("generation"), &cluster = fragments.column("cluster"),
          &sphericity = fragments.column("sphericity");
    CHECK(n == summary["counts"]["grains"]);
    CHECK(n == sample::cleaving_grains + summary["splits"]["number"].get<std::size_t>());
    CHECK(sum(volume) == Approx(whole).epsilon(1e-12));
    CHECK(sum(mass) == Approx(density * whole).epsilon(1e-12));
    CHECK(sum(clusters.column("volume_m3")) == Approx(whole).epsilon(1e-12));
    CHECK(sum(clusters.column("mass_kg")) == Approx(density * whole).epsilon(1e-12));
    CHECK(sum(clusters.column("fragments")) == static_cast<double>(n));
    CHECK(clusters.rows() == summary["fragments"]["number"].get<std::size_t>());

    std::map<double, double> of_grain, of_cluster;
    for (std::size_t i = 0; i < n; ++i) {
        of_grain[of[i]] += volume[i];
        of_cluster[cluster[i]] += mass[i];
        CHECK((generation[i] == 0.0) == (parent[i] == -1.0));
        CHECK(sphericity[i] > 0.1);
        CHECK(sphericity[i] < 0.9);  // of the best prism
    }
    CHECK(of_grain.size() == sample::cleaving_grains);
    for (const auto& [id, v] : of_grain) CHECK(v == Approx(prism).epsilon(1e-12));
    REQUIRE(of_cluster.size() == clusters.rows());
    for (std::size_t k = 0; k < clusters.rows(); ++k)
        CHECK(clusters.column("mass_kg")[k] == Approx(of_cluster.at(clusters.column("cluster")[k])).epsilon(1e-12));
}

void check_table(const Hdf5File& file, const HistoryTable& fragments)
{
    for (const char* name : {"id", "parent", "fragment_of", "generation", "cluster", "faces"}) {
        INFO(name);
        const auto rows = file.read<std::int32_t>(std::string("/fragments/") + name);
        CHECK(std::vector<double>(rows.begin(), rows.end()) == fragments.column(name));
    }
    for (const auto& [name, column] : {std::pair{"mass", "mass_kg"}, std::pair{"volume", "volume_m3"},
                                       std::pair{"surface", "surface_m2"}, std::pair{"flatness", "flatness"}}) {
        INFO(name);
        CHECK(file.read<double>(std::string("/fragments/") + name) == fragments.column(column));
    }
    const std::vector<double> position = file.read<double>("/fragments/position");
    REQUIRE(position.size() == 3 * fragments.rows());
    CHECK(position[4] == fragments.column("position_y_m")[1]);
}

void check_cracks(const HistoryTable& history, const Hdf5File& file, const json& cracks)
{
    const std::vector<double>&between = history.column("intergranular_area_m2"),
          &through = history.column("transgranular_area_m2"), &work = history.column("fracture_work_J"),
          &work_through = history.column("transgranular_fracture_work_J");
    const double last_between = between.back(), last_through = through.back();
    // Areas only grow; where a split shares out a broken face, its parts add up to it but for round-off. (The work need
    // not: where shear turns round under pressure, damage that grows hands energy to friction, and that counts back.)
    for (std::size_t i = 1; i < history.rows(); ++i) {
        CHECK(between[i] >= between[i - 1] * (1.0 - 1e-12));
        CHECK(through[i] >= through[i - 1] * (1.0 - 1e-12));
        CHECK(work_through[i] <= work[i] * (1.0 + 1e-12));
    }
    double listed = 0.0;
    for (const char* kind : {"intergranular_tension", "intergranular_shear", "intergranular_mixed"})
        listed += cracks[kind]["area_m2"].get<double>();
    CHECK(listed == Approx(last_between).epsilon(1e-12));
    CHECK(cracks["transgranular"]["area_m2"].get<double>() == Approx(last_through).epsilon(1e-12));
    CHECK(cracks["transgranular"]["number"] > 0);
    CHECK(cracks["area_m2"].get<double>() == Approx(last_between + last_through).epsilon(1e-12));
    CHECK(cracks["transgranular"]["share_of_area"].get<double>() ==
          Approx(last_through / (last_between + last_through)).epsilon(1e-12));
    CHECK(cracks["transgranular"]["share_of_fracture_work"].get<double>() ==
          Approx(work_through.back() / work.back()).epsilon(1e-12));

    // Faces broken in results.h5 are those of before later splits, their area the same.
    const std::vector<double> time = file.read<double>("/cracks/time"), area = file.read<double>("/cracks/area");
    CHECK(sum(area) == Approx(last_between + last_through).epsilon(1e-12));
    CHECK(cracks["first"]["time_s"] == time.front());
    const json &began = cracks["first_macroscopic"]["began"],
               &grown = cracks["first_macroscopic"]["became_macroscopic"];
    CHECK(std::find(time.begin(), time.end(), began["time_s"].get<double>()) != time.end());
    CHECK(began["time_s"] >= cracks["first"]["time_s"]);
    CHECK(grown["time_s"] > began["time_s"]);
    CHECK(grown["area_m2"] >= cracks["macroscopic_from_area_m2"]);

    // The load of the first crack lies between the rows around it.
    const std::vector<double>&t = history.column("time_s"), &load = history.column("load_N");
    const auto after = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time.front()) - t.begin());
    REQUIRE(after > 0);
    const auto [low, high] = std::minmax(load[after - 1], load[after]);
    CHECK(cracks["first"]["load_N"] >= low);
    CHECK(cracks["first"]["load_N"] <= high);
}

}  // namespace

TEST_CASE("fragments, cracks and shares of a run agree with the specimen and with each other", "[output][run]")
{
    const sample::TemporaryFolder folder;
    const std::filesystem::path run = sample::run_cleaving_disc(folder);
    const json summary = json::parse(read_file(run / "summary.json"));
    const HistoryTable fragments = read_history_csv(run / "fragments.csv"),
                       clusters = read_history_csv(run / "clusters.csv"),
                       history = read_history_csv(run / "history.csv");
    const Hdf5File file = Hdf5File::open(run / "results.h5");
    check_fragments(fragments, clusters, summary);
    check_table(file, fragments);
    check_cracks(history, file, summary["cracks"]);
    CHECK(summary["test"]["modulus_Pa"] > 0.0);
    CHECK(summary["test"]["nominal_strength_Pa"] > 0.0);
    // Where grains split, some came near it; NaN before a part exists and after its grain is gone.
    const std::vector<double> cleavage = file.read<double>("/snapshots/cleavage");
    CHECK(std::any_of(cleavage.begin(), cleavage.end(), [](double f) { return f > 0.5; }));
}
