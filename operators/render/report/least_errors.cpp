#include "operators/render/report/least_errors.h"

#include "operators/render/report/reachable_light.h"
#include "operators/statistics/few_events.h"
#include "operators/statistics/one_sample_more.h"
#include "operators/statistics/student_t.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Rgb times(const Rgb& a, const Rgb& b) {
    Rgb product(0.0);
    for (int c = 0; c < 3; ++c)
        if (a[c] != 0.0 && b[c] != 0.0) product[c] = a[c] * b[c];
    return product;
}

// Upper bounds on the measured value of K^i Le, for each bounce, and of the rest, per channel.
std::vector<Rgb> bounds(const Scene& scene, const SamplingSettings& settings) {
    const Rgb albedo = scene.materials.largest_albedo(),
              emitted = times(scene.emitters.largest_radiance(), Rgb(scene.camera.largest_response()));
    const LeftOut& left_out = settings.walk.left_out;
    const bool ends = left_out.rays_from_surfaces || settings.method->ends_at_first(scene);
    std::vector<Rgb> all{scene.hide_emitters ? Rgb(0.0) : emitted};
    Rgb bound = emitted;
    for (int i = 1; i <= settings.walk.bounces; ++i) {
        bound = times(bound, albedo);
        all.push_back(i > 1 && ends ? Rgb(0.0) : bound);
    }
    Rgb rest = times(bound, albedo);
    for (int c = 0; c < 3; ++c)
        if (rest[c] != 0.0) rest[c] = albedo[c] < 1.0 ? rest[c] / (1.0 - albedo[c]) : infinity;
    const bool no_rest = settings.walk.rest_probability == 0.0 || !settings.method->has_rest();
    all.push_back(no_rest || (ends && settings.walk.bounces > 0) ? Rgb(0.0) : rest);
    return all;
}

class SeriesBounds {
public:
    SeriesBounds(const Scene& scene, const SamplingSettings& settings, const SampleRanges& ranges,
                 const SeriesMoments::Result& result)
        : scene_(&scene),
          method_(settings.method),
          near_lights_have_no_bound_(!settings.weighs_directions()),
          has_chains_(settings.method->has_chains()),
          has_events_(!settings.colors && settings.method->has_events()),  // other colours may be negative
          result_(&result),
          ranges_(&ranges),
          quantities_(result.quantities()),
          stride_(settings.quantities()),
          layout_(settings.layout(scene.film)),
          size_(settings.replicate_size),
          roulette_(settings.walk.roulette),
          rest_probability_(settings.walk.rest_probability),
          bounds_(bounds(scene, settings)) {
        lights_ = seen_lights(scene, settings.seed);
        find_albedo(settings.seed);
    }

