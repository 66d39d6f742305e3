// SPDX-License-Identifier: MIT
// A place on the response field of a study, as a share of its width and height.
#pragma once

namespace physvib {

/// A place on the response field: x to the right, y downwards, both from 0 to 1.
struct FieldPlace {
    double x = 0.0, y = 0.0;
    bool operator==(const FieldPlace&) const = default;
};

} // namespace physvib
