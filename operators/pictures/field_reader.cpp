#include "operators/pictures/field_reader.h"

#include "core/base/frame.h"
#include "core/base/hot.h"
#include "core/sampling/heuristic.h"
#include "core/scene/pass_lights.h"
#include "operators/matrix/sides.h"
#include "operators/pointwise/basic_reflection.h"

#include <algorithm>

namespace neumann {

namespace {

constexpr std::size_t packet = RayCaster::packet_size;
// A gather ray follows at most so many mirrors if these have unknowns, and then reads the patches; without unknowns it goes on, by
// Russian roulette beyond the last bounce.
constexpr std::uint32_t most_mirrors_with_unknowns = 16, most_links = 1000;
// A ray that takes all directions takes part in Russian roulette below this part of its sample.
constexpr double least_share = 0.01;

// Casts n rays in packets and calls each(i); from(i) and hit(i) are as in Geometry::first_hits. The point is at infinity if nothing
// is hit.
template <class From, class Hit, class Each>
void for_hits(const Geometry& geometry, std::size_t n, const From& from, const Hit& hit, const Each& each) {
    for (std::size_t begin = 0; begin < n; begin += packet) {
        const std::size_t some = std::min(packet, n - begin);
        const std::uint32_t found = geometry.first_hits(
            some, [&](std::size_t i) { return from(begin + i); }, [&](std::size_t i) -> SurfacePoint& { return hit(begin + i); });
        for (std::size_t i = 0; i < some; ++i) {
            if (!(found >> i & 1u)) hit(begin + i).shape = SurfacePoint::infinity;
            each(begin + i);
        }
    }
}

// Mirrors and smooth glass: all light goes in one direction or two.
bool has_few_directions(const Bsdf& bsdf) { return choice(bsdf, Vec3(0.0, 0.0, 1.0)).has_value(); }

void add(float* to, std::size_t bounce, const Rgb& x) {
    for (int c = 0; c < 3; ++c) to[3 * bounce + static_cast<std::size_t>(c)] += static_cast<float>(x[c]);
}

// Adds `scale` times the quantities of a field at a point, starting with the `first`-th float.
void add_interpolated(const FieldStack& field, const SurfacePoint& p, const Patches::Place& place, const Vec3& w, std::size_t first,
                      float scale, float* __restrict to) {
    const PatchSpace::Reading reading = field.space().read(p, place, w);
    const float* __restrict a = field[reading.unknown[0]];
    const float* __restrict b = field[reading.unknown[1]];
    const float* __restrict c = field[reading.unknown[2]];
    const float* __restrict d = field[reading.unknown[3]];
    const auto wa = scale * static_cast<float>(reading.weight[0]), wb = scale * static_cast<float>(reading.weight[1]),
               wc = scale * static_cast<float>(reading.weight[2]), wd = scale * static_cast<float>(reading.weight[3]);
    const std::size_t end = field.stride();
    for (std::size_t k = first; k < end; ++k) to[k] += (wa * a[k] + wb * b[k]) + (wc * c[k] + wd * d[k]);
}

void add_constant(const FieldStack& field, const SurfacePoint& p, const Vec3& w, float scale, float* to) {
    const float* values = field[field.space().unknown(p, w)];
    for (std::size_t k = 0; k < field.stride(); ++k) to[k] += scale * values[k];
}

// to[k] += weight · from[k − 3]: each quantity gets the previous one.
void add_reflected(const Rgb& weight, const float* __restrict from, std::size_t first, std::size_t end, float* __restrict to) {
    const float w[3] = {static_cast<float>(weight.r), static_cast<float>(weight.g), static_cast<float>(weight.b)};
    for (std::size_t k = first; k < end; k += 3)
        for (std::size_t c = 0; c < 3; ++c) to[k + c] += w[c] * from[k + c - 3];
}

}  // namespace

struct FieldReader::Look {
    const PixelSample* sample;
    SurfacePoint x, y;  // the point that is seen, and the point that lights it
    Vec3 wo, wi;
    const Bsdf* bsdf;  // of the side that is seen; null if it absorbs
    bool diffuse;
    Rgb weight;
    double pdf;
    // For a gather ray: its throughput, and the number of links (operators/matrix/links.h): of mirrors and other sides from which
    // it went on.
    Rgb through;
    std::uint32_t links = 0;
    bool goes_on;
    // All vertices so far send light in two directions at most, and the ray has taken all of them, in copies of itself.
    bool takes_all = false;
    double compared_part = 1.0;  // of its rays, that are compared with coarser patches: the inverse

