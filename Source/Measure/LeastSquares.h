// SPDX-License-Identifier: MIT
// Damped nonlinear least squares (Levenberg 1944, Marquardt 1963), shared by the fits to samples.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// J^T J and J^T r of a model's derivatives J and the residual r. Message thread (M) only (allocates).
class NormalEquations {
public:
    static constexpr std::size_t block = 256; ///< rows per call, contiguous in memory for fast products
    using Column = std::array<double, block>;

    explicit NormalEquations(std::size_t size);

    /// Adds as many rows as `rest` has, at most `block`: the residual, and its derivative by each parameter.
    void add(const std::vector<Column>& columns, std::span<const double> rest);

    /// The step with damping `lambda`; empty if the equations are singular.
    std::vector<double> step(double lambda) const;

    /// The equations of only the parameters `first`, `first + stride`, ... (`width` of each): those in which
    /// the model is linear.
    NormalEquations each(std::size_t first, std::size_t stride, std::size_t width) const;

    /// Standard error of a parameter under white noise of `variance` (Cramer-Rao bound); infinite if it is
    /// undetermined.
    double errorOf(std::size_t number, double variance) const;

    std::size_t size() const noexcept { return right_.size(); }

private:
    std::vector<double> matrix_, right_; // row by row; only the lower triangle is used
};

/// Improves `model` until the energy no longer falls; false if no step lowered it. `energyOf(model)` is
/// minimised, `equationsOf(model)` returns its NormalEquations, `moved(model, step)` the model after a step.
template <class Model, class Energy, class Equations, class Move>
bool descend(Model& model, Energy energyOf, Equations equationsOf, Move moved) {
    constexpr int mostSteps = 40;
    constexpr double enough = 1e-12; // relative gain of a step that ends the search
    double energy = energyOf(model), lambda = 1e-3;
    NormalEquations equations = equationsOf(model);
    bool hasMoved = false;
    for (int i = 0; i < mostSteps && lambda < 1e9; ++i) {
        const std::vector<double> step = equations.step(lambda);
        Model trial = step.empty() ? model : moved(model, step);
        const double found = step.empty() ? energy : energyOf(trial);
        if (!(found < energy)) {
            lambda *= 10.0;
            continue;
        }
        const bool isEnough = energy - found < enough * energy;
        model = std::move(trial);
        energy = found;
        hasMoved = true;
        if (isEnough) break;
        lambda *= 0.1;
        equations = equationsOf(model);
    }
    return hasMoved;
}

} // namespace physvib
