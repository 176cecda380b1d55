#include "operators/experiments/blame/blame.h"

#include "operators/experiments/blame/sentences.h"
#include "operators/experiments/blame/shared_numbers.h"
#include "operators/experiments/blame/sure_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace neumann {

namespace {

// A mistake must be likelier than none by this, as −2 log of the likelihood.
constexpr double strong_evidence = 40.0;
// Two pictures of one renderer differ by more than their noise if their difference has a smaller probability.
constexpr double agreement_of_seeds = 0.05;
constexpr std::size_t places_a_term = 3;
constexpr std::uint64_t most_replayed = 64;  // samples of a pixel, from which a path is chosen

void expect_finite(const DepthPicture& picture) {
    const Image& mean = picture.mean;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            if (!is_finite(mean.at(x, y)))
                throw InputError(fmt::format("picture {}: the pixel in column {} and row {} is not finite", picture.depth, x, y));
}

void check(const std::vector<DepthPicture>& pictures, std::optional<Counting> counting) {
    if (pictures.empty()) throw InputError("there are no pictures to compare with");
    for (const DepthPicture& picture : pictures) expect_finite(picture);
    terms_of(pictures, counting.value_or(Counting::pbrt));  // throws if sizes or numbers are wrong
}

Scene on_their_film(const Scene& scene, const Image& picture) {
    Film film = scene.film;
    if (film.crop_width == picture.width && film.crop_height == picture.height) return scene;
    const bool is_cropped = film.crop_width != film.width || film.crop_height != film.height;
    if (is_cropped || std::int64_t{film.width} * picture.height != std::int64_t{film.height} * picture.width)
        throw InputError(fmt::format("the pictures have {}×{} pixels, and the scene's film has {}×{}, which is another shape",
                                     picture.width, picture.height, film.crop_width, film.crop_height));
    film.width = film.crop_width = picture.width;
    film.height = film.crop_height = picture.height;
    return scene.with(film);
}

bool is_black_everywhere(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgb& c) { return is_black(c); });
}

PictureNoise noise_of(const PixelEstimate& picture) {
    Image variance = picture.standard_error;
    for (Rgb& c : variance.pixels) c *= c;
    return {picture.mean, std::move(variance)};
}

PictureNoise sum_of(const BounceSeries& ours, const BounceRange& bounces) {
    PictureNoise sum = noise_of(ours.term(static_cast<std::size_t>(bounces.first)));
    for (int i = bounces.first + 1; i <= bounces.last; ++i) {
        const PictureNoise next = noise_of(ours.term(static_cast<std::size_t>(i)));
        for (std::size_t p = 0; p < sum.mean.pixels.size(); ++p) {
            sum.mean.pixels[p] += next.mean.pixels[p];
            sum.variance.pixels[p] += next.variance.pixels[p];
        }
    }
    return sum;
}

// The squared error that samples leave open even if they agree (PixelEstimate::least_error).
Image left_open(const BounceSeries& ours, const BounceRange& bounces) {
    Image sum;
    for (int i = bounces.first; i <= bounces.last; ++i) {
        const PixelEstimate term = ours.term(static_cast<std::size_t>(i));
        if (sum.pixels.empty()) sum = Image(term.mean.width, term.mean.height);
        for (std::size_t p = 0; p < term.least_error.pixels.size(); ++p)
            sum.pixels[p] += term.least_error.pixels[p] * term.least_error.pixels[p];
    }
    return sum;
}

// The variance, but at least what few samples leave open in each pixel; `times`: their variance in units of ours.
Image believed_one_by_one(Image variance, const ComparedTerm& term, double times) {
    for (std::size_t p = 0; p < variance.pixels.size(); ++p)
        variance.pixels[p] = glm::max(variance.pixels[p], term.left_open.pixels[p] * times);
    return variance;
}

Image in_errors(const Estimate& difference) {
    Image z(difference.mean.width, difference.mean.height);
    for (std::size_t p = 0; p < z.pixels.size(); ++p)
        for (int c = 0; c < 3; ++c)
            if (const double d = difference.mean.pixels[p][c]; d != 0.0)
                z.pixels[p][c] = d / difference.standard_error.pixels[p][c];
    return z;
}

