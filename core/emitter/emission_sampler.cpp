#include "core/emitter/emission_sampler.h"

#include "core/base/frame.h"
#include "core/sampling/delta_pdf.h"

#include <numeric>

namespace neumann {

EmissionSampler::EmissionSampler(const Geometry& geometry, const Emitters& emitters)
    : geometry_(&geometry),
      emitters_(&emitters),
      table_(geometry, emitters, emitters.powers(), LightTable::Rectangles::as_triangles) {
    const double all = std::accumulate(emitters.powers().begin(), emitters.powers().end(), 0.0);
    // The densities are 1/A for the point and |cosθ|/π for the direction. The factors d²/|cosθ| to the solid angle at x
    // and 1/d² to the area at x leave 1/(π A).
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
        const double power = emitters.powers()[shape];
        density_of_shape_.push_back(power > 0.0 ? power / all / emitters.area(shape) * inv_pi : 0.0);
    }
}

Emission EmissionSampler::sample(const Vec2& place, const Vec2& direction) const {
    const LightTable::Choice chosen = table_.choose(place.x);
    const Vec2 left(chosen.left, place.y);
    if (!table_.is_distant(chosen.index)) return from_surface(table_.parts()[chosen.index], left, direction);
    Emission e;
    e.distant = table_.distant(chosen.index);
    const DistantEmission sent = emitters_->send_distant(e.distant, left, direction);
    e.from.position = sent.from;
    e.from.normal = sent.w;
    e.from.shape = SurfacePoint::infinity;
    e.w = sent.w;
    e.weight = sent.light / chosen.probability;
    e.density = sent.pdf * chosen.probability;
    e.is_point = sent.is_point;
    e.is_delta = sent.is_delta;
    return e;
}

Emission EmissionSampler::from_surface(const LightTable::Part& part, const Vec2& place, const Vec2& direction) const {
    Emission e;
    e.from = geometry_->point(part.shape, part.primitive, place);
    e.w = Frame(e.from.normal).to_world(cosine_hemisphere(direction));
    e.density = density_of_shape_[part.shape];
    e.weight = emitters_->emitted(e.from, e.w) / e.density;
    return e;
}

double EmissionSampler::environment_density(const Vec3& w) const {
    if (empty() || !emitters_->has_environment()) return 0.0;
    return probability_of_distant(0) * emitters_->distant_density(0, Vec3(0.0), -w);
}

double EmissionSampler::density_of_delta(std::size_t distant, const Vec3& x, const Vec3& w) const {
    return probability_of_distant(distant) * emitters_->distant_density(distant, x, -w);
}

}  // namespace neumann
