// Pictures of all bounces from the series on a patch space. Everything is done several times with other random numbers, and the
// spread is the standard error. What the patches get wrong it does not show: the same pictures are also read from patches four
// times as large, and the difference tells the discretisation error.
#pragma once

#include "core/base/large_array.h"
#include "core/base/memory.h"
#include "core/image/image.h"
#include "operators/patches/patches.h"
#include "operators/pictures/energy_balance.h"
#include "operators/pictures/field_reader.h"
#include "operators/pictures/ray_resolution.h"
#include "operators/statistics/picture_statistics.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace neumann {

struct FieldSettings {
    FieldMethod method = FieldMethod::matrix;
    int bounces = 8;
    Patching patching;
    std::uint32_t rays = 32;           // of T, a facet, in one replicate; a power of two
    std::uint32_t light_samples = 16;  // of a facet, in one replicate, for b; a power of two
    std::uint32_t samples = 2;         // of the camera, a pixel, in one replicate; a power of two. As many again make We
    std::uint32_t gather_rays = 4;     // a camera sample; a power of two
    std::uint32_t replicates = 4;
    std::uint64_t seed = 0;
    bool rest = true;                  // Σ_{k>N} is wanted as well
    double memory = default_memory();  // bytes that may be taken, about
};

// What all replicates found in each pixel, from which the pictures are made as they are asked for.
class FieldPictures {
public:
    FieldPictures(const Film& film, const FieldSettings& settings);

    std::size_t bounces() const { return quantities_ - 2; }  // N
    // K^i Le, and Σ_{k≤i} K^k Le, 0 … N; and Σ_{k>N} K^k Le.
    Estimate term(std::size_t i) const { return picture(i, i); }
    Estimate sum(std::size_t i) const { return picture(0, i); }
    Estimate rest() const { return picture(quantities_ - 1, quantities_ - 1); }
    // The mean of term(i) alone, in floats.
    Image term_mean(std::size_t i) const;

    // Over pixels and channels. All pixels share the fields, so their errors go together; these are from whole replicates.
    MeanWithError mean_of_term(std::size_t i) const { return mean(i, i); }
    MeanWithError mean_of_sum(std::size_t i) const { return mean(0, i); }
    MeanWithError mean_of_rest() const { return mean(quantities_ - 1, quantities_ - 1); }
    PictureMeans means_of_term(std::size_t i) const { return means(i, i); }
    PictureMeans means_of_sum(std::size_t i) const { return means(0, i); }
    PictureMeans means_of_rest() const { return means(quantities_ - 1, quantities_ - 1); }
    // Of one replicate and quantity: over pixels in red, green and blue, and over channels as well.
    double replicate_mean(std::uint32_t replicate, std::size_t quantity, std::size_t which = sums_of_quantity - 1) const {
        return sums[(replicate * quantities_ + quantity) * sums_of_quantity + which] / (static_cast<double>(width_) * height_);
    }

    EnergyBalance power;  // of light, W: what patches exchange, replicates being the observations; without bounces for importance
    bool importance;      // of K*^i We in place of K^i Le, m⁻²·sr⁻¹
    bool rest_converges = false;
    std::vector<std::uint64_t> rays;  // cast for each bounce and the rest; those for all of them are counted for bounce 2, or the
                                      // rest where there is none
    std::size_t patches = 0, unknowns = 0;
    std::map<std::uint32_t, std::size_t> sides;  // of patches, by how many cells of directions they have
    std::uint64_t samples = 0;                   // a pixel, of the camera
    double field_seconds = 0.0, picture_seconds = 0.0;

    // For whoever fills them in: a pixel's values, three floats for each quantity, replicate by replicate, and after them the mean
    // difference to those from coarser patches.
    float* values(std::size_t pixel) { return values_.get() + pixel * stride_; }
    // Once those of pixels [begin, end) are there.
    void find_means(std::size_t begin, std::size_t end);
    std::size_t quantities() const { return quantities_; }
    // No error is stated below what these rays can tell.
    void set_resolution(RayResolution resolution) { resolution_ = std::move(resolution); }
    // Sums over all pixels, replicate by replicate and quantity by quantity: of red, green, blue, and of their mean.
    static constexpr std::size_t sums_of_quantity = 4;
    std::vector<double> sums;

private:
    Estimate picture(std::size_t first, std::size_t last) const;
    MeanWithError mean(std::size_t first, std::size_t last, std::size_t which = sums_of_quantity - 1) const;
    PictureMeans means(std::size_t first, std::size_t last) const;

    int width_, height_;
    std::uint32_t replicates_;
    std::size_t quantities_, stride_;
    LargeArray<float> values_;
    LargeArray<float> means_;  // of the replicates, a picture for each quantity
    RayResolution resolution_;
};

// Nothing where `stop` answers true meanwhile; asked from any thread.
std::optional<FieldPictures> render_fields(
    const Scene& scene, const FieldSettings& settings, const std::function<bool()>& stop = [] { return false; });

// The error of a whole picture, relative as relative_standard_error(): of the samples, of the patches, and of both. Rays make the
// finer and the coarser fields differ, too: that much is not the patches'.
struct PictureError {
    double sampling = 0.0, discretisation = 0.0;
    double all() const { return std::hypot(sampling, discretisation); }
};
PictureError picture_error(const Estimate& picture);

}  // namespace neumann
