#include "operators/fields/matrix/refinement.h"

#include <cmath>
#include <limits>
#include <string_view>

namespace neumann {

std::vector<RefinementRow> coarser_spectra(const MatrixSystem& as_given, const EigenLimits& limits) {
    std::vector<RefinementRow> rows;
    const TracedSettings& settings = as_given.settings();
    const auto add = [&](const char* what, std::size_t patches, std::uint32_t rays) {
        if (patches == 0 || rays == 0) return;
        TracedSettings coarser = settings;
        coarser.patches = patches;
        coarser.rays = rays;
        coarser.store = nullptr;
        const std::unique_ptr<MatrixSystem> system = as_given.with(coarser, limits.watch);
        RefinementRow row{what, system->settings(), system->space().patches().size(), system->space().size(), {}};
        for (int c = 0; c < system->channels(); ++c) {
            auto& leading = row.leading.emplace_back();
            const Eigenpairs found = system->leading(*system->reflected(c), 2, limits);
            for (const Eigenpair& pair : found.pairs)
                if (found.converged) leading.push_back(pair.value);
        }
        rows.push_back(std::move(row));
    };
    try {
        add("patches / 16", settings.patches / 16, settings.rays);
        add("patches / 4", settings.patches / 4, settings.rays);
        add("rays / 16", settings.patches, settings.rays / 16);
        add("rays / 4", settings.patches, settings.rays / 4);
    } catch (const Stopped&) {
    }
    return rows;
}

double radius_shift(const std::vector<RefinementRow>& rows, std::size_t channel, double radius) {
    double shift = std::numeric_limits<double>::quiet_NaN();
    for (const RefinementRow& row : rows) {
        if (!std::string_view(row.what).ends_with(" / 4") || row.leading[channel].empty()) continue;
        shift = std::fmax(shift, std::abs(std::abs(row.leading[channel][0]) - radius));
    }
    return shift;
}

}  // namespace neumann
