#include "operators/paths/walk/tree_ratios.h"

#include "core/base/error.h"
#include "operators/paths/walk/place_pilot.h"
#include "operators/paths/walk/tree_numbers.h"
#include "operators/paths/walk/tree_pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint32_t samples_of_pilot = 128;
constexpr std::uint64_t tree_stream = 0x7472656573ull;  // differs from the seed of the pictures
constexpr double most_branches = 256.0;

}  // namespace

double TreeRatios::walks(std::span<const double> rays_of_walk) const {
    if (!of_places) return walks_of_tree(of_depths, rays_of_walk);
    const double rays_of_one = std::accumulate(rays_of_walk.begin(), rays_of_walk.end(), 0.0);
    return rays_of_one > 0.0 ? rays_by_place / rays_of_one : 1.0;
}

std::shared_ptr<const TreeRatios> tree_ratios(const Scene& scene, int bounces, const TreeGoal& goal, const Watch& watch) {
    if (goal.bounce && *goal.bounce > bounces)
        throw OptionError("tree", fmt::format("{}: the last bounce that has a picture is {}", *goal.bounce, bounces));
    if (goal.by_place) {
        const PlacePilot pilot = learn_place_ratios(scene, bounces, tree_stream, watch);
        return std::make_shared<const TreeRatios>(TreeRatios{{}, pilot.all_rays, pilot.ratios, pilot.rays});
    }
    if (goal.branches) {
        const double paths = std::pow(*goal.branches, bounces);
        if (paths > most_branches)
            throw OptionError(
                "tree", fmt::format(" makes {} branches at {} reflections {:.3g} paths, where {:.0f} are the most; take fewer "
                                    "bounces",
                                    *goal.branches, bounces, paths, most_branches));
        return std::make_shared<const TreeRatios>(
            TreeRatios{std::vector<double>(static_cast<std::size_t>(bounces), static_cast<double>(*goal.branches))});
    }
    const int depths = goal.bounce.value_or(std::min(bounces, most_depths_of_tree));
    const TreePilot pilot = measure_tree(scene, depths, samples_of_pilot, tree_stream, watch);
    const std::vector<double> numbers = best_tree(goal.bounce ? pilot.bounces.back() : pilot.sum);
    TreeRatios result{{}, pilot.rays};
    double number = 1.0;
    for (std::size_t j = 1; j < numbers.size(); ++j) {
        const double ratio = std::clamp(numbers[j] / numbers[j - 1], least_branches, largest_branches);
        result.of_depths.push_back(std::min(ratio, most_branches / number));
        number *= result.of_depths.back();
    }
    return std::make_shared<const TreeRatios>(std::move(result));
}

}  // namespace neumann
