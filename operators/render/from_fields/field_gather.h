// Gather rays apply K once more at a pixel: to the fields that a ray finds on patches, directly or by mirrors and glass.
#pragma once

#include "operators/fields/matrix/field_stack.h"
#include "operators/render/from_fields/link_fields.h"
#include "operators/render/from_fields/pixel_lights.h"

#include <span>
#include <vector>

namespace neumann {

// One replicate of a series, on patches and on patches of four times the area.
struct FieldPair {
    const FieldStack &fine, &coarse;
    const LinkFields* by_links = nullptr;
};

class FieldGather {
public:
    // `rays`: gather rays per sample. `stride`: the floats of a pixel, as in FieldStack. Bounces that end before the
    // float `from_field` are found without fields.
    FieldGather(const Scene& scene, const PixelLights& lights, std::size_t stride, std::size_t from_field, std::uint32_t rays);

    // Adds the bounces from `from_field` on, and the rest, to the samples. Returns the number of rays cast.
    std::uint64_t add(const FieldPair& fields, std::span<const PixelRay> seen) const;

private:
    std::uint64_t sample_lights_at_links(std::span<PixelRay> seen, const FieldPair& fields) const;
    void choose_directions(std::vector<PixelRay>& seen, std::uint32_t ray) const;
    void read_or_go_on(PixelRay& l, const FieldPair& fields, bool compares, std::vector<double>& arriving) const;
    void arrive(const FieldStack& field, const PixelRay& l, const Patches::ChartPosition& place, const FieldStack* replaced,
                std::span<const float> by_links, std::vector<double>& arriving) const;

    const Scene& scene_;
    const PixelLights& lights_;
    std::size_t stride_, from_field_;
    std::uint32_t rays_, compared_;  // the first `compared_` rays also read the coarser patches
};

}  // namespace neumann
