// SPDX-License-Identifier: GPL-3.0-or-later
// Every stage of a step a fixed number of times on small models; callgrind writes a file for each (count_instructions).
#include "cases.h"
#include "model/lanes.h"
#include "stages.h"

#include <fmt/format.h>

#include <string>
#include <valgrind/callgrind.h>

using namespace grainfrac;
using namespace grainfrac::bench;

int main()
{
    struct Small {
        Kind kind;
        int bodies;
    };
    use_vector_unit(VectorUnit::base);  // what every machine has
    constexpr int rounds = 3;
    for (const Small m : {Small{Kind::honeycomb, 27}, Small{Kind::bonded_spheres, 200}, Small{Kind::prisms, 27},
                          Small{Kind::loose_spheres, 100}}) {
        Loaded& l = loaded(m.kind, m.bodies);
        for (const TimedStage& stage : stages) {
            const std::string name = fmt::format("{}/{} {}", name_of(m.kind), stage.name, rounds * l.interactions());
            CALLGRIND_START_INSTRUMENTATION;
            CALLGRIND_ZERO_STATS;
            for (int i = 0; i < rounds; ++i) stage.run(l.built.model, l.built.state, l.dt);
            CALLGRIND_DUMP_STATS_AT(name.c_str());
            CALLGRIND_STOP_INSTRUMENTATION;
        }
    }
    return 0;
}
