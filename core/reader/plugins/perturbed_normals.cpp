// Reads <bsdf type="normalmap"> and "bumpmap".
#include "core/reader/plugins/bsdfs.h"
#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

PerturbedNormal::Normal read_normal_map(Properties& p, const Context& context) {
    const Element* e = p.object("normalmap", "texture");
    if (!e) p.fail_empty(fmt::format("{} lacks the parameter 'normalmap', expected a texture", p.title()));
    const Texture texture = read_texture(*e, Illuminant::d65, context);
    return [f = texture.value](const ShadingPoint& at) { return 2.0 * f(at) - 1.0; };
}

// The texture may have any name.
PerturbedNormal::Normal read_bump_map(Properties& p, const Context& context) {
    const std::vector<const Element*> found = p.nested("texture");
    if (found.empty()) p.fail_empty(fmt::format("{} has no <texture> inside, expected one", p.title()));
    const double scale = p.number("scale").value_or(1.0);
    const Texture texture = read_texture(*found.front(), Illuminant::d65, context);
    if (!texture.slope)
        throw InputError(found.front()->attribute("type").place, fmt::format("texture '{}' has no slopes for {}; allowed: bitmap",
                                                                             found.front()->attribute("type").value, p.title()));
    return [slope = texture.slope, scale](const ShadingPoint& at) { return bump_normal(at, scale * slope(at)); };
}

}  // namespace

Materials::Sides Bsdfs::read_perturbed_normal(const Element& e) {
    Properties p(e, context_.objects);
    const PerturbedNormal::Normal normal =
        e.attribute("type").value == "normalmap" ? read_normal_map(p, context_) : read_bump_map(p, context_);
    PerturbedNormal::Options options;
    options.flip_invalid_normals = p.boolean("flip_invalid_normals").value_or(true);
    options.use_shadowing_function = p.boolean("use_shadowing_function").value_or(true);
    const std::vector<const Element*> nested = p.nested("bsdf");
    p.finish();
    if (nested.empty()) p.fail_empty(fmt::format("{} has no <bsdf> inside, expected one", p.title()));
    const Materials::Sides inner = sides(*nested.front());

    const auto perturb = [&](int side, bool from_behind) {
        if (side == Materials::absorbing) return Materials::absorbing;
        options.from_behind = from_behind;
        return store(PerturbedNormal(normal, shared(side), options), parts_of(side));
    };
    const int front = perturb(inner.front, false);
    return {front, perturb(inner.back, true)};
}

}  // namespace neumann::reader