std::vector<std::uint32_t> shapes_seen(const Scene& scene) {
    std::vector<std::uint32_t> shapes;
    for (int y = 0; y < scene.film.crop_height; ++y)
        for (int x = 0; x < scene.film.crop_width; ++x) {
            const CameraRay ray = scene.camera.ray({scene.film.crop_x + x + 0.5, scene.film.crop_y + y + 0.5});
            SurfacePoint hit;
            const bool met = scene.geometry.first_hit(ray.origin, ray.direction, ray.length, hit);
            shapes.push_back(met ? hit.shape : SurfacePoint::infinity);
        }
    return shapes;
}

class Judge {
public:
    Judge(ExpectedPictures& expected, std::optional<Counting> counting)
        : expected_(expected), scene_(expected.scene()), counting_(counting) {}

    Blame judge(const std::vector<DepthPicture>& pictures) {
        int most = 0;
        for (const DepthPicture& p : pictures) most = std::max(most, p.depth + 1);
        const std::shared_ptr<const BounceSeries> rendered = expected_.ours(most);
        const BounceSeries& ours = *rendered;
        result_.samples = ours.samples;
        choose_counting(pictures, ours);
        judge_noise(pictures, ours);
        compare(terms_of(pictures, result_.counting), ours);
        judge_terms();
        if (result_.first_wrong) {
            find_shapes();
            find_places(ours);
        }
        result_.sentences = sentences_about(result_, scene_);
        return std::move(result_);
    }

private:
    void choose_counting(const std::vector<DepthPicture>& pictures, const BounceSeries& ours) {
        if (counting_ == Counting::bounces) {
            result_.counting = Counting::bounces;
            return;
        }
        std::vector<double> sums;
        for (int i = 0; i <= ours.bounces(); ++i) sums.push_back(mean_of(ours.sum(static_cast<std::size_t>(i)).mean));
        const Counting likely = likely_counting(pictures, sums);
        result_.counting = counting_.value_or(likely);
        constexpr double close = 0.02, clearly = 4.0;
        const double misfit = misfit_of_means(pictures, likely, sums);
        if (misfit < close && misfit_of_means(pictures, result_.counting, sums) > clearly * misfit + close)
            result_.counting_by_the_data = likely;
    }

    // Finds the factor from our variance to theirs, from the picture with the smallest one: mistakes only increase it.
    void judge_noise(const std::vector<DepthPicture>& pictures, const BounceSeries& ours) {
        for (const DepthPicture& p : pictures) {
            if (p.variance) continue;
            const int last = last_bounce(result_.counting, p.depth);
            if (last < 0) continue;
            const auto i = static_cast<std::size_t>(last);
            const PictureNoise known = noise_of(are_sums() ? ours.sum(i) : ours.term(i));
            times_ = std::min(times_, times_the_variance(p.mean, known));
        }
        if (!std::isfinite(times_)) times_ = 1.0;
    }

    Image likely_variance(const BounceRange& bounces, const BounceSeries& ours) const {
        const auto last = static_cast<std::size_t>(bounces.last);
        Image variance = noise_of(are_sums() ? ours.sum(last) : ours.term(last)).variance;
        if (are_sums() && bounces.first > 0) {
            const Image before = noise_of(ours.sum(static_cast<std::size_t>(bounces.first - 1))).variance;
            for (std::size_t p = 0; p < variance.pixels.size(); ++p) variance.pixels[p] += before.pixels[p];
        }
        for (Rgb& c : variance.pixels) c *= times_;
        return variance;
    }

    void compare(std::vector<OtherTerm> theirs, const BounceSeries& ours) {
        result_.knows_their_noise =
            std::all_of(theirs.begin(), theirs.end(), [](const OtherTerm& t) { return t.variance.has_value(); });
        for (OtherTerm& t : theirs) {
            ComparedTerm c{t.bounces,
                           {std::move(t.mean), {}},
                           sum_of(ours, t.bounces),
                           std::move(t.half_difference),
                           left_open(ours, t.bounces),
                           {},
                           {}};
            c.theirs.variance = t.variance ? std::move(*t.variance) : likely_variance(t.bounces, ours);
            c.our_sum = ours.sum(static_cast<std::size_t>(t.bounces.last)).mean;
            c.our_sum_before = Image(c.our_sum.width, c.our_sum.height);
            if (t.bounces.first > 0) c.our_sum_before = ours.sum(static_cast<std::size_t>(t.bounces.first - 1)).mean;
            compared_.push_back(std::move(c));
        }
    }

