#include "operators/paths/corrected/field_raster.h"

#include "core/base/hot.h"
#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace neumann {

namespace {

constexpr std::uint64_t direct_light_stream = 0x726173746572ull;
// The average number of nodes per patch in the raster of all fields.
constexpr double nodes_of_patch = 2.0;
constexpr double most_nodes_along = 1024.0;
// The number of places on a part of a cluster at which lights are sampled.
constexpr std::uint32_t places_of_part = 4;

}  // namespace

FieldRaster::FieldRaster(const Scene& scene, const DiffuseSides& sides, const FieldStack& fields, std::uint64_t seed,
                         const Watch& watch)
    : space_(&fields.space()), stride_(fields.stride() - 3) {
    const Patches& patches = space_->patches();
    for (const Shape& shape : scene.geometry.shapes()) is_smooth_.push_back(has_smooth_normals(shape));
    std::vector<std::uint32_t> patches_of(patches.charts().size()), first_of(patches_of);
    has_side_.resize(patches.charts().size());
    for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
        const std::uint32_t chart = patches.chart_number(patch);
        if (patches_of[chart]++ == 0) first_of[chart] = patch;
        for (const bool front : {true, false})
            has_side_[chart][front ? 0 : 1] =
                sides.has(patches.charts()[chart].shape(), front) && space_->facet(patch, front) != space_->facets().size();
    }
    std::size_t nodes = 0, fine_nodes = 0;
    for (std::uint32_t chart = 0; chart < patches.charts().size(); ++chart) {
        const double n = patches_of[chart];
        const bool clusters = patches.charts()[chart].clusters();
        grids_.push_back(make_grid(chart, clusters ? n : n > 1.0 ? nodes_of_patch * n : 0.0, nodes));
        grids_.back().first_patch = first_of[chart];
        fine_grids_.push_back(make_grid(chart, clusters || n > 1.0 ? fine_nodes_of_patch * n : 0.0, fine_nodes));
    }
    values_.resize(nodes * stride_);
    fine_.resize(fine_nodes * 3);
    fill(fields);
    fill_direct(scene, seed, watch);
}

FieldRaster::Grid FieldRaster::make_grid(std::uint32_t chart, double cells, std::size_t& nodes) const {
    const Vec2 size = space_->patches().charts()[chart].lengths();
    Grid grid;
    const double cell = std::sqrt(size.x * size.y / std::max(cells, 1.0));
    const auto along = [&](double length) {
        return cells == 0.0 ? 1u : static_cast<std::uint32_t>(std::clamp(length / cell, 1.0, most_nodes_along)) + 1;
    };
    const bool clusters = space_->patches().charts()[chart].clusters();
    grid.columns = clusters ? static_cast<std::uint32_t>(cells) : along(size.x);
    grid.rows = clusters ? 1 : along(size.y);
    for (const int side : {0, 1}) {
        grid.first[static_cast<std::size_t>(side)] = nodes;
        if (has_side_[chart][static_cast<std::size_t>(side)]) nodes += std::size_t{grid.columns} * grid.rows;
    }
    return grid;
}

SurfacePoint FieldRaster::node(std::uint32_t chart, const Grid& grid, std::uint32_t column, std::uint32_t row) const {
    static constexpr double inside = 1e-3;
    const auto at = [](std::uint32_t i, std::uint32_t n) {
        return n == 1 ? 0.5 : std::clamp(static_cast<double>(i) / (n - 1), inside, 1.0 - inside);
    };
    return space_->patches().charts()[chart].point(space_->geometry(), {at(column, grid.columns), at(row, grid.rows)});
}

// The places lie across the faces of a part of a cluster, along Roberts' R2 sequence.
SurfacePoint FieldRaster::place_in_part(std::uint32_t chart, const Grid& grid, std::uint32_t column, std::uint32_t i) const {
    const double s = (column + (i + 0.5) / places_of_part) / grid.columns;
    return space_->patches().charts()[chart].bare_point(space_->geometry(), {s, glm::fract(0.5 + 0.7548776662466927 * i)});
}

