#include "operators/pictures/unmet_by_fields.h"

#include "operators/pictures/reachable_light.h"
#include "operators/plan/plan.h"
#include "operators/series/tail_bound.h"
#include "operators/statistics/one_sample_more.h"
#include "operators/statistics/student_t.h"

#include <algorithm>

namespace neumann {

namespace {

class Unmet {
public:
    Unmet(const Scene& scene, const FieldPictures& pictures, const FieldSettings& settings)
        : scene_(scene),
          lights_(seen_lights(scene, settings.seed)),
          seen_(seen_by_rays(scene, std::vector<char>(lights_.pixels.size(), 1), settings.seed)),
          ends_(make_plan(scene).walk.rays_from_surfaces) {
        const bool are_samples = !pictures.has_links && pictures.sides.size() == 1 && pictures.sides.begin()->first == 1;
        const double rays = std::min(settings.rays, settings.light_samples) * static_cast<double>(settings.replicates);
        if (are_samples) part_ = std::min(1.0, rule_of_three / rays);
    }

    // Means over pixels and channels.
    double term(std::size_t i) const {
        if (i == 0) return mean_over_pixels(lights_);
        if (i > 1 && ends_) return 0.0;
        return of_surfaces([&](double albedo, double radiance) { return std::pow(albedo, static_cast<double>(i)) * radiance; });
    }
    double all_beyond(std::size_t i) const {
        if (i > 0 && ends_) return 0.0;
        return of_surfaces(
            [&](double albedo, double radiance) { return tail_bound(Rgb(albedo), Rgb(radiance), static_cast<int>(i)); });
    }

private:
    static double mean_over_pixels(const Image& image) {
        double sum = 0.0;
        for (const Rgb& pixel : image.pixels) sum += mean_component(pixel);
        return sum / static_cast<double>(image.pixels.size());
    }
    template <class Bound>
    double of_surfaces(const Bound& bound) const {
        const Rgb albedo = scene_.materials.largest_albedo(), radiance = scene_.emitters.largest_radiance();
        const std::vector<Rgb>& pixels = seen_.albedo.pixels;
        double mean = 0.0;
        for (int c = 0; c < 3; ++c) {
            const auto reflect = std::count_if(pixels.begin(), pixels.end(), [&](const Rgb& pixel) { return pixel[c] > 0.0; });
            if (reflect > 0 && radiance[c] > 0.0)
                mean += static_cast<double>(reflect) / static_cast<double>(pixels.size()) * bound(albedo[c], radiance[c]) / 3.0;
        }
        return part_ * scene_.camera.largest_response() * mean;
    }

    const Scene& scene_;
    Image lights_;
    SeenByRays seen_;
    bool ends_;          // no surface is seen from another
    double part_ = 1.0;  // of the rays, that could have met something
};

bool is_unknown(const MeanWithError& mean) { return mean.mean == 0.0 && mean.standard_error == 0.0; }

}  // namespace

void report_unmet(SeriesReport& report, const Scene& scene, const FieldPictures& pictures, const FieldSettings& settings) {
    const bool rest = report.rest_verdict == RestVerdict::measured && is_unknown(report.rest);
    if (!rest && std::none_of(report.bounces.begin(), report.bounces.end(), [](const auto& b) { return is_unknown(b.mean); }))
        return;
    const Unmet unmet(scene, pictures, settings);
    double all = 0.0;
    const auto set = [](MeanWithError& mean, bool& is_unmet, double at_most) {
        is_unmet = at_most > 0.0;
        mean.standard_error = at_most / student_t_quantile(0.95, mean.degrees_of_freedom);
    };
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        BounceReport& bounce = report.bounces[i];
        if (!is_unknown(bounce.mean)) continue;
        set(bounce.mean, bounce.unmet, unmet.term(i));
        all = std::hypot(all, bounce.mean.standard_error);
    }
    report.sum.standard_error = std::hypot(report.sum.standard_error, all);
    if (rest) set(report.rest, report.rest_unmet, unmet.all_beyond(report.bounces.size() - 1));
}

}  // namespace neumann
