#include "operators/experiments/study/compared_crops.h"

#include <cmath>

namespace neumann {

std::vector<ComparedCrop> compare_crops(const std::vector<StudyRun>& runs, const std::vector<StudyPoint>& points,
                                        const StudyPlan& plan, const Estimate& reference, const std::vector<Crop>& given,
                                        std::size_t found, const std::function<Image(std::size_t n)>& picture) {
    struct Repeats {
        std::size_t method;
        std::vector<std::size_t> runs;  // with its largest budget
    };
    std::vector<Repeats> methods;
    std::vector<Image> maps;
    for (std::size_t m = 0; m < plan.efforts.size(); ++m) {
        const auto of_method = points_of_method(points, m);
        if (of_method.empty()) continue;
        Repeats& repeats = methods.emplace_back(Repeats{m, {}});
        for (std::size_t n = 0; n < runs.size(); ++n)
            if (runs[n].method == m && runs[n].budget == of_method.back()->budget()) repeats.runs.push_back(n);
        maps.push_back(error_map(
            repeats.runs.size(), [&](std::size_t j) { return picture(repeats.runs[j]); }, reference));
    }
    std::vector<Crop> places = given;
    const std::vector<Crop> differing = differing_places(maps, reference.mean, found);
    places.insert(places.end(), differing.begin(), differing.end());

    std::vector<ComparedCrop> crops;
    std::vector<PictureErrors> errors;
    for (const Crop& place : places) crops.push_back({place, crops.size() < given.size(), cropped(reference, place), {}});
    for (std::size_t m = 0; m < methods.size(); ++m) {
        errors.clear();
        for (const ComparedCrop& crop : crops) errors.emplace_back(crop.reference);
        for (std::size_t j = 0; j < methods[m].runs.size(); ++j) {
            const Image whole = picture(methods[m].runs[j]);
            for (std::size_t c = 0; c < crops.size(); ++c) {
                const Image part = cropped(whole, crops[c].place);
                errors[c].add(part);
                if (j == 0) crops[c].methods.push_back({methods[m].method, part, cropped(maps[m], crops[c].place), {}});
            }
        }
        for (std::size_t c = 0; c < crops.size(); ++c) {
            const ErrorStatistics statistics = errors[c].statistics();
            crops[c].methods.back().rmse =
                rmse_of({statistics.mean_mse.value, std::hypot(statistics.mean_mse.standard_error, statistics.reference_error)});
        }
    }
    return crops;
}

}  // namespace neumann