void FieldRaster::fill(const FieldStack& fields) {
    const Patches& patches = space_->patches();
    oneapi::tbb::parallel_for(std::size_t{0}, grids_.size(), [&](std::size_t number) {
        const auto chart = static_cast<std::uint32_t>(number);
        const Grid& grid = grids_[chart];
        for (const std::size_t side : {0u, 1u}) {
            if (!has_side_[chart][side]) continue;
            float* to = values_.data() + grid.first[side] * stride_;
            if (patches.charts()[chart].clusters()) {
                for (std::uint32_t i = 0; i < grid.columns; ++i, to += stride_) {
                    const std::uint32_t facet = space_->facet(grid.first_patch + i, side == 0);
                    std::copy_n(fields[space_->facets()[facet].first] + 3, stride_, to);
                }
                continue;
            }
            for (std::uint32_t row = 0; row < grid.rows; ++row)
                for (std::uint32_t column = 0; column < grid.columns; ++column, to += stride_) {
                    const SurfacePoint p = node(chart, grid, column, row);
                    const PatchSpace::Reading reading =
                        space_->read(p, patches.place(chart, p.position), side == 0 ? p.normal : -p.normal);
                    for (std::size_t q = 0; q < 4; ++q) {
                        if (reading.weight[q] == 0.0) continue;
                        const float* const from = fields[reading.unknown[q]] + 3;
                        for (std::size_t k = 0; k < stride_; ++k) to[k] += static_cast<float>(reading.weight[q]) * from[k];
                    }
                }
        }
    });
}

namespace {

// A part of K Le at a point with normal n on the lit side, without the reflectance: the contribution of samples
// `begin` … `end` − 1 of light_samples.
NEUMANN_HOT Rgb light_at_node(const Geometry& geometry, const LightSampler& lights, const SurfacePoint& p, const Vec3& n,
                              std::uint32_t begin, std::uint32_t end, Sampler& sampler, std::uint64_t& rays) {
    std::array<LightSample, RayCaster::packet_size> waiting;
    std::array<double, RayCaster::packet_size> cosine;
    std::size_t count = 0;
    Rgb sum(0.0);
    const auto look = [&] {
        const std::uint32_t seen = geometry.visible(
            count, [&](std::size_t i) { return std::pair<const SurfacePoint&, const SurfacePoint&>(p, waiting[i].point); },
            RayCaster::Rays::alike);
        for (std::size_t i = 0; i < count; ++i)
            if (seen >> i & 1u) sum += waiting[i].weight * cosine[i];
        rays += count;
        count = 0;
    };
    for (std::uint32_t i = begin; i < end; ++i) {
        sampler.start(i);
        waiting[count] = lights.sample({p.position, n}, sampler.next2());
        if (!(waiting[count].pdf > 0.0)) continue;
        cosine[count] = glm::dot(n, waiting[count].w);
        if (cosine[count] > 0.0 && ++count == waiting.size()) look();
    }
    if (count > 0) look();
    return sum * (inv_pi / FieldRaster::light_samples);
}

}  // namespace

void FieldRaster::fill_direct(const Scene& scene, std::uint64_t seed, const Watch& watch) {
    if (scene.emitters.empty()) return;
    const LightSampler lights(scene.geometry, scene.emitters, LightChoice::mixed, LightPlace::near_projected);
    const SobolPoints points(light_samples);
    struct Row {
        std::uint32_t chart, row;
        bool front;
    };
    std::vector<Row> rows;
    for (std::uint32_t chart = 0; chart < fine_grids_.size(); ++chart)
        for (const bool front : {true, false})
            if (has_side_[chart][front ? 0 : 1])
                for (std::uint32_t row = 0; row < fine_grids_[chart].rows; ++row) rows.push_back({chart, row, front});
    std::atomic<std::uint64_t> rays = 0;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, rows.size()), [&](const auto& range) {
        if (watch.stop()) return;
        std::uint64_t cast = 0;
        for (std::size_t r = range.begin(); r < range.end(); ++r) {
            const auto [chart, row, front] = rows[r];
            const Grid& grid = fine_grids_[chart];
            const bool clusters = space_->patches().charts()[chart].clusters();
            const std::size_t first = grid.first[front ? 0 : 1] + std::size_t{row} * grid.columns;
            for (std::uint32_t column = 0; column < grid.columns; ++column) {
                Sampler sampler(points, seed ^ direct_light_stream, static_cast<std::uint32_t>(first + column));
                Rgb light(0.0);
                const std::uint32_t places = clusters ? places_of_part : 1, each = light_samples / places;
                for (std::uint32_t i = 0; i < places; ++i) {
                    const SurfacePoint p = clusters ? place_in_part(chart, grid, column, i) : node(chart, grid, column, row);
                    const Vec3 n = front ? p.normal : -p.normal;
                    const SurfaceSide side = scene.materials.side(p, n);
                    light += std::get<Diffuse>(*side.bsdf).reflectance(side.p) *
                             light_at_node(scene.geometry, lights, p, side.p.frame.n, i * each, (i + 1) * each, sampler, cast);
                }
                for (int c = 0; c < 3; ++c)
                    fine_[3 * (first + column) + static_cast<std::size_t>(c)] = static_cast<float>(light[c]);
            }
        }
        rays += cast;
    });
    if (watch.stop()) throw Stopped();
    rays_ = rays;
}

}  // namespace neumann