    void go_on_with_probability(double p, Sampler& sampler) {
        if (p >= 1.0) return;
        goes_on = goes_on && sampler.next() < p;
        through /= p;
    }
    double rays(double of_others) const { return takes_all ? 1.0 : of_others; }

    // Samples wi from the BSDF, with its pdf and the weight for basic radiance; false if nothing is reflected.
    bool choose_direction(const Materials& materials, Sampler& sampler) {
        const SurfaceSide side = materials.side(x, wo);
        if (!side.bsdf) return false;
        set(BasicReflection::sample(materials, side, wo, sampler.next2()));
        return pdf != 0.0;
    }
    void set(const BasicReflection& sampled) {
        wi = sampled.wi;
        weight = sampled.weight;
        pdf = sampled.pdf;
    }
    // Takes the directions of a material that has two at most: the first itself, and the second by a copy in `others`.
    bool take_all(const Materials& materials, std::vector<Look>& others) {
        const SurfaceSide side = materials.side(x, wo);
        const auto first = side.bsdf ? choice(*side.bsdf, side.p.frame.to_local(wo)) : std::nullopt;
        if (!first) return takes_all = false;
        constexpr double last = 1.0 - 0x1p-53;
        if (*first > 0.0 && *first < 1.0) {
            Look& other = others.emplace_back(*this);
            other.set(BasicReflection::sample(materials, side, wo, {last, 0.5}));
            other.weight *= 1.0 - *first;
            other.through *= other.weight;
        }
        set(BasicReflection::sample(materials, side, wo, {0.0, 0.5}));
        if (*first > 0.0) weight *= *first;
        through *= weight;
        return true;
    }
};

FieldReader::FieldReader(const Scene& scene, FieldReading reading, int bounces, std::uint32_t gather_rays)
    : scene_(scene),
      reading_(reading),
      stride_(3 * (static_cast<std::size_t>(bounces) + 2)),
      from_field_(bounces > 0 ? 6 : 3),
      lights_(scene.geometry, scene.emitters),
      gather_rays_(gather_rays),
      compared_((gather_rays + 3) / 4) {
    if (scene.emitters.empty()) return;
    if (scene.emitters.has_environment()) {
        near_ = std::numeric_limits<double>::infinity();
        return;
    }
    const SobolPoints points(256);
    Sampler sampler(points, 0, 0);
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sampler.start(i);
        const LightSample light = lights_.sample(scene.geometry.center(), sampler.next2());
        if (light.pdf == delta_pdf) continue;
        low = glm::min(low, light.point.position);
        high = glm::max(high, light.point.position);
    }
    if (low.x > high.x) return;  // no light has an extent
    low_ = low;
    high_ = high;
    near_ = glm::length(high_ - low_);
}

