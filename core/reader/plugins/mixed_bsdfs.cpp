// Reads the <bsdf>s that wrap others: `mask`, `blendbsdf`, `mixturebsdf` and `coating`. Each side is made of the same
// side of the nested ones.
#include "core/reader/plugins/bsdfs.h"
#include "core/reader/plugins/ior.h"
#include "core/reader/plugins/textures.h"
#include "core/reader/xml/numbers.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// Reads a weight or opacity, which must be in [0, 1] everywhere.
SurfaceFunction read_share(Properties& p, const std::string& name, const Context& context) {
    const SurfaceFunction share = read_number_texture(p, name, 0.5, context);
    const double largest = share.upper_bound().r;
    if (!(largest >= 0.0 && largest <= 1.0))
        p.complain(name, fmt::format("{} of {} is {}, expected from 0 to 1", name, p.title(), largest));
    return share;
}

// The weights must not be negative, and must add up to at most 1, up to rounding.
std::vector<double> read_weights(const Attribute& given, const std::string& title) {
    Attribute separated = given;
    std::replace(separated.value.begin(), separated.value.end(), ';', ',');
    std::vector<double> weights = parse_numbers(separated);
    for (const double weight : weights)
        if (weight < 0.0) throw InputError(given.place, fmt::format("a weight of {} is {}, expected at least 0", title, weight));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum <= 1.0 + 1e-6))
        throw InputError(given.place, fmt::format("the weights of {} add up to {}, expected at most 1", title, sum));
    if (sum > 1.0)
        for (double& weight : weights) weight /= sum;
    return weights;
}

// Reads σ of a layer, per unit of its thickness.
SurfaceFunction read_absorption(Properties& p, const Context& context) {
    if (const auto texture = find_color_texture(p, "sigma_a", Illuminant::d65, context)) return *texture;
    const Element* e = p.find("sigma_a", color_types);
    return e ? parse_metal_index(p, "sigma_a", *e, context.warnings) : Rgb(0.0);
}

}  // namespace

std::shared_ptr<const Bsdf> Bsdfs::shared(int index) const {
    return index == Materials::absorbing ? nullptr : std::make_shared<const Bsdf>(bsdfs_[static_cast<std::size_t>(index)]);
}

Materials::Sides Bsdfs::read_mask(const Element& e) {
    Properties p(e, context_.objects);
    const SurfaceFunction opacity = read_share(p, "opacity", context_);
    const std::vector<const Element*> nested = p.nested("bsdf");
    p.finish();
    if (nested.empty()) p.fail_empty("bsdf 'mask' has no <bsdf> inside, expected one");
    const Materials::Sides inner = sides(*nested.front());
    const auto masked = [&](int index) { return store(Mask(shared(index), opacity), parts_of(index)); };
    const int front = masked(inner.front);
    return {front, masked(inner.back)};
}

Materials::Sides Bsdfs::read_blend(const Element& e) {
    Properties p(e, context_.objects);
    const SurfaceFunction weight = read_share(p, "weight", context_);
    const std::vector<const Element*> nested = p.nested("bsdf", 2);
    p.finish();
    if (nested.size() != 2)
        p.fail_empty(fmt::format("bsdf 'blendbsdf' has {} <bsdf> inside, expected two", nested.empty() ? "no" : "one"));
    const Materials::Sides first = sides(*nested[0]), second = sides(*nested[1]);
    const int front = store_blend(e, first.front, second.front, weight);
    return {front, store_blend(e, first.back, second.back, weight)};
}

int Bsdfs::store_blend(const Element& e, int first, int second, const SurfaceFunction& weight) {
    if (first == second) return first;  // a mixture of a material and itself
    constexpr double most_parts = 65536.0;
    const double parts = parts_of(first) + parts_of(second);
    if (parts > most_parts)
        throw InputError(e.place, fmt::format("bsdf '{}' is a mixture of {:.0f} materials, expected at most {:.0f}",
                                              e.attribute("type").value, parts, most_parts));
    return store(Blend(shared(first), shared(second), weight), parts);
}

Materials::Sides Bsdfs::read_mixture(const Element& e) {
    Properties p(e, context_.objects);
    const Element& given = p.require("weights", {"string"});
    const auto weights = p.attempt("weights", [&] { return read_weights(given.attribute("value"), p.title()); });
    const std::vector<const Element*> nested = p.nested("bsdf", std::numeric_limits<std::size_t>::max());
    p.finish();
    if (nested.empty()) p.fail_empty("bsdf 'mixturebsdf' has no <bsdf> inside, expected one for each weight");
    if (nested.size() != weights->size())
        p.fail("weights", fmt::format("bsdf 'mixturebsdf' has {} weights and {} <bsdf> inside, expected as many", weights->size(),
                                      nested.size()));
    std::vector<Materials::Sides> parts;
    for (const Element* inner : nested) parts.push_back(sides(*inner));
    // Mixtures of halves keep the nesting of many parts shallow. What the weights lack to 1 absorbs.
    const auto mixed = [&](int Materials::Sides::*side) {
        const std::function<int(std::size_t, std::size_t)> mix = [&](std::size_t first, std::size_t end) {
            if (end - first == 1) return parts[first].*side;
            const std::size_t middle = first + (end - first) / 2;
            const auto sum = [&](std::size_t i, std::size_t j) {
                return std::accumulate(weights->begin() + static_cast<std::ptrdiff_t>(i),
                                       weights->begin() + static_cast<std::ptrdiff_t>(j), 0.0);
            };
            const double left = sum(first, middle), right = sum(middle, end);
            const int a = mix(first, middle), b = mix(middle, end);
            return store_blend(e, a, b, Rgb(left + right > 0.0 ? right / (left + right) : 0.5));
        };
        const double total = std::accumulate(weights->begin(), weights->end(), 0.0);
        const int all = mix(0, parts.size());
        return total < 1.0 ? store_blend(e, Materials::absorbing, all, Rgb(total)) : all;
    };
    const int front = mixed(&Materials::Sides::front);
    return {front, mixed(&Materials::Sides::back)};
}

Materials::Sides Bsdfs::read_coating(const Element& e) {
    Properties p(e, context_.objects);
    const double inside = read_ior(p, "int_ior", "bk7", context_), outside = read_ior(p, "ext_ior", "air", context_);
    const double thickness = p.number("thickness").value_or(1.0);
    if (thickness < 0.0) p.complain("thickness", fmt::format("thickness is {}, expected at least 0", thickness));
    const SurfaceFunction sigma = read_absorption(p, context_);
    const SurfaceFunction specular = read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context_);
    const std::vector<const Element*> nested = p.nested("bsdf");
    p.finish();
    if (nested.empty()) p.fail_empty("bsdf 'coating' has no <bsdf> inside, expected one");
    const Materials::Sides inner = sides(*nested.front());
    for (const int side : {inner.front, inner.back}) refuse_transmission(*nested.front(), side, "coating");
    const auto coated = [&](int side) {
        return store(Coating(shared(side), inside / outside, scaled(sigma, thickness), specular), parts_of(side));
    };
    const int front = coated(inner.front);
    return {front, coated(inner.back)};
}

}  // namespace neumann::reader
