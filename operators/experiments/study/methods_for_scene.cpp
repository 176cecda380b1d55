#include "operators/experiments/study/methods_for_scene.h"

#include "core/base/error.h"
#include "operators/render/methods/method_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann {

std::optional<MethodsForScene> methods_for_scene(int bounces, std::uint64_t seed, const Scene& scene, const Pilot& pilot,
                                                 const Watch& watch) {
    MethodsForScene found;
    for (const Method& method : all_methods()) {
        const bool is_studied = std::visit(
            []<class M>(const M&) {
                if constexpr (MakesPaths<M>) return M::is_studied;
                return true;
            },
            method);
        if (!is_studied) continue;
        const StudyMethod studied{name_of(method), method};
        try {
            const Effort least = has_fields(method) ? field_effort(0) : sampling_effort(0);
            if (!run_method(studied, least, bounces, seed, scene, pilot, watch)) return std::nullopt;
            found.methods.push_back(studied);
        } catch (const InputError& e) {
            found.left_out.push_back(e.what());
        }
    }
    if (found.methods.empty()) throw InputError(fmt::format("no method can do this scene: {}", fmt::join(found.left_out, "; ")));
    return found;
}

}  // namespace neumann
