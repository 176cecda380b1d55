#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/option_makers.h"

namespace neumann::method {

namespace {

const Named<Spacing> spacings{{"hessian", Spacing::hessian}, {"split-sphere", Spacing::split_sphere}};

}  // namespace

std::vector<MethodOption> Cache::own_options() {
    return {
        choice(
            "records", "HOW",
            "For cache: what says how far apart records stand: hessian (the second derivatives of their irradiance, the default) "
            "or "
            "split-sphere (the distances of what they see)",
            spacings, [](const Cache& m) { return m.records; }, [](Cache& m, Spacing s) { m.records = s; }),
        option(
            "accuracy", "A",
            "For cache: the error allowed to records; with hessian relative, on average within the usual distance of records "
            "(default 0.05); with split-sphere their reach as a part of the distance of what they see (default 0.25). A larger one "
            "makes fewer records",
            [](const Cache& m) { return m.accuracy; }, [](Cache& m, double a) { m.accuracy = a; }, above_zero())};
}

CacheSettings Cache::settings() const {
    return {records, accuracy.value_or(default_accuracy(records)), directions.value_or(default_rays_of_record)};
}

std::shared_ptr<const PathMethod> Cache::prepare(const Preparing& in) const {
    return std::make_shared<const CachePaths>(
        std::make_shared<const RecordPlaces>(in.scene, settings(), in.settings.sampler, in.settings.seed, in.memory, in.watch));
}

void Cache::complete(const SamplingSettings& settings, const Film&) {
    const CacheSettings& taken = as<CachePaths>(settings.method)->records().settings();
    accuracy = taken.accuracy;
    directions = taken.rays;
}

}  // namespace neumann::method
