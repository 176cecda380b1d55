#include "core/base/error.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/option_makers.h"
#include "operators/render/methods/sampling.h"

#include <fmt/format.h>

namespace neumann::method {

void Bidirectional::expect(const Scene& scene) const { expect_visible_emitters(name, scene); }

std::vector<MethodOption> Bidirectional::own_options() {
    return {whole<int>(
        "ways", "BOUNCE",
        "For bidirectional: write pictures of every way (s, t) to make this bounce, s vertices from the light and t from the "
        "camera, with and without its weight",
        1, 1000, [](const Bidirectional& m) { return m.ways; }, [](Bidirectional& m, int n) { m.ways = n; })};
}

void Bidirectional::expect_sense(bool) const {
    if (direct.direct != DirectLight::mis || direct.place == LightPlace::projected)
        throw InputError(
            fmt::format("bidirectional both asks for lights and hits them; take direct = mis, mis-balance or "
                        "mis-solid-angle, not {}",
                        name_of(direct)));
    if (direct.lights == LightChoice::all) throw InputError("bidirectional asks one light at a time; lights = all belongs to walk");
}

std::shared_ptr<const PathMethod> Bidirectional::prepare(const Preparing&) const {
    return std::make_shared<const BidirectionalPaths>();
}

}  // namespace neumann::method
