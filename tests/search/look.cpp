#include "tests/search/look.h"

#include "operators/render/methods/method_options.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace neumann::search {

namespace {

constexpr int bounces = 3;

// What makes fields, or points that carry their errors, does so anew in each replicate: few of them, and more only where the spread
// has to tell small probabilities.
struct Effort {
    std::uint64_t samples;  // of paths, of all pixels
    std::uint32_t replicates;
    // Of fields only the replicates become more, so that the value with its bias stays and has to be as far off as is stated.
    std::uint32_t replicates_of_fields;
    int patches_of_walks;  // that read fields
};
constexpr std::array<Effort, 3> efforts{{{4096, 8, 8, 100}, {131072, 32, 32, 300}, {524288, 64, 64, 600}}};
constexpr std::uint64_t samples_of_field = 256;  // of all pixels, in a replicate
constexpr std::uint32_t patches = 60, directions_of_field = 16;
constexpr int directions_of_walks = 256;

Goal goal(const Method& method, const Film& film, const Look& look) {
    const Effort& effort = efforts.at(look.number);
    Goal goal;
    goal.bounces = bounces;
    goal.seed = look.seed;
    const auto pixels = static_cast<std::uint64_t>(film.crop_width) * static_cast<std::uint64_t>(film.crop_height);
    goal.replicates = has_fields(method) ? effort.replicates_of_fields : effort.replicates;
    goal.samples = std::bit_floor(std::max<std::uint64_t>(
        (has_fields(method) ? samples_of_field * *goal.replicates : effort.samples) / pixels, *goal.replicates));
    goal.only_pictures = !look.thorough;
    return goal;
}

}  // namespace

std::string as_looked_at(const std::string& method, const Look& look) {
    const Effort& effort = efforts.at(look.number);
    const Method as_given = read_method(method);
    if (has_fields(as_given))
        return fmt::format("{}:patches={}:directions={}", method, patches, directions_of_field * effort.replicates_of_fields);
    if (std::holds_alternative<method::Guided>(as_given) || std::holds_alternative<method::Corrected>(as_given))
        return fmt::format("{}:patches={}:directions={}", method, effort.patches_of_walks, directions_of_walks);
    return method;
}

std::string command(const std::string& scene, const Film& film, const std::string& method, const Look& look) {
    const MethodText text = differences_of(read_method(as_looked_at(method, look)));
    std::string line = fmt::format("neumann render {} --method {}", scene, text.name);
    for (const auto& [name, value] : text.options)
        line += value == "true" ? fmt::format(" --{}", name) : fmt::format(" --{} {}", name, value);
    const Goal g = goal(read_method(method), film, look);
    return line + fmt::format(" -n {} --spp {} --seed {}", bounces, *g.samples, g.seed);
}

Measured look_at(const Scene& scene, const Pilot& pilot, const std::string& method, const Look& look) {
    const Method m = read_method(as_looked_at(method, look));
    return measure(method, render(scene, m, goal(m, scene.film, look), {}, pilot));
}

}  // namespace neumann::search
