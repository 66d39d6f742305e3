// SPDX-License-Identifier: MIT
// Cholesky's decomposition solves what products have gathered.
#include "Measure/LeastSquares.h"
#include <cmath>

namespace physvib {
namespace {

/// False if `a` (n x n, by rows) is not positive. `b` becomes the solution.
bool solve(std::vector<double> a, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 0.0)) return false;
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
    return true;
}

} // namespace

NormalEquations::NormalEquations(std::size_t size)
    : matrix_(size * size)
    , right_(size) {}

void NormalEquations::add(const std::vector<Column>& columns, std::span<const double> rest) {
    for (std::size_t a = 0; a < size(); ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
            double sum = 0.0;
            for (std::size_t i = 0; i < rest.size(); ++i) sum += columns[a][i] * columns[b][i];
            matrix_[a * size() + b] += sum;
        }
        for (std::size_t i = 0; i < rest.size(); ++i) right_[a] += columns[a][i] * rest[i];
    }
}

std::vector<double> NormalEquations::step(double lambda) const {
    std::vector<double> damped = matrix_, b = right_;
    for (std::size_t i = 0; i < size(); ++i) damped[i * size() + i] *= 1.0 + lambda;
    return solve(std::move(damped), b) ? b : std::vector<double>{};
}

NormalEquations NormalEquations::each(std::size_t first, std::size_t stride, std::size_t width) const {
    std::vector<std::size_t> kept;
    for (std::size_t at = first; at < size(); at += stride)
        for (std::size_t i = 0; i < width; ++i) kept.push_back(at + i);
    NormalEquations part(kept.size());
    for (std::size_t a = 0; a < kept.size(); ++a) {
        for (std::size_t b = 0; b <= a; ++b) part.matrix_[a * kept.size() + b] = matrix_[kept[a] * size() + kept[b]];
        part.right_[a] = right_[kept[a]];
    }
    return part;
}

double NormalEquations::errorOf(std::size_t number, double variance) const {
    std::vector<double> unit(size());
    unit[number] = 1.0;
    return solve(matrix_, unit) ? std::sqrt(variance * unit[number]) : HUGE_VAL;
}

} // namespace physvib
