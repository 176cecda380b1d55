#include "operators/render/from_fields/field_gather.h"

#include "core/base/hot.h"
#include "core/sampling/heuristic.h"
#include "operators/fields/matrix/sides.h"

#include <algorithm>

namespace neumann {

namespace {

// The longest chain of mirrors that a gather ray follows. If mirrors have unknowns, it reads the patches at the end of
// the chain; otherwise it goes on, by Russian roulette beyond the last bounce.
constexpr std::uint32_t most_mirrors_with_unknowns = 16, most_links = 1000;
// A ray that takes all directions takes part in Russian roulette below this share of its sample.
constexpr double least_share = 0.01;

// to[k] += weight · from[k − 3]: each quantity gets the previous one.
void add_reflected(const Rgb& weight, const double* __restrict from, std::size_t first, std::size_t end, double* __restrict to) {
    const double w[3] = {weight.r, weight.g, weight.b};
    for (std::size_t k = first; k < end; k += 3)
        for (std::size_t c = 0; c < 3; ++c) to[k + c] += w[c] * from[k + c - 3];
}

// Whether light that comes by links to the start of this ray is left out of what the ray reads; it is added separately.
bool leaves_out_links(const PixelRay& l, const FieldPair& fields) { return l.diffuse && fields.by_links; }

}  // namespace

FieldGather::FieldGather(const Scene& scene, const PixelLights& lights, std::size_t stride, std::size_t from_field,
                         std::uint32_t rays)
    : scene_(scene), lights_(lights), stride_(stride), from_field_(from_field), rays_(rays), compared_((rays + 3) / 4) {}

NEUMANN_FLAT std::uint64_t FieldGather::add(const FieldPair& fields, std::span<const PixelRay> seen) const {
    std::uint64_t rays = 0;
    std::vector<double> arriving(stride_);
    std::vector<PixelRay> active;
    for (std::uint32_t r = 0; r < rays_; ++r) {
        active.clear();
        for (const PixelRay& look : seen) {
            if (r > 0 && look.takes_all) continue;  // all its rays would be the same
            PixelRay& l = active.emplace_back(look);
            l.goes_on = true;
            l.through = Rgb(l.sample->weight / l.rays(rays_));
            l.compared_part = l.takes_all ? 1.0 : static_cast<double>(rays_) / compared_;
        }
        for (;;) {
            rays += sample_lights_at_links(active, fields);
            choose_directions(active, r);
            if (active.empty()) break;
            rays += active.size();
            for (PixelRay& l : active) l.goes_on = false;
            for_hits(
                scene_.geometry, active.size(),
                [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(active[i].x, active[i].wi); },
                [&](std::size_t i) -> SurfacePoint& { return active[i].y; },
                [&](std::size_t i) { read_or_go_on(active[i], fields, r < compared_, arriving); });
        }
    }
    return rays;
}

std::uint64_t FieldGather::sample_lights_at_links(std::span<PixelRay> seen, const FieldPair& fields) const {
    std::vector<PixelRay*> active;
    for (PixelRay& l : seen)
        if (l.goes_on && l.links > 0 && !leaves_out_links(l, fields) && !has_few_directions(*l.bsdf)) active.push_back(&l);
    return lights_.find_at_links(active);
}

// Chooses directions for the rays that go on and removes the others.
void FieldGather::choose_directions(std::vector<PixelRay>& seen, std::uint32_t ray) const {
    std::vector<PixelRay> others;
    std::erase_if(seen, [](const PixelRay& l) { return !l.goes_on; });
    for (PixelRay& l : seen) {
        Sampler& sampler = *l.sample->gather_sampler;
        if (l.links == 0) sampler.start(l.sample->first_gather_ray + ray);
        const bool beyond = l.links >= stride_ / 3 - 1;
        if (l.takes_all && !beyond && l.take_all(scene_.materials, others)) continue;
        l.goes_on = l.choose_direction(scene_.materials, sampler);
        l.through *= l.weight;
        if (beyond) l.go_on_with_probability(std::min(max_component(l.weight), 1.0), sampler);
    }
    seen.insert(seen.end(), others.begin(), others.end());
    for (PixelRay& l : seen)
        if (l.takes_all)
            l.go_on_with_probability(std::min(max_component(glm::abs(l.through)) / (least_share * std::abs(l.sample->weight)), 1.0),
                                     *l.sample->gather_sampler);
    std::erase_if(seen, [](const PixelRay& l) { return !l.goes_on; });
}

// Ends a ray: adds the light that it brings, or makes it start again at the point it has reached.
void FieldGather::read_or_go_on(PixelRay& l, const FieldPair& fields, bool compares, std::vector<double>& arriving) const {
    // The direct light at first vertices that are not specular is already sampled (bounce 1).
    if (const Rgb emitted =
            (l.links > 0 || l.takes_all) && !leaves_out_links(l, fields) ? scene_.emitters.emitted(l.y, -l.wi) : Rgb(0.0);
        !is_black(emitted)) {
        const double weight = l.pdf == delta_pdf ? 1.0 : power_heuristic(l.pdf, lights_.pdf(l.x.position, l.wi, l.y));
        l.sample->add(lights_.bounce_of(l), l.through * emitted * (weight / (l.index_beyond * l.index_beyond)));
    }
    if (l.y.is_infinite()) return;
    const PatchSpace& space = fields.fine.space();
    const Bsdf* bsdf = scene_.materials.side(l.y, -l.wi).bsdf;
    const bool has_unknown = space.unknown(l.y, -l.wi) != space.nothing();
    if (has_unknown ? l.links < most_mirrors_with_unknowns && bsdf && lobe(*bsdf).kind == Lobe::Kind::specular
                    : l.links < most_links && is_glossy(bsdf)) {
        l.x = l.y;
        l.wo = -l.wi;
        l.bsdf = bsdf;
        l.index = l.index_beyond;
        ++l.links;
        l.goes_on = true;
        return;
    }
    if (!has_unknown) return;
    const Patches::ChartPosition place = space.patches().place(l.y);
    const bool reads_raster = !l.diffuse && fields.by_links && bsdf && !is_glossy(bsdf);
    LinkRaster::Reading by_links;
    if (reads_raster)
        by_links = fields.by_links->raster.read(place.chart, space.is_front(l.y, -l.wi),
                                                LinkRaster::spread(space.patches().charts()[place.chart], place.st));
    arrive(fields.fine, l, place, reads_raster ? &fields.by_links->fine_replaced : nullptr, by_links.fine, arriving);
    add_reflected(l.through, arriving.data(), from_field_, stride_, l.sample->values);
    if (!compares || !l.sample->difference) return;
    const Rgb weight = l.through * (l.sample->difference_weight * l.compared_part);
    add_reflected(weight, arriving.data(), from_field_, stride_, l.sample->difference);
    arrive(fields.coarse, l, place, reads_raster ? &fields.by_links->coarse_replaced : nullptr, by_links.coarse, arriving);
    add_reflected(-weight, arriving.data(), from_field_, stride_, l.sample->difference);
}

// Sets `arriving`: bounce i is K times bounce i − 1 of the field, and the rest is K times the sum of its bounce N and
// rest. `by_links` is added to the field in the place of `replaced`.
void FieldGather::arrive(const FieldStack& field, const PixelRay& l, const Patches::ChartPosition& place,
                         const FieldStack* replaced, std::span<const float> by_links, std::vector<double>& arriving) const {
    const std::size_t rest = stride_ - 3;
    std::fill(arriving.begin(), arriving.end(), 0.0);
    // Linear interpolation between the centres of patches does not preserve their means and would lose up to some percent of a
    // bounce. A diffuse surface can gather the piecewise constant field, because patches do not show there.
    if (l.diffuse)
        field.add(field.space().unknown(l.y, -l.wi), 0, 1.0, arriving.data());
    else
        field.add(field.space().read(l.y, place, -l.wi), 0, 1.0, arriving.data());
    if (replaced) {
        replaced->add(replaced->space().read(l.y, place, -l.wi), 6, -1.0, arriving.data());
        const SurfaceSide side = scene_.materials.side(l.y, -l.wi);
        const Rgb rho = reflectance(*side.bsdf, side.p);
        for (std::size_t k = 0; k < by_links.size(); ++k) arriving[6 + k] += rho[static_cast<int>(k % 3)] * double{by_links[k]};
    }
    const auto take_in_last = [&] {
        for (std::size_t c = 0; c < 3; ++c) arriving[rest - 3 + c] += arriving[rest + c];
    };
    // Emitted light is found at the lights; the field has none from afar.
    std::fill_n(arriving.begin(), 3, 0.0);
    for (std::uint32_t link = 0; link < std::min<std::uint32_t>(l.links, static_cast<std::uint32_t>(stride_)); ++link) {
        take_in_last();
        std::copy_backward(arriving.begin(), arriving.end() - 3, arriving.end());
        std::fill_n(arriving.begin(), 3, 0.0);
    }
    take_in_last();
}

}  // namespace neumann