    void judge_terms() {
        const std::vector<SureCause> sure = find_sure_causes(expected_, compared_, are_sums());
        for (std::size_t i = 0; i < compared_.size(); ++i) {
            const ComparedTerm& c = compared_[i];
            TermVerdict v;
            v.bounces = c.bounces;
            v.test = test_difference(c.theirs, c.ours);
            v.threshold = false_alarms / static_cast<double>(compared_.size());
            v.differs = v.test.p < v.threshold;
            if (!result_.first_wrong && (v.differs || sure[i].is_found())) look_into(v, i, sure[i]);
            v.theirs = c.theirs;
            v.ours = c.ours;
            v.difference = difference_of({c.theirs.mean, believed_one_by_one(c.theirs.variance, c, times_)},
                                         {c.ours.mean, believed_one_by_one(c.ours.variance, c, 1.0)});
            v.z = in_errors(v.difference);
            if (v.differs && !result_.first_wrong) result_.first_wrong = i;
            result_.terms.push_back(std::move(v));
        }
    }

    // Judges a term that is further apart from ours than chance explains. It differs if some mistake is clearly
    // likelier than none, and either the mistake explains the difference, or their pixels are known not to have shared
    // their errors. The term after it is explained together with it.
    void look_into(TermVerdict& v, std::size_t i, const SureCause& sure) {
        const ComparedTerm& c = compared_[i];
        const auto from = compared_.begin() + static_cast<std::ptrdiff_t>(i);
        const std::vector<ComparedTerm> terms(from, from + std::min<std::ptrdiff_t>(2, compared_.end() - from));
        std::vector<Suspect> suspects = find_suspects(expected_, before_that_agrees(i), terms, are_sums(), shapes_seen(scene_));
        const double of_none = misfit_of_none(terms);
        const auto is_strong = [&](const Suspect& s) { return of_none - s.misfit > strong_evidence; };
        const bool is_likely = std::ranges::any_of(suspects, is_strong);
        const bool is_explained = sure.is_found() || std::ranges::any_of(suspects, [&](const Suspect& s) {
                                      return s.is_a_cause && s.explains() && is_strong(s);
                                  });
        v.differs = is_likely && (is_explained || are_independent(c));
        if (v.differs) {
            std::ranges::stable_partition(suspects, [&](const Suspect& s) { return s.words == sure.words; });
            result_.suspects = std::move(suspects);
        } else {
            v.doubt = is_likely ? doubt_about(c) : TermVerdict::Doubt::few_samples;
        }
    }

    // The term before, if it agrees.
    const ComparedTerm* before_that_agrees(std::size_t i) const {
        if (i == 0 || result_.terms[i - 1].differs || result_.terms[i - 1].doubt) return nullptr;
        return &compared_[i - 1];
    }

    // Their two pictures, unless they are the same.
    static std::optional<std::pair<PictureNoise, PictureNoise>> two_seeds(const ComparedTerm& c) {
        if (!c.half_difference || is_black_everywhere(*c.half_difference)) return std::nullopt;
        std::pair<PictureNoise, PictureNoise> two(c.theirs, c.theirs);
        for (std::size_t p = 0; p < c.theirs.mean.pixels.size(); ++p) {
            two.first.mean.pixels[p] += c.half_difference->pixels[p];
            two.second.mean.pixels[p] -= c.half_difference->pixels[p];
        }
        return two;
    }

    // Whether their pixels have independent random numbers.
    static bool are_independent(const ComparedTerm& c) {
        const auto two = two_seeds(c);
        return smooth_part(c.theirs, c.ours) < most_if_independent ||
               (two && !seeds_differ(*two) && smooth_part(two->first, two->second) < most_if_independent);
    }

    static bool seeds_differ(const std::pair<PictureNoise, PictureNoise>& two) {
        return test_difference(two.first, two.second).p < agreement_of_seeds;
    }

