// The materials of the program of CMU 15-462 and Berkeley CS184. Where the program differs from physics, physics is
// followed: Fresnel's equations replace Schlick's approximation.
#include "core/reader/formats/collada/surface.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/make_elements.h"

#include <array>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

const std::array<std::string, 5> kinds = {"emission", "glass", "microfacet", "mirror", "refraction"};
const std::array<std::string, 7> numbers_of_kinds = {"alpha", "eta", "ior", "k", "reflectance", "roughness", "transmittance"};

Element dielectric(const Element& e) {
    const double ior = read_number(required_child(e, "ior"));
    Element bsdf = make_object("bsdf", "dielectric", e.place);
    add_float(bsdf, "int_ior", ior, required_child(e, "ior").place);
    add_float(bsdf, "ext_ior", 1.0, e.place);
    return bsdf;
}

void add_color(Element& bsdf, const std::string& name, const Element& e, const std::string& tag) {
    const Element& color = required_child(e, tag);
    add_rgb(bsdf, name, read_color(color).rgb, color.place);
}

void warn_of_roughness(const Element& e, const std::string& name, const Import& import) {
    const Element* roughness = child(e, "roughness");
    if (roughness && read_number(*roughness) != 0.0)
        import.warnings.add(fmt::format("material '{}': its roughness is not used, as in the course's program", name));
}

Element read_glass(const Element& e, const std::string& name, const Import& import) {
    warn_of_roughness(e, name, import);
    Element bsdf = dielectric(e);
    add_color(bsdf, "specular_reflectance", e, "reflectance");
    add_color(bsdf, "specular_transmittance", e, "transmittance");
    return bsdf;
}

Element read_refraction(const Element& e, const std::string& name, const Import& import) {
    warn_of_roughness(e, name, import);
    import.warnings.add(fmt::format(
        "material '{}': a refraction lets through what Fresnel's equations leave, and not all as in the course's program", name));
    Element bsdf = dielectric(e);
    add_rgb(bsdf, "specular_reflectance", Rgb(0.0), e.place);
    add_color(bsdf, "specular_transmittance", e, "transmittance");
    return bsdf;
}

Element read_mirror(const Element& e) {
    Element bsdf = make_object("bsdf", "conductor", e.place);
    add_string(bsdf, "material", "none", e.place);
    add_color(bsdf, "specular_reflectance", e, "reflectance");
    return two_sided(std::move(bsdf));
}

Element read_microfacet(const Element& e) {
    Element bsdf = make_object("bsdf", "roughconductor", e.place);
    add_string(bsdf, "distribution", "beckmann", e.place);
    const Element& alpha = required_child(e, "alpha");
    add_float(bsdf, "alpha", read_number(alpha), alpha.place);
    add_color(bsdf, "eta", e, "eta");
    add_color(bsdf, "k", e, "k");
    return two_sided(std::move(bsdf));
}

}  // namespace

Surface read_course_effect(const Element& technique, const std::string& name, const Import& import) {
    check_children(technique, kinds, import.problems);
    Surface surface;
    const Element* first = nullptr;
    for (const Element& e : technique.children) {
        if (first)
            throw InputError(e.place, fmt::format("a second material <{}>, expected only one; the first is at {}", e.tag,
                                                  to_string(first->place)));
        first = &e;
        if (e.tag == "emission") {
            const Element& radiance = required_child(e, "radiance");
            surface.emitter = make_object("emitter", "area", e.place);
            add_rgb(*surface.emitter, "radiance", read_color(radiance).rgb, radiance.place);
            continue;
        }
        check_children(e, numbers_of_kinds, import.problems);
        if (e.tag == "glass") surface.bsdf = read_glass(e, name, import);
        if (e.tag == "refraction") surface.bsdf = read_refraction(e, name, import);
        if (e.tag == "mirror") surface.bsdf = read_mirror(e);
        if (e.tag == "microfacet") surface.bsdf = read_microfacet(e);
    }
    if (!first) throw InputError(technique.place, "<technique> has no material, expected " + join({kinds.begin(), kinds.end()}));
    return surface;
}

}  // namespace neumann::reader::collada
