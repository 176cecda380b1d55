#include "core/reader/bsdfs.h"

#include "core/reader/color.h"

namespace neumann::reader {

namespace {

Diffuse read_diffuse(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const Element* reflectance = p.find("reflectance", color_types);
    const Rgb c = reflectance ? parse_color(p, "reflectance", *reflectance, Illuminant::d65, context.warnings) : Rgb(0.5);
    p.finish();
    return Diffuse(c);
}

}  // namespace

Materials::Sides Bsdfs::sides(const Element& e) {
    const auto known = sides_.find(&e);
    return known != sides_.end() ? known->second : sides_[&e] = read(e);
}

Materials::Sides Bsdfs::read(const Element& e) {
    const std::string& type = e.attribute("type").value;
    if (type == "diffuse") return {store(read_diffuse(e, context_)), Materials::absorbing};
    if (type != "twosided") fail_type(e, {"diffuse", "twosided"});

    Properties p(e, context_.objects);
    const std::vector<const Element*> nested = p.nested("bsdf", 2);
    p.finish();
    if (nested.empty()) throw InputError(e.place, "bsdf 'twosided' has no <bsdf> inside, expected one or two");
    for (const Element* inner : nested)
        if (inner->attribute("type").value == "twosided") throw InputError(e.place, "bsdf 'twosided' stands inside another one");
    return {sides(*nested.front()).front, sides(*nested.back()).front};
}

Materials::Sides Bsdfs::default_sides(bool emits) {
    if (emits) return {};
    if (default_ == Materials::absorbing) default_ = store(Diffuse(Rgb(0.5)));
    return {default_, Materials::absorbing};
}

int Bsdfs::store(Bsdf bsdf) {
    bsdfs_.push_back(std::move(bsdf));
    return static_cast<int>(bsdfs_.size()) - 1;
}

}  // namespace neumann::reader
