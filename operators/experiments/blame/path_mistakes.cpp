#include "operators/experiments/blame/path_mistakes.h"

#include "core/emitter/light_sampler.h"
#include "core/scene/camera_sample.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace neumann {

namespace {

constexpr double clamp_limits[] = {0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0, 32.0};
constexpr double most_survival = 0.95;

std::vector<WrongTerms> all_wrong(bool (*is_wanted)(Mistake)) {
    std::vector<WrongTerms> all;
    for (const MistakeKind& kind : mistake_kinds()) {
        if (!is_wanted(kind.mistake)) continue;
        if (kind.mistake == Mistake::clamped)
            for (const double limit : clamp_limits) all.push_back({&kind, DirectLight::mis, limit, {}});
        else
            for (const DirectLight direct_light : kind.direct_light) all.push_back({&kind, direct_light, 0.0, {}});
    }
    return all;
}

// A light sample as seen from x, on either side of the lamp.
struct LampSample {
    SurfacePoint y;
    Vec3 w;
    Rgb light{0.0};  // Le / pdf
    double pdf = 0.0, cosine = 1.0, distance2 = 1.0;
    bool is_back = false, is_surface = false;
};

bool counts_twice(Mistake mistake, int bounce) {
    return mistake == Mistake::light_twice || (mistake == Mistake::emission_at_bounce_1 && bounce == 1);
}

// Follows paths, and adds up their contributions under each mistake.
class PathsOfAll {
public:
    PathsOfAll(const Scene& scene, const WrongPaths& wanted, std::vector<WrongTerms>& wrong)
        : scene_(scene),
          ranges_(wanted.ranges),
          begins_(wanted.ranges.at(wanted.begins).first),
          factor_(wanted.factor),
          wrong_(wrong),
          lights_(scene.geometry, scene.emitters) {
        for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape)
            areas_.push_back(scene.emitters.is_emitter(shape) ? scene.geometry.area(shape) : 0.0);
        for (WrongTerms& w : wrong)
            for (std::size_t r = 0; r < ranges_.size(); ++r)
                w.terms.push_back({Image(columns(), rows()), Image(columns(), rows())});
    }

    // Sets the mean of the right picture in the range in which limits begin, from a few samples; they are relative to it.
    void set_scale(double scale) { scale_ = scale; }

    int columns() const { return (scene_.film.crop_width + factor_ - 1) / factor_; }
    int rows() const { return (scene_.film.crop_height + factor_ - 1) / factor_; }
    void row(int y, int samples, std::uint64_t seed, const Watch& watch) {
        const int low = std::min((y + 1) * factor_, scene_.film.crop_height);
        for (int v = y * factor_; v < low; ++v)
            for (int u = 0; u < scene_.film.crop_width && !watch.stop(); ++u) pixel(u, v, samples, seed);
    }

private:
    // Adds a pixel of the film to the joined one.
    void pixel(int x, int y, int samples, std::uint64_t seed) {
        const auto pixel = static_cast<std::uint32_t>(y * scene_.film.crop_width + x);
        Sampler sampler(seed, pixel);
        Walk walk(*this);
        std::vector<Rgb> sums(wrong_.size() * ranges_.size(), Rgb(0.0)), squares = sums;
        for (int s = 0; s < samples; ++s) {
            sampler.start(static_cast<std::uint64_t>(s));
            walk.follow(x, y, sampler);
            for (std::size_t i = 0; i < sums.size(); ++i) {
                sums[i] += walk.found[i];
                squares[i] += walk.found[i] * walk.found[i];
            }
        }
        const int across = std::min(factor_, scene_.film.crop_width - x / factor_ * factor_),
                  down = std::min(factor_, scene_.film.crop_height - y / factor_ * factor_);
        const double n = samples, pixels = static_cast<double>(across) * down;
        for (std::size_t m = 0; m < wrong_.size(); ++m)
            for (std::size_t r = 0; r < ranges_.size(); ++r) {
                const Rgb mean = sums[m * ranges_.size() + r] / n;
                PictureNoise& of = wrong_[m].terms[r];
                of.mean.at(x / factor_, y / factor_) += mean / pixels;
                of.variance.at(x / factor_, y / factor_) +=
                    glm::max(squares[m * ranges_.size() + r] / n - mean * mean, 0.0) / (std::max(n - 1.0, 1.0) * pixels * pixels);
            }
    }

