// SPDX-License-Identifier: GPL-3.0-or-later
// A sample between two ends that are pulled apart evenly: its end layers move along the axis and are free across it, so
// that the stress is the same all along. Quasi-static; means over a window that leaves the softer surface out.
#pragma once

#include "model/model.h"
#include "model/state.h"
#include "motion/relax.h"

#include <optional>

namespace grainfrac {

/// Strain of the elastic tests: far below what turns or bends anything, far above round-off (1e-10 of the forces) [-].
inline constexpr double small_strain = 1e-6;

struct Range1D {
    double low = 0.0, high = 0.0;  ///< [m]
};
Range1D range_along(const State& state, int axis);

/// Smooth weight: 1 within, falling to 0 as cos^2 over the outermost spheres, so that it does not matter on which side
/// of an edge a sphere is.
class Window {
public:
    double weight(const Vec3& x) const;
    /// Integral of the weight [m^3].
    double volume() const;

private:
    friend std::optional<Window> core_window(const State&, int, double, double);
    struct Edge {
        double flat = 0.0, end = 0.0;  // from the middle [m]
        double at(double distance) const;
    };
    Vec3 middle_;
    int axis_ = 2;
    bool round_ = true;  // across the axis: a circle, else a rectangle
    Edge along_, across_[2];
    double thickness_ = 0.0;  // of what lies in one plane across z; 0: not so [m]
};

/// Without the outermost layer of about 1.5 `size`, and of all of it for size 0. Empty if nothing is left. `thickness`:
/// of grains that lie in one plane across z [m].
std::optional<Window> core_window(const State& state, int axis, double size, double thickness);

struct Strains {
    Vec3 normal;                     ///< along x, y, z [-]
    bool has_width[3] = {};          ///< else all bodies are in one layer across it
    double lateral(int axis) const;  ///< mean across the axis [-]
};

/// Young's modulus and Poisson ratio from means over a core. Across the axis its stress is not quite zero: the surface
/// contracts otherwise than the inside, which holds it. That is small, so it is taken out as of an isotropic solid.
struct CoreElasticity {
    double young_modulus, poisson_ratio;  ///< [Pa], [-]
};
CoreElasticity core_elasticity(const Vec3& stress, const Strains& strains, int axis);

class PulledSample {
public:
    /// Bodies within half a spacing of either end are the grips.
    PulledSample(Model& model, State& state, int axis);

    /// The ends at this strain, all in equilibrium; begins with the uniform strain of `poisson_ratio`. Bonds break
    /// where a `largest` force so far is given; it ends when the sample carries a good part less [N].
    Relaxed stretch_to(double strain, double poisson_ratio, double largest = -1.0);
    /// Pull of the grips [N].
    double force() const;
    double strain_of_ends() const;
    /// Normal stresses along x, y, z, means over the window [Pa]. `solid_fraction` of a packing where it is known: what
    /// the bodies in the window stand for is then exact; 0: not known.
    Vec3 mean_stress(const Window& window, double solid_fraction);
    /// Slopes of the displacements; without a window those of the whole.
    Strains strains(const Window* window) const;
    /// Pulled on until it carries less than a good part of what it did. Strengths and fracture energies are scaled so
    /// that the first bond breaks at small_strain, and the force back: all is linear [N].
    double largest_force();

private:
    void move_by(double axial, double lateral);
    double utilisation() const;

    Model& model_;
    State& state_;
    int axis_;
    double middle_ = 0.0, length_ = 0.0, strain_ = 0.0;  // [m], [m], [-]
    double poisson_ratio_ = 0.0;
    int walls_[2] = {-1, -1};  // top, bottom
};

}  // namespace grainfrac
