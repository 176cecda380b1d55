#include "operators/paths/corrected/approximation.h"

#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/traced_series.h"
#include "operators/fields/patches/patch_memory.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr std::uint64_t field_stream = 0x636f7272656374ull;
constexpr std::uint32_t most_light_samples = 64;
// The part of the uniform density in the density of points; the other part is proportional to the brightness of the fields.
constexpr double uniform_share = 0.3;
// α of the tables of directions (guided/direction_tables.h).
constexpr double share_of_cosine = 0.5;

// An unknown takes memory for the fields, here and on coarser patches, for their rasters, work space, T, and the tables
// of directions.
void check_memory(const ApproximationSettings& settings, double patches) {
    check_patch_memory(static_cast<std::size_t>(patches), settings.rays,
                       300.0 + 2.0 * (32.0 + 60.0 * (settings.bounces + 2.0)) + 8.0 * settings.rays +
                           2.0 * static_cast<double>(DirectionTables::bytes_of_facet),
                       settings.memory);
}

}  // namespace

Approximation::Approximation(const Scene& scene, const ApproximationSettings& settings, const Watch& watch) : settings_(settings) {
    const DiffuseSides sides(scene);
    if (sides.empty()) return;
    check_memory(settings, static_cast<double>(settings.patches));
    diffuse_scene_.emplace(with_diffuse_materials(scene));
    space_.emplace(scene_patches(*diffuse_scene_, {.patches = settings.patches, .grading = 0.5, .compared = false}));
    check_memory(settings, static_cast<double>(space_->patches().size()));
    const TracedSeries series = trace_series(*diffuse_scene_, *space_, space_->coarser(),
                                             {.bounces = settings.bounces,
                                              .rays = settings.rays,
                                              .light_samples = std::min(settings.rays, most_light_samples),
                                              .seed = settings.seed ^ field_stream,
                                              .rest = true,
                                              .rough_rays = true},
                                             watch);
    fields_.emplace(scene, sides, series.fine, settings.seed, watch);
    tables_.emplace(series.fine,
                    TableSettings{CellDistribution::cells, share_of_cosine, settings.bounces, settings.seed ^ field_stream}, watch);
    rays_ = series.rays + fields_->rays() + tables_->rays();
    find_density(sides, series.fine);
    if (!facets_.empty()) return;
    fields_.reset();
    tables_.reset();
}

void Approximation::find_density(const DiffuseSides& sides, const FieldStack& fields) {
    const int N = settings_.bounces;
    std::vector<double> mean(static_cast<std::size_t>(N) + 1);
    const auto value = [&](const Facet& facet, int k) {
        const float* v = fields[facet.first] + 3 * k;
        return double{v[0]} + v[1] + v[2];
    };
    for (std::uint32_t f = 0; f < space_->facets().size(); ++f) {
        const Facet& facet = space_->facets()[f];
        if (!sides.has(space_->patches().chart(facet.patch).shape(), facet.front)) continue;
        facets_.push_back(f);
        area_ += space_->patches().area(facet.patch);
        for (int k = 1; k <= N; ++k) mean[static_cast<std::size_t>(k)] += value(facet, k) * space_->patches().area(facet.patch);
    }
    double sum = 0.0;
    for (const std::uint32_t f : facets_) {
        const Facet& facet = space_->facets()[f];
        double brightness = 0.0;
        for (int k = 1; k <= N; ++k)
            if (const double m = mean[static_cast<std::size_t>(k)]; m > 0.0) brightness += value(facet, k) * area_ / (m * N);
        ends_.push_back(sum += (uniform_share + (1.0 - uniform_share) * brightness) * space_->patches().area(facet.patch));
    }
    for (double& end : ends_) end /= sum;
}

Approximation::Draw Approximation::draw(double choice, const Vec2& u) const {
    const auto i = std::min<std::size_t>(
        static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), choice) - ends_.begin()), ends_.size() - 1);
    const Facet& facet = space_->facets()[facets_[i]];
    const SurfacePoint p = space_->patches().point(facet.patch, u);
    const double probability = ends_[i] - (i > 0 ? ends_[i - 1] : 0.0);
    return {p, facet.front ? p.normal : -p.normal, space_->patches().area(facet.patch) / probability};
}

}  // namespace neumann
