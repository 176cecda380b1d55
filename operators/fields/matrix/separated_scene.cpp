#include "operators/fields/matrix/separated_scene.h"

#include "core/base/error.h"
#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "core/scene/pass_lights.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/ray_table.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/sides.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t stream_of_lamps = 0x6c616d7073ull, stream_of_camera = 0x746f756368ull;
constexpr std::size_t most_lamps = 12;      // those that are not among the brightest are one
constexpr std::size_t most_facets = 16384;  // numbers of 16 bits, and a frame in time
constexpr std::size_t most_at_once = 1024;  // samples of all lamps together for a facet, if there are many lamps

void expect_diffuse(const Scene& scene) {
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape)
        for (const bool front : {true, false}) {
            const Bsdf* const bsdf = scene.materials.at(shape, front);
            if (!is_glossy(bsdf)) continue;
            const std::string why = "is not diffuse, and R is a number for each patch only where all materials are";
            if (shape >= scene.origins.size()) throw InputError(fmt::format("the material of shape {} {}", shape, why));
            const Origin& origin = scene.origins[shape];
            throw InputError(origin.place, fmt::format("{} of {} {}", origin.bsdf, origin.shape, why));
        }
}

class Separation {
public:
    Separation(const Scene& scene, const SeparatingSettings& settings, const Watch& watch)
        : scene_(scene),
          settings_(settings),
          space_(scene_patches(scene, {.patches = settings.patches, .compared = false})),
          table_(few(space_), settings.rays, settings.seed, watch) {}

    SeparatedScene result() {
        result_.rays = settings_.rays;
        result_.seen.assign(table_.seen().begin(), table_.seen().end());
        fill_facets();
        fill_lamps();
        look();
        return std::move(result_);
    }

private:
    static const PatchSpace& few(const PatchSpace& space) {
        if (space.facets().size() <= most_facets) return space;
        throw InputError(fmt::format(
            "the scene has {} sides of patches at least, one for each flat or round piece; expected {} or fewer to touch",
            space.facets().size(), most_facets));
    }

    std::uint32_t material_of(const Facet& facet) {
        const std::uint32_t shape = space_.patches().chart(facet.patch).shape();
        const Bsdf* const bsdf = scene_.materials.at(shape, facet.front);
        const auto [known, is_new] = number_of_.try_emplace(bsdf, static_cast<std::uint32_t>(result_.materials.size()));
        if (is_new) {
            const bool has_name = bsdf && shape < scene_.origins.size();
            result_.materials.push_back({has_name ? scene_.origins[shape].bsdf
                                         : bsdf   ? "a material"
                                                  : "black",
                                         Rgb(0.0), !bsdf || is_constant(*bsdf)});
        }
        return known->second;
    }

    void fill_facets() {
        const ReflectionMatrix<4> R(scene_.materials, space_);
        for (std::uint32_t f = 0; f < space_.facets().size(); ++f) {
            const Facet& facet = space_.facets()[f];
            result_.facets.push_back({material_of(facet), space_.patches().area(facet.patch), to_rgb<4>(R.reflectance().col(f))});
        }
        std::vector<double> areas(result_.materials.size(), 0.0);
        for (const SeparatedScene::Facet& f : result_.facets) {
            result_.materials[f.material].reflectance += f.reflectance * f.area;
            areas[f.material] += f.area;
        }
        for (std::size_t m = 0; m < areas.size(); ++m) result_.materials[m].reflectance /= areas[m];
    }

    // The lamp of each entry of Emitters::powers(): first of shapes, then of distant lights.
    void name_lamps() {
        const std::vector<double>& powers = scene_.emitters.powers();
        const std::size_t shapes = scene_.geometry.shapes().size();
        std::vector<std::size_t> shining;
        for (std::size_t k = 0; k < powers.size(); ++k)
            if (powers[k] > 0.0) shining.push_back(k);
        std::ranges::stable_sort(shining, [&](std::size_t a, std::size_t b) { return powers[a] > powers[b]; });
        lamp_of_.assign(powers.size(), 0);
        for (std::size_t i = 0; i < shining.size(); ++i) {
            const std::size_t k = shining[i], lamp = std::min(i, most_lamps - 1);
            lamp_of_[k] = lamp;
            if (lamp < result_.lamps.size()) {
                result_.lamps[lamp].name = fmt::format("the other {} lamps", shining.size() - lamp);
                continue;
            }
            const bool is_sky = k == shapes && scene_.emitters.has_environment();
            result_.lamps.push_back({k < shapes ? (k < scene_.origins.size() ? scene_.origins[k].shape : fmt::format("shape {}", k))
                                     : is_sky   ? "the sky"
                                                : fmt::format("light {}", k - shapes + 1)});
        }
        for (SeparatedScene::Lamp& lamp : result_.lamps) {
            lamp.emitted.assign(result_.facets.size(), Rgb(0.0));
            lamp.arriving.assign(result_.facets.size(), Rgb(0.0));
        }
    }

