#include "apps/output/pages/paths_json.h"

#include "apps/output/files/health_json.h"
#include "apps/output/files/json_number.h"
#include "apps/output/files/replay_json.h"
#include "core/base/error.h"
#include "core/geometry/outline.h"
#include "core/scene/floor_plan.h"
#include "core/scene/seen_segment.h"
#include "operators/paths/walk/path_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t lines_of_outline = 4000, largest_of_pixel = 6, first_of_pixel = 4;

// Six digits are enough for drawings and tables.
Json shortened(double x) { return json_number(std::isfinite(x) ? std::stod(fmt::format("{:.6g}", x)) : x); }
Json shortened(const Json& json) {
    if (json.is_number_float()) return shortened(json.get<double>());
    Json short_one = json;
    for (Json& part : short_one)
        if (part.is_structured() || part.is_number_float()) part = shortened(part);
    return short_one;
}

const char* kind_of(PathStep::Kind kind) {
    switch (kind) {
        case PathStep::Kind::first:
            return "first";
        case PathStep::Kind::goes_on:
            return "goes on";
        case PathStep::Kind::record:
            return "record";
        case PathStep::Kind::shadow_ray:
            return "asks";
    }
    return "";
}

class Drawing {
public:
    Drawing(const Scene& scene, Pixel pixel)
        : scene_(scene),
          plan_(scene.camera.options()),
          sensor_(scene.camera.ray({pixel.x + 0.5, pixel.y + 0.5}).sensor),
          far_(4.0 * scene.geometry.radius()) {}

    Json line_from_above(const Vec3& a, const Vec3& b) const {
        const Vec2 from = plan_.at(a), to = plan_.at(b);
        return {from.x, from.y, to.x, to.y};
    }

    // A ray as replay reports it, with its position on the film and from above.
    Json ray(const ReplayedStep& s) const {
        const PathStep& step = s.step;
        const bool leaves = step.to.is_infinite() || (!step.found && step.kind != PathStep::Kind::shadow_ray);
        const Vec3 from = step.from.position, to = leaves ? from + step.w * far_ : step.to.position;
        Json json = as_json(s, scene_);
        json["kind"] = kind_of(step.kind);
        json["of_light"] = step.from_light;
        json["leaves"] = leaves;
        if (!is_finite(from) || !is_finite(to)) return json;
        json["above"] = line_from_above(from, to);
        // The ray from the camera is a point in the picture.
        if (step.kind == PathStep::Kind::first && !step.from_light) return json;
        json["film"] = Json::array();
        const Film& film = scene_.film;
        for (const auto& [a, b, hidden] : seen_pieces(scene_, from, to, sensor_))
            json["film"].push_back({a.x - film.crop_x, a.y - film.crop_y, b.x - film.crop_x, b.y - film.crop_y, hidden ? 1 : 0});
        return json;
    }

    Json outline() const {
        Json lines = Json::array();
        for (const Segment& s : neumann::outline(scene_.geometry.shapes(), plan_.from_above, lines_of_outline))
            lines.push_back(line_from_above(s.from, s.to));
        return lines;
    }
    std::string seen_along() const {
        for (int c = 0; c < 3; ++c)
            if (plan_.from_above[c] != 0.0) return fmt::format("{}{}", plan_.from_above[c] < 0.0 ? "−" : "+", "xyz"[c]);
        return "";
    }

private:
    const Scene& scene_;
    FloorPlan plan_;
    std::uint32_t sensor_;
    double far_;  // length to which rays that leave the scene are drawn
};

// For each number of samples and each bounce: red, green, blue, and their standard errors.
Json history_json(const PixelHistory& history) {
    Json json = {{"samples", Json::array()}, {"interval_factor", Json::array()}, {"terms", Json::array()}, {"sums", Json::array()}};
    const auto means_json = [](const std::vector<PixelHistory::Mean>& means) {
        Json all = Json::array();
        for (const auto& [mean, error] : means) all.push_back({mean.r, mean.g, mean.b, error.r, error.g, error.b});
        return all;
    };
    for (const PixelHistory::Point& point : history.points) {
        json["samples"].push_back(point.samples);
        json["interval_factor"].push_back(json_number(point.interval_factor));
        json["terms"].push_back(means_json(point.terms));
        json["sums"].push_back(means_json(point.sums));
    }
    return json;
}

