// Prints the results of `neumann spectrum` as tables, CSV and JSON.
#pragma once

#include "apps/commands/spectrum_command.h"
#include "operators/fields/matrix/scene_spectrum.h"

namespace neumann {

void print_spectrum(const PatchScene& scene, const SceneSpectrum& report);
void print_spectrum_csv(const PatchScene& scene, const SceneSpectrum& report);
nlohmann::ordered_json spectrum_json(const PatchScene& scene, const SceneSpectrum& report);

}  // namespace neumann