    static TermVerdict::Doubt doubt_about(const ComparedTerm& c) {
        const auto two = two_seeds(c);
        if (two && seeds_differ(*two)) return TermVerdict::Doubt::seeds_differ;
        if (is_mostly_ours(c)) return TermVerdict::Doubt::few_samples;
        return two ? TermVerdict::Doubt::seeds_agree : TermVerdict::Doubt::shared_numbers;
    }

    // Whether most of the noise that hides the difference is ours.
    static bool is_mostly_ours(const ComparedTerm& c) {
        double ours = 0.0, all = 0.0;
        for (const Rgb& v : c.ours.variance.pixels) ours += v.r + v.g + v.b;
        for (const BlockDifference& b : block_differences(c.theirs, c.ours).blocks)
            all += (b.noise.r + b.noise.g + b.noise.b) * b.pixels() * b.pixels();
        return ours > 0.5 * all;
    }

    bool are_sums() const { return result_.counting != Counting::bounces; }

    void find_shapes() {
        const TermVerdict& v = result_.terms[*result_.first_wrong];
        const std::vector<std::uint32_t> shapes = shapes_seen(scene_);
        struct Sums {
            double squares = 0.0, theirs = 0.0, ours = 0.0;
        };
        std::map<std::uint32_t, Sums> by_shape;
        double all = 0.0;
        for (std::size_t p = 0; p < shapes.size(); ++p) {
            Sums& sums = by_shape[shapes[p]];
            const double square = glm::dot(v.difference.mean.pixels[p], v.difference.mean.pixels[p]);
            sums.squares += square;
            sums.theirs += mean_component(v.theirs.mean.pixels[p]);
            sums.ours += mean_component(v.ours.mean.pixels[p]);
            all += square;
        }
        for (const auto& [shape, sums] : by_shape)
            result_.shapes.push_back(
                {shape, all > 0.0 ? sums.squares / all : 0.0, sums.ours > 0.0 ? sums.theirs / sums.ours : 1.0});
        std::sort(result_.shapes.begin(), result_.shapes.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    }

    void find_places(const BounceSeries& ours) {
        const auto& record = std::get<PathRecord>(ours.record);
        const RecordedSamples samples(
            scene_, {ours.method, ours.seed, ours.bounces(), record.rest_probability.value_or(0.0), record.replicate_size});
        for (TermVerdict& v : result_.terms) {
            if (!v.differs) continue;
            v.worst = worst_places(v.theirs, v.ours, places_a_term);
            for (WorstPlace& place : v.worst) {
                const auto pixel = static_cast<std::uint32_t>(place.pixel_y * v.z.width + place.pixel_x);
                place.path = brightest_path(scene_, samples, pixel, std::min(ours.samples, most_replayed), v.bounces);
            }
        }
    }

    ExpectedPictures& expected_;
    const Scene& scene_;
    const std::optional<Counting> counting_;
    double times_ = std::numeric_limits<double>::infinity();  // their variance, in units of ours
    std::vector<ComparedTerm> compared_;
    Blame result_;
};

}  // namespace

const char* name_of(Blame::Verdict verdict) {
    switch (verdict) {
        case Blame::Verdict::right:
            return "right";
        case Blame::Verdict::wrong:
            return "wrong";
        default:
            return "unclear";
    }
}

const TermVerdict* Blame::first_doubtful() const {
    const auto found = std::ranges::find_if(terms, [](const TermVerdict& t) { return t.doubt.has_value(); });
    return found == terms.end() ? nullptr : &*found;
}

Blame blame(const Scene& scene, std::vector<DepthPicture> pictures, const BlameSettings& settings, const Watch& watch) {
    check(pictures, settings.counting);
    ExpectedPictures expected(on_their_film(scene, pictures.front().mean), settings.samples, settings.seconds, settings.seed,
                              watch);
    return Judge(expected, settings.counting).judge(pictures);
}

Blame blame(ExpectedPictures& expected, const std::vector<DepthPicture>& pictures, std::optional<Counting> counting) {
    check(pictures, counting);
    const Film& film = expected.scene().film;
    if (const Image& mean = pictures.front().mean; mean.width != film.crop_width || mean.height != film.crop_height)
        throw InputError(fmt::format("the pictures have {}×{} pixels, expected the film's {}×{}", mean.width, mean.height,
                                     film.crop_width, film.crop_height));
    return Judge(expected, counting).judge(pictures);
}

}  // namespace neumann