NEUMANN_HOT std::array<std::uint64_t, 3> FieldReader::read(const FieldPair& fields, std::span<const PixelSample> samples) const {
    std::vector<Look> looks;
    std::array<std::uint64_t, 3> rays{find_first_points(samples, looks), 0, 0};
    if (shows_patches(reading_)) {
        for (const Look& l : looks) {
            const auto weight = static_cast<float>(l.sample->weight), of_difference = weight * l.sample->difference_weight;
            add_constant(fields.fine, l.x, l.wo, weight, l.sample->values);
            if (!l.sample->difference) continue;
            add_constant(fields.fine, l.x, l.wo, of_difference, l.sample->difference);
            add_constant(fields.coarse, l.x, l.wo, -of_difference, l.sample->difference);
        }
        return rays;
    }
    for (const Look& l : looks) add(l.sample->values, 0, l.sample->weight * scene_.emitters.emitted(l.x, l.wo));
    std::erase_if(looks, [](const Look& l) { return !l.bsdf; });
    if (from_field_ > 3) rays[1] = find_lights(looks) + find_lights_by_chance(looks);
    const auto to_gather = reading_ == FieldReading::gather
                               ? looks.begin()
                               : std::stable_partition(looks.begin(), looks.end(), [](const Look& l) { return l.diffuse; });
    const FieldStack &fine = fields.by_links ? fields.by_links->fine : fields.fine,
                     &coarse = fields.by_links ? fields.by_links->coarse : fields.coarse;
    for (const Look& l : std::span(looks.begin(), to_gather)) {
        const Patches::Place place = fields.fine.space().patches().place(l.x);
        const auto weight = static_cast<float>(l.sample->weight), of_difference = weight * l.sample->difference_weight;
        add_interpolated(fine, l.x, place, l.wo, from_field_, weight, l.sample->values);
        if (!l.sample->difference) continue;
        add_interpolated(fine, l.x, place, l.wo, from_field_, of_difference, l.sample->difference);
        add_interpolated(coarse, l.x, place, l.wo, from_field_, -of_difference, l.sample->difference);
    }
    // Gather rays from diffuse points leave out what comes to these by links.
    for (const Look& l : std::span(to_gather, looks.end()))
        if (fields.by_links && l.diffuse)
            add_interpolated(fields.by_links->kept, l.x, fields.fine.space().patches().place(l.x), l.wo, from_field_,
                             static_cast<float>(l.sample->weight), l.sample->values);
    rays[2] = gather(fields, std::span(to_gather, looks.end()));
    return rays;
}

std::uint64_t FieldReader::find_first_points(std::span<const PixelSample> samples, std::vector<Look>& looks) const {
    std::uint64_t cast = samples.size();
    looks.reserve(samples.size());
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
                add(samples[begin + i].values, 0, samples[begin + i].weight * scene_.emitters.emitted(hits[i], -rays[i].direction));
                continue;
            }
            Look& l = looks.emplace_back();
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

// Direct light by points on lights.
std::uint64_t FieldReader::find_lights(std::vector<Look>& looks) const {
    if (lights_.empty()) return 0;
    std::vector<Look*> asking;
    for (Look& l : looks)
        if (ask_light(l, *l.sample->sampler, Rgb(l.sample->weight), looks_for_lights(l))) asking.push_back(&l);
    add_visible(asking);
    return asking.size();
}

// Chooses a point on a light and sets y and the weight of what it brings; false if it brings nothing.
bool FieldReader::ask_light(Look& l, Sampler& sampler, const Rgb& scale, bool asks_directions_too) const {
    const LightSample light = lights_.sample(l.x.position, sampler.next2());
    if (!(light.pdf > 0.0)) return false;
    const SurfaceSide side = scene_.materials.side(l.x, l.wo);
    if (!side.bsdf) return false;
    const Vec3 wo = side.p.frame.to_local(l.wo), wi = side.p.frame.to_local(light.w);
    const double pdf_other = asks_directions_too ? pdf(*side.bsdf, side.p, wo, wi) : 0.0;
    l.weight = eval(*side.bsdf, side.p, wo, wi) * light.weight * scale * (std::abs(wi.z) * power_heuristic(light.pdf, pdf_other));
    l.y = light.point;
    return !is_black(l.weight);
}

// Adds the light that is asked for, where it is visible.
void FieldReader::add_visible(std::span<Look* const> asking) const {
    for (std::size_t begin = 0; begin < asking.size(); begin += packet) {
        const std::size_t n = std::min(packet, asking.size() - begin);
        const std::uint32_t seen = scene_.geometry.visible(
            n,
            [&](std::size_t i) {
                return std::pair<const SurfacePoint&, const SurfacePoint&>(asking[begin + i]->x, asking[begin + i]->y);
            },
            RayCaster::Rays::alike);
        for (std::size_t i = 0; i < n; ++i)
            if (seen >> i & 1u) {
                const Look& l = *asking[begin + i];
                add(l.sample->values, bounce_of(l), l.weight);
            }
    }
}