    struct Quantity {
        std::vector<float> errors;  // h/t; empty where all are 0
        double mean_at_most = 0.0, of_mean = 0.0;
    };
    // Must be called for q = 0, 1, … in order.
    Quantity bound(std::size_t q, double samples, double t) {
        const Estimate term = result_->term(q);
        const std::size_t pixels = result_->pixels();
        remember_largest(q);
        const Rgb in_picture = has_chains_ && q > 0 ? weight_in_picture(term) : Rgb(0.0);
        std::vector<float> errors(3 * pixels);
        std::vector<Rgb> differences(pixels, Rgb(0.0));  // D of the pixels whose samples are all 0
        const Rgb unmet = brought_by_unmet(q);
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pixels, 1024), [&](const auto& range) {
            for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
                const Rgb nearby = difference_nearby(pixel, q);
                const Rgb weight = has_events_ && q > 0 ? weight_nearby(term, pixel, in_picture) : Rgb(0.0);
                const double part = part_of_samples(pixel);
                for (int c = 0; c < 3; ++c) {
                    const double mean = term.mean.pixels[pixel][c], error = term.standard_error.pixels[pixel][c];
                    double d = nearby[c];
                    if (mean == 0.0 && error == 0.0) {
                        if (d == 0.0) d = difference_elsewhere(pixel, q, c, unmet[c]);
                        differences[pixel][c] = d;
                    }
                    if (d == 0.0) continue;
                    const bool agree = error <= agreement * std::abs(mean);
                    double h = expectation_above(mean, error * error, weight[c]);
                    if (agree || !samples_are_mixtures(q)) h = std::max(h, least_half_width(d, samples * part, agree));
                    if (mean == 0.0) h = std::min(h, largest_mean(pixel, q, c));
                    errors[3 * pixel + static_cast<std::size_t>(c)] = static_cast<float>(h / t);
                }
            }
        });
        Quantity found;
        if (is_zero(term.mean)) {
            Rgb d(0.0), at_most(0.0), means(0.0);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                for (int c = 0; c < 3; ++c) {
                    if (differences[pixel][c] == 0.0) continue;
                    d[c] = std::max(d[c], differences[pixel][c]);
                    means[c] += largest_mean(pixel, q, c) / static_cast<double>(pixels);
                }
            for (int c = 0; c < 3; ++c)
                at_most[c] = std::min(means[c], rule_of_three * d[c] / (samples * static_cast<double>(pixels)));
            found.mean_at_most = mean_component(at_most);
        }
        found.of_mean = error_of_mean(q, samples * static_cast<double>(pixels)) / t;
        if (std::any_of(errors.begin(), errors.end(), [](float e) { return e > 0.0f; })) found.errors = std::move(errors);
        return found;
    }

