#include "apps/commands/spectrum_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/commands/progress_line.h"
#include "apps/commands/run_by_all.h"
#include "apps/commands/spectrum_print.h"
#include "apps/output/files/json_text.h"
#include "core/base/interrupt.h"
#include "core/base/stopwatch.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/solvers/petsc/petsc.h"

#include <fmt/format.h>

namespace neumann {

SceneSpectrum spectrum_of(const PatchScene& scene, const SpectrumRequest& request,
                          const std::function<void(const std::function<std::string()>&)>& tell) {
    const Stopwatch clock;
    SpectrumLimits limits{
        request.eigenvalues, channel_number(request.channel), request.seconds, static_cast<double>(request.most), {}};
    if (dynamic_cast<const TracedSystem*>(&scene.system())) limits.petsc = request.petsc;
    limits.look = [&](const std::string& what, const EigenStep& step) {
        tell([&] {
            return fmt::format("{}   {:.0f} applications of K   largest residual {:.1e}   {:.0f} s", what, step.applications,
                               step.residual, clock.seconds());
        });
    };
    SceneSpectrum found = scene_spectrum(scene.system(), limits, {.stop = interrupted});
    const std::vector<std::string> of_scene = scene.warnings();
    found.warnings.insert(found.warnings.begin(), of_scene.begin(), of_scene.end());
    return found;
}

namespace {

int find_and_print(const SpectrumRequest& request, Processes* processes) {
    if (request.petsc) require_petsc();  // throws before anything is read
    catch_interrupts();
    ProgressLine line(request.patches.quiet);
    line.show([] { return std::string("tracing T"); });
    const PatchScene scene =
        processes ? PatchScene(request.patches, *processes, request.petsc.value_or("")) : PatchScene(request.patches);
    const SceneSpectrum found = spectrum_of(scene, request, [&](const auto& text) { line.show(text); });
    line.clear();
    print_warnings(found.warnings, request.patches.quiet);
    if (request.patches.json)
        fmt::print("{}\n", json_text(spectrum_json(scene, found), 2));
    else if (request.csv)
        print_spectrum_csv(scene, found);
    else
        print_spectrum(scene, found);
    return 0;
}

}  // namespace

int spectrum_command(const SpectrumRequest& request) { return run_by_all(request, find_and_print); }

}  // namespace neumann
