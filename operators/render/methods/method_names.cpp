#include "core/base/named_values.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/method_table.h"

namespace neumann {

namespace {

// Names that methods have in Mitsuba, pbrt and papers.
const Named<std::string> methods_elsewhere{
    {"path", "walk"},      {"pt", "walk"},           {"bdpt", "bidirectional"},  {"vcm", "photon or bidirectional"},
    {"ptracer", "light"},  {"lighttracer", "light"}, {"photonmapper", "photon"}, {"ppm", "photon"},
    {"sppm", "photon"},    {"mlt", "metropolis"},    {"mmlt", "metropolis"},     {"pssmlt", "metropolis"},
    {"irrcache", "cache"}, {"radiosity", "patches"}, {"whitted", "classic"}};

template <class... M>
std::vector<Method> with_defaults(const std::variant<M...>&) {
    return {M{}...};
}

}  // namespace

const std::vector<Method>& all_methods() {
    static const std::vector<Method> all = with_defaults(Method{});
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

const char* help_of(const Method& method) {
    return std::visit([](const auto& m) { return m.help; }, method);
}

const std::string& method_help() {
    static const std::string text = [] {
        std::vector<std::string> all;
        for (const Method& method : all_methods()) all.push_back(fmt::format("{}: {}", name_of(method), help_of(method)));
        return fmt::format("{}", fmt::join(all, "; "));
    }();
    return text;
}

}  // namespace neumann
