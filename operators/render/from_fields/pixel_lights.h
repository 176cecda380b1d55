// Samples direct light at the points that rays of pixels reach: by light samples (points on lights), and by directions
// from the BSDF that happen to hit a light.
#pragma once

#include "core/emitter/light_sampler.h"
#include "operators/render/from_fields/pixel_ray.h"

#include <span>

namespace neumann {

class PixelLights {
public:
    // Bounces beyond `last_bounce` are added to it.
    PixelLights(const Scene& scene, std::size_t last_bounce);

    bool empty() const { return lights_.empty(); }
    double pdf(const Vec3& x, const Vec3& w, const SurfacePoint& y) const { return lights_.pdf(x, w, y); }

    // Adds bounce 1 at points that pixels see, by one light sample each and, where directions from the BSDF are used as
    // well, by one of these. Returns the number of rays.
    std::uint64_t find(std::span<PixelRay> rays) const;
    // Adds direct light by light samples at links with directions other than those of mirrors and glass; the next ray
    // may hit it too.
    std::uint64_t find_at_links(std::span<PixelRay* const> rays) const;
    // The bounce of the light that a ray finds at its last vertex.
    std::size_t bounce_of(const PixelRay& l) const { return std::min<std::size_t>(l.links + 1, last_bounce_); }

private:
    std::uint64_t find_by_points(std::span<PixelRay> rays) const;
    std::uint64_t find_by_chance(std::span<PixelRay> rays) const;
    bool sample_light(PixelRay& l, Sampler& sampler, const Rgb& scale, bool with_directions) const;
    void add_visible(std::span<PixelRay* const> active) const;
    bool samples_directions(const PixelRay& l) const;

    const Scene& scene_;
    std::size_t last_bounce_;
    LightSampler lights_;
    Vec3 low_{0.0}, high_{0.0};  // the box around the lights
    double near_ = 0.0;
};

}  // namespace neumann
