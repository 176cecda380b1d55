#include "operators/experiments/blame/path_mistakes.h"

#include "core/emitter/light_sampler.h"
#include "core/scene/camera_sample.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace neumann {

namespace {

struct Kind {
    Mistake mistake;
    const char *name, *words;
    bool is_of_lamp_samples;  // whether the mistake depends on how light samples share the work with directions
};
constexpr Kind kinds[] = {
    {Mistake::none, "none", "nothing is wrong", false},
    {Mistake::times_pi, "times_pi", "every diffuse reflection has a factor π too much (1/π is missing in the BRDF)", false},
    {Mistake::over_pi, "over_pi", "every diffuse reflection is divided by π once too often", false},
    {Mistake::albedo_squared, "albedo_squared", "reflectances are multiplied in twice", false},
    {Mistake::white, "white", "reflectances are left out: surfaces reflect as if they were white", false},
    {Mistake::no_cosine, "no_cosine", "cosθ at the receiving surface is missing where lamps are sampled", true},
    {Mistake::cosine_squared, "cosine_squared", "cosθ at the receiving surface counts twice where lamps are sampled", true},
    {Mistake::no_light_cosine, "no_light_cosine", "cosθ at the lamp is missing where points on lamps are sampled", true},
    {Mistake::no_inverse_square, "no_inverse_square", "1/d² is missing where points on lamps are sampled", true},
    {Mistake::half_light, "half_light", "samples of lamps count half (their area or their pdf is off by 2)", false},
    {Mistake::twice_light, "twice_light", "samples of lamps count twice (their area or their pdf is off by 2)", false},
    {Mistake::no_shadows, "no_shadows", "lamps shine through surfaces: visibility is not tested", true},
    {Mistake::lamps_shine_back, "lamps_shine_back", "lamps shine from both sides", true},
    {Mistake::light_twice, "light_twice",
     "light is counted twice: samples of lamps and directions that hit them both count in full", false},
    {Mistake::no_lamp_samples, "no_lamp_samples",
     "samples of lamps are missing (paths with s = 1), and directions that hit lamps have their weight beside them", false},
    {Mistake::no_hits, "no_hits",
     "directions that hit lamps are missing (paths with s = 0), and samples of lamps have their weight beside them", false},
    {Mistake::no_light_after_mirror, "no_light_after_mirror",
     "lamps that are hit after a mirror or glass do not count: their reflections and caustics are missing", false},
    {Mistake::no_caustics, "no_caustics", "light that comes by way of mirrors or glass to other surfaces is missing", false},
    {Mistake::no_mirrors, "no_mirrors", "mirrors and glass reflect nothing", false},
    {Mistake::black_backs, "black_backs", "surfaces are black from behind: one-sided where they should be two-sided", false},
    {Mistake::no_emission, "no_emission", "lamps are not seen directly", false},
    {Mistake::no_roulette_weight, "no_roulette_weight", "survivors of Russian roulette are not divided by their probability",
     false},
    {Mistake::clamped, "clamped", "bright samples are clamped", false},
};
constexpr double clamp_limits[] = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0};
constexpr double most_survival = 0.95;

const Kind& kind_of(Mistake mistake) {
    return *std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.mistake == mistake; });
}