// The samples of a pixel that are shown, with the reason why.
std::map<std::uint64_t, std::string> shown_samples(const RecordedRun& run, const SampleLayout& layout, std::uint32_t pixel,
                                                   const PixelHistory* history, std::uint64_t first) {
    std::map<std::uint64_t, std::string> shown;
    if (history)
        for (const std::size_t i : history->largest(largest_of_pixel)) shown[first + i] = "among the largest";
    const std::uint64_t count = history ? history->count() : run.samples / run.render.replicate_size * layout.size(pixel);
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(first_of_pixel, count); ++i)
        shown.emplace(first + i, fmt::format("number {} of the pixel", i + 1));
    return shown;
}

Json pixel_json(const RecordedRun& run, const Scene& scene, RecordedSamplers& samplers, std::uint32_t number,
                const std::map<std::uint64_t, std::string>& named) {
    const Pixel pixel = pixel_of(scene.film, number);
    const Drawing drawing(scene, pixel);
    const std::vector<ReplicatesOf> replicates = samplers.replicates();
    const PictureSampler& sampler = replicates.front().sampler;
    if (sampler.layout().size(number) == 0)
        throw OptionError("paths", fmt::format("{},{}: no samples were taken of this pixel", pixel.x, pixel.y));
    Json json = {{"pixel", {pixel.x, pixel.y}}, {"picture", {pixel.x - scene.film.crop_x, pixel.y - scene.film.crop_y}}};
    std::optional<PixelHistory> history;
    if (const std::string why = sampler.settings().method->why_no_history(); why.empty()) {
        history = history_of_pixel(replicates, number);
        json["history"] = history_json(*history);
    } else {
        json["why_no_history"] = why;
    }
    const std::uint64_t first = run.merged.empty() ? run.first / run.render.replicate_size * sampler.layout().size(number) : 0;
    auto shown = shown_samples(run, sampler.layout(), number, history ? &*history : nullptr, first);
    for (const auto& [sample, why] : named) shown[sample] = why;
    if (history) json["count"] = history->count();
    json["paths"] = Json::array();
    for (const auto& [sample, why] : shown) {
        const auto [samples, name] = samplers.find({number, sample});
        const Replay replayed = samples.replay(name);
        Json path = {{"sample", sample}, {"why", why}};
        if (history) path["part"] = history->part(sample - first);
        if (sampler.path_sampler().parts() > 0) path["method"] = sampler.path_sampler().part_of(name).method;
        path["terms"] = Json::array();
        for (const Rgb& term : replayed.terms) path["terms"].push_back(as_json(term));
        path["rays"] = Json::array();
        for (const ReplayedStep& step : replayed.steps) path["rays"].push_back(drawing.ray(step));
        json["paths"].push_back(std::move(path));
    }
    return json;
}

}  // namespace

Json paths_json(const RecordedRun& run, const Scene& scene, const ChosenPixels& chosen) {
    std::vector<std::uint32_t> order;
    std::map<std::uint32_t, std::map<std::uint64_t, std::string>> named;
    const auto add = [&](std::uint32_t number) {
        if (std::ranges::find(order, number) == order.end()) order.push_back(number);
    };
    for (const Vec2& p : chosen.pixels) add(pixel_number(scene.film, static_cast<int>(p.x), static_cast<int>(p.y), "--paths"));
    if (chosen.named)
        for (const auto& [name, why] : reported_samples(run, scene.film)) {
            add(name.pixel);
            named[name.pixel][name.sample] = why;
        }
    RecordedSamplers samplers(scene, run);
    const Drawing plan(scene, pixel_of(scene.film, 0));
    Json json = {{"seen_along", plan.seen_along()}, {"outline", plan.outline()}, {"pixels", Json::array()}};
    for (const std::uint32_t number : order) json["pixels"].push_back(pixel_json(run, scene, samplers, number, named[number]));
    return shortened(json);
}

}  // namespace neumann
