// Pictures of all bounces from the series on a patch space. Independent replicates give the standard error, which does
// not contain the discretisation error. Therefore the same pictures are also read from patches of four times the area,
// and the difference estimates the discretisation error.
#pragma once

#include "core/base/large_array.h"
#include "core/base/memory.h"
#include "core/image/image.h"
#include "operators/fields/patches/patches.h"
#include "operators/render/from_fields/field_reader.h"
#include "operators/render/from_fields/ray_resolution.h"
#include "operators/render/from_paths/energy_balance.h"
#include "operators/statistics/picture_statistics.h"
#include "operators/statistics/sample_ranges.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

struct FieldSettings {
    FieldReading reading = FieldReading::matrix;
    int bounces = 8;
    Patching patching;
    std::uint32_t rays = 32;           // rays of T per facet and replicate; a power of two
    std::uint32_t light_samples = 16;  // light samples for b per facet and replicate; a power of two
    std::uint32_t samples = 2;         // camera samples per pixel and replicate; a power of two. As many again estimate We
    std::uint32_t gather_rays = 4;     // per camera sample; a power of two
    std::uint32_t replicates = 4;
    std::uint64_t seed = 0;
    bool rest = true;                  // also compute Σ_{k>N} K^k Le
    double memory = default_memory();  // approximate limit in bytes
    bool operator==(const FieldSettings&) const = default;
};

// The values of all replicates in each pixel. Pictures are computed from them on demand.
class FieldPictures {
    static constexpr std::size_t sums_of_quantity = 4;

public:
    FieldPictures(const Film& film, const FieldSettings& settings);

    std::size_t bounces() const { return quantities_ - 2; }  // N
    // The pictures of K^i Le and Σ_{k≤i} K^k Le for i = 0 … N, and of Σ_{k>N} K^k Le.
    Estimate term(std::size_t i) const { return picture(i, i); }
    Estimate sum(std::size_t i) const { return picture(0, i); }
    Estimate rest() const { return picture(quantities_ - 1, quantities_ - 1); }
    // The mean of term(i) alone, in floats.
    Image term_mean(std::size_t i) const;

    // Means over pixels and channels. All pixels share the fields, so their errors are correlated; the standard errors
    // come from the spread of whole replicates.
    MeanWithError mean_of_term(std::size_t i) const { return mean(i, i); }
    MeanWithError mean_of_sum(std::size_t i) const { return mean(0, i); }
    MeanWithError mean_of_rest() const { return mean(quantities_ - 1, quantities_ - 1); }
    PictureMeans means_of_term(std::size_t i) const { return means(i, i); }
    PictureMeans means_of_sum(std::size_t i) const { return means(0, i); }
    PictureMeans means_of_rest() const { return means(quantities_ - 1, quantities_ - 1); }
    // The mean over pixels of one replicate and quantity. `which`: 0 … 2 red, green, blue; 3 the mean of the channels.
    double replicate_mean(std::uint32_t replicate, std::size_t quantity, std::size_t which = sums_of_quantity - 1) const {
        return sums_[(replicate * quantities_ + quantity) * sums_of_quantity + which] / (static_cast<double>(width_) * height_);
    }

    // Power of the light on the patches, W, with replicates as observations; it has no bounces for importance.
    EnergyBalance power;
    bool importance;  // the pictures show K*^i We, m⁻²·sr⁻¹, in place of K^i Le
    bool rest_converges = false;
    // Rays cast for each bounce and the rest. Rays for all of them are counted for bounce 2, or for the rest if N < 2.
    std::vector<std::uint64_t> rays;
    std::size_t patches = 0, unknowns = 0;
    bool has_links = false;                      // whether rays of T may go on by links
    std::map<std::uint32_t, std::size_t> sides;  // number of sides of patches by their number of cells of directions
    std::uint64_t samples = 0;                   // camera samples per pixel
    double field_seconds = 0.0, picture_seconds = 0.0;

    // The place of a pixel's values, for the code that fills them in: three floats per quantity, replicate by
    // replicate, and then the mean difference to the values from coarser patches.
    float* values(std::size_t pixel) { return values_.get() + pixel * stride_; }
    // Sets the values of a replicate, all quantities of each pixel.
    void set_replicate(std::uint32_t replicate, std::span<const Rgb> picture);
    // √(Σ SE² / Σ mean²) of a quantity over all pixels, from the values set so far.
    double relative_noise(std::size_t quantity) const;
    void set_to_zero(std::size_t quantity);
    // Sums over all pixels are added up from sums over groups of this many pixels. A group's sums are made when its
    // values are complete, in any order of groups, and added at the end.
    void add_by_groups(std::uint32_t pixels);
    void group_is_complete(std::size_t group);
    void add_groups();
    std::size_t quantities() const { return quantities_; }
    // Sets the resolution below whose error no standard error may fall (ray_resolution.h).
    void set_resolution(RayResolution resolution) { resolution_ = std::move(resolution); }

private:
    void find_means(std::size_t begin, std::size_t end);
    void find_differences();
    void raise_errors(const std::vector<SampleRange>& ranges, Estimate& picture) const;
    Estimate picture(std::size_t first, std::size_t last) const;
    MeanWithError mean(std::size_t first, std::size_t last, std::size_t which = sums_of_quantity - 1) const;
    PictureMeans means(std::size_t first, std::size_t last) const;

    int width_, height_;
    std::uint32_t replicates_, group_ = 1;
    std::size_t quantities_, stride_;
    LargeArray<float> values_;
    LargeArray<float> means_;  // means over the replicates, one picture per quantity
    // Sums over all pixels, replicate by replicate and quantity by quantity, of red, green, blue and their mean.
    std::vector<double> sums_, sums_of_groups_;
    // The largest minus the smallest value in the picture, three numbers per quantity.
    std::vector<double> differences_;
    RayResolution resolution_;
};

// The relative error of a whole picture (as relative_standard_error()) from sampling, from discretisation, and from both. Noise of
// the rays also makes the fine and the coarse fields differ; that part is subtracted from the discretisation error.
struct PictureError {
    double sampling = 0.0, discretisation = 0.0;
    double all() const { return std::hypot(sampling, discretisation); }
};
PictureError picture_error(const Estimate& picture);

// The estimated discretisation error.
struct DiscretisationReport {
    double mean = 0.0, worst = 0.0;  // of the error, over pixels and channels, radiance
    int worst_x = 0, worst_y = 0;    // the pixel of the film where the worst is
    double relative = 0.0;           // √(Σ error² / Σ mean²), with the part from noise subtracted
};
DiscretisationReport report_discretisation(const Film& film, const Estimate& picture, const PictureError& error);

}  // namespace neumann
