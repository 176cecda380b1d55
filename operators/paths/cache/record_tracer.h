// Fills an irradiance cache pass by pass: every record sends out new rays, and then its bounces are computed one after another,
//
//     E_1 = A L_1,    E_k = A (ρ/π E_{k−1}),    Σ_{k>N} E_k by the same recursion
//
// where A stands for the rays of all records at once. Each ray brings direct light and, from the first diffuse surface with records
// nearby, the E of one of these, chosen at random in proportion to its weight. Only the camera uses derivatives: without them a row
// of A ρ/π is an average, ‖A ρ/π‖∞ ≤ the largest albedo, and the recursion converges where the series is sure to. A record's rays
// serve all its bounces, so that the terms of a pass are those of one matrix. If light comes back to a record, the mean over passes
// is off by a part of about 1 / n, where n is the number of rays of all records.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/cache/record_places.h"
#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/walk_settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

// The irradiance at all records of a pass.
class CachePass {
public:
    // The radii of the records, and radii that are √2 times as large.
    enum Radii { narrow, wide };

    // E and its derivatives along x and y of the record's frame: two with respect to the normal, and two with respect
    // to the position.
    struct Irradiance {
        glm::vec3 value{0.0f};
        glm::vec3 derivative[4] = {glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)};

        glm::vec3 at(const std::array<float, 4>& offset) const {
            glm::vec3 sum = value;
            for (std::size_t i = 0; i < 4; ++i) sum += offset[i] * derivative[i];
            return sum;
        }
        Irradiance& operator+=(const Irradiance& other) {
            value += other.value;
            for (std::size_t i = 0; i < 4; ++i) derivative[i] += other.derivative[i];
            return *this;
        }
    };

    CachePass(const RecordPlaces& places, std::size_t bounces) : places_(&places), bounces_(bounces) {
        for (auto& values : values_) values.resize(bounces * places.records().size());
    }

    // E_1 … E_bounces are kept; if there is a rest, the last is the sum of all from there on.
    std::size_t bounces() const { return bounces_; }
    std::span<Irradiance> of(Radii radii, std::size_t k) {
        const std::size_t records = places_->records().size();
        return std::span(values_[radii]).subspan((k - 1) * records, records);
    }
    std::span<const Irradiance> of(Radii radii, std::size_t k) const { return const_cast<CachePass&>(*this).of(radii, k); }

    // Finds the irradiance at y for each bounce with narrow and with wide radii: E[2 (k − 1)] and E[2 (k − 1) + 1].
    // Returns the record with the largest weight, or nothing if there is none nearby.
    std::optional<std::uint32_t> read(const Vec3& y, const Vec3& n, std::vector<RecordPlaces::NearRecord>& near,
                                      std::span<Rgb> E) const;

    // The ray of a record that brings most light.
    std::uint32_t brightest_ray(std::size_t record) const { return brightest_[record]; }

private:
    friend class RecordTracer;
    const RecordPlaces* places_;
    std::size_t bounces_;
    std::vector<Irradiance> values_[2];  // bounce by bounce
    std::vector<std::uint32_t> brightest_;
};

class RecordTracer {
public:
    // Keeps a reference to the scene.
    RecordTracer(const Scene& scene, std::shared_ptr<const DirectLightSampler> direct, const WalkSettings& walk,
                 std::shared_ptr<const RecordPlaces> places, SamplerKind sampler, std::uint64_t seed);

    // Traces a pass; returns nothing if `stop` returns true. Adds to `rays`, which has N + 2 entries. The same on any
    // number of threads.
    std::optional<CachePass> trace(
        std::uint64_t pass, std::span<std::uint64_t> rays, std::uint64_t& given_up,
        const std::function<bool()>& stop = [] { return false; }) const;

    // Traces one ray of a pass again. Rays are numbered record by record.
    template <class Observer>
    void trace_ray(std::uint64_t pass, std::uint32_t ray, const Observer& observer) const;

private:
    struct Rays;
    struct Workspace;
    void send_out(std::uint64_t pass, std::size_t record, Rays& rays, Workspace& work) const;

    const Scene* scene_;
    std::shared_ptr<const DirectLightSampler> direct_;
    WalkSettings walk_;  // for the rays of records, whose light is reflected once more
    bool has_rest_;
    std::size_t kept_;  // CachePass::bounces()
    std::shared_ptr<const RecordPlaces> places_;
    SamplerKind sampler_;
    std::uint64_t seed_;
    SobolPoints points_;
};

}  // namespace neumann