// Direct light by BSDF sampling.
std::uint64_t FieldReader::find_lights_by_chance(std::vector<Look>& looks) const {
    const Emitters& emitters = scene_.emitters;
    std::vector<Look*> asking;
    for (Look& l : looks) {
        // The others find theirs when they take all directions.
        if (!emitters.empty() && !l.takes_all && looks_for_lights(l) && l.choose_direction(scene_.materials, *l.sample->sampler))
            asking.push_back(&l);
    }
    for_hits(
        scene_.geometry, asking.size(),
        [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(asking[i]->x, asking[i]->wi); },
        [&](std::size_t i) -> SurfacePoint& { return asking[i]->y; },
        [&](std::size_t i) {
            const Look& l = *asking[i];
            const Rgb emitted = emitters.emitted(l.y, -l.wi);
            if (is_black(emitted)) return;
            add(l.sample->values, 1,
                l.weight * emitted * (l.sample->weight * power_heuristic(l.pdf, lights_.pdf(l.x.position, l.wi, l.y))));
        });
    return asking.size();
}

// Whether BSDF sampling is used as well: near the lights (closer than the size of their box), where the variance of points on them
// may be infinite, and if the material is not diffuse. The choice depends on x alone, so the estimate stays unbiased.
bool FieldReader::looks_for_lights(const Look& l) const {
    return !l.diffuse || glm::distance(l.x.position, glm::clamp(l.x.position, low_, high_)) < near_;
}