    struct Walk {
        explicit Walk(const PathsOfAll& paths)
            : paths(paths),
              factor(paths.wrong_.size()),
              survived(paths.wrong_.size()),
              now(paths.wrong_.size()),
              later(paths.wrong_.size()),
              found(paths.wrong_.size() * paths.ranges_.size()) {}
        void follow(int x, int y, Sampler& sampler);
        // Follows the path, and returns the bounce after the last one that it put.
        int go(int x, int y, Sampler& sampler);
        // Adds the contributions to this bounce to the range that contains it.
        void put(int bounce);
        void sample_lamp(const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo, const Rgb& beta, int bounce,
                         Sampler& sampler);
        void hit(const SurfacePoint& x, const Vec3& wo, const Rgb& beta, double pdf, double pdf_of_lamp, int bounce,
                 bool had_diffuse);
        void play_roulette(const Rgb& beta, const Rgb& albedo, const std::optional<Rgb>& albedo_before);
        void reflect(const Reflection& reflection);
        void mirror();
        void go_on(const NextDirection& next);

        const PathsOfAll& paths;
        // By mistake: the factors of the path so far, and the contributions to this bounce and to the next.
        std::vector<Rgb> factor;
        std::vector<double> survived;  // the probability with which Russian roulette let the path go on
        std::vector<Rgb> now, later;
        std::vector<Rgb> arrived;  // the factors before this bounce's reflection
        std::vector<Rgb> found;    // by mistake and range
    };
    LampSample sample_lamp(const SurfacePoint& x, Sampler& sampler) const;
    // Le on this side of a lamp, also from behind.
    Rgb emitted_behind(const SurfacePoint& p) const {
        return p.is_infinite() || !scene_.emitters.is_emitter(p.shape) ? Rgb(0.0) : scene_.emitters.emitted(p, p.normal);
    }

    const Scene& scene_;
    const std::vector<BounceRange>& ranges_;
    int begins_;  // the first bounce with roulette, or a limit
    int factor_;
    std::vector<WrongTerms>& wrong_;
    LightSampler lights_;
    std::vector<double> areas_;  // of lamps, by shape
    double scale_ = 1.0;
};

LampSample PathsOfAll::sample_lamp(const SurfacePoint& x, Sampler& sampler) const {
    const Vec2 u = sampler.next2();
    LampSample s;
    if (!lights_.finds_even_points()) {
        const LightSample light = lights_.sample({x.position}, u);
        const Vec3 d = light.point.position - x.position;
        return {light.point, light.w, light.weight, light.pdf, 1.0, glm::dot(d, d), false, false};
    }
    const EvenPoint even = lights_.sample_even_point(u);
    const Vec3 d = even.point.position - x.position;
    s.y = even.point;
    s.distance2 = glm::dot(d, d);
    s.w = d / std::sqrt(s.distance2);
    const double cosine = -glm::dot(even.point.normal, s.w);
    s.cosine = std::abs(cosine);
    s.is_back = cosine < 0.0;
    s.is_surface = true;
    s.pdf = s.cosine > 0.0 ? even.density * s.distance2 / s.cosine : 0.0;
    s.light = s.pdf > 0.0 ? even.radiance / s.pdf : Rgb(0.0);
    return s;
}

void PathsOfAll::Walk::sample_lamp(const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo, const Rgb& beta, int bounce,
                                   Sampler& sampler) {
    const LampSample s = paths.sample_lamp(x, sampler);
    if (!(s.pdf > 0.0) || is_black(s.light)) return;
    const Vec3 wi = side.p.frame.to_local(s.w);
    const Rgb all = beta * eval(*side.bsdf, side.p, wo, wi) * s.light * std::abs(wi.z);
    if (is_black(all)) return;
    const bool is_seen = paths.scene_.geometry.visible(x, s.y);
    const double other = s.pdf == delta_pdf ? 0.0 : pdf(*side.bsdf, side.p, wo, wi);
    const double share = s.pdf == delta_pdf ? 1.0 : s.pdf * s.pdf / (s.pdf * s.pdf + other * other);
    const LampSight sight = s.is_surface ? LampSight{std::abs(wi.z), s.cosine, s.distance2, paths.areas_[s.y.shape]}
                                         : LampSight{std::abs(wi.z), 1.0, 1.0, 1.0};
    for (std::size_t m = 0; m < now.size(); ++m) {
        const WrongTerms& w = paths.wrong_[m];
        const Mistake mistake = w.mistake();
        if (w.direct_light == DirectLight::bsdf || mistake == Mistake::no_lamp_samples) continue;
        if (!is_seen && mistake != Mistake::no_shadows) continue;
        if (s.is_back && mistake != Mistake::lamps_shine_back) continue;
        double f = w.direct_light == DirectLight::light ? 1.0 : share;
        if (w.kind->lamp_sample) f *= w.kind->lamp_sample(sight);
        // Twice both has the expectation of counting both in full.
        if (counts_twice(mistake, bounce)) f *= 2.0;
        (mistake == Mistake::no_samples_at_the_end ? later : now)[m] += factor[m] * all * f;
    }
}