private:
    // The number of samples of a pixel relative to the mean number. Paths from lights are equally many for all pixels.
    double part_of_samples(std::size_t pixel) const {
        const double part = layout_.size(static_cast<std::uint32_t>(pixel)) / static_cast<double>(size_);
        return method_->splats() ? std::min(part, 1.0) : part;
    }
    bool samples_are_mixtures(std::size_t q) const { return method_->two_radii() && q > 1; }
    const SampleRange& range(std::size_t pixel, std::size_t q) const { return ranges_->of[pixel * stride_ + q]; }

    Rgb difference_nearby(std::size_t pixel, std::size_t q) const {
        SampleRange all;
        for_neighbourhood(result_->width(), result_->height(), pixel, [&](std::size_t other) { all.merge(range(other, q)); });
        return Rgb(difference(all, 0), difference(all, 1), difference(all, 2));
    }
    // The least half width of the mean's interval.
    double error_of_mean(std::size_t q, double samples) const {
        SampleRange all;
        for (std::size_t pixel = 0; pixel < result_->pixels(); ++pixel) all.merge(range(pixel, q));
        const double d = (difference(all, 0) + difference(all, 1) + difference(all, 2)) / 3.0;
        const MeanWithError mean = result_->mean_of_term(q);
        return least_half_width(d, samples, mean.standard_error <= agreement * std::abs(mean.mean));
    }
    // All states of a bounce's chains bring the same amount, and a chain stays at a state for a while. Such a stay is an event with
    // about the same weight everywhere in a picture, even if the means of its blocks differ by orders of magnitude.
    static Rgb weight_in_picture(const Estimate& term) {
        Rgb weight(0.0);
        for (int c = 0; c < 3; ++c) {
            Events all;
            for (std::size_t pixel = 0; pixel < term.mean.pixels.size(); ++pixel) add(term, pixel, c, all);
            weight[c] = all.weight();
        }
        return weight;
    }
    // Paths that bring much, such as those that reach a small lamp by a mirror, are events, too.
    Rgb weight_nearby(const Estimate& term, std::size_t pixel, const Rgb& in_picture) const {
        Rgb weight(0.0);
        for (int c = 0; c < 3; ++c) {
            Events nearby;
            for_neighbourhood(result_->width(), result_->height(), pixel, [&](std::size_t other) { add(term, other, c, nearby); });
            weight[c] = nearby.and_one_of(in_picture[c]).weight();
        }
        return weight;
    }
    static void add(const Estimate& term, std::size_t pixel, int c, Events& events) {
        const double error = term.standard_error.pixels[pixel][c];
        events.add(term.mean.pixels[pixel][c], error * error);
    }
    // D if all samples of the pixel and its neighbours are 0. `unmet`: D if all samples of the picture are 0.
    double difference_elsewhere(std::size_t pixel, std::size_t q, int c, double unmet) const {
        if (bounds_[q][c] == 0.0) return 0.0;
        if (q == 0) return lights_.pixels[pixel][c] > 0.0 && method_->is_boundless(q) ? infinity : lights_.pixels[pixel][c];
        if (albedo_.pixels[pixel][c] == 0.0) return 0.0;
        return met_[c] > 0.0 ? met_[c] : unmet;
    }
    // The largest value that the quantity can have in a pixel.
    double largest_mean(std::size_t pixel, std::size_t q, int c) const {
        return q == 0 && method_->is_boundless(q) ? lights_.pixels[pixel][c] : bounds_[q][c];
    }
    // The most that a sample of the quantity may bring if no sample of the picture has brought anything: as much as one
    // of an earlier bounce, or at most the bounds. Paths that survive roulette bring more; one that goes on into the
    // rest brings all of it, times 1/p.
    Rgb brought_by_unmet(std::size_t q) const {
        if (method_->is_boundless(q)) return Rgb(infinity);
        const bool is_rest = q + 1 == quantities_;
        const Rgb albedo = scene_->materials.largest_albedo();
        Rgb brought(0.0);
        for (int c = 0; c < 3; ++c) {
            if (bounds_[q][c] == 0.0) continue;
            double sample = largest_[c] > 0.0 ? largest_[c] : near_lights_have_no_bound_ ? infinity : bounds_[q][c];
            if (roulette_.kind == Roulette::Kind::fixed)
                sample = is_rest ? infinity : sample / std::pow(roulette_.survival, static_cast<double>(q));
            else if (is_rest && largest_[c] > 0.0)
                sample *= albedo[c] < 1.0 ? albedo[c] / (1.0 - albedo[c]) : infinity;
            brought[c] = is_rest ? sample / rest_probability_ : sample;
        }
        return brought;
    }
    // Updates met_ and largest_ with the quantity's samples in the whole picture; if all are 0, largest_ stays as it was.
    void remember_largest(std::size_t q) {
        met_ = Rgb(0.0);
        for (std::size_t pixel = 0; pixel < result_->pixels(); ++pixel)
            for (int c = 0; c < 3; ++c) met_[c] = std::max(met_[c], double{range(pixel, q).largest[c]});
        if (q == 0 && near_lights_have_no_bound_) return;
        for (int c = 0; c < 3; ++c)
            if (met_[c] > 0.0) largest_[c] = met_[c];
    }
    // Finds the albedo seen in those pixels, and their neighbours, in which some bounce is 0. If no paths start at the camera, it
    // also finds the light seen there, because dim lights are not among the points on lights, which are chosen by power.
    void find_albedo(std::uint64_t seed) {
        const std::size_t pixels = result_->pixels();
        const int width = result_->width(), height = result_->height();
        std::vector<char> wanted(pixels, 0);
        const auto has_unmet = [&](std::size_t pixel) {
            for (std::size_t q = method_->starts_at_camera() ? 1 : 0; q < quantities_; ++q) {
                const Rgb mean = result_->term_at(pixel, q);
                for (int c = 0; c < 3; ++c)
                    if (mean[c] == 0.0 && bounds_[q][c] > 0.0) return true;
            }
            return false;
        };
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            if (has_unmet(pixel)) for_neighbourhood(width, height, pixel, [&](std::size_t other) { wanted[other] = 1; });
        const SeenByRays seen = seen_by_rays(*scene_, wanted, seed);
        albedo_ = seen.albedo;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            for_neighbourhood(width, height, pixel, [&](std::size_t other) {
                albedo_.pixels[pixel] = glm::max(albedo_.pixels[pixel], seen.albedo.pixels[other]);
            });
        if (method_->starts_at_camera()) return;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            for_neighbourhood(width, height, pixel, [&](std::size_t other) {
                lights_.pixels[pixel] = glm::max(lights_.pixels[pixel], seen.emitted.pixels[other]);
            });
    }

    const Scene* scene_;
    std::shared_ptr<const PathMethod> method_;
    bool near_lights_have_no_bound_;
    bool has_chains_, has_events_;
    const SeriesMoments::Result* result_;
    const SampleRanges* ranges_;
    std::size_t quantities_, stride_;
    SampleLayout layout_;
    std::uint32_t size_;
    Roulette roulette_;
    double rest_probability_;
    std::vector<Rgb> bounds_;
    // The largest sample in the picture of this quantity; and of this or else of an earlier one.
    Rgb met_{0.0}, largest_{0.0};
    Image lights_, albedo_;
};

}  // namespace

