#include "operators/render/from_paths/energy_balance.h"

#include "core/sampling/warp.h"
#include "operators/pointwise/adjoint_reflection.h"
#include "operators/statistics/student_t.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

BalanceSheet::BalanceSheet(const Scene& scene, bool from_light, int bounces, int walks, std::uint64_t seed, std::uint32_t stream)
    : scene_(&scene),
      from_light_(from_light),
      share_(1.0 / walks),
      random_(seed, stream),
      entries_(static_cast<std::size_t>(bounces) + 1) {
    random_.start(0);
}

void BalanceSheet::add(std::uint32_t path, const PathStep& step) {
    if (step.from_light != from_light_) return;
    if (path >= first_.size()) {
        first_.resize(path + 1);
        waiting_.resize(path + 1);
    }
    if (step.kind == PathStep::Kind::first) {
        first_[path] = step;
        waiting_[path] = true;
        return;
    }
    settle(path);
    if (step.kind == PathStep::Kind::shadow_ray || step.bounce >= static_cast<int>(entries_.size())) return;
    const Rgb beta = step.beta * share_;
    EnergyShares& entry = entries_[static_cast<std::size_t>(step.bounce)];
    (step.found ? entry.went_on : entry.left) += mean_component(beta);
    if (step.found) arrive(step.bounce + 1, step.to, -step.w, beta);
}

void BalanceSheet::settle(std::uint32_t path) {
    if (!waiting_[path]) return;
    waiting_[path] = false;
    const PathStep& step = first_[path];
    const double beta = mean_component(step.beta);
    entries_[0].arrived += beta;
    (step.found ? entries_[0].went_on : entries_[0].left) += beta;
    if (step.found) arrive(1, step.to, -step.w, step.beta);
}

void BalanceSheet::arrive(int bounce, const SurfacePoint& x, const Vec3& w, const Rgb& beta) {
    if (bounce >= static_cast<int>(entries_.size())) return;
    EnergyShares& entry = entries_[static_cast<std::size_t>(bounce)];
    entry.arrived += mean_component(beta);
    entry.absorbed += mean_component(beta * (Rgb(1.0) - albedo(x, w)));
}

// The albedo ρ of a surface, for paths from the camera and, with R*, for paths from lights.
Rgb BalanceSheet::albedo(const SurfacePoint& x, const Vec3& w) {
    const SurfaceSide side = scene_->materials.side(x, w);
    const Vec2 u_material = random_.next2(), u_uniform = random_.next2();
    if (!side.bsdf) return Rgb(0.0);
    const bool both = transmits(*side.bsdf);
    const double uniform = inv_pi * (both ? 0.25 : 0.5);
    Vec3 any = uniform_hemisphere(u_uniform);
    if (both && random_.next() < 0.5) any.z = -any.z;
    if (from_light_) {
        const auto part = [&](const Vec3& wo) {
            const SurfaceSide there = scene_->materials.side(x, wo);
            if (!there.bsdf) return Rgb(0.0);
            return geometric_bsdf(there, wo, w) *
                   (std::abs(glm::dot(x.normal, wo)) / (AdjointReflection::pdf(side, w, wo) + uniform));
        };
        const auto drawn = AdjointReflection::sample(scene_->materials, side, w, u_material);
        const Rgb of_material = drawn.pdf == delta_pdf ? drawn.weight : drawn.pdf > 0.0 ? part(drawn.wo) : Rgb(0.0);
        return of_material + part(side.p.frame.to_world(any));
    }
    const Vec3 wo = side.p.frame.to_local(w);
    const auto part = [&](const Vec3& wi) {
        return eval(*side.bsdf, side.p, wo, wi) * (std::abs(wi.z) / (pdf(*side.bsdf, side.p, wo, wi) + uniform));
    };
    const BsdfSample drawn = sample(*side.bsdf, side.p, wo, u_material);
    const Rgb of_material = drawn.pdf == delta_pdf ? drawn.weight : drawn.pdf > 0.0 ? part(drawn.wi) : Rgb(0.0);
    return of_material + part(any);
}

void BalanceSheet::finish(std::uint32_t paths) {
    for (std::uint32_t path = 0; path < first_.size(); ++path) settle(path);
    for (EnergyShares& e : entries_)
        for (double* x : {&e.arrived, &e.absorbed, &e.left, &e.went_on}) *x /= paths;
}

bool EnergyBalance::is_sick(std::size_t bounce) const {
    const MeanWithError& d = bounces[bounce - 1].imbalance;
    const double each = 1.0 - (1.0 - confidence) / static_cast<double>(bounces.size());
    // Tolerates the rounding errors of thousands of paths.
    const double rounding = 1e-12 * bounces[bounce - 1].arrived.mean;
    return !(std::abs(d.mean) <= student_t_quantile(each, d.degrees_of_freedom) * d.standard_error + rounding);
}

bool EnergyBalance::is_sick() const {
    for (std::size_t bounce = 1; bounce <= bounces.size(); ++bounce)
        if (is_sick(bounce)) return true;
    return false;
}

EnergyBalance balance(const std::vector<std::vector<EnergyShares>>& observations) {
    EnergyBalance result;
    if (observations.empty()) return result;
    const auto n = static_cast<double>(observations.size());
    const auto mean = [&](std::size_t i, const auto& part) {
        double sum = 0.0, squares = 0.0;
        for (const auto& o : observations) sum += part(o[i]);
        for (const auto& o : observations) squares += (part(o[i]) - sum / n) * (part(o[i]) - sum / n);
        return MeanWithError{sum / n, n > 1.0 ? std::sqrt(squares / (n * (n - 1.0))) : std::numeric_limits<double>::infinity(),
                             n - 1.0};
    };
    const auto arrived = [](const EnergyShares& e) { return e.arrived; };
    const auto left = [](const EnergyShares& e) { return e.left; };
    result.begun = mean(0, arrived);
    result.left = mean(0, left);
    for (std::size_t i = 1; i < observations.front().size(); ++i)
        result.bounces.push_back({mean(i, arrived), mean(i, [](const EnergyShares& e) { return e.absorbed; }), mean(i, left),
                                  mean(i, [](const EnergyShares& e) { return e.went_on; }),
                                  mean(i, [](const EnergyShares& e) { return e.arrived - e.absorbed - e.left - e.went_on; })});
    return result;
}

}  // namespace neumann
