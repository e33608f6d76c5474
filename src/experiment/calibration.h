// SPDX-License-Identifier: GPL-3.0-or-later
// Bond stiffnesses and strength that give a part a wanted modulus, Poisson ratio and tensile strength, found by pulling
// samples of its packing (docs/theory/calibration.md).
#pragma once

#include "experiment/experiment.h"
#include "experiment/lattice_stiffness.h"
#include "model/case.h"

#include <functional>
#include <optional>
#include <vector>

namespace grainfrac {

/// What a trial sets: stiffness per area of all bonds, and k_s/k_n.
struct BondConstants {
    double normal_stiffness = 0.0;  ///< [Pa/m]
    double shear_ratio = 0.0;       ///< [-]
};

/// What a sample says when it is pulled.
struct Response {
    double young_modulus = 0.0;  ///< [Pa]
    double poisson_ratio = 0.0;  ///< of a chain 0 [-]
    double residual = 0.0;       ///< of the relaxation [-]
    int steps = 0;               ///< of the relaxation
    bool at_rest = false;
};

struct Trial {
    BondConstants bonds;
    Response response;
};

struct ElasticTarget {
    double young_modulus = 0.0;           ///< [Pa]
    std::optional<double> poisson_ratio;  ///< none: the shear ratio stays as it is [-]
    double tolerance = 0.005;             ///< of the modulus; of the Poisson ratio, over it or a tenth [-]
    int most_trials = 8;
    Packing packing = Packing::random;  ///< its closed form tells how the response follows the constants
};

/// Trials from a start until the last one meets the target or most_trials are done. The closed form of the packing is
/// corrected by what a trial differs from it, by the line through the last two where they are near each other. Throws
/// InputError with key "poisson_ratio" where no shear ratio reaches it.
std::vector<Trial> find_bond_constants(const ElasticTarget& target, const BondConstants& start,
                                       const std::function<Response(const BondConstants&)>& pull);
bool meets(const ElasticTarget& target, const Response& response);

/// How the sample of one [[calibration]] is made, pulled and measured.
class CalibrationSample {
public:
    /// Throws InputError with full keys: a part that there is not, no bond that joins it, a sample too thin.
    CalibrationSample(const Case& c, std::size_t calibration, Device device);

    ElasticTarget target() const;
    /// What the trials begin with: given by the input or from the closed form.
    BondConstants start() const;
    /// Elastic tension test.
    Response pull(const BondConstants& bonds) const;
    /// Peak of the nominal stress when pulled until it breaks, with the strengths of the input [Pa].
    double strength(const BondConstants& bonds) const;

    int bond_entry() const { return entry_; }  ///< of [[bonds]]
    int bodies() const { return bodies_; }
    int bonds() const { return bonds_; }
    double area() const { return area_; }  ///< section that the modulus is over; 0: of the core [m^2]

private:
    Built built(const BondConstants& bonds, bool breaks = false) const;

    const CalibrationSpec spec_;
    Case case_;  // of the sample alone
    std::string key_;
    Device device_;
    std::size_t part_ = 0;
    int entry_ = -1, axis_ = 2, bodies_ = 0, bonds_ = 0;
    Packing packing_ = Packing::random;
    bool core_ = true;
    double area_ = 0.0;       // [m^2]
    double density_ = 0.0;    // of the closed form, for k_n per area instead of K_n
    double thickness_ = 0.0;  // of grains in one plane [m]
    double spacing_ = 0.0;    // of a chain, else 0 [m]
};

}  // namespace grainfrac
