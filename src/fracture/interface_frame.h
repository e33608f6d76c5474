// SPDX-License-Identifier: GPL-3.0-or-later
// Jump of an interface in its own frame: mean normal, mean first tangent, second tangent. Using the mean of both faces
// makes the law the same whichever body is called a.
#pragma once

#include "fracture/interface_law.h"
#include "geometry/quat.h"

namespace grainfrac {

struct InterfaceFrame {
    Mat3 rotation_a, rotation_b;
    Vec3 between;  ///< c_b - c_a [m]
    Vec3 n, t1, t2;

    GF_FN InterfaceFrame(const Quat& orientation_a, const Quat& orientation_b, const Vec3& centers_apart,
                         const Vec3& normal_a, const Vec3& normal_b, const Vec3& tangent_a, const Vec3& tangent_b)
        : rotation_a(to_matrix(orientation_a)), rotation_b(to_matrix(orientation_b)), between(centers_apart)
    {
        n = normalized(rotation_a * normal_a + rotation_b * normal_b);
        t1 = normalized(tangential(rotation_a * tangent_a + rotation_b * tangent_b, n));
        t2 = cross(n, t1);
    }
    GF_FN InterfaceJump in_frame(const Vec3& jump) const { return {dot(jump, n), dot(jump, t1), dot(jump, t2)}; }
};

}  // namespace grainfrac
