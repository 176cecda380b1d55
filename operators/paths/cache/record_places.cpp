#include "operators/paths/cache/record_places.h"

#include "core/base/error.h"
#include "core/base/median.h"
#include "core/scene/camera_sample.h"
#include "operators/paths/cache/record_index.h"
#include "operators/paths/cache/record_rays.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace neumann {

namespace {

constexpr std::uint64_t places_stream = 0x7265636f726473ull;  // differs from the seed of the pictures
// The number of paths from the camera whose first diffuse vertices are to be covered: some per pixel, within bounds.
constexpr std::uint32_t paths_a_pixel = 4, fewest_camera_paths = 1u << 14, most_camera_paths = 1u << 18;
constexpr int most_reflections = 16;
// The number of bounces of light, after that from the lights, from which radii are found: later ones are smoother.
constexpr int bounces_looked_at = 2;
// The number of vertices seen by a record that are to be covered, too.
constexpr std::size_t vertices_of_record = 16;
// Vertices that no record reads with e below this get a record. It is below 1 so that records overlap and fade over
// from one to the next.
constexpr double reach_for_cover = 0.8;
constexpr std::size_t fewest_at_once = 16, most_at_once = 512, vertices_at_once = 4096;
// ℓ and the smallest radius, as parts of the median distance of the vertices that are seen from their middle.
constexpr double disk_part = 0.1, smallest_part = 0.005;
// If that distance is below this part of the scene's radius, it says nothing of the size of shapes, and the scene's
// radius is taken instead.
constexpr double smallest_extent = 1e-4;
// The factor for the radii of records that the camera does not read: what they give is averaged over a hemisphere.
constexpr double unseen_radius = 2.0;
// With the Hessian: s, and the largest radius as a part of R.
constexpr double turning_with_hessian = 0.25, part_of_distance = 0.5;
// The sine above the surface of rays that look for objects on it, and the cosine between normals of one surface.
constexpr double rise = 0.05, same_surface = 0.7;
// Records that are read at y lie within this part of their radius above or below the surface at y.
constexpr double flat = 0.2;
// The memory for a ray in a pass and for what it finds.
constexpr double bytes_of_ray = 96.0;

}  // namespace

// A vertex on a diffuse side.
struct RecordPlaces::Vertex {
    SurfacePoint x;
    Frame frame{Vec3(0.0, 0.0, 1.0)};
};

// Chooses the places: vertices that no record covers get a record, in order, many at once.
class RecordPlaces::Placer {
public:
    Placer(const Scene& scene, RecordPlaces& places, SamplerKind sampler, std::uint64_t seed, double memory, const Watch& watch)
        : scene_(scene),
          places_(places),
          direct_(scene, {}),
          sampler_(sampler),
          seed_(seed),
          memory_(memory),
          watch_(watch),
          points_(std::bit_ceil(static_cast<std::uint32_t>(places.cells_.size()))) {}

    void place_seen() {
        std::vector<Vertex> seen = camera_vertices();
        if (seen.empty()) {
            if (scene_.emitters.empty()) return;
            throw InputError("cache keeps records on diffuse surfaces, and paths from the camera meet none; take walk");
        }
        std::vector<Vec3> positions;
        for (const Vertex& vertex : seen) positions.push_back(vertex.x.position);
        const double extent = median_distance(positions), size = scene_.geometry.radius();
        extent_ = extent > smallest_extent * size ? extent : size;
        places_.disk_ = disk_part * extent_;
        for (std::size_t first = 0; first < seen.size(); first += vertices_at_once)
            cover({seen.begin() + static_cast<std::ptrdiff_t>(first),
                   seen.begin() + static_cast<std::ptrdiff_t>(std::min(first + vertices_at_once, seen.size()))},
                  true);
        places_.seen_ = places_.records_.size();
    }
    // Covers the vertices that the records see, and those seen from there.
    void place_unseen() {
        while (!ahead_.empty()) {
            std::vector<Vertex> some(std::move(ahead_));
            ahead_.clear();
            for (std::size_t first = 0; first < some.size(); first += vertices_at_once)
                cover({some.begin() + static_cast<std::ptrdiff_t>(first),
                       some.begin() + static_cast<std::ptrdiff_t>(std::min(first + vertices_at_once, some.size()))},
                      false);
        }
    }

private:
    struct Work {
        PlainWalkers walkers;
        std::vector<Sampler> samplers;
        std::vector<NearRecord> near;
        std::vector<Rgb> radiance;
        std::vector<double> grey, inverse_distances;
        std::vector<Vec2> translation;
        std::vector<std::uint64_t> rays = std::vector<std::uint64_t>(bounces_looked_at + 2);
        std::uint64_t given_up = 0;
    };
    struct Proposal {
        double radius = 0.0;
        Index::Reach reach{};
        std::vector<Vertex> sees;
    };