NEUMANN_HOT std::uint64_t FieldReader::gather(const FieldPair& fields, std::span<const Look> looks) const {
    std::vector<float> arriving(stride_);
    const std::size_t rest = stride_ - 3;
    // Bounce i is K times bounce i − 1, and the rest is K times the sum of bounce N and the rest. `by_links` adds to the field.
    const auto arrive = [&](const FieldStack& field, const Look& l, const Patches::Place& place, const FieldStack* replaced,
                            std::span<const float> by_links) {
        std::fill(arriving.begin(), arriving.end(), 0.0f);
        // Linear interpolation between the patches' centres does not preserve their means; it would lose up to some percent of a
        // bounce. A diffuse surface can gather the piecewise constant field, because patches do not show there.
        if (l.diffuse)
            add_constant(field, l.y, -l.wi, 1.0f, arriving.data());
        else
            add_interpolated(field, l.y, place, -l.wi, 0, 1.0f, arriving.data());
        if (replaced) {
            add_interpolated(*replaced, l.y, place, -l.wi, 6, -1.0f, arriving.data());
            const SurfaceSide side = scene_.materials.side(l.y, -l.wi);
            const Rgb rho = reflectance(*side.bsdf, side.p);
            for (std::size_t k = 0; k < by_links.size(); ++k)
                arriving[6 + k] += static_cast<float>(rho[static_cast<int>(k % 3)]) * by_links[k];
        }
        const auto take_in_last = [&] {
            for (std::size_t c = 0; c < 3; ++c) arriving[rest - 3 + c] += arriving[rest + c];
        };
        // Lights at the end of links are found without the field.
        if (l.links > 0) std::fill_n(arriving.begin(), 3, 0.0f);
        for (std::uint32_t link = 0; link < std::min<std::uint32_t>(l.links, static_cast<std::uint32_t>(stride_)); ++link) {
            take_in_last();
            std::copy_backward(arriving.begin(), arriving.end() - 3, arriving.end());
            std::fill_n(arriving.begin(), 3, 0.0f);
        }
        take_in_last();
    };
    std::uint64_t rays = 0;
    std::vector<Look> asking, others;
    bool compare = true;
    const auto skips_lights = [&](const Look& l) { return l.diffuse && fields.by_links; };
    const auto read_or_go_on = [&](std::size_t i) {
        Look& l = asking[i];
        // The direct light at other first vertices is already sampled (bounce 1).
        if (const Rgb emitted = (l.links > 0 || (l.takes_all && from_field_ > 3)) && !skips_lights(l)
                                    ? scene_.emitters.emitted(l.y, -l.wi)
                                    : Rgb(0.0);
            !is_black(emitted)) {
            const double weight = l.pdf == delta_pdf ? 1.0 : power_heuristic(l.pdf, lights_.pdf(l.x.position, l.wi, l.y));
            add(l.sample->values, bounce_of(l), l.through * emitted * weight);
        }
        if (l.y.is_infinite()) return;
        const Bsdf* bsdf = scene_.materials.side(l.y, -l.wi).bsdf;
        const bool has_unknown = fields.fine.space().unknown(l.y, -l.wi) != fields.fine.space().nothing();
        if (has_unknown ? l.links < most_mirrors_with_unknowns && bsdf && lobe(*bsdf).kind == Lobe::Kind::specular
                        : l.links < most_links && is_glossy(bsdf)) {
            l.x = l.y;
            l.wo = -l.wi;
            l.bsdf = bsdf;
            ++l.links;
            l.goes_on = true;
            return;
        }
        if (!has_unknown) return;
        const Patches::Place place = fields.fine.space().patches().place(l.y);
        const bool reads_raster = !l.diffuse && fields.by_links && bsdf && !is_glossy(bsdf);
        LinkRaster::Reading by_links;
        if (reads_raster) by_links = fields.by_links->raster.read(place.chart, glm::dot(l.y.normal, l.wi) < 0.0, place.st);
        arrive(fields.fine, l, place, reads_raster ? &fields.by_links->fine_replaced : nullptr, by_links.fine);
        add_reflected(l.through, arriving.data(), from_field_, stride_, l.sample->values);
        if (!compare || !l.sample->difference) return;
        const Rgb weight = l.through * (l.sample->difference_weight * l.compared_part);
        add_reflected(weight, arriving.data(), from_field_, stride_, l.sample->difference);
        arrive(fields.coarse, l, place, reads_raster ? &fields.by_links->coarse_replaced : nullptr, by_links.coarse);
        add_reflected(-weight, arriving.data(), from_field_, stride_, l.sample->difference);
    };
    for (std::uint32_t r = 0; r < gather_rays_; ++r) {
        compare = r < compared_;
        asking.clear();
        for (const Look& look : looks) {
            if (r > 0 && look.takes_all) continue;  // all its rays would be the same
            Look& l = asking.emplace_back(look);
            l.goes_on = true;
            l.through = Rgb(l.sample->weight / l.rays(gather_rays_));
            l.compared_part = l.takes_all ? 1.0 : static_cast<double>(gather_rays_) / compared_;
        }
        for (;;) {
            rays += find_lights_at_links(asking, skips_lights);
            others.clear();
            std::erase_if(asking, [](const Look& l) { return !l.goes_on; });
            for (Look& l : asking) {
                Sampler& sampler = *l.sample->gather_sampler;
                if (l.links == 0) sampler.start(l.sample->first_gather_ray + r);
                const bool beyond = l.links >= stride_ / 3 - 1;
                if (l.takes_all && !beyond && l.take_all(scene_.materials, others)) continue;
                l.goes_on = l.choose_direction(scene_.materials, sampler);
                l.through *= l.weight;
                if (beyond) l.go_on_with_probability(std::min(max_component(l.weight), 1.0), sampler);
            }
            asking.insert(asking.end(), others.begin(), others.end());
            for (Look& l : asking)
                if (l.takes_all)
                    l.go_on_with_probability(
                        std::min(max_component(glm::abs(l.through)) / (least_share * std::abs(l.sample->weight)), 1.0),
                        *l.sample->gather_sampler);
            std::erase_if(asking, [](const Look& l) { return !l.goes_on; });
            if (asking.empty()) break;
            rays += asking.size();
            for (Look& l : asking) l.goes_on = false;
            for_hits(
                scene_.geometry, asking.size(),
                [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(asking[i].x, asking[i].wi); },
                [&](std::size_t i) -> SurfacePoint& { return asking[i].y; }, read_or_go_on);
        }
    }
    return rays;
}

// Direct light at links that have other directions than those of mirrors and glass; chance finds it too, when the next ray meets a
// light.
template <class Skips>
std::uint64_t FieldReader::find_lights_at_links(std::span<Look> looks, const Skips& skips) const {
    if (lights_.empty()) return 0;
    std::vector<Look*> asking;
    for (Look& l : looks)
        if (l.goes_on && l.links > 0 && !skips(l) && !has_few_directions(*l.bsdf) &&
            ask_light(l, *l.sample->gather_sampler, l.through, true))
            asking.push_back(&l);
    add_visible(asking);
    return asking.size();
}

// The bounce of the light that a gather ray finds at its last vertex.
std::size_t FieldReader::bounce_of(const Look& l) const { return std::min<std::size_t>(l.links + 1, stride_ / 3 - 1); }

}  // namespace neumann