std::vector<WrongTerms> all_wrong() {
    std::vector<WrongTerms> all;
    for (const Kind& kind : kinds) {
        if (kind.mistake == Mistake::clamped) {
            for (const double limit : clamp_limits) all.push_back({kind.mistake, false, limit, {}});
            continue;
        }
        all.push_back({kind.mistake, false, 0.0, {}});
        if (kind.is_of_lamp_samples) all.push_back({kind.mistake, true, 0.0, {}});
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

// Follows paths, and adds up their contributions under each mistake.
class WrongPaths {
public:
    WrongPaths(const Scene& scene, const std::vector<BounceRange>& ranges, std::vector<WrongTerms>& wrong)
        : scene_(scene), ranges_(ranges), wrong_(wrong), lights_(scene.geometry, scene.emitters) {
        for (WrongTerms& w : wrong)
            for (std::size_t r = 0; r < ranges.size(); ++r)
                w.terms.push_back(
                    {Image(scene.film.crop_width, scene.film.crop_height), Image(scene.film.crop_width, scene.film.crop_height)});
    }

    // Sets the mean of the right picture in the first range, from a few samples; clamps are relative to it.
    void set_scale(double scale) { scale_ = scale; }

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
        const double n = samples;
        for (std::size_t m = 0; m < wrong_.size(); ++m)
            for (std::size_t r = 0; r < ranges_.size(); ++r) {
                const Rgb mean = sums[m * ranges_.size() + r] / n;
                wrong_[m].terms[r].mean.at(x, y) = mean;
                wrong_[m].terms[r].variance.at(x, y) =
                    glm::max(squares[m * ranges_.size() + r] / n - mean * mean, 0.0) / std::max(n - 1.0, 1.0);
            }
    }

private:
    struct Walk {
        explicit Walk(const WrongPaths& paths)
            : paths(paths),
              factor(paths.wrong_.size()),
              now(paths.wrong_.size()),
              found(paths.wrong_.size() * paths.ranges_.size()) {}
        void follow(int x, int y, Sampler& sampler);
        // Adds the contributions to this bounce to the range that contains it.
        void put(int bounce);
        void sample_lamp(const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo, const Rgb& beta, Sampler& sampler);
        void hit(const SurfacePoint& x, const Vec3& wo, const Rgb& beta, double pdf, double pdf_of_lamp, bool had_diffuse);
        void reflect(const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo, const Rgb& beta, int bounce, bool is_mirror);

        const WrongPaths& paths;
        // By mistake: the factors of the path so far, and the contribution to this bounce.
        std::vector<Rgb> factor, now;
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
    std::vector<WrongTerms>& wrong_;
    LightSampler lights_;
    double scale_ = 1.0;
};

LampSample WrongPaths::sample_lamp(const SurfacePoint& x, Sampler& sampler) const {
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

void WrongPaths::Walk::sample_lamp(const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo, const Rgb& beta,
                                   Sampler& sampler) {
    const LampSample s = paths.sample_lamp(x, sampler);
    if (!(s.pdf > 0.0) || is_black(s.light)) return;
    const Vec3 wi = side.p.frame.to_local(s.w);
    const Rgb all = beta * eval(*side.bsdf, side.p, wo, wi) * s.light * std::abs(wi.z);
    if (is_black(all)) return;
    const bool is_seen = paths.scene_.geometry.visible(x, s.y);
    const double other = s.pdf == delta_pdf ? 0.0 : pdf(*side.bsdf, side.p, wo, wi), cosine = std::abs(wi.z);
    const double share = s.pdf == delta_pdf ? 1.0 : s.pdf * s.pdf / (s.pdf * s.pdf + other * other);
    for (std::size_t m = 0; m < now.size(); ++m) {
        const WrongTerms& w = paths.wrong_[m];
        double f = w.without_hits ? 1.0 : share;
        if (!is_seen && w.mistake != Mistake::no_shadows) continue;
        if (s.is_back && w.mistake != Mistake::lamps_shine_back) continue;
        if (w.mistake == Mistake::no_lamp_samples) continue;
        switch (w.mistake) {
            case Mistake::no_cosine:
                f /= cosine;
                break;
            case Mistake::cosine_squared:
                f *= cosine;
                break;
            case Mistake::no_light_cosine:
                f /= s.cosine;
                break;
            case Mistake::no_inverse_square:
                f *= s.is_surface ? s.distance2 : 1.0;
                break;
            case Mistake::half_light:
                f *= 0.5;
                break;
            case Mistake::twice_light:
                f *= 2.0;
                break;
            case Mistake::light_twice:
                f *= 2.0;  // this has the expectation of counting both in full
                break;
            default:
                break;
        }
        now[m] += factor[m] * all * f;
    }
}

void WrongPaths::Walk::hit(const SurfacePoint& x, const Vec3& wo, const Rgb& beta, double pdf, double pdf_of_lamp,
                           bool had_diffuse) {
    const Rgb front = paths.scene_.emitters.emitted(x, wo), back = is_black(front) ? paths.emitted_behind(x) : Rgb(0.0);
    if (is_black(front) && is_black(back)) return;
    const bool is_mirror = pdf == delta_pdf;
    const double share = is_mirror ? 1.0 : pdf * pdf / (pdf * pdf + pdf_of_lamp * pdf_of_lamp);
    for (std::size_t m = 0; m < now.size(); ++m) {
        const WrongTerms& w = paths.wrong_[m];
        if ((w.without_hits || w.mistake == Mistake::no_hits) && !is_mirror) continue;
        if (is_mirror && (w.mistake == Mistake::no_light_after_mirror || (w.mistake == Mistake::no_caustics && had_diffuse)))
            continue;
        const Rgb& Le = w.mistake == Mistake::lamps_shine_back && is_black(front) ? back : front;
        now[m] += factor[m] * beta * Le * (w.mistake == Mistake::light_twice && !is_mirror ? 2.0 * share : share);
    }
}

void WrongPaths::Walk::reflect(const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo, const Rgb& beta, int bounce,
                               bool is_mirror) {
    const Rgb albedo = reflectance(*side.bsdf, side.p);
    const bool is_behind = glm::dot(x.normal, side.p.frame.to_world(wo)) < 0.0;
    const double survival = std::min(max_component(beta), most_survival);
    for (std::size_t m = 0; m < factor.size(); ++m) {
        switch (paths.wrong_[m].mistake) {
            case Mistake::times_pi:
                if (!is_mirror) factor[m] *= pi;
                break;
            case Mistake::over_pi:
                if (!is_mirror) factor[m] *= inv_pi;
                break;
            case Mistake::albedo_squared:
                if (!is_mirror) factor[m] *= albedo;
                break;
            case Mistake::white:
                if (!is_mirror && max_component(albedo) > 0.0)
                    for (int c = 0; c < 3; ++c) factor[m][c] *= albedo[c] > 0.0 ? 1.0 / albedo[c] : 0.0;
                break;
            case Mistake::no_mirrors:
                if (is_mirror) factor[m] = Rgb(0.0);
                break;
            case Mistake::black_backs:
                if (is_behind && !transmits(*side.bsdf)) factor[m] = Rgb(0.0);
                break;
            case Mistake::no_roulette_weight:
                // The throughput on arrival decides whether the path goes on to this bounce.
                if (bounce >= std::max(paths.ranges_.front().first, 1)) factor[m] *= survival;
                break;
            default:
                break;
        }
    }
}

void WrongPaths::Walk::put(int bounce) {
    for (std::size_t r = 0; r < paths.ranges_.size(); ++r) {
        if (bounce < paths.ranges_[r].first || bounce > paths.ranges_[r].last) continue;
        for (std::size_t m = 0; m < now.size(); ++m) {
            Rgb brought = now[m];
            if (paths.wrong_[m].mistake == Mistake::clamped)
                if (const double limit = paths.wrong_[m].limit * paths.scale_, most = max_component(brought); most > limit)
                    brought *= limit / most;
            found[m * paths.ranges_.size() + r] += brought;
        }
    }
    std::fill(now.begin(), now.end(), Rgb(0.0));
}

void WrongPaths::Walk::follow(int column, int row, Sampler& sampler) {
    const Scene& scene = paths.scene_;
    std::fill(factor.begin(), factor.end(), Rgb(1.0));
    std::fill(now.begin(), now.end(), Rgb(0.0));
    std::fill(found.begin(), found.end(), Rgb(0.0));
    const CameraSample camera = sample_camera(scene, scene.film.crop_x + column, scene.film.crop_y + row, sampler);
    const CameraRay& ray = camera.ray;
    SurfacePoint x;
    if (!scene.geometry.first_hit(ray.origin, ray.direction, ray.length, x)) x.shape = SurfacePoint::infinity;
    Vec3 wo = -ray.direction;
    Rgb beta(camera.weight);
    for (std::size_t m = 0; m < now.size(); ++m) {
        const Mistake mistake = paths.wrong_[m].mistake;
        const Rgb front = scene.emitters.emitted(x, wo);
        const bool shows_back = mistake == Mistake::lamps_shine_back && is_black(front);
        if (mistake != Mistake::no_emission) now[m] = beta * (shows_back ? paths.emitted_behind(x) : front);
    }
    put(0);
    bool had_diffuse = false;
    const int last = paths.ranges_.back().last;
    for (int bounce = 1; bounce <= last && !x.is_infinite(); ++bounce) {
        const SurfaceSide side = scene.materials.side(x, wo);
        if (!side.bsdf) return;
        const Vec3 local = side.p.frame.to_local(wo);
        arrived = factor;
        reflect(side, x, local, beta, bounce, false);
        if (!paths.lights_.empty()) sample_lamp(side, x, local, beta, sampler);
        const BsdfSample sampled = sample(*side.bsdf, side.p, local, sampler.next2());
        if (!(sampled.pdf > 0.0) || is_black(sampled.weight)) {
            put(bounce);
            return;
        }
        if (sampled.pdf == delta_pdf) {
            factor = arrived;
            reflect(side, x, local, beta, bounce, true);
        }
        const Vec3 w = side.p.frame.to_world(sampled.wi);
        had_diffuse = had_diffuse || sampled.pdf != delta_pdf;
        const SurfacePoint from = x;
        if (!scene.geometry.first_hit(from, w, x)) x.shape = SurfacePoint::infinity;
        beta *= sampled.weight;
        wo = -w;
        const bool is_lamp = scene.emitters.is_emitter(x.shape);
        const double pdf_of_lamp =
            is_lamp && sampled.pdf != delta_pdf && !paths.lights_.empty() ? paths.lights_.pdf({from.position}, w, x) : 0.0;
        if (is_lamp) hit(x, wo, beta, sampled.pdf, pdf_of_lamp, had_diffuse);
        put(bounce);
    }
}

}  // namespace

const char* name_of(Mistake mistake) { return kind_of(mistake).name; }
const char* describe(Mistake mistake) { return kind_of(mistake).words; }

std::vector<WrongTerms> wrong_terms(const Scene& scene, const std::vector<BounceRange>& ranges, int samples, std::uint64_t seed,
                                    const Watch& watch) {
    const auto run = [&](std::vector<WrongTerms>& wrong, int n, std::uint64_t with_seed, double scale) {
        WrongPaths paths(scene, ranges, wrong);
        paths.set_scale(scale);
        std::atomic<bool> stopped = false;
        oneapi::tbb::parallel_for(0, scene.film.crop_height, [&](int y) {
            if (stopped || watch.stop()) stopped = true;
            for (int x = 0; x < scene.film.crop_width && !stopped; ++x) paths.pixel(x, y, n, with_seed);
        });
        if (stopped) throw Stopped();
    };
    std::vector<WrongTerms> right = {{Mistake::none, false, 0.0, {}}}, wrong = all_wrong();
    run(right, 4, seed + 1, 1.0);
    double sum = 0.0;
    for (const Rgb& c : right[0].terms[0].mean.pixels) sum += max_component(c);
    run(wrong, samples, seed, sum / static_cast<double>(right[0].terms[0].mean.pixels.size()));
    return wrong;
}

}  // namespace neumann
