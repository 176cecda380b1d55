// The pixels of a picture from fields, read in groups: all samples of all replicates of a few of them.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/fields/matrix/traced_series.h"
#include "operators/render/from_fields/field_pictures.h"
#include "operators/render/from_fields/field_reader.h"
#include "operators/render/from_fields/link_fields.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

class FieldPixels {
public:
    struct Workspace {
        // One sampler per sample that is read at once, one gather sampler per pixel.
        std::vector<Sampler> samplers, gather_samplers;
        std::vector<PixelSample> samples;
        // Pixel by pixel, for `values` also replicate by replicate, then quantity by quantity.
        std::vector<double> values, difference;
    };

    // Keeps references to both arguments.
    FieldPixels(const Scene& scene, const FieldSettings& settings);

    std::uint32_t pixels() const { return pixels_; }
    std::uint32_t group() const { return group_; }  // pixels of one group
    std::uint32_t groups() const { return (pixels_ + group_ - 1) / group_; }
    // The index of a group's first value in FieldPictures; for groups() the end.
    std::size_t first_value(std::uint32_t group) const {
        return std::min(std::size_t{group} * group_, std::size_t{pixels_}) * stride_ * (settings_.replicates + std::size_t{1});
    }
    // Adds the light read from the fields to the values of a group if they hold light by links already, and otherwise
    // sets them. Returns the rays cast.
    RaysByBounce read(std::uint32_t group, std::span<const TracedSeries> series, std::span<const LinkFields> by_links,
                      FieldPictures& pictures, Workspace& work) const;

private:
    const Scene& scene_;
    const FieldSettings& settings_;
    std::uint32_t width_, pixels_, group_;
    std::size_t stride_;  // number of floats of a replicate
    SobolPoints sobol_, gather_sobol_;
    std::uint32_t compared_;  // number of a replicate's samples that are also read from coarser patches
    FieldReader reader_;
};

}  // namespace neumann
