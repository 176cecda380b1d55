#include "operators/paths/guided/guide.h"

#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/traced_series.h"
#include "operators/fields/patches/patch_memory.h"

namespace neumann {

namespace {

// The random numbers are independent of those of walks with the same seed, and of those of the tables.
constexpr std::uint64_t guide_stream = 0x6775696465206bull;

// Checks the memory for the fields (also on coarser patches), work space, T and the tables. Called before the patch space exists,
// and again when the number of unknowns is known.
void check_guide_memory(const GuideSettings& settings, double unknowns, double facets) {
    check_patch_memory(settings.patches, settings.rays,
                       300.0 + unknowns * (32.0 + 15.0 * (DirectionTables::most_terms + 2.0) + 4.0 * DirectionTables::most_tables) +
                           facets * (4.0 * settings.field_rays + static_cast<double>(DirectionTables::bytes_of_facet)),
                       settings.memory);
}

PatchSpace make_guide_space(const Scene& scene, const GuideSettings& settings) {
    check_guide_memory(settings, 1.0, 1.0);
    PatchSpace space = scene_patches(scene, {.patches = settings.patches, .compared = false});
    const auto patches = static_cast<double>(space.patches().size());
    check_guide_memory(settings, space.size() / patches, static_cast<double>(space.facets().size()) / patches);
    return space;
}

}  // namespace

Guide::Guide(const Scene& scene, const GuideSettings& settings, const Watch& watch)
    : settings_(settings), space_(make_guide_space(scene, settings)) {
    const TracedSeries series = trace_series(scene, space_, space_.coarser(),
                                             {.bounces = DirectionTables::terms(settings.bounces),
                                              .rays = settings.field_rays,
                                              .seed = settings.seed ^ guide_stream,
                                              .rest = false,
                                              .rough_rays = true},
                                             watch);
    tables_.emplace(series.fine, TableSettings{settings.rays, settings.share_of_material, settings.bounces, settings.seed}, watch);
    rays_ = series.rays + tables_->rays();
}

}  // namespace neumann
