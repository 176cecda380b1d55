#include "core/material/perturbed_normal.h"

#include "core/material/bsdf.h"
#include "core/sampling/third_number.h"

#include <algorithm>

namespace neumann {

namespace {

double tangent_squared(const Vec3& w) { return (w.x * w.x + w.y * w.y) / (w.z * w.z); }

}  // namespace

Vec3 bump_normal(const ShadingPoint& p, const Vec2& slope) {
    const Vec3 &s = p.frame.s, &t = p.frame.t;
    const auto [dp_du, dp_dv] = tangents(p);
    const Vec3 n =
        glm::cross(Vec3(glm::dot(s, dp_du), glm::dot(t, dp_du), slope.x), Vec3(glm::dot(s, dp_dv), glm::dot(t, dp_dv), slope.y));
    // Seen from behind, the frame's z points to the back.
    const Vec3 front = glm::cross(s, t);
    return glm::dot(p.normal, s * n.x + t * n.y + front * n.z) < 0.0 ? -n : n;
}

Vec3 PerturbedNormal::normal(const ShadingPoint& p) const {
    const Vec3 n = normal_(p);
    return options_.from_behind ? Vec3(-n.x, -n.y, n.z) : n;
}

bool PerturbedNormal::is_mirrored(const Vec3& normal, const Vec3& wo) const {
    return options_.flip_invalid_normals && wo.z * glm::dot(wo, normal) <= 0.0;
}

PerturbedNormal::Perturbed PerturbedNormal::perturbed(const ShadingPoint& p, Vec3 n, bool mirrored) const {
    if (mirrored) n = {-n.x, -n.y, n.z};
    const double length = glm::length(n);
    n = length > 0.0 && std::isfinite(length) ? n / length : Vec3(0.0, 0.0, 1.0);
    const Vec3 along = Vec3(1.0, 0.0, 0.0) - n * n.x;
    const double along_length = glm::length(along);
    const Vec3 s = along_length > 0.0 ? along / along_length : Vec3(0.0, 1.0, 0.0);
    Perturbed result{Frame(s, glm::cross(n, s), n), p};
    result.p.frame = Frame(p.frame.to_world(s), p.frame.to_world(result.frame.t), p.frame.to_world(n));
    return result;
}

PerturbedNormal::Perturbed PerturbedNormal::perturbed(const ShadingPoint& p, const Vec3& wo) const {
    const Vec3 n = normal(p);
    return perturbed(p, n, is_mirrored(n, wo));
}

double PerturbedNormal::shadowing(const Vec3& normal, const Vec3& wi) const {
    if (!options_.use_shadowing_function) return 1.0;
    const double alpha2 = std::min(0.125 * tangent_squared(normal), 1.0);
    return 2.0 / (1.0 + std::sqrt(1.0 + alpha2 * tangent_squared(wi)));
}

Rgb PerturbedNormal::eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    const Perturbed there = perturbed(p, wo);
    const Vec3 wo_there = there.frame.to_local(wo), wi_there = there.frame.to_local(wi);
    if (wo_there.z <= 0.0 || wi.z * wi_there.z <= 0.0) return Rgb(0.0);
    return neumann::eval(*nested_, there.p, wo_there, wi_there) * (wi_there.z / wi.z * shadowing(there.frame.n, wi));
}

double PerturbedNormal::pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    const Perturbed there = perturbed(p, wo);
    const Vec3 wo_there = there.frame.to_local(wo), wi_there = there.frame.to_local(wi);
    if (wo_there.z <= 0.0 || wi.z * wi_there.z <= 0.0) return 0.0;
    return neumann::pdf(*nested_, there.p, wo_there, wi_there);
}

BsdfSample PerturbedNormal::sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
    const Perturbed there = perturbed(p, wo);
    const Vec3 wo_there = there.frame.to_local(wo);
    if (wo_there.z <= 0.0) return {};
    const BsdfSample drawn = neumann::sample(*nested_, there.p, wo_there, u);
    const Vec3 wi = there.frame.to_world(drawn.wi);
    if (wi.z * drawn.wi.z <= 0.0) return {};
    return {wi, drawn.weight * shadowing(there.frame.n, wi), drawn.pdf, drawn.eta};
}

bool PerturbedNormal::may_leave_by_both(const ShadingPoint& p, const Vec3& wi) const {
    if (!options_.flip_invalid_normals || neumann::lobe(*nested_).kind != Lobe::Kind::specular) return false;
    const Vec3 n = normal(p);
    return perturbed(p, n, !is_mirrored(n, wi)).frame.to_local(wi).z > 0.0;
}

double PerturbedNormal::pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const {
    const Perturbed there = perturbed(p, wi);
    const Vec3 wi_there = there.frame.to_local(wi), wo_there = there.frame.to_local(wo);
    if (wi_there.z <= 0.0 || wo.z * wo_there.z <= 0.0) return 0.0;
    return neumann::pdf_from_light(*nested_, there.p, wi_there, wo_there) * (may_leave_by_both(p, wi) ? 0.5 : 1.0);
}

BsdfSample PerturbedNormal::sample_from_light(const ShadingPoint& p, const Vec3& wi, const Vec2& u) const {
    const Vec3 n = normal(p);
    const bool usual = is_mirrored(n, wi), both = may_leave_by_both(p, wi), mirrored = usual != (both && third_number(u) < 0.5);
    const Perturbed there = perturbed(p, n, mirrored);
    const Vec3 wi_there = there.frame.to_local(wi);
    if (wi_there.z <= 0.0) return {};
    const BsdfSample drawn = neumann::sample_from_light(*nested_, there.p, wi_there, u);
    const Vec3 wo = there.frame.to_world(drawn.wi);
    if (wo.z * drawn.wi.z <= 0.0) return {};
    const double share = both ? 0.5 : 1.0;
    if (drawn.pdf != delta_pdf) return mirrored == usual ? BsdfSample{wo, drawn.weight, drawn.pdf * share} : BsdfSample{};
    if (is_mirrored(n, wo) != mirrored) return {};
    return {wo, drawn.weight * (shadowing(there.frame.n, wi) / share), delta_pdf, drawn.eta};
}

Rgb PerturbedNormal::reflectance(const ShadingPoint& p) const { return neumann::reflectance(*nested_, p); }

PerturbedNormal PerturbedNormal::white() const {
    return {normal_, std::make_shared<const Bsdf>(neumann::white(*nested_)), options_};
}

Rgb PerturbedNormal::largest_albedo() const { return neumann::largest_albedo(*nested_); }

bool PerturbedNormal::transmits() const { return neumann::transmits(*nested_); }
bool PerturbedNormal::is_grey() const { return neumann::is_grey(*nested_); }

Lobe PerturbedNormal::lobe() const { return neumann::lobe(*nested_); }

}  // namespace neumann
