// SPDX-License-Identifier: MIT
// Nonlinear least squares in small steps, damped (Levenberg 1944, Marquardt 1963): what fits to samples
// share.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// J^T J and J^T r of a model's derivatives J and the residual r. M only (allocates).
class NormalEquations {
public:
    static constexpr std::size_t block = 256; ///< rows at a time, so that products run over neighbours
    using Column = std::array<double, block>;

    explicit NormalEquations(std::size_t size);

    /// Adds as many rows as `rest` has, at most `block`: the residual there, and the derivative by each
    /// number.
    void add(const std::vector<Column>& columns, std::span<const double> rest);

    /// The step under a damping of `lambda`; empty if the equations do not tell one.
    std::vector<double> step(double lambda) const;

    /// Only the numbers `first`, `first + stride`, ...: of a model in which those are linear.
    NormalEquations each(std::size_t first, std::size_t stride, std::size_t width) const;

    /// Standard error of a number under white noise of `variance` (Cramer-Rao bound); infinite if nothing
    /// tells it.
    double errorOf(std::size_t number, double variance) const;

    std::size_t size() const noexcept { return right_.size(); }

private:
    std::vector<double> matrix_, right_; // by rows; the lower triangle counts
};

/// Moves `model` downhill until nothing is gained; false if it never moved. `energyOf(model)` is what falls,
/// `equationsOf(model)` its NormalEquations, `moved(model, step)` a model beside it.
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
