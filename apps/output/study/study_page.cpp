// index.html of a study.
#include "apps/output/files/packed_pictures.h"
#include "apps/output/pages/page.h"
#include "apps/output/study/study_data.h"
#include "core/image/display.h"

#include <fmt/format.h>

#include <deque>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// The reference, and then the pictures of the methods with their error maps as errors.
PackedSeries packed(const ComparedCrop& crop) {
    PackedSeries series(crop.place.width, crop.place.height, 1 + crop.methods.size());
    series.add_term(0, Estimate{crop.reference.mean, {}});
    for (std::size_t m = 0; m < crop.methods.size(); ++m)
        series.add_term(1 + m, Estimate{crop.methods[m].picture, crop.methods[m].errors});
    series.pack();
    return series;
}

}  // namespace

std::string study_page(const StudyData& data, const Json& study) {
    std::deque<std::string> parts;
    Json pictures = {{"exposure", exposure_for(data.reference.pictures[data.sum()].mean, data.reference.pictures.front().mean)}};
    const auto add = [&](const std::string& name, const PackedSeries& series) {
        Json head = series.head();
        head["heads"] = Json::array();
        for (const PackedPicture& picture : series.pictures()) {
            parts.push_back(
                fmt::format("<script type=\"text/plain\" id=\"{}-{}\">{}</script>\n", name, head["heads"].size(), picture.bytes));
            head["heads"].push_back(picture.head);
        }
        return head;
    };
    const Image& whole = data.reference.pictures[data.sum()].mean;
    PackedSeries overview(whole.width, whole.height, 1);
    overview.add_term(0, Estimate{whole, {}});
    overview.pack();
    pictures["whole"] = add("whole", overview);
    pictures["crops"] = Json::array();
    for (const ComparedCrop& crop : data.crops)
        pictures["crops"].push_back(add(fmt::format("crop-{}", pictures["crops"].size()), packed(crop)));
    parts.push_front(
        fmt::format("<script id=\"study\" type=\"application/json\">{}</script>\n"
                    "<script id=\"pictures\" type=\"application/json\">{}</script>\n",
                    for_script(study), for_script(pictures)));
    return page("study.html", {parts.begin(), parts.end()});
}

}  // namespace neumann