void PathsOfAll::Walk::hit(const SurfacePoint& x, const Vec3& wo, const Rgb& beta, double pdf, double pdf_of_lamp, int bounce,
                           bool had_diffuse) {
    const Rgb front = paths.scene_.emitters.emitted(x, wo), back = is_black(front) ? paths.emitted_behind(x) : Rgb(0.0);
    if (is_black(front) && is_black(back)) return;
    const bool is_mirror = pdf == delta_pdf;
    const double share = is_mirror ? 1.0 : pdf * pdf / (pdf * pdf + pdf_of_lamp * pdf_of_lamp);
    for (std::size_t m = 0; m < now.size(); ++m) {
        const WrongTerms& w = paths.wrong_[m];
        const Mistake mistake = w.mistake();
        if ((w.direct_light == DirectLight::light || mistake == Mistake::no_hits) && !is_mirror) continue;
        if (is_mirror && (mistake == Mistake::no_light_after_mirror || (mistake == Mistake::no_caustics && had_diffuse))) continue;
        const Rgb& Le = mistake == Mistake::lamps_shine_back && is_black(front) ? back : front;
        double f = w.direct_light == DirectLight::bsdf ? 1.0 : share;
        if (counts_twice(mistake, bounce) && !is_mirror) f *= 2.0;
        now[m] += factor[m] * beta * Le * f;
    }
}

// The walk's own throughput, with the mistake, decides: beta times the factors of survivors, whose probability is in `factor`.
void PathsOfAll::Walk::play_roulette(const Rgb& beta, const Rgb& albedo, const std::optional<Rgb>& albedo_before) {
    for (std::size_t m = 0; m < factor.size(); ++m) {
        const MistakeKind& kind = *paths.wrong_[m].kind;
        const bool is_before = kind.survival == Survival::by_reflectance_before;
        if (!kind.survivors || !(survived[m] > 0.0) || (is_before && !albedo_before)) continue;
        const Rgb decides = is_before                                   ? *albedo_before
                            : kind.survival == Survival::by_reflectance ? albedo
                                                                        : beta * factor[m] / survived[m];
        const double p = std::min(max_component(decides), most_survival);
        survived[m] *= p;
        factor[m] *= p > 0.0 ? kind.survivors(p) : 0.0;
    }
}

void PathsOfAll::Walk::reflect(const Reflection& reflection) {
    for (std::size_t m = 0; m < factor.size(); ++m)
        if (const auto f = paths.wrong_[m].kind->reflection) factor[m] *= f(reflection);
}

void PathsOfAll::Walk::mirror() {
    factor = arrived;
    for (std::size_t m = 0; m < factor.size(); ++m)
        if (paths.wrong_[m].mistake() == Mistake::no_mirrors) factor[m] = Rgb(0.0);
}

void PathsOfAll::Walk::go_on(const NextDirection& next) {
    for (std::size_t m = 0; m < factor.size(); ++m)
        if (const auto f = paths.wrong_[m].kind->next_direction) factor[m] *= f(next);
}

void PathsOfAll::Walk::put(int bounce) {
    for (std::size_t r = 0; r < paths.ranges_.size(); ++r) {
        if (bounce < paths.ranges_[r].first || bounce > paths.ranges_[r].last) continue;
        for (std::size_t m = 0; m < now.size(); ++m) {
            Rgb brought = now[m];
            if (paths.wrong_[m].mistake() == Mistake::clamped && bounce >= paths.begins_)
                if (const double limit = paths.wrong_[m].limit * paths.scale_, most = max_component(brought); most > limit)
                    brought *= limit / most;
            found[m * paths.ranges_.size() + r] += brought;
        }
    }
    std::swap(now, later);
    std::fill(later.begin(), later.end(), Rgb(0.0));
}

