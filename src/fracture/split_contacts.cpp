// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/split_contacts.h"

#include "contact/linear_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grainfrac {

std::vector<OldContact> take_contacts(State& state, const std::vector<Parting>& partings)
{
    Contacts& c = state.contacts;
    std::vector<OldContact> old;
    state.for_each_contact([&](int i) {
        const bool concerned = std::any_of(partings.begin(), partings.end(), [&](const Parting& p) {
            return p.request.body == c.a[i] || p.request.body == c.b[i];
        });
        if (!concerned || c.active[i] != 1) return;
        old.push_back({c.a[i], c.b[i], c.normal_force[i] - c.viscous_force[i], c.shear_force[i]});
        state.past_contacts.inserted_work -= c.stored_energy[i];
        c.active.at(i) = 0;
        c.shear_force.at(i) = {};
        for (Buffer<double>* history : {&c.stored_energy, &c.viscous_force, &c.twist_moment, &c.max_overlap,
                                        &c.offset_overlap, &c.normal_force, &c.shear_stiffness, &c.twist_stiffness})
            history->at(i) = 0.0;
        c.stiffness_scale.at(i) = 1.0;
    });
    return old;
}

std::vector<int> give_contacts(const Model& model, State& state, const std::vector<Parting>& partings,
                               const std::vector<OldContact>& old)
{
    Contacts& c = state.contacts;
    const auto parts = [&](int body) {
        std::vector<int> list{body};
        for (const Parting& p : partings) {
            if (p.request.body == body) list.push_back(p.part_1);
        }
        return list;
    };
    std::vector<std::pair<int, int>> pairs;  // sorted, as the list is
    for (int i = 0; i < state.pairs.size(); ++i) pairs.emplace_back(state.pairs.a[i], state.pairs.b[i]);
    std::vector<int> given;
    for (const OldContact& o : old) {
        struct Heir {
            int contact;
            double own;
            bool turned_round;  // the pair is named the other way round
        };
        std::vector<Heir> heirs;
        double sum = 0.0;
        for (const int a : parts(o.a)) {
            for (const int b : parts(o.b)) {
                const std::pair<int, int> pair = std::minmax(a, b);
                const auto found = std::lower_bound(pairs.begin(), pairs.end(), pair);
                if (found == pairs.end() || *found != pair) continue;
                const int i = state.pairs.contact[static_cast<int>(found - pairs.begin())];
                if (i < 0 || c.point[i].overlap_energy <= 0.0) continue;
                const double own = model.contact_laws[c.law[i]].area_stiffness * c.point[i].overlap_force;
                heirs.push_back({i, own, a > b});
                sum += own;
            }
        }
        for (const auto& [i, own, turned_round] : heirs) {
            const double share = own / sum, pressed = share * o.pressed;
            given.push_back(i);
            c.active.at(i) = 1;
            c.normal.at(i) = c.point[i].normal;
            c.shear_force.at(i) = (turned_round ? -share : share) * tangential(o.shear_force, c.point[i].normal);
            c.twist_moment.at(i) = c.max_overlap.at(i) = c.offset_overlap.at(i) = 0.0;
            c.shear_stiffness.at(i) = c.twist_stiffness.at(i) = 0.0;
            c.stiffness_scale.at(i) = 1.0;
            match_force(std::fmax(0.0, pressed), own, c.point[i], c.offset_overlap.at(i), c.stiffness_scale.at(i),
                        c.max_overlap.at(i));
        }
    }
    // Parts are eroded by smaller radii, and their sharper edges may reach what the grain's did not: no force from
    // that.
    for (int i = 0; i < c.size(); ++i) {
        const bool concerned = std::any_of(partings.begin(), partings.end(), [&](const Parting& p) {
            return p.request.body == c.a[i] || p.request.body == c.b[i] || p.part_1 == c.a[i] || p.part_1 == c.b[i];
        });
        if (!concerned || c.active[i] == 1 || c.point[i].overlap_energy <= 0.0) continue;
        c.active.at(i) = 1;
        c.normal.at(i) = c.point[i].normal;
        c.offset_overlap.at(i) = std::sqrt(2.0 * c.point[i].overlap_energy);
    }
    return given;
}

}  // namespace grainfrac
