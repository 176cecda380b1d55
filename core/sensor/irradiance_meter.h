// The irradiance on the front of a shape, averaged over its area (Mitsuba's `irradiancemeter`):
//
//     E = 1/A ∫∫ L(p, ω) cosθ dω dA = π E[L(p, ω)],   p uniform by area, ω in proportion to cosθ.
//
// Its terms are the irradiances by light of each number of bounces. All pixels measure the same.
#pragma once

#include "core/geometry/area_sampler.h"
#include "core/sampling/warp.h"
#include "core/sensor/even_film.h"

namespace neumann {

class IrradianceMeter {
public:
    // Keeps a reference to the geometry. Throws InputError if the shape has no area.
    IrradianceMeter(const Geometry& geometry, std::uint32_t shape, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2& lens) const;
    std::optional<FilmPoint> see(const Vec3& p, const Vec2& lens) const;
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const { return density(ray.cosine, p - ray.origin); }
    double response() const { return pi; }

private:
    // The density at the end of d of the rays that leave a point of the meter, in pixels per area perpendicular to d.
    double density(double cosine, const Vec3& d) const { return film_.pixels() * cosine * inv_pi / glm::dot(d, d); }

    std::shared_ptr<const AreaSampler> points_;
    EvenFilm film_;
};

}  // namespace neumann
