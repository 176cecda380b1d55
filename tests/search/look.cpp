#include "tests/search/look.h"

#include "operators/methods/method_options.h"
#include "operators/methods/render.h"

#include <fmt/format.h>

#include <array>

namespace neumann::search {

namespace {

constexpr int bounces = 3;

// What makes fields, or points that carry their errors, does so anew in each replicate: few of them, and more only where the spread
// has to tell small probabilities.
struct Effort {
    std::uint64_t samples;  // of paths, per pixel
    std::uint32_t replicates;
    std::uint64_t samples_of_fields;
    std::uint32_t replicates_of_fields;
    int patches, directions;
    int patches_of_walks;  // that read fields
};
constexpr std::array<Effort, 3> efforts{
    {{256, 8, 64, 4, 150, 64, 100}, {8192, 32, 256, 16, 1000, 1024, 300}, {32768, 64, 512, 16, 2500, 2048, 600}}};
constexpr int directions_of_walks = 256;

Goal goal(const Method& method, const Look& look) {
    const Effort& effort = efforts.at(look.number);
    Goal goal;
    goal.bounces = bounces;
    goal.seed = look.seed;
    goal.samples = has_fields(method) ? effort.samples_of_fields : effort.samples;
    goal.replicates = has_fields(method) ? effort.replicates_of_fields : effort.replicates;
    goal.only_pictures = !look.thorough;
    return goal;
}

}  // namespace

std::string as_looked_at(const std::string& method, const Look& look) {
    const Effort& effort = efforts.at(look.number);
    const Method as_given = read_method(method);
    if (has_fields(as_given)) return fmt::format("{}:patches={}:directions={}", method, effort.patches, effort.directions);
    if (std::holds_alternative<method::Guided>(as_given) || std::holds_alternative<method::Corrected>(as_given))
        return fmt::format("{}:patches={}:directions={}", method, effort.patches_of_walks, directions_of_walks);
    return method;
}

std::string command(const std::string& scene, const std::string& method, const Look& look) {
    const MethodText text = differences_of(read_method(as_looked_at(method, look)));
    std::string line = fmt::format("neumann render {} --method {}", scene, text.name);
    for (const auto& [name, value] : text.options)
        line += value == "true" ? fmt::format(" --{}", name) : fmt::format(" --{} {}", name, value);
    const Goal g = goal(read_method(method), look);
    return line + fmt::format(" -n {} --spp {} --seed {}", bounces, *g.samples, g.seed);
}

Measured look_at(const Scene& scene, const Pilot& pilot, const std::string& method, const Look& look) {
    const Method m = read_method(as_looked_at(method, look));
    return measure(method, render(scene, m, goal(m, look), {}, pilot));
}

}  // namespace neumann::search
