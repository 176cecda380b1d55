#include "apps/output/files/ways_files.h"

#include "apps/output/files/rendered_picture.h"
#include "apps/output/sheets/contact_sheet.h"
#include "core/image/in_file.h"

#include <fmt/format.h>

#include <deque>

namespace neumann {

namespace {

std::string file_of(const Way& way, bool weighted) {
    return fmt::format("way_s{}_t{}{}.exr", way.s, way.t, weighted ? "" : "_unweighted");
}

std::string label_of(const Way& way) { return fmt::format("s = {}, t = {}", way.s, way.t); }

void write_sheet(OutputFolder& folder, int bounce, const std::vector<LabelledPicture>& weighted,
                 const std::vector<LabelledPicture>& unweighted) {
    Image sum = *weighted.front().picture;
    for (std::size_t i = 1; i < weighted.size(); ++i)
        for (std::size_t k = 0; k < sum.pixels.size(); ++k) sum.pixels[k] += weighted[i].picture->pixels[k];
    folder.write("ways.png", contact_sheet(weighted, unweighted, exposure_for(sum, sum), find_label_font(),
                                           {fmt::format("bounce {} by each way, weighted", bounce), "each by itself, unweighted"}));
}

std::string with_interval(const WayPicture& p) {
    return fmt::format("{:>12.6g}  {:<18}", p.means.all.mean,
                       p.infinite_variance ? "infinite variance" : fmt::format("± {:.2g}", p.means.all.interval()));
}

}  // namespace

void write_ways(OutputFolder& folder, const Ways& ways, const ChosenFiles& files) {
    std::vector<LabelledPicture> weighted, unweighted;
    std::deque<Image> means;
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
            if (files.pictures) folder.write(file_of(way, is_weighted), encode_exr(p.picture, attributes));
            (is_weighted ? weighted : unweighted).push_back({label_of(way), &means.emplace_back(as_in_file(p.picture).mean)});
        }
    if (files.sheets) write_sheet(folder, ways.bounce, weighted, unweighted);
}

void write_sheet_of_ways(OutputFolder& folder, const RenderedFolder& rendered) {
    const auto ways = rendered.run().find("ways");
    if (ways == rendered.run().end()) return;
    std::vector<LabelledPicture> weighted, unweighted;
    std::deque<Image> means;
    for (const auto& of : ways->at("ways")) {
        const Way way{of.at("s"), of.at("t"), {}, {}};
        for (const bool is_weighted : {true, false}) {
            Image& mean = means.emplace_back(rendered.picture(file_of(way, is_weighted)).mean);
            (is_weighted ? weighted : unweighted).push_back({label_of(way), &mean});
        }
    }
    write_sheet(folder, ways->at("bounce"), weighted, unweighted);
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
