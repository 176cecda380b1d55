#include "operators/fields/matrix/reflection_block.h"

#include "core/sampling/sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace neumann {

namespace {

constexpr std::uint32_t samples_of_row = 4096;

using Index = Eigen::Index;

}  // namespace

// Minimises ½ dᵀ A d − row_sumsᵀ log d, which is convex in log d and whose gradient vanishes at the solution. Newton's
// method follows a few sweeps, because the sweeps are slow for glass.
void scale_symmetrically(ReflectionBlock::Matrix& A, const Eigen::VectorXd& row_sums) {
    constexpr int most_sweeps = 100, most_steps = 40;
    const Index n = A.rows();
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, row_sums.maxCoeff());
    Eigen::VectorXd d = Eigen::VectorXd::Ones(n), sums = A * d;
    const auto error = [&] { return (sums - row_sums).cwiseAbs().maxCoeff(); };
    for (int sweep = 0; sweep < most_sweeps && error() > rounding; ++sweep) {
        d = (sums.array() > 0.0).select(d.array() * (row_sums.array() / sums.array()).sqrt(), 0.0).matrix();
        sums = d.cwiseProduct(A * d);
    }
    for (int step = 0; step < most_steps && error() > rounding; ++step) {
        Eigen::MatrixXd hessian = d.asDiagonal() * A * d.asDiagonal();
        // If the cells form two parts that exchange light only with each other, log d is determined up to a constant.
        hessian.diagonal() += sums + Eigen::VectorXd::Constant(n, 1e-9);
        const Eigen::VectorXd change = hessian.ldlt().solve(row_sums - sums).cwiseMax(-1.0).cwiseMin(1.0);
        const Eigen::VectorXd next = d.cwiseProduct(change.array().exp().matrix()), next_sums = next.cwiseProduct(A * next);
        if (!((next_sums - row_sums).norm() < (sums - row_sums).norm())) break;
        d = next;
        sums = next_sums;
    }
    A = d.asDiagonal() * A * d.asDiagonal();
}

ReflectionBlock::ReflectionBlock(DirectionCells cells) : matrices_(1, Matrix(cells.size(), cells.size())) {
    matrices_[0].setIdentity();
}

ReflectionBlock::ReflectionBlock(const Bsdf& bsdf, DirectionCells cells) {
    const Side side{white(bsdf), cells, 0, 1.0};
    build(std::span(&side, 1));
}

ReflectionBlock::ReflectionBlock(const Bsdf& front, DirectionCells front_cells, const Bsdf& back, DirectionCells back_cells) {
    const std::array<Side, 2> sides{
        {{white(front), front_cells, 0, 1.0}, {white(back), back_cells, front_cells.size(), refractive_ratio(front)}}};
    build(sides);
}

// Estimates row i with ωo sampled in cell i and ωi sampled from the BSDF.
std::vector<std::vector<Rgb>> ReflectionBlock::sampled_rows(std::span<const Side> sides) {
    const std::uint32_t n = sides.back().first + sides.back().cells.size();
    const SobolPoints points(samples_of_row);
    std::vector<std::vector<Rgb>> rows(n, std::vector<Rgb>(n, Rgb(0.0)));
    oneapi::tbb::parallel_for(std::uint32_t{0}, n, [&](std::uint32_t i) {
        const Side &here = i < sides.back().first ? sides.front() : sides.back(),
                   &there = &here == &sides.front() ? sides.back() : sides.front();
        const double basic = there.index * there.index / (here.index * here.index);
        Sampler sampler(points, 0, i);
        for (std::uint32_t sample = 0; sample < points.size(); ++sample) {
            sampler.start(sample);
            const Vec3 wo = here.cells.direction(i - here.first, sampler.next2());
            const BsdfSample s = neumann::sample(here.bsdf, {}, wo, sampler.next2());
            if (!(s.pdf > 0.0)) continue;
            const Rgb weight = s.weight / static_cast<double>(points.size());
            if (s.wi.z > 0.0)
                rows[i][here.first + here.cells.cell(s.wi)] += weight;
            else if (s.wi.z < 0.0 && sides.size() == 2)
                rows[i][there.first + there.cells.cell({s.wi.x, -s.wi.y, -s.wi.z})] += weight * basic;  // in Frame(−n)
        }
    });
    return rows;
}

void ReflectionBlock::build(std::span<const Side> sides) {
    const auto rows = sampled_rows(sides);
    const auto n = static_cast<Index>(rows.size());
    Eigen::VectorXd etendue(n);
    std::vector<std::uint32_t> mirrored;
    for (const Side& side : sides) {
        etendue.segment(side.first, side.cells.size()).setConstant(side.index * side.index / side.cells.size());
        for (std::uint32_t cell = 0; cell < side.cells.size(); ++cell) mirrored.push_back(side.first + side.cells.mirrored(cell));
    }
    etendue /= etendue[0];
    const bool grey = std::all_of(sides.begin(), sides.end(), [](const Side& side) { return is_grey(side.bsdf); });
    for (int c = 0; c < (grey ? 1 : 3); ++c) {
        Eigen::VectorXd albedo = Eigen::VectorXd::Zero(n);
        std::vector<Eigen::Triplet<double>> entries;
        for (std::uint32_t i = 0; i < rows.size(); ++i)
            for (std::uint32_t j = 0; j < rows.size(); ++j) {
                albedo[i] += 0.5 * rows[i][j][c];
                // An isotropic material has the same albedo after half a turn about the normal.
                albedo[mirrored[i]] += 0.5 * rows[i][j][c];
                const double mean = 0.5 * (etendue[i] * rows[i][j][c] + etendue[j] * rows[j][i][c]);
                if (mean > 0.0) entries.emplace_back(static_cast<int>(i), static_cast<int>(j), mean);
            }
        // A mean albedo must not exceed the largest albedo, as a sampled one may.
        for (const Side& side : sides) {
            auto of_side = albedo.segment(side.first, side.cells.size()).array();
            of_side = of_side.min(largest_basic_albedo(side.bsdf)[c]);
        }
        Matrix& B = matrices_.emplace_back(n, n);
        B.setFromTriplets(entries.begin(), entries.end());
        scale_symmetrically(B, etendue.cwiseProduct(albedo));
        B = etendue.cwiseInverse().asDiagonal() * B;
    }
}

}  // namespace neumann
