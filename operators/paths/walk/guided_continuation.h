// Path guiding: diffuse surfaces sample tables of the indirect incident light (direction_tables.h). Other materials sample their
// BSDF, and so do all at bounce N and in the rest, where roulette would end walks because guiding lowers their weight. Unbiased if
// the tables do not depend on the walks.
#pragma once

#include "operators/paths/guided/guide.h"
#include "operators/paths/walk/continuation.h"

#include <memory>
#include <variant>

namespace neumann {

class GuidedContinuation {
public:
    static constexpr bool joins_points = false;

    explicit GuidedContinuation(std::shared_ptr<const Guide> guide) : guide_(std::move(guide)) {}

    // The continuation at a vertex of a walk. With a table, fs |cosθ| / pdf is ρ divided by the table's density.
    class Vertex {
    public:
        Vertex() = default;
        Vertex(const CellDistribution* table, const Frame& shading) : table_(table) {
            // If there are texture coordinates, the shading frame's tangents differ from those of the table.
            const Frame frame(shading.n);
            if (frame.s == shading.s && frame.t == shading.t) return;
            s_ = {glm::dot(frame.s, shading.s), glm::dot(frame.s, shading.t)};
            t_ = {glm::dot(frame.t, shading.s), glm::dot(frame.t, shading.t)};
        }

        template <class Sampler>
        BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
            const Vec2 u = sampler.next2();
            if (!table_) return neumann::sample(*side.bsdf, side.p, wo, u);
            const CellDistribution::CellSample cell = table_->sample(u);
            BsdfSample sampled = neumann::sample(*side.bsdf, side.p, wo, cell.u);
            const Vec3 w = sampled.wi;
            sampled.wi = Vec3(s_ * w.x + t_ * w.y, w.z);
            sampled.weight *= cell.inverse_density;
            return sampled;
        }
        // The BSDF's pdf, not the density of sample(). It only enters the MIS weights, which stay unbiased for any pdf used
        // consistently; BsdfSample::pdf is the same. It is at most 1/α times the true density, and needs no table lookup.
        double pdf(const SurfaceSide& side, const Vec3& wo, const Vec3& wi, const SurfacePoint&) const {
            return neumann::pdf(*side.bsdf, side.p, wo, wi);
        }

    private:
        const CellDistribution* table_ = nullptr;
        Vec2 s_{1.0, 0.0}, t_{0.0, 1.0};  // rotation from the table's tangents to those of the shading frame
    };

    using VertexData = const CellDistribution*;
    VertexData vertex_data(const SurfacePoint& x, const Vec3& wo, int wanted) const {
        const CellDistribution* t = wanted == 0 ? nullptr : guide_->tables().at(x, wo, wanted);
        return t;
    }
    Vertex at(const SurfaceSide& side, VertexData table) const {
        if (!table || !std::holds_alternative<Diffuse>(*side.bsdf)) return {};
        return {table, side.p.frame};
    }

private:
    std::shared_ptr<const Guide> guide_;
};

}  // namespace neumann
