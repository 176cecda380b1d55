#include "core/base/error.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/walk_paths.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/option_makers.h"

#include <fmt/format.h>

namespace neumann::method {

namespace {

constexpr int tree_width = 32;  // of the film of the pilot for --tree, in pixels
// The number of consecutive pixels that use each other's tails with --reuse: more of them cost more rays than they
// save, in most scenes (tests/bench/bench_reuse.cpp).
constexpr std::uint32_t reusing_pixels = 8;

constexpr std::string_view equal = "equal-";
constexpr int most_equal_branches = 16;

std::optional<TreeGoal> read_tree(const std::string& text) {
    if (text == "sum") return std::make_optional<TreeGoal>();
    if (text == "place") return TreeGoal{.by_place = true};
    if (text.starts_with(equal)) {
        const auto branches = number_in<int>(text.substr(equal.size()));
        return branches && *branches >= 2 && *branches <= most_equal_branches ? std::optional(TreeGoal{{}, *branches})
                                                                              : std::nullopt;
    }
    const auto bounce = number_in<int>(text);
    return bounce && *bounce >= 1 && *bounce <= most_depths_of_tree ? std::optional(TreeGoal{*bounce}) : std::nullopt;
}

const Named<std::optional<HemisphereDensity>> densities{
    {"bsdf", {}}, {"uniform", HemisphereDensity::uniform}, {"cosine", HemisphereDensity::cosine}};

std::string print_tree(const TreeGoal& tree) {
    if (tree.branches) return fmt::format("{}{}", equal, *tree.branches);
    if (tree.by_place) return "place";
    return tree.bounce ? fmt::format("{}", *tree.bounce) : "sum";
}

}  // namespace

std::vector<MethodOption> Walk::own_options() {
    return {
        choice(
            "indirect", "HOW",
            "For walk: how it goes on from a surface: in directions of the material (bsdf, the default), or, to compare, uniform "
            "over "
            "the hemisphere or in proportion to the cosine, whatever the material; mirrors and glass keep their own",
            densities, [](const Walk& m) { return m.indirect; },
            [](Walk& m, std::optional<HemisphereDensity> d) { m.indirect = d; }),
        option(
            "tree", "WHAT",
            "For walk: split walks, and end them by Russian roulette, by the numbers of samples at each depth that a pilot finds "
            "best for the sum of all bounces (sum) or for one bounce (its number), or by what it learns at each place (place, for "
            "the "
            "sum); or, to compare, into equally many at every "
            "reflection "
            "(equal-2)",
            [](const Walk& m) { return m.tree; }, [](Walk& m, const TreeGoal& t) { m.tree = t; },
            Form<TreeGoal>{read_tree, print_tree,
                           not_a(fmt::format("sum, place, a bounce from 1 to {}, or equal-2 to equal-{}", most_depths_of_tree,
                                             most_equal_branches))}),
        flag(
            "reuse",
            "For walk: let the walks of eight pixels in a row use each other's tails, from the second surface on where both are "
            "diffuse",
            [](const Walk& m) { return m.reuse; }, [](Walk& m, bool on) { m.reuse = on; })};
}

void Walk::expect_sense(bool lights) const {
    if (lights && !samples_lights(direct))
        throw OptionError("lights", fmt::format(" chooses among lights, and direct = {} asks none; take light, solid-angle or mis",
                                                name_of(direct)));
    if (tree && (split != Split{} || roulette != Roulette{}))
        throw OptionError("tree", " chooses what split and roulette say; take it alone");
    if (indirect && (tree || reuse)) throw OptionError("indirect", " is for plain walks; take it without tree and reuse");
    if (reuse && (tree || adaptive || split != Split{}))
        throw OptionError("reuse", " needs one walk of each pixel; take it without tree, adaptive and split");
}

std::optional<Decisions> Walk::leaves_out() const {
    if (tree || reuse) return std::nullopt;
    Decisions taken{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light};
    if (direct.direct != DirectLight::hemisphere && direct.direct != DirectLight::cosine)
        taken.push_back(&LeftOut::shadow_rays_in_room);
    if (direct.direct == DirectLight::mis) taken.push_back(&LeftOut::light_samples);
    return taken;
}

std::shared_ptr<const PathMethod> Walk::prepare(const Preparing& in) const {
    if (tree)
        return std::make_shared<const WalkPaths>(
            tree_ratios(in.scene.with(small_film(in.scene.film, tree_width)), in.settings.walk.bounces, *tree, in.watch));
    if (indirect) return std::make_shared<const WalkPaths>(*indirect);
    return reuse ? std::make_shared<const WalkPaths>(reusing_pixels) : plain_walks();
}

}  // namespace neumann::method
