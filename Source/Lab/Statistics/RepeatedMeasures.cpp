// SPDX-License-Identifier: MIT
// Repeated-measures ANOVA by orthonormal contrasts.
// Steps: 1. Represent each effect by contrasts of the cells (Kronecker products over the factors). 2. Its
// error matrix is the scatter of the participants' residuals under these contrasts. 3. F compares the sum of
// squares of the group means with the trace of the error matrix. 4. The shape of the error matrix gives
// Mauchly's test and the corrections for sphericity.
#include "Lab/Statistics/RepeatedMeasures.h"
#include "Lab/Statistics/DesignEffects.h"
#include "Lab/Statistics/Distributions.h"
#include "Lab/Statistics/EffectIntervals.h"
#include "Lab/Statistics/Moments.h"
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using Matrix = Eigen::MatrixXd;

/// Contrast columns of a factor: each level against the mean of the previous ones (Helmert), or equal weights
/// if the effect does not include the factor.
Matrix factorContrasts(std::size_t levels, bool isInEffect) {
    const auto k = static_cast<Eigen::Index>(levels);
    if (!isInEffect) return Matrix::Constant(k, 1, 1.0 / std::sqrt(static_cast<double>(k)));
    Matrix contrasts = Matrix::Zero(k, k - 1);
    for (Eigen::Index c = 1; c < k; ++c) {
        const auto before = static_cast<double>(c);
        contrasts.col(c - 1).head(c).setConstant(-1.0 / std::sqrt(before * (before + 1.0)));
        contrasts(c, c - 1) = before / std::sqrt(before * (before + 1.0));
    }
    return contrasts;
}

Matrix kronecker(const Matrix& a, const Matrix& b) {
    Matrix product(a.rows() * b.rows(), a.cols() * b.cols());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        for (Eigen::Index j = 0; j < a.cols(); ++j)
            product.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
    return product;
}

Matrix contrastsOf(const Design& design, unsigned within) {
    Matrix contrasts = Matrix::Ones(1, 1);
    for (std::size_t i = 0; i < design.within.size(); ++i)
        contrasts = kronecker(contrasts, factorContrasts(design.within[i].levels.size(), within >> i & 1u));
    return contrasts;
}

/// Decomposes the values into group means and each participant's residuals.
struct Groups {
    Matrix means, left; ///< one row per group; one row per participant
    Eigen::VectorXd sizes;

    explicit Groups(const Design& design)
        : means{Matrix::Zero(static_cast<Eigen::Index>(design.groupCount()),
                             static_cast<Eigen::Index>(design.cells()))}
        , left{Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
              design.values.data(), static_cast<Eigen::Index>(design.participants.size()), means.cols())}
        , sizes{Eigen::VectorXd::Zero(means.rows())} {
        for (Eigen::Index p = 0; p < left.rows(); ++p) {
            means.row(groupOf(design, p)) += left.row(p);
            sizes(groupOf(design, p)) += 1.0;
        }
        means.array().colwise() /= sizes.array();
        for (Eigen::Index p = 0; p < left.rows(); ++p) left.row(p) -= means.row(groupOf(design, p));
    }
    double errorDf() const { return static_cast<double>(left.rows() - means.rows()); }

    /// Sum of squares of the hypothesis that the unweighted mean of the groups is 0, or that the groups do
    /// not differ.
    double hypothesisSquares(const Matrix& contrasts, bool isBetween) const {
        const Matrix z = means * contrasts;
        const auto count = static_cast<double>(z.rows());
        if (!isBetween) return z.colwise().mean().squaredNorm() * count * count / sizes.cwiseInverse().sum();
        const Eigen::RowVectorXd grand = sizes.transpose() * z / sizes.sum();
        return (sizes.asDiagonal() * (z.rowwise() - grand).cwiseAbs2()).sum();
    }

private:
    static Eigen::Index groupOf(const Design& design, Eigen::Index participant) {
        return static_cast<Eigen::Index>(design.groups[static_cast<std::size_t>(participant)]);
    }
};

/// True if differences between levels are constant over participants or linearly dependent, with the
/// tolerance of R's qr as used by car.
bool isSingular(const Matrix& error) {
    const Matrix triangle = error.householderQr().matrixQR();
    for (Eigen::Index i = 0; i < error.cols(); ++i)
        if (std::abs(triangle(i, i)) < 1e-7 * error.col(i).norm()) return true;
    return false;
}