    // The first diffuse vertices of paths from the camera.
    std::vector<Vertex> camera_vertices() {
        const Film& film = scene_.film;
        const std::uint64_t wanted = std::uint64_t{paths_a_pixel} * static_cast<std::uint64_t>(film.crop_width) *
                                     static_cast<std::uint64_t>(film.crop_height);
        const std::uint32_t count =
            std::bit_floor(static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, fewest_camera_paths, most_camera_paths)));
        const SobolPoints net(count);
        std::vector<std::optional<Vertex>> found(count);
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, count, 256), [&](const auto& range) {
            if (watch_.stop()) return;
            for (std::uint32_t k = range.begin(); k < range.end(); ++k) {
                Sampler sampler(SamplerKind::sobol, net, seed_, 0);
                sampler.start(k);
                const Vec2 u = sampler.next2();
                const CameraSample sample = sample_camera(scene_, film.crop_x + static_cast<int>(u.x * film.crop_width),
                                                          film.crop_y + static_cast<int>(u.y * film.crop_height), sampler);
                found[k] = first_diffuse(sample.ray, sampler);
            }
        });
        if (watch_.stop()) throw Stopped();
        std::vector<Vertex> all;
        for (const auto& vertex : found)
            if (vertex) all.push_back(*vertex);
        return all;
    }
    std::optional<Vertex> first_diffuse(const CameraRay& ray, Sampler& sampler) const {
        SurfacePoint x;
        Vec3 w = ray.direction;
        const auto found = [&](std::size_t) -> SurfacePoint& { return x; };
        bool hit = (scene_.geometry.first_hits(std::span(&ray, 1), found) & 1u) != 0;
        for (int reflections = 0; hit && reflections < most_reflections; ++reflections) {
            const SurfaceSide side = scene_.materials.side(x, -w);
            if (!side.bsdf) break;
            if (diffuse_reflection(side)) return Vertex{x, side.p.frame};
            const BsdfSample next = MaterialContinuation().sample(side, side.p.frame.to_local(-w), sampler);
            if (next.pdf == 0.0) break;
            w = side.p.frame.to_world(next.wi);
            const SurfacePoint from = x;
            hit = (scene_.geometry.first_hits(
                       1, [&](std::size_t) { return std::pair<const SurfacePoint&, const Vec3&>(from, w); }, found) &
                   1u) != 0;
        }
        return std::nullopt;
    }

    bool is_covered(const Vertex& vertex, bool by_seen, std::vector<NearRecord>& near) const {
        places_.find(vertex.x.position, vertex.frame.n, by_seen, reach_for_cover, near);
        return !near.empty();
    }

    void cover(std::vector<Vertex> vertices, bool seen) {
        std::size_t at_once = fewest_at_once;
        std::vector<char> covered;
        for (;;) {
            covered.assign(vertices.size(), 0);
            oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, vertices.size(), 64), [&](const auto& range) {
                std::vector<NearRecord>& near = work_.local().near;
                for (std::size_t i = range.begin(); i < range.end(); ++i) covered[i] = is_covered(vertices[i], seen, near);
            });
            std::size_t left = 0;
            for (std::size_t i = 0; i < vertices.size(); ++i)
                if (!covered[i]) vertices[left++] = vertices[i];
            vertices.resize(left);
            if (vertices.empty()) return;
            const std::size_t some = std::min(at_once, vertices.size());
            std::vector<Proposal> proposals(some);
            oneapi::tbb::parallel_for(std::size_t{0}, some, [&](std::size_t i) {
                if (!watch_.stop()) propose(vertices[i], proposed_ + i, proposals[i], work_.local());
            });
            if (watch_.stop()) throw Stopped();
            proposed_ += some;
            for (std::size_t i = 0; i < some; ++i) {
                if (is_covered(vertices[i], seen, work_.local().near)) continue;
                add(vertices[i], proposals[i], seen);
            }
            vertices.erase(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(some));
            at_once = std::min(2 * at_once, most_at_once);
        }
    }

    void add(const Vertex& vertex, const Proposal& proposal, bool seen) {
        auto& records = places_.records_;
        records.push_back({vertex.x, vertex.frame, clamped(proposal.radius * (seen ? 1.0 : unseen_radius)), seen});
        const double bytes = bytes_of_ray * static_cast<double>(records.size() * places_.cells_.size());
        if (bytes > memory_)
            throw OptionError("accuracy",
                              fmt::format("{:g}: the rays of {} records, and more are needed, take {:.1f} GiB, and {:.1f} may be "
                                          "taken; take a larger number, or fewer directions",
                                          places_.settings_.accuracy, records.size(), bytes / 0x1p30, memory_ / 0x1p30));
        places_.index_->add(records.back(), static_cast<std::uint32_t>(records.size() - 1), proposal.reach);
        ahead_.insert(ahead_.end(), proposal.sees.begin(), proposal.sees.end());
    }
    double clamped(double radius) const { return std::clamp(radius, smallest_part * extent_, extent_); }

    // Traces the rays of a record at the vertex.
    void propose(const Vertex& vertex, std::size_t number, Proposal& proposal, Work& work) {
        const HemisphereCells& cells = places_.cells_;
        const std::size_t count = cells.size();
        const WalkSettings settings{.bounces = bounces_looked_at, .rest_probability = 0.0};
        work.samplers.assign(count, Sampler(sampler_, points_, seed_, pixel_of_record(number)));
        for (std::size_t i = 0; i < count; ++i) work.samplers[i].start(i);
        work.radiance.assign(count, Rgb(0.0));
        work.inverse_distances.assign(count, 0.0);
        leave_record(scene_, cells, vertex.x, vertex.frame, 0, std::span(work.samplers), work.walkers, NoObserver(),
                     [&](std::uint32_t i, const Walker& w) {
                         if (!w.x.is_infinite()) work.inverse_distances[i] = 1.0 / glm::length(w.x.position - vertex.x.position);
                     });
        work.rays[0] += count;
        const std::size_t every = std::max<std::size_t>(count / vertices_of_record, 1);
        std::uint64_t given_up = 0;
        walk_to_records(
            scene_, direct_, settings, std::span(work.samplers), work.walkers, std::span(work.rays), given_up,
            [&](std::uint32_t i, const Walker& w, const Vec3&, const Rgb&, int) {
                if (i % every == 0) proposal.sees.push_back({w.x, scene_.materials.side(w.x, w.wo).p.frame});
                return false;
            },
            [&](std::uint32_t i, std::size_t, const Rgb& light) { work.radiance[i] += light; });
        proposal.radius = radius(work);
        proposal.reach = reach(vertex);
    }

    // Finds the reach by rays that just rise above the surface. A surface that bends up with it is not an object on it.
    Index::Reach reach(const Vertex& vertex) const {
        constexpr std::size_t sectors = Index::sectors;
        std::array<double, sectors> free{};
        for (std::size_t k = 0; k < sectors; ++k) {
            const Vec2 u = direction_on_circle(static_cast<double>(k) / sectors) * std::sqrt(1.0 - rise * rise);
            const Vec3 w = vertex.frame.to_world(Vec3(u, rise));
            SurfacePoint y;
            const bool hit = (scene_.geometry.first_hits(
                                  1, [&](std::size_t) { return std::pair<const SurfacePoint&, const Vec3&>(vertex.x, w); },
                                  [&](std::size_t) -> SurfacePoint& { return y; }) &
                              1u) != 0;
            const double facing = hit ? glm::dot(y.normal, vertex.frame.n) * (glm::dot(y.normal, w) > 0.0 ? -1.0 : 1.0) : 1.0;
            free[k] = facing < same_surface ? glm::length(y.position - vertex.x.position) : std::numeric_limits<double>::infinity();
        }
        Index::Reach found{};
        for (std::size_t k = 0; k < sectors; ++k) found[k] = static_cast<float>(std::min(free[k], free[(k + 1) % sectors]));
        return found;
    }

    double radius(Work& work) const {
        const HemisphereCells& cells = places_.cells_;
        const std::size_t count = cells.size();
        work.grey.clear();
        double sum = 0.0, inverse_sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            work.grey.push_back(mean_component(work.radiance[i]));
            sum += work.grey.back();
            inverse_sum += work.inverse_distances[i];
        }
        work.translation.resize(count);
        cells.translation(work.inverse_distances, work.translation);
        Vec2 gradient(0.0);
        for (std::size_t i = 0; i < count; ++i) gradient += work.translation[i] * work.grey[i];
        const double E = cells.weight() * sum, steep = glm::length(gradient);
        const double by_gradient = steep > 0.0 ? E / steep : std::numeric_limits<double>::infinity(),
                     distance =
                         inverse_sum > 0.0 ? static_cast<double>(count) / inverse_sum : std::numeric_limits<double>::infinity();
        const CacheSettings& settings = places_.settings_;
        if (settings.spacing == Spacing::split_sphere) return std::min(settings.accuracy * distance, by_gradient);
        const Vec3 h = cells.hessian(work.grey, work.inverse_distances);
        // |λ1| + |λ2| of (h.x, h.y; h.y, h.z).
        const double mean = 0.5 * (h.x + h.z), spread = std::hypot(0.5 * (h.x - h.z), h.y),
                     curvature = 2.0 * std::max(std::abs(mean), spread);
        const double by_distance = part_of_distance * distance;
        if (!(curvature > 0.0)) return by_distance;  // also if no light was found
        const double by_hessian = std::sqrt(std::sqrt(8.0 * settings.accuracy * E / curvature) * places_.disk_);
        return std::min({by_hessian, by_gradient, by_distance});
    }

    const Scene& scene_;
    RecordPlaces& places_;
    DirectLightSampler direct_;
    SamplerKind sampler_;
    std::uint64_t seed_;
    double memory_;
    const Watch& watch_;
    SobolPoints points_;
    double extent_ = 1.0;
    std::size_t proposed_ = 0;
    std::vector<Vertex> ahead_;  // vertices that records see
    oneapi::tbb::enumerable_thread_specific<Work> work_;

