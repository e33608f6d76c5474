// SPDX-License-Identifier: GPL-3.0-or-later
// Where the first crack and the first macroscopic crack of a run began.
#pragma once

#include "io/results.h"

#include <optional>
#include <vector>

namespace grainfrac {

/// The face with which a crack began.
struct CrackStart {
    double time = 0.0;        ///< when it failed [s]
    Vec3 point;               ///< its centroid, where it was soon after [m]
    int mode = 0, cause = 0;  ///< as in CrackFace
    int faces = 0;            ///< that failed at that time, this one among them
};

/// A macroscopic crack: broken faces that touch each other and together reach a given area.
struct MacroscopicCrack {
    CrackStart start;   ///< where the largest of the cracks that it grew from began
    double time = 0.0;  ///< when it reached the area [s]
    double area = 0.0;  ///< then [m^2]
    int faces = 0;      ///< then
};

struct CrackScale {
    double area = 0.0;   ///< of broken faces that makes a crack macroscopic [m^2]
    double reach = 0.0;  ///< faces nearer to each other than this are one crack [m]
};
/// A quarter of the smallest face of the box round the sharp grains, and a tenth of the mean grain spacing.
CrackScale crack_scale(const Model& model, const State& state);

/// Earliest crack that became macroscopic, of faces in the order of their times.
std::optional<MacroscopicCrack> find_macroscopic_crack(const std::vector<CrackFace>& cracks, const CrackScale& scale);

/// Looks at the cracks now and then during a run, so that points are those where faces broke and not where they lie at
/// the end.
class CrackWatch {
public:
    CrackWatch() = default;
    explicit CrackWatch(const CrackScale& scale) : scale_(scale) {}
    /// To be called after faces have broken. Cheap once both are known.
    void look(const Model& model, const State& state);

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [scale, first, macroscopic] = *this;
        visit("scale", scale);
        visit("first", first);
        visit("macroscopic", macroscopic);
    }

    const CrackScale& scale() const { return scale_; }
    const std::optional<CrackStart>& first() const { return first_; }
    const std::optional<MacroscopicCrack>& macroscopic() const { return macroscopic_; }

private:
    CrackScale scale_;
    std::optional<CrackStart> first_;
    std::optional<MacroscopicCrack> macroscopic_;
};

}  // namespace grainfrac
