#include "operators/render/report/unmet_by_fields.h"

#include "operators/render/plan/plan.h"
#include "operators/render/report/reachable_light.h"
#include "operators/statistics/one_sample_more.h"
#include "operators/statistics/student_t.h"

#include <algorithm>
#include <limits>

namespace neumann {

namespace {

// Upper bounds on the value of K^i Le in the pictures, bounce by bounce.
class LimitOfTerm {
public:
    LimitOfTerm(const Scene& scene, const FieldPictures& pictures, const FieldSettings& settings)
        : pictures_(pictures),
          albedo_(scene.materials.largest_albedo()),
          limit_(scene.emitters.largest_radiance() * scene.camera.largest_response()),
          lights_(seen_lights(scene, settings.seed)),
          seen_(seen_by_rays(scene, std::vector<char>(lights_.pixels.size(), 1), settings.seed)),
          ends_(make_plan(scene).walk.rays_from_surfaces),
          is_sampled_(!pictures.has_links && pictures.sides.size() == 1 && pictures.sides.begin()->first == 1) {
        const double rays = std::min(settings.rays, settings.light_samples) * static_cast<double>(settings.replicates);
        if (is_sampled_) part_ = std::min(1.0, rule_of_three / rays);
    }

    // Goes on to the next bounce.
    void advance() {
        ++bounce_;
        for (int c = 0; c < 3; ++c) limit_[c] = limit_[c] == 0.0 || albedo_[c] == 0.0 ? 0.0 : limit_[c] * albedo_[c];
        if (bounce_ > 1 && ends_) limit_ = Rgb(0.0);
    }
    // The bounds on means over pixels and channels: of this bounce, and of this and all later ones.
    double of_term() const {
        return bounce_ == 0 ? mean([&](std::size_t pixel, int c) { return lights_.pixels[pixel][c]; }) : on_surfaces(limit_);
    }
    double of_all() const {
        Rgb all = limit_;
        for (int c = 0; c < 3; ++c)
            if (all[c] > 0.0) all[c] = albedo_[c] < 1.0 ? all[c] / (1.0 - albedo_[c]) : std::numeric_limits<double>::infinity();
        return on_surfaces(all);
    }
    // Call if the bounce was met: later ones have no more than its largest visible value (except by links).
    void look() {
        if (!is_sampled_ || bounce_ == 0) return;
        Rgb largest(0.0);
        for (const Rgb& pixel : pictures_.term_mean(bounce_).pixels) largest = glm::max(largest, pixel);
        for (int c = 0; c < 3; ++c)
            if (largest[c] > 0.0) limit_[c] = std::min(limit_[c], largest[c]);
    }

private:
    template <class Value>
    double mean(const Value& value) const {
        double sum = 0.0;
        for (std::size_t pixel = 0; pixel < lights_.pixels.size(); ++pixel)
            for (int c = 0; c < 3; ++c) sum += value(pixel, c);
        return sum / (3.0 * static_cast<double>(lights_.pixels.size()));
    }
    double on_surfaces(const Rgb& limit) const {
        return part_ * mean([&](std::size_t pixel, int c) { return seen_.albedo.pixels[pixel][c] > 0.0 ? limit[c] : 0.0; });
    }

    const FieldPictures& pictures_;
    std::size_t bounce_ = 0;
    Rgb albedo_, limit_;
    Image lights_;
    SeenByRays seen_;
    bool ends_;          // whether no surface is seen from another
    bool is_sampled_;    // whether fields are sampled by rays and by points on lights, from sides of one cell
    double part_ = 1.0;  // the largest part of these rays that could have met something
};

bool is_unknown(const MeanWithError& mean) { return mean.mean == 0.0 && mean.standard_error == 0.0; }

}  // namespace

void report_unmet(SeriesReport& report, const Scene& scene, const FieldPictures& pictures, const FieldSettings& settings) {
    const bool rest = report.rest_verdict == RestVerdict::measured && is_unknown(report.rest);
    if (!rest && std::none_of(report.bounces.begin(), report.bounces.end(), [](const auto& b) { return is_unknown(b.mean); }))
        return;
    LimitOfTerm limit(scene, pictures, settings);
    const auto set = [](MeanWithError& mean, bool& is_unmet, double at_most) {
        is_unmet = at_most > 0.0;
        mean.standard_error = at_most / student_t_quantile(0.95, mean.degrees_of_freedom);
    };
    double all = 0.0;
    for (BounceReport& bounce : report.bounces) {
        if (is_unknown(bounce.mean)) {
            set(bounce.mean, bounce.unmet, limit.of_term());
            all = std::hypot(all, bounce.mean.standard_error);
        } else {
            limit.look();
        }
        limit.advance();
    }
    report.sum.standard_error = std::hypot(report.sum.standard_error, all);
    if (rest) set(report.rest, report.rest_unmet, limit.of_all());
}

}  // namespace neumann
