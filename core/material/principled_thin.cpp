#include "core/material/principled_thin.h"

#include "core/material/fresnel.h"
#include "core/material/ggx.h"
#include "core/material/measured_albedo.h"
#include "core/sampling/choose.h"

#include <algorithm>

namespace neumann {

namespace {

Ggx facets(const PrincipledValues& v, bool reflecting) { return Ggx(v.alpha(reflecting ? 1.0 : 0.65 * v.eta - 0.35)); }

}  // namespace

PrincipledThin::PrincipledThin(std::shared_ptr<const PrincipledParameters> parameters) : parameters_(std::move(parameters)) {
    for (const PrincipledValues& v : parameters_->extremes())
        largest_albedo_ =
            glm::max(largest_albedo_,
                     measured_albedo(parameters_->is_isotropic(), [&](const Vec3& wo, const Vec2& u) { return sample(v, wo, u); }));
}

Lobe PrincipledThin::lobe() const {
    const PrincipledValues v = parameters_->extremes().front();
    if (v.spec_trans == 0.0) return {Lobe::Kind::rough, 1.0};
    const Vec2 reflecting = facets(v, true).alpha(), transmitting = facets(v, false).alpha();
    return {Lobe::Kind::rough, std::min({reflecting.x, reflecting.y, transmitting.x, transmitting.y})};
}

Rgb PrincipledThin::eval(const PrincipledValues& v, const Vec3& wo, const Vec3& wi) {
    if (wo.z <= 0.0 || wi.z == 0.0) return Rgb(0.0);
    const bool reflecting = wi.z > 0.0;
    const double diffuse = 1.0 - v.spec_trans, through = 0.5 * v.diff_trans;
    const Vec3 m = glm::normalize(wo + above(wi));
    const double cosine = glm::dot(wo, m);
    Rgb f = reflecting
                ? (v.base_color * (v.diffuse(wo.z, wi.z, cosine) * inv_pi) + v.sheen_color(cosine)) * (diffuse * (1.0 - through))
                : v.base_color * (diffuse * through * inv_pi);
    if (v.spec_trans > 0.0 && (reflecting || glm::dot(wi, m) < 0.0)) {
        const Ggx ggx = facets(v, reflecting);
        const double F = conductor_fresnel(cosine, v.eta, 0.0);
        const Rgb share =
            reflecting ? Rgb((1.0 - v.spec_tint) * F) + v.spec_tint * v.tinted_fresnel(cosine) : v.base_color * (1.0 - F);
        f += share * (v.spec_trans * ggx.density(m) / (4.0 * ggx.projected_area(wo) * ggx.projected_area(above(wi))));
    }
    return f;
}

double PrincipledThin::pdf(const PrincipledValues& v, const Vec3& wo, const Vec3& wi) {
    if (wo.z <= 0.0 || wi.z == 0.0) return 0.0;
    const bool reflecting = wi.z > 0.0;
    const double diffuse = 1.0 - v.spec_trans, through = 0.5 * v.diff_trans;
    double sum = diffuse * (reflecting ? 1.0 - through : through) * std::abs(wi.z) * inv_pi;
    const Vec3 m = glm::normalize(wo + above(wi));
    if (v.spec_trans > 0.0 && (reflecting || glm::dot(wi, m) < 0.0)) {
        const Ggx ggx = facets(v, reflecting);
        sum += 0.5 * v.spec_trans * ggx.density(m) / (4.0 * ggx.projected_area(wo));
    }
    return sum;
}

BsdfSample PrincipledThin::sample(const PrincipledValues& v, const Vec3& wo, Vec2 u) {
    if (wo.z <= 0.0) return {};
    Vec3 wi;
    if (choose_first(v.spec_trans, u.x)) {
        const bool reflecting = choose_first(0.5, u.x);
        const Vec3 m = facets(v, reflecting).sample_visible(wo, u);
        wi = 2.0 * glm::dot(wo, m) * m - wo;
        if (wi.z <= 0.0) return {};
        if (!reflecting) wi.z = -wi.z;
        if (!reflecting && glm::dot(wi, m) >= 0.0) return {};
    } else {
        const bool through = choose_first(0.5 * v.diff_trans, u.x);
        wi = cosine_hemisphere(u);
        if (through) wi.z = -wi.z;
    }
    const double density = pdf(v, wo, wi);
    if (!(density > 0.0)) return {};
    return {wi, eval(v, wo, wi) * (std::abs(wi.z) / density), density};
}

}  // namespace neumann
