#include "operators/matrix/reflection_block.h"

#include "core/sampling/sobol_sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <limits>

namespace neumann {

namespace {

constexpr std::uint32_t samples_of_row = 4096;

using Index = Eigen::Index;
using Rows = std::vector<std::vector<Rgb>>;

// Row i by drawing ωo in cell i and ωi from the material.
Rows sampled_rows(const Bsdf& bsdf, DirectionCells cells) {
    const SobolPoints points(samples_of_row);
    Rows rows(cells.size(), std::vector<Rgb>(cells.size(), Rgb(0.0)));
    oneapi::tbb::parallel_for(std::uint32_t{0}, cells.size(), [&](std::uint32_t i) {
        SobolSampler sampler(points, 0, i);
        for (std::uint32_t n = 0; n < points.size(); ++n) {
            sampler.start(n);
            const Vec3 wo = cells.direction(i, sampler.next2());
            const BsdfSample s = sample(bsdf, {}, wo, sampler.next2());
            if (s.pdf > 0.0 && s.wi.z > 0.0) rows[i][cells.cell(s.wi)] += s.weight / static_cast<double>(points.size());
        }
    });
    return rows;
}

}  // namespace

void scale_symmetrically(ReflectionBlock::Matrix& A, const Eigen::VectorXd& row_sums) {
    constexpr int most_sweeps = 10000;
    const Index n = A.rows();
    Eigen::VectorXd d = Eigen::VectorXd::Ones(n);
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const Eigen::ArrayXd sums = d.array() * (A * d).array();
        const double error = (sums - row_sums.array()).abs().maxCoeff();
        if (error <= 4.0 * std::numeric_limits<double>::epsilon()) break;
        d = (sums > 0.0).select(d.array() * (row_sums.array() / sums).sqrt(), 0.0).matrix();
    }
    A = d.asDiagonal() * A * d.asDiagonal();
}

ReflectionBlock::ReflectionBlock(DirectionCells cells) : matrices_(1, Matrix(cells.size(), cells.size())) {
    matrices_[0].setIdentity();
}

ReflectionBlock::ReflectionBlock(const Bsdf& bsdf, DirectionCells cells) {
    const Rows rows = sampled_rows(white(bsdf), cells);
    const auto n = static_cast<Index>(cells.size());
    for (int c = 0; c < (is_grey(white(bsdf)) ? 1 : 3); ++c) {
        Eigen::VectorXd albedo = Eigen::VectorXd::Zero(n);
        std::vector<Eigen::Triplet<double>> entries;
        for (std::uint32_t i = 0; i < cells.size(); ++i)
            for (std::uint32_t j = 0; j < cells.size(); ++j) {
                albedo[i] += 0.5 * rows[i][j][c];
                // A material that knows no direction but its normal has the same albedo half a turn further.
                albedo[cells.mirrored(i)] += 0.5 * rows[i][j][c];
                const double mean = 0.5 * (rows[i][j][c] + rows[j][i][c]);
                if (mean > 0.0) entries.emplace_back(static_cast<int>(i), static_cast<int>(j), mean);
            }
        Matrix& B = matrices_.emplace_back(n, n);
        B.setFromTriplets(entries.begin(), entries.end());
        scale_symmetrically(B, albedo);
    }
}

}  // namespace neumann
