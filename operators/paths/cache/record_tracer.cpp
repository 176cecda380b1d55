#include "operators/paths/cache/record_tracer.h"

#include "operators/paths/cache/record_rays.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>

namespace neumann {

namespace {

// The rest has converged if an iteration changes it by no more than this, relative to its largest value.
constexpr float converged = 1e-6f;
constexpr int most_iterations = 10'000;

}  // namespace

// The results of the rays of all records.
struct RecordTracer::Rays {
    // The record that a ray reads, and the weight of the ray's radiance in the derivatives by the position.
    struct Link {
        glm::vec3 weight{0.0f};  // β ρ/π
        std::uint32_t record[2] = {};
        std::uint32_t bounce = 0;  // number of reflections before the cache is read; 0: it is not read
        glm::vec2 translation{0.0f};
    };
    struct Light {
        std::uint32_t ray, bounce;
        glm::vec3 radiance;
    };

    std::vector<Link> links;                // of all records, cell by cell
    std::vector<std::vector<Light>> light;  // light of each record that was found without the cache
    std::vector<float> brightness;          // of each ray
};

struct RecordTracer::Workspace {
    explicit Workspace(std::size_t quantities) : rays(quantities) {}
    PlainWalkers walkers;
    std::vector<Sampler> samplers;
    std::vector<RecordPlaces::NearRecord> near;
    std::vector<double> inverse_distances;
    std::vector<Vec2> translation;
    std::vector<glm::vec3> radiance[2];
    std::vector<std::uint64_t> rays;
    std::uint64_t given_up = 0;
};

std::optional<std::uint32_t> CachePass::read(const Vec3& y, const Vec3& n, std::vector<RecordPlaces::NearRecord>& near,
                                             std::span<Rgb> E) const {
    places_->find(y, n, true, wider, near);
    std::ranges::fill(E, Rgb(0.0));
    double sums[2] = {0.0, 0.0};
    float most = 0.0f;
    std::optional<std::uint32_t> largest;
    for (const RecordPlaces::NearRecord& near_record : near) {
        const float weight[2] = {std::max(1.0f - near_record.error, 0.0f), 1.0f - near_record.error / static_cast<float>(wider)};
        for (std::size_t radii = 0; radii < 2; ++radii) {
            sums[radii] += double{weight[radii]};
            if (weight[radii] == 0.0f) continue;
            for (std::size_t k = 0; k < bounces_; ++k)
                E[2 * k + radii] +=
                    Rgb(weight[radii] * values_[radii][k * places_->records().size() + near_record.record].at(near_record.offset));
        }
        if (weight[narrow] <= most) continue;
        most = weight[narrow];
        largest = near_record.record;
    }
    for (std::size_t k = 0; k < E.size(); ++k) E[k] /= sums[k % 2];
    return largest;
}

RecordTracer::RecordTracer(const Scene& scene, std::shared_ptr<const DirectLightSampler> direct, const WalkSettings& walk,
                           std::shared_ptr<const RecordPlaces> places, SamplerKind sampler, std::uint64_t seed)
    : scene_(&scene),
      direct_(std::move(direct)),
      walk_(walk),
      has_rest_(walk.rest_probability > 0.0),
      kept_(static_cast<std::size_t>(has_rest_ ? std::max(walk.bounces, 1) : std::max(walk.bounces - 1, 0))),
      places_(std::move(places)),
      sampler_(sampler),
      seed_(seed),
      points_(std::bit_ceil(static_cast<std::uint32_t>(places_->cells().size()))) {
    if (!has_rest_) walk_.bounces = static_cast<int>(kept_);
}

void RecordTracer::send_out(std::uint64_t pass, std::size_t record, Rays& rays, Workspace& work) const {
    const HemisphereCells& cells = places_->cells();
    const std::size_t count = cells.size();
    const Record& from = places_->records()[record];
    const auto links = std::span(rays.links).subspan(record * count, count);
    work.samplers.assign(count, Sampler(sampler_, points_, seed_, pixel_of_record(record)));
    for (std::size_t i = 0; i < count; ++i) work.samplers[i].start(pass * points_.size() + i);
    work.inverse_distances.assign(count, 0.0);
    leave_record(*scene_, cells, from.x, from.frame, 0, std::span(work.samplers), work.walkers, NoObserver(),
                 [&](std::uint32_t i, const Walker& w) {
                     if (!w.x.is_infinite()) work.inverse_distances[i] = 1.0 / glm::length(w.x.position - from.x.position);
                 });
    work.rays[0] += count;
    walk_to_records(
        *scene_, *direct_, walk_, std::span(work.samplers), work.walkers, std::span(work.rays), work.given_up,
        [&](std::uint32_t i, const Walker& w, const Vec3& n, const Rgb& weight, int bounce) {
            places_->find(w.x.position, n, false, wider, work.near);
            double sums[2] = {0.0, 0.0};
            const auto weight_of = [](const RecordPlaces::NearRecord& near, std::size_t radii) {
                return std::max(1.0 - double{near.error} / (radii == CachePass::wide ? wider : 1.0), 0.0);
            };
            for (const RecordPlaces::NearRecord& near : work.near)
                for (std::size_t radii = 0; radii < 2; ++radii) sums[radii] += weight_of(near, radii);
            if (sums[CachePass::narrow] == 0.0) return false;
            Rays::Link& link = links[i];
            link.weight = glm::vec3(weight);
            link.bounce = static_cast<std::uint32_t>(bounce);
            const double choice = work.samplers[i].next();
            for (std::size_t radii = 0; radii < 2; ++radii) {
                double left = choice * sums[radii];
                for (const RecordPlaces::NearRecord& near : work.near) {
                    const double part = weight_of(near, radii);
                    if (part == 0.0) continue;
                    link.record[radii] = near.record;
                    left -= part;
                    if (left < 0.0) break;
                }
            }
            return true;
        },
        [&](std::uint32_t i, std::size_t q, const Rgb& light) {
            rays.light[record].push_back({i, static_cast<std::uint32_t>(q), glm::vec3(light)});
        });
    work.translation.resize(count);
    cells.translation(work.inverse_distances, work.translation);
    for (std::size_t i = 0; i < count; ++i) links[i].translation = glm::vec2(work.translation[i]);
}

std::optional<CachePass> RecordTracer::trace(std::uint64_t pass, std::span<std::uint64_t> counted, std::uint64_t& given_up,
                                             const std::function<bool()>& stop) const {
    CachePass result(*places_, kept_);
    const HemisphereCells& cells = places_->cells();
    const std::size_t records = places_->records().size(), count = cells.size();
    result.brightest_.assign(records, 0);
    if (kept_ == 0) return result;
    Rays rays{std::vector<Rays::Link>(records * count), std::vector<std::vector<Rays::Light>>(records),
              std::vector<float>(records * count, 0.0f)};
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] { return Workspace(counted.size()); });
    std::atomic<bool> stopped = false;
    const auto for_records = [&](std::size_t at_once, const auto& f) {
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, records, at_once), [&](const auto& range) {
            if (stopped || stop()) {
                stopped = true;
                return;
            }
            Workspace& work = workspaces.local();
            for (std::size_t record = range.begin(); record < range.end(); ++record) f(record, work);
        });
        return !stopped;
    };
    if (!for_records(4, [&](std::size_t record, Workspace& work) { send_out(pass, record, rays, work); })) return std::nullopt;
    for (const Workspace& work : workspaces) {
        for (std::size_t q = 0; q < work.rays.size(); ++q) counted[q] += work.rays[q];
        given_up += work.given_up;
    }

    // The irradiance of the record if its rays bring `work.radiance`.
    const auto irradiance = [&](std::size_t record, std::size_t radii, const Workspace& work) {
        Rgb value(0.0), derivative[4] = {Rgb(0.0), Rgb(0.0), Rgb(0.0), Rgb(0.0)};
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb L(work.radiance[radii][i]);
            const Vec2 &turn = cells.rotation(i), move(rays.links[record * count + i].translation);
            value += L;
            derivative[0] += L * turn.x;
            derivative[1] += L * turn.y;
            derivative[2] += L * move.x;
            derivative[3] += L * move.y;
        }
        CachePass::Irradiance E{glm::vec3(value * cells.weight())};
        for (std::size_t j = 0; j < 4; ++j) E.derivative[j] = glm::vec3(derivative[j]);
        return E;
    };
    // Adds the light that a record's rays read from the cache: read(link, radii) returns the sum of what a ray reads.
    const auto reflect = [&](std::size_t record, Workspace& work, const auto& read) {
        for (std::size_t i = 0; i < count; ++i) {
            const Rays::Link& link = rays.links[record * count + i];
            if (link.bounce == 0) continue;
            for (std::size_t radii = 0; radii < 2; ++radii) work.radiance[radii][i] += link.weight * read(link, radii);
        }
    };
    const auto irradiance_read = [&](const Rays::Link& link, std::size_t radii, std::size_t k) {
        return result.of(CachePass::Radii(radii), k)[link.record[radii]].value;
    };
    for (std::size_t k = 1; k <= kept_; ++k) {
        const bool of_rest = has_rest_ && k == kept_;
        const bool goes_on = for_records(16, [&](std::size_t record, Workspace& work) {
            work.radiance[0].assign(count, glm::vec3(0.0f));
            for (const Rays::Light& light : rays.light[record])
                if (of_rest ? light.bounce >= k : light.bounce == k) work.radiance[0][light.ray] += light.radiance;
            work.radiance[1] = work.radiance[0];
            reflect(record, work, [&](const Rays::Link& link, std::size_t radii) {
                glm::vec3 sum(0.0f);
                const std::size_t first = k > link.bounce ? k - link.bounce : 0;
                for (std::size_t j = std::max<std::size_t>(first, 1); j < k && (of_rest || j == first); ++j)
                    sum += irradiance_read(link, radii, j);
                return sum;
            });
            for (std::size_t i = 0; i < count; ++i)
                rays.brightness[record * count + i] += work.radiance[0][i].r + work.radiance[0][i].g + work.radiance[0][i].b;
            for (std::size_t radii = 0; radii < 2; ++radii)
                result.of(CachePass::Radii(radii), k)[record] = irradiance(record, radii, work);
        });
        if (!goes_on) return std::nullopt;
    }
    for (std::size_t record = 0; record < records; ++record) {
        const auto brightness = std::span(rays.brightness).subspan(record * count, count);
        result.brightest_[record] = static_cast<std::uint32_t>(std::ranges::max_element(brightness) - brightness.begin());
    }
    if (!has_rest_) return result;

    // The rest S is c, what was found so far, and what S itself contributes: S = c + A S. The iteration uses only its
    // values; its derivatives are computed at the end.
    std::vector<glm::vec3> S[2], next[2];
    for (std::size_t radii = 0; radii < 2; ++radii) {
        for (const CachePass::Irradiance& c : result.of(CachePass::Radii(radii), kept_)) S[radii].push_back(c.value);
        next[radii].resize(records);
    }
    const auto rest = [&](const Rays::Link& link, std::size_t radii) { return S[radii][link.record[radii]]; };
    std::vector<float> change(records), size(records);
    for (int iteration = 0; records > 0; ++iteration) {
        if (iteration == most_iterations) {
            ++given_up;
            break;
        }
        const bool goes_on = for_records(16, [&](std::size_t record, Workspace&) {
            change[record] = size[record] = 0.0f;
            for (std::size_t radii = 0; radii < 2; ++radii) {
                Rgb sum(0.0);
                for (const Rays::Link& link : std::span(rays.links).subspan(record * count, count))
                    if (link.bounce > 0) sum += Rgb(link.weight * rest(link, radii));
                glm::vec3& value = next[radii][record];
                value = glm::vec3(sum * cells.weight()) + result.of(CachePass::Radii(radii), kept_)[record].value;
                const glm::vec3 moved = glm::abs(value - S[radii][record]);
                for (int c = 0; c < 3; ++c) {
                    change[record] = std::max(change[record], moved[c]);
                    size[record] = std::max(size[record], std::abs(value[c]));
                }
            }
        });
        if (!goes_on) return std::nullopt;
        if (*std::ranges::max_element(change) <= converged * *std::ranges::max_element(size)) break;
        std::ranges::swap(S, next);
    }
    const bool goes_on = for_records(16, [&](std::size_t record, Workspace& work) {
        for (auto& radiance : work.radiance) radiance.assign(count, glm::vec3(0.0f));
        reflect(record, work, rest);
        for (std::size_t radii = 0; radii < 2; ++radii)
            result.of(CachePass::Radii(radii), kept_)[record] += irradiance(record, radii, work);
    });
    return goes_on ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace neumann
