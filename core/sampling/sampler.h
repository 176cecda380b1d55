// The random numbers of one sample of a pixel, in [0, 1), drawn dimension by dimension. Either they are independent, or points of
// Sobol's sequence in replicates: each run of `size` samples of a pixel is one scrambled net (sobol_points.h), and replicates and
// pixels are independent of each other. The mean of a replicate is therefore an unbiased estimate, and the spread of the
// replicates' means gives its error. Only the first four dimensions, which are the best, are used: each further four are the same
// points in another order (padding: Burley, Practical Hash-Based Owen Scrambling, 2020).
#pragma once

#include "core/base/vec.h"
#include "core/sampling/sobol_points.h"

#include <array>
#include <cstdint>
#include <memory>

namespace neumann {

enum class SamplerKind { independent, sobol };

// Copies share the scrambled points of their pixel, which are made for up to 64 samples at once: samplers of a pixel belong to one
// thread.
class Sampler {
public:
    // Makes independent numbers.
    Sampler(std::uint64_t seed, std::uint32_t pixel) : seed_(seed), pixel_(pixel) {}
    // Makes Sobol' points; keeps a reference to them.
    Sampler(const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel);
    Sampler(SamplerKind kind, const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel)
        : Sampler(kind == SamplerKind::sobol ? Sampler(points, seed, pixel) : Sampler(seed, pixel)) {}

    void start(std::uint64_t sample) {
        sample_ = sample;
        dimension_ = 0;
    }
    double next() {
        const std::uint32_t lane = dimension_ % SobolPoints::dimensions;
        if (lane == 0) start_group(dimension_ / SobolPoints::dimensions);
        ++dimension_;
        return bits_[lane] * 0x1p-32 + 0x1p-33;  // in (0, 1): the centres of 2^32 cells
    }
    Vec2 next2() {
        // Independent numbers of a pair come from the same group; a single number left over is skipped.
        if (!points_ && dimension_ % SobolPoints::dimensions == SobolPoints::dimensions - 1) ++dimension_;
        const double x = next();
        return {x, next()};
    }

private:
    struct Scrambled;
    void start_group(std::uint32_t group);

    const SobolPoints* points_ = nullptr;  // null: independent numbers
    std::shared_ptr<Scrambled> scrambled_;
    std::uint64_t seed_, sample_ = 0;
    std::uint32_t pixel_, dimension_ = 0;
    SobolPoints::Numbers bits_{};  // of the current group
};

}  // namespace neumann
