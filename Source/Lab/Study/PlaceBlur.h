// SPDX-License-Identifier: MIT
// A model of where phantoms are felt: the place, blurred by a normal distribution, answered with the nearest
// point.
#pragma once
#include "Lab/Study/PhantomGrid.h"
#include <span>

namespace physvib {

/// What the model says of a square grid on the corners.
struct BlurredGrid {
    double shareExact = 0.0;      ///< of right answers
    double shareTolerance1 = 0.0; ///< of answers at most one step off (Manhattan)
    double bits = 0.0;            ///< information transfer, exact
    double bitsTolerance1 = 0.0;  ///< the same with an answer at most one step off counted as right
};

/// `blur`: standard deviation in x and y, as a share of the field's width and height, > 0. Any thread
/// (allocates).
BlurredGrid blurredGrid(int lines, double blur);

/// A measured share of exact answers on a grid of lines x lines.
struct ExactShare {
    int lines = 0;
    double share = 0.0;
};

/// The blur whose exact shares come nearest to the measured ones (least squares), within a ten-thousandth of
/// the field. Any thread (allocates).
double fitPlaceBlur(std::span<const ExactShare> measured);

} // namespace physvib