LeastErrors::LeastErrors(const Scene& scene, const SamplingSettings& settings, const RenderedSeries& series,
                         const SeriesMoments::Result& result)
    : width_(result.width()),
      height_(result.height()),
      terms_(result.quantities()),
      sums_(result.quantities()),
      means_at_most_(result.quantities(), 0.0),
      of_means_(result.quantities(), 0.0) {
    const double t = student_t_quantile(0.95, result.degrees_of_freedom());
    if (!std::isfinite(t) || series.moments.ranges().of.empty()) return;
    SeriesBounds bounds_of_series(scene, settings, series.moments.ranges(), result);
    for (std::size_t q = 0; q < terms_.size(); ++q) {
        // All samples of a pass share its photons or records, and those of a chain its states, so they count as one.
        const bool is_shared = (settings.method->two_radii() && q > 1) || (settings.method->has_chains() && q > 0);
        auto found = bounds_of_series.bound(q, static_cast<double>(is_shared ? series.moments.replicates() : series.samples), t);
        terms_[q] = std::move(found.errors);
        means_at_most_[q] = found.mean_at_most;
        if (!is_shared && !settings.method->splats()) of_means_[q] = found.of_mean;
        if (q > 0) sums_[q] = sums_[q - 1];
        if (terms_[q].empty()) continue;
        sums_[q].resize(terms_[q].size());
        for (std::size_t k = 0; k < terms_[q].size(); ++k) sums_[q][k] = std::hypot(sums_[q][k], terms_[q][k]);
    }
}

Image LeastErrors::image(const std::vector<Errors>& all, std::size_t i) const {
    const Errors& errors = all[i];
    if (errors.empty()) return {};
    Image out(width_, height_);
    for (std::size_t pixel = 0; pixel < out.pixels.size(); ++pixel)
        for (std::size_t c = 0; c < 3; ++c) out.pixels[pixel][static_cast<int>(c)] = double{errors[3 * pixel + c]};
    return out;
}

void report_least(SeriesReport& report, const LeastErrors& least) {
    double of_unmet = 0.0, of_met = 0.0;
    const auto set = [&](MeanWithError& mean, bool& unmet, std::size_t i) {
        const double at_most = least.mean_at_most(i);
        unmet = at_most != 0.0;
        if (unmet) return mean.standard_error = at_most / student_t_quantile(0.95, mean.degrees_of_freedom);
        mean.standard_error = std::max(mean.standard_error, least.of_mean(i));
        return 0.0;
    };
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        of_unmet = std::hypot(of_unmet, set(report.bounces[i].mean, report.bounces[i].unmet, i));
        of_met = std::hypot(of_met, least.of_mean(i));
    }
    report.sum.standard_error = std::hypot(std::max(report.sum.standard_error, of_met), of_unmet);
    if (report.rest_verdict == RestVerdict::measured) set(report.rest, report.rest_unmet, report.bounces.size());
}

}  // namespace neumann