    void fill_lamps() {
        name_lamps();
        const ExitantVector<4> Le = emitted_light<4>(scene_, space_);
        for (std::uint32_t f = 0; f < result_.facets.size(); ++f) {
            const std::uint32_t shape = space_.patches().chart(space_.facets()[f].patch).shape();
            if (scene_.emitters.is_emitter(shape)) result_.lamps[lamp_of_[shape]].emitted[f] = to_rgb<4>(Le.col(f));
        }
        const LightSampler lights(scene_.geometry, scene_.emitters, LightChoice::all, LightPlace::near_projected);
        if (lights.empty()) return;
        const std::size_t all = lights.samples_per_point();
        std::uint32_t samples = settings_.rays;
        while (samples > 1 && samples * all > std::max<std::size_t>(most_at_once, settings_.rays)) samples /= 2;
        const SobolPoints points(samples);
        oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(result_.facets.size()), [&](std::uint32_t f) {
            const Facet& facet = space_.facets()[f];
            Sampler sampler(points, settings_.seed ^ stream_of_lamps, f);
            for (std::uint32_t i = 0; i < samples; ++i) {
                sampler.start(i);
                const SurfacePoint x = space_.patches().point(facet.patch, sampler.next2());
                const Frame frame = space_.frame(facet, x);
                for (std::size_t n = 0; n < all; ++n) {
                    const LightSample y = lights.sample({x.position, frame.n}, sampler.next2(), n);
                    const double cosine = glm::dot(frame.n, y.w);
                    if (!(y.pdf > 0.0) || !(cosine > 0.0) || !scene_.geometry.visible(x, y.point)) continue;
                    const std::size_t source = y.point.is_infinite() ? scene_.geometry.shapes().size() + y.distant : y.point.shape;
                    result_.lamps[lamp_of_[source]].arriving[f] += y.weight * (cosine * inv_pi / samples);
                }
            }
        });
        for (SeparatedScene::Lamp& lamp : result_.lamps) {
            Rgb sum(0.0);
            for (std::size_t f = 0; f < lamp.emitted.size(); ++f)
                sum += (lamp.emitted[f] + lamp.arriving[f]) * result_.facets[f].area;
            lamp.colour = sum / std::max(max_component(sum), 1e-300);
        }
    }

    void look() {
        const Film& film = scene_.film;
        int k = 1;
        const auto joined = [&](int n) { return (n + k - 1) / k; };
        while (static_cast<std::size_t>(joined(film.crop_width)) * joined(film.crop_height) > settings_.pixels) ++k;
        result_.factor = k;
        result_.width = joined(film.crop_width);
        result_.height = joined(film.crop_height);
        const auto pixels = static_cast<std::size_t>(result_.width) * result_.height;
        const std::size_t sky = scene_.geometry.shapes().size();
        std::vector<Rgb>* background = nullptr;
        if (scene_.emitters.has_environment() && scene_.emitters.powers()[sky] > 0.0) {
            background = &result_.lamps[lamp_of_[sky]].background;
            background->assign(pixels, Rgb(0.0));
        }
        std::vector<std::map<std::uint32_t, double>> rows(pixels);
        const SobolPoints points(settings_.camera_rays);
        oneapi::tbb::parallel_for(0, result_.height, [&](int row) {
            for (int column = 0; column < result_.width; ++column) {
                const auto pixel = static_cast<std::uint32_t>(row * result_.width + column);
                Sampler sampler(points, settings_.seed ^ stream_of_camera, pixel);
                for (std::uint32_t s = 0; s < settings_.camera_rays; ++s) {
                    sampler.start(s);
                    const Vec2 u = sampler.next2();
                    const int left = column * k, top = row * k, right = std::min(left + k, film.crop_width),
                              bottom = std::min(top + k, film.crop_height);
                    const int x = left + static_cast<int>(u.x * (right - left)), y = top + static_cast<int>(u.y * (bottom - top));
                    see(sample_camera(scene_, film.crop_x + x, film.crop_y + y, sampler), rows[pixel],
                        background ? &(*background)[pixel] : nullptr);
                }
            }
        });
        result_.camera.first.push_back(0);
        for (const auto& row : rows) {
            for (const auto& [facet, weight] : row) {
                result_.camera.facet.push_back(facet);
                result_.camera.weight.push_back(weight);
            }
            result_.camera.first.push_back(static_cast<std::uint32_t>(result_.camera.facet.size()));
        }
    }

    void see(const CameraSample& camera, std::map<std::uint32_t, double>& row, Rgb* background) const {
        const double part = camera.weight / settings_.camera_rays;
        const Vec3& w = camera.ray.direction;
        SurfacePoint x;
        std::uint64_t cast = 0;
        const bool meets = scene_.geometry.first_hit(camera.ray.origin, w, camera.ray.length, x) &&
                           (!scene_.hide_emitters || pass_lights(scene_.emitters, scene_.geometry, w, x, cast));
        if (!meets) {
            x.shape = SurfacePoint::infinity;
            if (background && !scene_.hide_emitters) *background += scene_.emitters.emitted(x, -w) * part;
            return;
        }
        const PatchSpace::Reading reading = space_.read(x, -w);
        for (std::size_t i = 0; i < reading.unknown.size(); ++i)
            if (reading.weight[i] != 0.0 && reading.unknown[i] < result_.facets.size())
                row[reading.unknown[i]] += reading.weight[i] * part;
    }

    const Scene& scene_;
    const SeparatingSettings settings_;
    const PatchSpace space_;  // of diffuse sides: an unknown is a facet
    const RayTable table_;
    std::map<const Bsdf*, std::uint32_t> number_of_;
    std::vector<std::size_t> lamp_of_;
    SeparatedScene result_;
};

}  // namespace

