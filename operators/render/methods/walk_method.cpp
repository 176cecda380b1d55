#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/walk_paths.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

namespace {

constexpr int tree_width = 32;  // of the pilot of --tree, in pixels
// That use each other's tails with --reuse: more of them cost more rays than they save, in most scenes
// (tests/bench/bench_reuse.cpp).
constexpr std::uint32_t reusing_pixels = 8;

}  // namespace

std::shared_ptr<const PathMethod> Walk::prepare(const Preparing& in) const {
    if (tree)
        return std::make_shared<const WalkPaths>(
            tree_ratios(in.scene.with(small_film(in.scene.film, tree_width)), in.settings.walk.bounces, *tree, in.watch));
    return reuse ? std::make_shared<const WalkPaths>(reusing_pixels) : plain_walks();
}

}  // namespace neumann::method
