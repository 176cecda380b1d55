#include "operators/render/from_fields/field_reader.h"

#include "core/base/hot.h"
#include "core/scene/pass_lights.h"

#include <algorithm>

namespace neumann {

namespace {

// The readings of one field for one pixel. Patches that several share are read once, with the sum of the weights.
class Readings {
public:
    void add(const PatchSpace::Reading& reading, double weight, double of_difference) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double w = reading.weight[i];
            Unknown& u = find(reading.unknown[i]);
            u.weight += weight * w;
            u.of_difference += of_difference * w;
        }
    }
    void add_field(const FieldStack& field, std::size_t first, double* values, double* difference) {
        for (const Unknown& u : unknowns_) {
            if (u.weight != 0.0) field.add(u.number, first, u.weight, values);
            if (u.of_difference != 0.0) field.add(u.number, first, u.of_difference, difference);
        }
        unknowns_.clear();
    }

private:
    struct Unknown {
        std::uint32_t number;
        double weight, of_difference;
    };
    // Only the last entries are searched, because a pixel may see any number of patches.
    Unknown& find(std::uint32_t number) {
        constexpr std::size_t most = 12;
        for (std::size_t i = unknowns_.size(), end = i > most ? i - most : 0; i-- > end;)
            if (unknowns_[i].number == number) return unknowns_[i];
        return unknowns_.emplace_back(number, 0.0, 0.0);
    }

    std::vector<Unknown> unknowns_;
};

}  // namespace

FieldReader::FieldReader(const Scene& scene, FieldReading reading, int bounces, std::uint32_t gather_rays)
    : scene_(scene),
      reading_(reading),
      from_field_(bounces > 0 ? 6 : 3),
      lights_(scene, static_cast<std::size_t>(bounces) + 1),
      gather_(scene, lights_, 3 * (static_cast<std::size_t>(bounces) + 2), from_field_, gather_rays) {}

NEUMANN_HOT RaysByBounce FieldReader::read(const FieldPair& fields, std::span<const PixelSample> samples) const {
    std::vector<PixelRay> seen;
    std::array<std::uint64_t, 3> rays{find_first_points(samples, seen), 0, 0};
    if (shows_patches(reading_)) {
        add_patches(fields, seen);
        return rays;
    }
    for (const PixelRay& l : seen) l.sample->add(0, l.sample->weight * scene_.emitters.emitted(l.x, l.wo));
    std::erase_if(seen, [](const PixelRay& l) { return !l.bsdf; });
    const auto to_gather = reading_ == FieldReading::gather
                               ? seen.begin()
                               : std::stable_partition(seen.begin(), seen.end(), [](const PixelRay& l) { return l.diffuse; });
    // If bounce 1 has no picture, the interpolated fields contain it in the rest.
    rays[1] = lights_.find(from_field_ > 3 ? std::span(seen) : std::span(to_gather, seen.end()));
    add_interpolated(fields, std::span(seen.begin(), to_gather));
    // Gather rays from diffuse points leave out light that comes to these points by links, so it is added here.
    for (const PixelRay& l : std::span(to_gather, seen.end()))
        if (fields.by_links && l.diffuse)
            fields.by_links->kept.add(fields.fine.space().read(l.x, l.wo), from_field_, l.sample->weight, l.sample->values);
    rays[2] = gather_.add(fields, std::span(to_gather, seen.end()));
    return rays;
}

void FieldReader::add_patches(const FieldPair& fields, std::span<const PixelRay> seen) const {
    for (const PixelRay& l : seen) {
        const double weight = l.sample->weight, of_difference = weight * l.sample->difference_weight;
        const std::uint32_t unknown = fields.fine.space().unknown(l.x, l.wo);
        fields.fine.add(unknown, 0, weight, l.sample->values);
        if (!l.sample->difference) continue;
        fields.fine.add(unknown, 0, of_difference, l.sample->difference);
        fields.coarse.add(fields.coarse.space().unknown(l.x, l.wo), 0, -of_difference, l.sample->difference);
    }
}

void FieldReader::add_interpolated(const FieldPair& fields, std::span<const PixelRay> seen) const {
    const FieldStack &fine = fields.by_links ? fields.by_links->fine : fields.fine,
                     &coarse = fields.by_links ? fields.by_links->coarse : fields.coarse;
    Readings of_fine, of_coarse;
    for (std::size_t begin = 0, end = 0; begin < seen.size(); begin = end) {
        double* const values = seen[begin].sample->values;
        double* difference = nullptr;
        for (; end < seen.size() && seen[end].sample->values == values; ++end) {
            const PixelRay& l = seen[end];
            const Patches::ChartPosition place = fields.fine.space().patches().place(l.x);
            const double weight = l.sample->weight, of_difference = weight * l.sample->difference_weight;
            const bool compared = l.sample->difference;
            of_fine.add(fine.space().read(l.x, place, l.wo), weight, compared ? of_difference : 0.0);
            if (!compared) continue;
            difference = l.sample->difference;
            of_coarse.add(coarse.space().read(l.x, place, l.wo), 0.0, -of_difference);
        }
        of_fine.add_field(fine, from_field_, values, difference);
        of_coarse.add_field(coarse, from_field_, values, difference);
    }
}

std::uint64_t FieldReader::find_first_points(std::span<const PixelSample> samples, std::vector<PixelRay>& seen) const {
    constexpr std::size_t packet = RayCaster::packet_size;
    std::uint64_t cast = samples.size();
    seen.reserve(samples.size());
    std::array<SurfacePoint, packet> hits;
    std::array<Ray, packet> rays;
    for (std::size_t begin = 0; begin < samples.size(); begin += packet) {
        const std::size_t n = std::min(packet, samples.size() - begin);
        for (std::size_t i = 0; i < n; ++i) rays[i] = samples[begin + i].ray;
        const std::uint32_t found = scene_.geometry.first_hits(std::span<const Ray>(rays).first(n),
                                                               [&](std::size_t i) -> SurfacePoint& { return hits[i]; });
        for (std::size_t i = 0; i < n; ++i) {
            const bool hit = found >> i & 1u;
            if (scene_.hide_emitters && (!hit || !pass_lights(scene_.emitters, scene_.geometry, rays[i].direction, hits[i], cast)))
                continue;
            if (!hit) {
                if (reading_ == FieldReading::importance) continue;
                hits[i].shape = SurfacePoint::infinity;
                samples[begin + i].add(0, samples[begin + i].weight * scene_.emitters.emitted(hits[i], -rays[i].direction));
                continue;
            }
            PixelRay& l = seen.emplace_back();
            l.sample = &samples[begin + i];
            l.x = hits[i];
            l.wo = -rays[i].direction;
            l.bsdf = scene_.materials.side(l.x, l.wo).bsdf;
            l.diffuse = l.bsdf && lobe(*l.bsdf).kind == Lobe::Kind::diffuse;
            l.takes_all = l.bsdf && has_few_directions(*l.bsdf);
        }
    }
    return cast;
}

}  // namespace neumann
