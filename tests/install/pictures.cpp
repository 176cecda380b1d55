// The pictures of all bounces with their errors: in a furnace of albedo a, that of bounce i is a^i in every pixel.
#include "core/reader/read_scene.h"
#include "operators/render/methods/render.h"

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) try {
    const neumann::Scene scene = neumann::read_scene(argc > 1 ? argv[1] : "", {{"albedo", "0.5"}, {"res", "4"}});
    neumann::method::Walk walk;
    walk.direct.direct = neumann::DirectLight::bsdf;
    const neumann::BounceSeries series = neumann::render(scene, walk, {.bounces = 4, .samples = 16});
    for (int i = 0; i <= series.bounces(); ++i) {
        const neumann::MeanWithError& mean = series.report.bounces[static_cast<std::size_t>(i)].mean;
        std::printf("picture %d: %.4f\n", i, mean.mean);
        if (std::abs(mean.mean - std::pow(0.5, i)) > 1e-9) return 1;
    }
} catch (const neumann::InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
}