/// Mauchly's test (1940), p by Box's second-order expansion. `shape`: the error matrix with a mean diagonal
/// of 1. `cells` replaces Box's p, as in R's mauchly.test and car, so that p agrees with them.
void addMauchly(const Matrix& shape, double df, double cells, Sphericity& sphericity) {
    const auto p = static_cast<double>(shape.rows());
    if (df < p || isSingular(shape)) return;
    const Eigen::LLT<Matrix> root{shape};
    if (root.info() != Eigen::Success) return;
    const double logW = 2.0 * root.matrixLLT().diagonal().array().log().sum();
    if (!std::isfinite(logW)) return;
    const double rho = 1.0 - (2.0 * p * p + p + 2.0) / (6.0 * p * df);
    const double second = (p + 2.0) * (p - 1.0) * (p - 2.0) *
                          (2.0 * p * p * p + 6.0 * p * p + 3.0 * cells + 2.0) /
                          (288.0 * df * p * rho * df * p * rho);
    const double z = std::max(0.0, -df * rho * logW), f = p * (p + 1.0) / 2.0 - 1.0;
    const double first = chiSquaredUpper(z, f);
    sphericity.mauchlyW = std::exp(std::min(0.0, logW));
    sphericity.mauchlyP = std::clamp(first + second * (chiSquaredUpper(z, f + 4.0) - first), 0.0, 1.0);
}

void addSphericity(const Matrix& error, double df, double cells, TestLine& line) {
    const auto p = static_cast<double>(error.rows());
    line.epsilon = 1.0;
    if (error.rows() < 2) return;
    const Matrix shape = error * (p / error.trace());
    const double epsilon = p / shape.squaredNorm();
    Sphericity sphericity;
    sphericity.epsilonHuynhFeldt = ((df + 1.0) * p * epsilon - 2.0) / (p * (df - p * epsilon));
    // with two participants the formula would divide by 0
    if (df - p * epsilon <= 1e-9 * df) sphericity.epsilonHuynhFeldt = 1.0;
    const double used = std::min(1.0, sphericity.epsilonHuynhFeldt);
    sphericity.pHuynhFeldt = fUpper(*line.statistic, used * *line.df1, used * *line.df2);
    line.epsilon = epsilon;
    line.pCorrected = fUpper(*line.statistic, epsilon * *line.df1, epsilon * *line.df2);
    addMauchly(shape, df, cells, sphericity);
    line.sphericity = sphericity;
}

/// Upper bound of a sum of squares that is rounding error only. The lower limit avoids an overflow in later
/// divisions.
double roundingOf(const std::vector<double>& values) {
    const double largest = largestMagnitude(values);
    return std::max(1e-200, 1e-28 * static_cast<double>(values.size()) * largest * largest);
}

std::string faultOf(const Design& design) {
    if (!design.fault.empty()) return design.fault;
    if (design.within.empty() && !design.between) return "expected a within-factor or a between-factor";
    if (design.participants.size() < 2)
        return "expected two or more participants, found only " + design.participants.front();
    if (design.participants.size() <= design.groupCount())
        return "column " + design.between->name +
               ": expected a group of two or more participants, found none";
    return {};
}

} // namespace

TestReport repeatedMeasures(const Design& design) {
    if (auto fault = faultOf(design); !fault.empty()) return {fault};
    TestReport report{{}, "F", "generalised eta squared", design.within.empty() ? "" : "Greenhouse-Geisser"};
    if (design.groupCount() > 1)
        report.notes.push_back("Type III sums of squares: groups of different sizes count alike");
    const Groups groups{design};
    const double df = groups.errorDf();
    const double nothing = roundingOf(design.values);
    double allErrors = 0.0;
    std::vector<double> squares;
    for (const DesignEffect& effect : effectsOf(design)) {
        const Matrix contrasts = contrastsOf(design, effect.within), scores = groups.left * contrasts,
                     error = scores.transpose() * scores;
        if (!effect.isBetween) allErrors += error.trace();     // once per set of contrasts
        if (effect.within == 0 && !effect.isBetween) continue; // the grand mean is not tested
        if (!(error.trace() > nothing))
            return {"effect " + effect.name(design) +
                    ": expected participants who differ in it, found none: nothing to compare it with"};
        TestLine line{effect.name(design), {}, {}, {}, {}, {}, {}, {}, design.participants.size()};
        const auto dimensions = static_cast<double>(contrasts.cols());
        squares.push_back(groups.hypothesisSquares(contrasts, effect.isBetween));
        line.df1 = dimensions * (effect.isBetween ? static_cast<double>(design.groupCount() - 1) : 1.0);
        line.df2 = dimensions * df;
        line.statistic = squares.back() / *line.df1 / (error.trace() / *line.df2);
        line.p = line.pCorrected = fUpper(*line.statistic, *line.df1, *line.df2);
        if (effect.within != 0) addSphericity(error, df, static_cast<double>(design.cells()), line);
        report.lines.push_back(std::move(line));
    }
    for (std::size_t i = 0; i < squares.size(); ++i) {
        TestLine& line = report.lines[i];
        line.effectSize = squares[i] / (squares[i] + allErrors);
        const double epsilon = line.sphericity ? *line.epsilon : 1.0;
        if (const auto bounds = noncentralityOfF(*line.statistic, epsilon * *line.df1, epsilon * *line.df2)) {
            const double unit = squares[i] / (*line.df1 * *line.statistic * epsilon); // squares per
                                                                                      // noncentrality
            const auto share = [&](double n) { return n * unit / (n * unit + allErrors); };
            line.effectInterval = {share(bounds->least), share(bounds->most)};
        }
    }
    return report;
}

} // namespace physvib
