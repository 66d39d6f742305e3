// SPDX-License-Identifier: MIT
// Matrix products and Cholesky decomposition of the normal equations, by Eigen.
#include "Measure/LeastSquares.h"
#include <Eigen/Cholesky>
#include <cmath>

namespace physvib {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Rows = Eigen::Map<const Eigen::MatrixXd, Eigen::Unaligned, Eigen::OuterStride<>>;

/// Solves a x = b from the lower triangle of `a`; false if it is not positive definite.
bool solve(const Matrix& a, Eigen::Ref<Eigen::VectorXd> b) {
    const Eigen::LLT<Matrix> decomposed(a);
    if (decomposed.info() != Eigen::Success) return false;
    decomposed.solveInPlace(b);
    return true;
}

Eigen::Index index(std::size_t i) noexcept { return static_cast<Eigen::Index>(i); }

Matrix square(const std::vector<double>& byRows, std::size_t size) {
    return Eigen::Map<const Matrix>(byRows.data(), index(size), index(size));
}
Eigen::Map<Eigen::VectorXd> vectorOf(std::vector<double>& numbers) {
    return {numbers.data(), index(numbers.size())};
}

} // namespace

NormalEquations::NormalEquations(std::size_t size)
    : matrix_(size * size)
    , right_(size) {}

void NormalEquations::add(const std::vector<Column>& columns, std::span<const double> rest) {
    const Rows derivatives(columns.front().data(), index(rest.size()), index(size()),
                           Eigen::OuterStride<>(index(block)));
    Eigen::Map<Matrix> matrix(matrix_.data(), index(size()), index(size()));
    matrix.triangularView<Eigen::Lower>() += derivatives.transpose() * derivatives;
    vectorOf(right_) +=
        derivatives.transpose() * Eigen::Map<const Eigen::VectorXd>(rest.data(), index(rest.size()));
}

std::vector<double> NormalEquations::step(double lambda) const {
    Matrix damped = square(matrix_, size());
    damped.diagonal() *= 1.0 + lambda;
    std::vector<double> b = right_;
    return solve(damped, vectorOf(b)) ? b : std::vector<double>{};
}

NormalEquations NormalEquations::each(std::size_t first, std::size_t stride, std::size_t width) const {
    std::vector<std::size_t> kept;
    for (std::size_t at = first; at < size(); at += stride)
        for (std::size_t i = 0; i < width; ++i) kept.push_back(at + i);
    NormalEquations part(kept.size());
    for (std::size_t a = 0; a < kept.size(); ++a) {
        for (std::size_t b = 0; b <= a; ++b)
            part.matrix_[a * kept.size() + b] = matrix_[kept[a] * size() + kept[b]];
        part.right_[a] = right_[kept[a]];
    }
    return part;
}

double NormalEquations::errorOf(std::size_t number, double variance) const {
    std::vector<double> unit(size());
    unit[number] = 1.0;
    return solve(square(matrix_, size()), vectorOf(unit)) ? std::sqrt(variance * unit[number]) : HUGE_VAL;
}

} // namespace physvib
