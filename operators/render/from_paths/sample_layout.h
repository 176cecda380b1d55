// The number of samples of each pixel in a replicate, and the numbers of the paths of a replicate: pixel by pixel.
// Usually all pixels have the same number; an allocation (allocation.h) gives some 2^k times as many.
#pragma once

#include "core/sampling/sobol_points.h"
#include "operators/statistics/sample_place.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace neumann {

struct Allocation {
    virtual ~Allocation() = default;  // a method may distribute the parts of its samples, too

    static constexpr std::int8_t none = -128;  // exponent of a pixel without samples
    std::vector<std::int8_t> exponents = {};   // k of all pixels of the crop, row by row
    std::uint64_t rays = 0;                    // cast to find the exponents

    Allocation() = default;
    explicit Allocation(std::vector<std::int8_t> exponents, std::uint64_t rays = 0) : exponents(std::move(exponents)), rays(rays) {}

    // `size` · 2^k, at least 1; 0 for none.
    static std::uint32_t size_of(std::uint32_t size, std::int8_t exponent) {
        if (exponent == none) return 0;
        return exponent >= 0 ? size << exponent : std::max(size >> -exponent, 1u);
    }
    static double times(std::int8_t exponent) { return exponent == none ? 0.0 : std::ldexp(1.0, exponent); }
};

// Consecutive pixels with equally many samples, whose paths advance together.
struct PixelGroup {
    std::uint32_t begin, end, size;
    std::uint32_t paths() const { return (end - begin) * size; }
};

// The place of a sample: the first path of its group, and its index there.
struct PlaceInGroup {
    std::uint64_t replicate;
    std::uint32_t first, path;
};

class SampleLayout {
public:
    // `size`: samples of a pixel; a power of two. `allocation`: null if all pixels have equally many samples.
    // `together`: the least number of pixels of a group, if there is no allocation.
    SampleLayout(std::uint32_t pixels, std::uint32_t size, std::shared_ptr<const Allocation> allocation = {},
                 std::uint32_t together = 1);

    std::uint32_t size(std::uint32_t pixel) const;
    std::vector<std::uint32_t> sizes() const;  // of all pixels, if they differ
    std::uint32_t pixels() const { return pixels_; }
    std::uint32_t paths() const;
    std::uint32_t first_path(std::uint32_t pixel) const;
    std::uint32_t pixel_of(std::uint32_t path) const;

    // The number of groups; together they have all pixels that have samples.
    std::uint32_t groups() const;
    PixelGroup group(std::uint32_t number) const;
    // The number of the group that contains this pixel, which must have samples.
    std::uint32_t group_of(std::uint32_t pixel) const;
    PixelGroup group_with(std::uint32_t path) const { return group(group_of(pixel_of(path))); }

    SampleName name(std::uint64_t replicate, std::uint32_t path) const;
    PlaceInGroup place(const SampleName& name) const;

    // The Sobol' points for a pixel with this many samples.
    const SobolPoints& net(std::uint32_t size) const;

private:
    std::uint32_t pixels_, size_, pixels_of_group_;
    std::shared_ptr<const Allocation> allocation_;
    std::vector<std::uint32_t> first_path_;  // for each pixel, and last the number of paths
    std::vector<PixelGroup> groups_;
    std::vector<SobolPoints> nets_;  // for 1, 2, 4, … points if there is an allocation; otherwise for `size`
};

}  // namespace neumann
