// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a step, each by itself: what is timed and counted. dt = 0, so that a state can be used again.
#pragma once

#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "contact/gather.h"
#include "fracture/bond_forces.h"
#include "motion/integrate.h"
#include "motion/step.h"

#include <array>

namespace grainfrac::bench {

struct TimedStage {
    const char* name;
    void (*run)(const Model&, State&, double dt);
};

inline constexpr std::array stages = {
    TimedStage{"step", [](const Model& m, State& s, double dt) { step(m, s, dt); }},
    TimedStage{"kick", [](const Model& m, State& s, double) { kick(m, s, 0.0); }},
    TimedStage{"drift", [](const Model& m, State& s, double) { drift(m, s, 0.0); }},
    TimedStage{"pairs_are_stale", [](const Model& m, State& s, double) { pairs_are_stale(m, s, 0.0); }},
    TimedStage{"find_pairs", [](const Model& m, State& s, double) { find_pairs(m, s); }},
    TimedStage{"find_contacts", [](const Model& m, State& s, double) { find_contacts(m, s); }},
    TimedStage{"follow_contacts", [](const Model& m, State& s, double) { follow_contacts(m, s); }},
    TimedStage{"contact_forces", [](const Model& m, State& s, double) { contact_forces(m, s, 0.0); }},
    TimedStage{"bond_forces", [](const Model& m, State& s, double) { bond_forces(m, s, 0.0); }},
    TimedStage{"gather_forces", [](const Model& m, State& s, double) { gather_forces(m, s); }},
};

}  // namespace grainfrac::bench