public:
    std::uint64_t rays() {
        std::uint64_t sum = 0;
        for (const Work& work : work_)
            for (const std::uint64_t n : work.rays) sum += n;
        return sum;
    }
};

RecordPlaces::RecordPlaces(const Scene& scene, const CacheSettings& settings, SamplerKind sampler, std::uint64_t seed,
                           double memory, const Watch& watch)
    : settings_(settings),
      cells_(settings.rays),
      index_(std::make_unique<Index>()),
      turning_(settings.spacing == Spacing::split_sphere ? settings.accuracy : turning_with_hessian) {
    Placer placer(scene, *this, sampler, seed ^ places_stream, memory, watch);
    placer.place_seen();
    placer.place_unseen();
    rays_ = placer.rays();
}

RecordPlaces::~RecordPlaces() = default;

void RecordPlaces::find(const Vec3& y, const Vec3& n, bool only_seen, double most, std::vector<NearRecord>& near) const {
    near.clear();
    index_->for_near(y, [&](std::uint32_t number) {
        const Record& record = records_[number];
        if (only_seen && !record.is_seen) return;
        const Frame& frame = record.frame;
        const Vec3 d = y - record.x.position;
        const double turned = glm::dot(n, frame.n);
        if (turned <= 0.0 || std::max(std::abs(glm::dot(d, n)), std::abs(glm::dot(d, frame.n))) > flat * record.radius) return;
        const double error = glm::length(d) / record.radius + std::sqrt(std::max(1.0 - turned, 0.0)) / turning_;
        if (error >= most || !index_->reaches(number, glm::dot(d, frame.s), glm::dot(d, frame.t))) return;
        near.push_back({number,
                        static_cast<float>(error),
                        {static_cast<float>(glm::dot(n, frame.s)), static_cast<float>(glm::dot(n, frame.t)),
                         static_cast<float>(glm::dot(d, frame.s)), static_cast<float>(glm::dot(d, frame.t))}});
    });
}

}  // namespace neumann
