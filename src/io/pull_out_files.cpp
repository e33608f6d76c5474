// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pull_out_files.h"

#include "io/csv_row.h"
#include "io/history_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace grainfrac {

namespace {

constexpr const char* rows_name = "pull_out.csv";
constexpr const char* profiles_name = "profiles.csv";
/// A profile is due within this of its mean damage [-].
constexpr double damage_round_off = 1e-9;

constexpr const char* rows_head =
    "# phase: 0 stress growth, 1 debonding, 2 friction. Slip of the exit and of the embedded end: of the fibre "
    "against the matrix, along the pull.\n"
    "end_slip_m,end_stress_Pa,end_displacement_m,embedded_slip_m,mean_damage,phase,support_stress_Pa\n";
constexpr const char* profiles_head =
    "# means of the levels of the fibre; z from where its matrix begins; tau_spread: about the mean of a level\n"
    "mean_damage,z_m,slip_m,tau_Pa,sigma_f_Pa,damage,tau_spread_Pa\n";

std::vector<double> sorted(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values;
}

/// Stress growth, debonding, friction (physics: phases of a pull-out).
int phase_of(const PullOutState& s)
{
    return s.mean_damage <= 0.0 ? 0 : (s.mean_damage < 1.0 - damage_round_off ? 1 : 2);
}

}  // namespace

PullOutFiles::PullOutFiles(const std::filesystem::path& folder, std::vector<double> profiles_at)
    : rows_(folder / rows_name, rows_head),
      profiles_(folder / profiles_name, profiles_head),
      due_(sorted(std::move(profiles_at)))
{
}

PullOutFiles::PullOutFiles(const std::filesystem::path& folder, std::vector<double> profiles_at,
                           const PullOutMark& mark)
    : rows_(folder / rows_name, mark.rows),
      profiles_(folder / profiles_name, mark.profiles),
      due_(sorted(std::move(profiles_at))),
      next_(static_cast<std::size_t>(mark.next_profile)),
      whole_(mark.whole)
{
}

void check_heads(const std::filesystem::path& folder, const PullOutMark& mark)
{
    check_head(folder / rows_name, mark.rows);
    check_head(folder / profiles_name, mark.profiles);
}

PullOutMark PullOutFiles::mark() const
{
    return {rows_.mark(), profiles_.mark(), static_cast<std::int64_t>(next_), whole_};
}

void PullOutFiles::append(const PullOutState& s, const FibreProfile& p)
{
    std::string line;
    for (const double x : {s.exit_slip, s.end_stress, s.end_displacement, s.embedded_slip, s.mean_damage})
        append_cell(line, x);
    append_cell(line, phase_of(s));
    append_cell(line, s.support_stress);
    rows_.append(line + '\n');
    if (next_ < due_.size() && due_[next_] <= 0.0) {  // the last state without damage
        if (s.mean_damage <= 0.0) {
            if (s.end_stress != 0.0) whole_ = {s, p};
            return;
        }
        finish();
    }
    if (next_ >= due_.size() || s.mean_damage < due_[next_] - damage_round_off) return;
    while (next_ < due_.size() && s.mean_damage >= due_[next_] - damage_round_off) ++next_;
    put_profile(s, p);
}

void PullOutFiles::finish()
{
    if (next_ >= due_.size() || due_[next_] > 0.0) return;
    while (next_ < due_.size() && due_[next_] <= 0.0) ++next_;
    if (whole_) put_profile(whole_->first, whole_->second);
}

void PullOutFiles::put_profile(const PullOutState& s, const FibreProfile& p)
{
    std::string rows;
    for (std::size_t k = 0; k < p.position.size(); ++k) {
        std::string row;
        for (const double x :
             {s.mean_damage, p.position[k], p.slip[k], p.shear[k], p.stress[k], p.damage[k], p.spread[k]})
            append_cell(row, x);
        rows += row + '\n';
    }
    profiles_.append(rows);
}

void write_pull_out_plots(const std::filesystem::path& folder)
{
    const HistoryTable rows = read_history_csv(folder / rows_name), profiles = read_history_csv(folder / profiles_name);
    const std::vector<double>& stress = rows.column("end_stress_Pa");
    if (stress.size() < 2) return;
    plot_curves(folder / "plots" / "pull_out", "Fibre pull-out", "slip at the exit, displacement of the end [m]",
                "stress at the end [Pa]",
                {{"slip at the exit", rows.column("end_slip_m"), stress},
                 {"displacement of the end", rows.column("end_displacement_m"), stress}});
    std::map<double, std::pair<Curve, Curve>> of_damage;
    const std::vector<double>& D = profiles.column("mean_damage");
    for (std::size_t i = 0; i < profiles.rows(); ++i) {
        auto& [shear, tension] = of_damage[D[i]];
        shear.label = tension.label = fmt::format("mean damage {:.2g}", D[i]);
        shear.x.push_back(profiles.column("z_m")[i]);
        shear.y.push_back(profiles.column("tau_Pa")[i]);
        tension.x.push_back(profiles.column("z_m")[i]);
        tension.y.push_back(profiles.column("sigma_f_Pa")[i]);
    }
    std::vector<Curve> shears, tensions;
    for (auto& [damage, both] : of_damage) {
        if (both.first.x.size() < 2) continue;
        shears.push_back(std::move(both.first));
        tensions.push_back(std::move(both.second));
    }
    if (shears.empty()) return;
    plot_curves(folder / "plots" / "fibre_shear", "Shear of the interface", "from the embedded end [m]", "shear [Pa]",
                shears);
    plot_curves(folder / "plots" / "fibre_stress", "Stress of the fibre", "from the embedded end [m]", "stress [Pa]",
                tensions);
}

}  // namespace grainfrac
