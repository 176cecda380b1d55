#include "operators/render/methods/method_options.h"
#include "operators/render/methods/method_table.h"
#include "operators/render/methods/named_values.h"

namespace neumann {

namespace {

// Names of Mitsuba, pbrt and papers.
const Named<std::string> methods_elsewhere{
    {"path", "walk"},      {"pt", "walk"},           {"bdpt", "bidirectional"},  {"vcm", "photon or bidirectional"},
    {"ptracer", "light"},  {"lighttracer", "light"}, {"photonmapper", "photon"}, {"ppm", "photon"},
    {"sppm", "photon"},    {"mlt", "metropolis"},    {"mmlt", "metropolis"},     {"pssmlt", "metropolis"},
    {"irrcache", "cache"}, {"radiosity", "patches"}, {"whitted", "classic"}};

const Named<std::string> helps{
    {"auto",
     "of walk, guided, corrected and bidirectional the one that promises least error in this scene, by a short pilot, the default "
     "(walk, if an option is given that auto does not have, or the render is small)"},
    {"walk", "one walk from the camera for all bounces"},
    {"guided", "walks with directions sampled from a matrix solution"},
    {"corrected", "walks that read approximate fields on patches and remove their errors"},
    {"surface", "walks with points sampled on all surfaces"},
    {"light", "walks from the lights to the camera"},
    {"bidirectional", "walks from both ends, joined everywhere"},
    {"mixed", "walk, guided, corrected, bidirectional, light and metropolis, each for the blocks and the bounces where it is best"},
    {"photon", "photon maps, for caustics, with a bias that falls"},
    {"cache", "an irradiance cache, for diffuse rooms, with a bias that stays"},
    {"metropolis", "chains of paths that mutate, for light that is hard to find"},
    {"classic", "mirrors and glass alone, which leaves out other paths"},
    {"pointwise", "each bounce by itself, slow and plain"},
    {"matrix", "T and R on patches, fast"},
    {"gather", "T and R on patches, with K applied once more at the pixel"},
    {"patches", "the patches as they are"}};

}  // namespace

const std::vector<Method>& all_methods() {
    static const std::vector<Method> all{method::Auto{},      method::Walk{},   method::Guided{},        method::Corrected{},
                                         method::Surface{},   method::Light{},  method::Bidirectional{}, method::Mixed{},
                                         method::Photon{},    method::Cache{},  method::Metropolis{},    method::Classic{},
                                         method::Pointwise{}, method::Matrix{}, method::Gather{},        method::Patches{}};
    return all;
}

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const Method& method : all_methods()) names.push_back(name_of(method));
    return names;
}

std::string wrong_method(const std::string& name) {
    const std::vector<std::string> all = method_names();
    if (std::ranges::find(all, name) != all.end()) return "";
    if (const auto here = value(methods_elsewhere, name)) return fmt::format("what other programs call {} is {} here", name, *here);
    return not_in(name, all);
}

std::string method_help(const std::string& name) { return value(helps, name).value(); }

const std::string& method_help() {
    static const std::string text = [] {
        std::vector<std::string> all;
        for (const std::string& name : method_names()) all.push_back(name + ": " + method_help(name));
        return fmt::format("{}", fmt::join(all, "; "));
    }();
    return text;
}

}  // namespace neumann