void PathsOfAll::Walk::follow(int column, int row, Sampler& sampler) {
    std::fill(factor.begin(), factor.end(), Rgb(1.0));
    std::fill(survived.begin(), survived.end(), 1.0);
    for (std::vector<Rgb>* sum : {&now, &later, &found}) std::fill(sum->begin(), sum->end(), Rgb(0.0));
    put(go(column, row, sampler));
}

int PathsOfAll::Walk::go(int column, int row, Sampler& sampler) {
    const Scene& scene = paths.scene_;
    const CameraSample camera = sample_camera(scene, scene.film.crop_x + column, scene.film.crop_y + row, sampler);
    const CameraRay& ray = camera.ray;
    SurfacePoint x;
    if (!scene.geometry.first_hit(ray.origin, ray.direction, ray.length, x)) x.shape = SurfacePoint::infinity;
    Vec3 wo = -ray.direction;
    Rgb beta(camera.weight);
    std::optional<Rgb> albedo_before;
    for (std::size_t m = 0; m < now.size(); ++m) {
        const Mistake mistake = paths.wrong_[m].mistake();
        const Rgb front = scene.emitters.emitted(x, wo);
        const bool shows_back = mistake == Mistake::lamps_shine_back && is_black(front);
        if (mistake != Mistake::no_emission) now[m] = beta * (shows_back ? paths.emitted_behind(x) : front);
    }
    put(0);
    bool had_diffuse = false;
    const int last = paths.ranges_.back().last, first_roulette = std::max(paths.begins_, 1);
    int bounce = 1;
    for (; bounce <= last && !x.is_infinite(); ++bounce) {
        const SurfaceSide side = scene.materials.side(x, wo);
        if (!side.bsdf) break;
        const Vec3 local = side.p.frame.to_local(wo);
        const Rgb albedo = reflectance(*side.bsdf, side.p);
        if (bounce >= first_roulette) play_roulette(beta, albedo, albedo_before);
        albedo_before = albedo;
        arrived = factor;
        reflect({albedo, glm::dot(x.normal, wo) < 0.0 && !transmits(*side.bsdf)});
        if (!paths.lights_.empty()) sample_lamp(side, x, local, beta, bounce, sampler);
        const BsdfSample sampled = sample(*side.bsdf, side.p, local, sampler.next2());
        if (!(sampled.pdf > 0.0) || is_black(sampled.weight)) {
            put(bounce);
            return bounce + 1;
        }
        const Vec3 w = side.p.frame.to_world(sampled.wi);
        const bool is_mirror = sampled.pdf == delta_pdf;
        if (is_mirror)
            mirror();
        else
            go_on({sampled.wi, w, side.p.frame.n, albedo});
        had_diffuse = had_diffuse || !is_mirror;
        const SurfacePoint from = x;
        if (!scene.geometry.first_hit(from, w, x)) x.shape = SurfacePoint::infinity;
        beta *= sampled.weight;
        wo = -w;
        const bool is_lamp = scene.emitters.is_emitter(x.shape);
        const double pdf_of_lamp = is_lamp && !is_mirror && !paths.lights_.empty() ? paths.lights_.pdf({from.position}, w, x) : 0.0;
        if (is_lamp) hit(x, wo, beta, sampled.pdf, pdf_of_lamp, bounce, had_diffuse);
        put(bounce);
    }
    return bounce;
}

}  // namespace

std::vector<WrongTerms> wrong_terms(const Scene& scene, const WrongPaths& wanted, int samples, std::uint64_t seed,
                                    const Watch& watch) {
    const auto run = [&](std::vector<WrongTerms>& wrong, int n, std::uint64_t with_seed, double scale) {
        PathsOfAll paths(scene, wanted, wrong);
        paths.set_scale(scale);
        oneapi::tbb::parallel_for(0, paths.rows(), [&](int y) { paths.row(y, n, with_seed, watch); });
        if (watch.stop()) throw Stopped();
    };
    std::vector<WrongTerms> right = {{&mistake_kinds().front()}}, wrong = all_wrong(wanted.is_wanted);
    run(right, 4, seed + 1, 1.0);
    double sum = 0.0;
    const Image& mean = right[0].terms[wanted.begins].mean;
    for (const Rgb& c : mean.pixels) sum += max_component(c);
    run(wrong, samples, seed, sum / static_cast<double>(mean.pixels.size()));
    return wrong;
}

}  // namespace neumann