SeparatedScene separate(const Scene& scene, const SeparatingSettings& settings, const Watch& watch) {
    expect_diffuse(scene);
    check_camera(scene);
    return Separation(scene, settings, watch).result();
}

std::vector<std::vector<Rgb>> pictures_of_series(const SeparatedScene& scene, int bounces) {
    const std::size_t n = scene.facets.size();
    const auto picture = [&](const std::vector<Rgb>& field) {
        std::vector<Rgb> result(scene.camera.first.size() - 1, Rgb(0.0));
        for (std::size_t p = 0; p < result.size(); ++p)
            for (std::uint32_t e = scene.camera.first[p]; e < scene.camera.first[p + 1]; ++e)
                result[p] += field[scene.camera.facet[e]] * scene.camera.weight[e];
        return result;
    };
    std::vector<Rgb> field(n, Rgb(0.0)), arriving(n, Rgb(0.0));
    for (const SeparatedScene::Lamp& lamp : scene.lamps)
        for (std::size_t f = 0; f < n; ++f) {
            field[f] += lamp.emitted[f];
            arriving[f] += lamp.arriving[f];
        }
    std::vector<std::vector<Rgb>> pictures{picture(field)};
    for (const SeparatedScene::Lamp& lamp : scene.lamps)
        for (std::size_t p = 0; p < lamp.background.size(); ++p) pictures[0][p] += lamp.background[p];
    for (int i = 1; i <= bounces; ++i) {
        if (i > 1)
            for (std::size_t f = 0; f < n; ++f) {
                Rgb sum(0.0);
                for (std::uint32_t r = 0; r < scene.rays; ++r)
                    if (const std::uint32_t g = scene.seen[f * scene.rays + r]; g < n) sum += field[g];
                arriving[f] = sum / static_cast<double>(scene.rays);
            }
        for (std::size_t f = 0; f < n; ++f) field[f] = scene.facets[f].reflectance * arriving[f];
        pictures.push_back(picture(field));
    }
    return pictures;
}

}  // namespace neumann
