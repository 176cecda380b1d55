#include "apps/commands/ways.h"

#include "apps/sheets/contact_sheet.h"
#include "apps/files/rendered_picture.h"

#include <fmt/format.h>

namespace neumann {

namespace {

std::string file_of(const Way& way, bool weighted) {
    return fmt::format("way_s{}_t{}{}.exr", way.s, way.t, weighted ? "" : "_unweighted");
}

std::string with_interval(const WayPicture& p) {
    return fmt::format("{:>12.6g}  {:<18}", p.means.all.mean,
                       p.infinite_variance ? "infinite variance" : fmt::format("± {:.2g}", p.means.all.interval()));
}

}  // namespace

Ways render_ways(const Scene& scene, SamplingSettings settings, int bounce, std::uint64_t samples, const RenderObserver& observer) {
    settings.walk.bounces = bounce;
    settings.walk.rest_probability = 0.0;
    settings.ways_of_last_bounce = true;
    const RenderedSeries series = render_series(scene, settings, {samples, std::nullopt, std::nullopt}, observer);
    const auto result = series.moments.result();
    const auto picture = [&](std::size_t q) {
        const auto tail = tail_index(series.tally.largest[q]);
        return WayPicture{result.term(q), result.means_of_term(q), tail && tail->variance_is_infinite()};
    };
    Ways out{bounce, {}};
    for (int s = 0; s <= bounce + 1; ++s) {
        const auto q = static_cast<std::size_t>(s);
        out.ways.push_back({s, bounce + 2 - s, picture(q), picture(q + static_cast<std::size_t>(bounce) + 2)});
    }
    return out;
}

void write_ways(OutputFolder& folder, const Ways& ways) {
    std::vector<LabelledPicture> weighted, unweighted;
    for (const Way& way : ways.ways)
        for (const bool is_weighted : {true, false}) {
            const WayPicture& p = is_weighted ? way.weighted : way.unweighted;
            Attributes attributes{
                {"neumann:quantity", std::string(is_weighted ? "weighted" : "unweighted")},
                {"neumann:bounce", static_cast<std::int64_t>(ways.bounce)},
                {"neumann:light_vertices", static_cast<std::int64_t>(way.s)},
                {"neumann:camera_vertices", static_cast<std::int64_t>(way.t)},
                {"neumann:degrees_of_freedom", p.picture.degrees_of_freedom},
                {"neumann:variance", std::string(p.infinite_variance ? "infinite: stderr gives no interval" : "finite")},
                {"neumann:pixels", std::string("correlated: their errors go together")}};
            attributes.merge(mean_attributes(p.means));
            folder.write(file_of(way, is_weighted), encode_exr(p.picture, attributes));
            (is_weighted ? weighted : unweighted).push_back({fmt::format("s = {}, t = {}", way.s, way.t), &p.picture.mean});
        }
    Image sum = ways.ways.front().weighted.picture.mean;
    for (std::size_t i = 1; i < ways.ways.size(); ++i)
        for (std::size_t k = 0; k < sum.pixels.size(); ++k) sum.pixels[k] += ways.ways[i].weighted.picture.mean.pixels[k];
    folder.write("ways.png",
                 contact_sheet(weighted, unweighted, exposure_for(sum, sum), find_label_font(),
                               {fmt::format("bounce {} by each way, weighted", ways.bounce), "each by itself, unweighted"}));
}

std::string ways_table(const Ways& ways) {
    std::string text = fmt::format(
        "Bounce {} by its ways, s vertices from the light and t from the camera\n{:>6}{:>4}  {:>12}  {:<18}  {:>12}  {:<18}\n",
        ways.bounce, "s", "t", "weighted", "95% interval", "by itself", "95% interval");
    for (const Way& way : ways.ways)
        text += fmt::format("{:>6}{:>4}  {}  {}\n", way.s, way.t, with_interval(way.weighted), with_interval(way.unweighted));
    return text;
}

nlohmann::ordered_json as_json(const Ways& ways) {
    nlohmann::ordered_json json{{"bounce", ways.bounce}, {"ways", nlohmann::ordered_json::array()}};
    const auto figures = [](const WayPicture& p) {
        nlohmann::ordered_json j{{"mean", p.means.all.mean}};
        if (p.infinite_variance)
            j["interval95"] = "none: the variance is infinite";
        else
            j["interval95"] = p.means.all.interval();
        return j;
    };
    for (const Way& way : ways.ways)
        json["ways"].push_back(
            {{"s", way.s}, {"t", way.t}, {"weighted", figures(way.weighted)}, {"unweighted", figures(way.unweighted)}});
    return json;
}

}  // namespace neumann
