#include "operators/paths/corrected/point_maker.h"

#include "core/sampling/sampler.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>

namespace neumann {

namespace {

// Places, light samples and walks have independent random numbers.
constexpr std::uint64_t place_stream = 0x706c61636573ull, light_stream = 0x6c6967687473ull, walk_stream = 0x77616c6b73ull;
// The last set has no other set behind it, so its walks go on to their end.
constexpr std::size_t most_sets = 8;
constexpr double survival_in_last_set = 1.0 / 8.0;
constexpr std::uint32_t points_at_once = 4;

}  // namespace

struct PointMaker::Workspace {
    CorrectedWalkers walkers;
    std::vector<Sampler> light, walk;  // of each point
    std::vector<Rgb> terms;
    std::vector<float> fields;  // at a point
    std::vector<std::uint64_t> rays;
};

PointMaker::PointMaker(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& walk, const Approximation& fields,
                       SamplerKind sampler, std::uint64_t seed, std::uint32_t points, const FirstVertex& samples)
    : scene_(scene),
      direct_(direct),
      walk_(walk),
      fields_(fields),
      sampler_(sampler),
      seed_(seed),
      points_(points),
      samples_(samples),
      light_net_(samples.lights),
      direction_net_(samples.directions) {
    const int sets = walk.bounces - 1 + (walk.rest_probability > 0.0 ? 1 : 0);
    sets_ = fields.fields() ? std::min(static_cast<std::size_t>(std::max(sets, 0)), most_sets) : 0;
    if (walk_.rest_probability > 0.0) walk_.rest_probability = 1.0;
}

SharedPoints PointMaker::make_set(std::uint64_t replicate, std::size_t set, const JoinedPoints& next, const Caustics* caustics,
                                  std::uint64_t& rays, std::uint64_t& given_up) const {
    WalkSettings walk = walk_;
    walk.bounces = std::max(walk_.bounces - 1 - static_cast<int>(set), 0);
    const auto N = static_cast<std::size_t>(walk.bounces), quantities = N + 2;
    FirstVertex samples = samples_;
    if (!next.errors) samples.survival = survival_in_last_set;
    const CorrectedWalk corrected(scene_, direct_, walk, fields_, next,
                                  {caustics, caustics ? caustics->bounces_of_points() : 0, false, nullptr}, samples);
    const FieldRaster& fields = *fields_.fields();

    std::vector<SharedPoints::Point> points(points_);
    std::vector<Rgb> errors_of_points(points_ * (quantities - 1));
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces;
    std::atomic<std::uint64_t> cast = 0, lost = 0;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, points_ / points_at_once, 1), [&](const auto& range) {
        Workspace& work = workspaces.local();
        work.rays.assign(quantities, 0);
        work.fields.resize(3 * fields.size());
        TermSamples out{{}, work.rays};
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
            const std::uint32_t first = group * points_at_once;
            work.terms.assign(points_at_once * quantities, Rgb(0.0));
            out.quantities = work.terms;
            work.walkers.begin(points_at_once);
            work.walkers.samplers.clear();
            work.light.clear();
            work.walk.clear();
            for (std::uint32_t i = 0; i < points_at_once; ++i) {
                const std::uint32_t number = first + i, name = static_cast<std::uint32_t>(set) * points_ + number;
                Sampler place(seed_ ^ place_stream, name);
                place.start(replicate);
                const double choice = (number + place.next()) / points_;
                const Approximation::Draw draw = fields_.draw(choice, place.next2());
                points[number] = {draw.point, draw.normal, scene_.materials.side(draw.point, draw.normal).p.frame.n,
                                  draw.inverse_density};
                work.light.push_back(Sampler(sampler_, light_net_, seed_ ^ light_stream, name));
                work.walk.push_back(Sampler(sampler_, direction_net_, seed_ ^ walk_stream, name));
                work.walk.back().start(replicate * samples_.directions);
                work.walkers.samplers.push_back(work.walk.back());
                CorrectedWalker& w = work.walkers.walker[i];
                w = {};
                w.x = draw.point;
                w.wo = draw.normal;
                w.path = i;
            }
            corrected(
                work.walkers,
                [&](std::uint32_t i, std::uint32_t l) -> Sampler& {
                    work.light[i].start(replicate * samples_.lights + l);
                    return work.light[i];
                },
                [&](std::uint32_t i, std::uint32_t g) -> const Sampler& {
                    work.walk[i].start(replicate * samples_.directions + g);
                    return work.walk[i];
                },
                [](std::uint32_t) { return GoingOn(); }, out);
            for (std::uint32_t i = 0; i < points_at_once; ++i) {
                const SharedPoints::Point& p = points[first + i];
                Rgb* const errors = errors_of_points.data() + (first + i) * (quantities - 1);
                for (std::size_t k = 1; k < quantities; ++k) errors[k - 1] = work.terms[i * quantities + k];
                fields.read(p.y, glm::dot(p.y.normal, p.normal) > 0.0, work.fields.data());
                for (std::size_t k = 0; k < fields.size(); ++k)
                    if (k < N || walk.rest_probability > 0.0)
                        errors[std::min(k, N)] -= Rgb(work.fields[3 * k], work.fields[3 * k + 1], work.fields[3 * k + 2]);
            }
        }
        for (const std::uint64_t n : work.rays) cast += n;
        lost += out.given_up;
    });
    rays += cast;
    given_up += lost;
    return {std::move(points), std::move(errors_of_points)};
}

std::optional<SharedPoints> PointMaker::make(std::uint64_t replicate, const Caustics* caustics, const SharedPoints* carrying,
                                             std::uint64_t& rays, std::uint64_t& given_up, const Watch& watch) const {
    std::optional<SharedPoints> next;
    for (std::size_t set = sets_; set-- > 0;) {
        SharedPoints made = make_set(replicate, set, {next ? &*next : nullptr, carrying}, caustics, rays, given_up);
        next = std::move(made);
        if (watch.stop()) return std::nullopt;
    }
    return next;
}

}  // namespace neumann
