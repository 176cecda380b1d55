#include "apps/output/pages/blame_page.h"

#include "apps/output/pages/page.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <deque>

namespace neumann {

PackedSeries packed_pictures(const Blame& found) {
    const std::vector<TermVerdict>& terms = found.terms;
    PackedSeries packed(terms.front().z.width, terms.front().z.height, 3 * terms.size());
    oneapi::tbb::parallel_for(std::size_t{0}, terms.size(), [&](std::size_t i) {
        packed.add_term(3 * i, Estimate{terms[i].theirs.mean, {}});
        packed.add_term(3 * i + 1, Estimate{terms[i].ours.mean, {}});
        packed.add_term(3 * i + 2, terms[i].difference);
    });
    packed.pack();
    return packed;
}

std::string blame_page(const PackedSeries& pictures, nlohmann::ordered_json data) {
    std::deque<std::string> tags;
    std::vector<std::string_view> parts;
    data["packed"] = pictures.head();
    for (const PackedPicture& picture : pictures.pictures()) {
        parts.push_back(
            tags.emplace_back(fmt::format("<script type=\"text/plain\" id=\"picture-{}\">", data["packed"]["heads"].size())));
        parts.push_back(picture.bytes);
        parts.push_back("</script>\n");
        data["packed"]["heads"].push_back(picture.head);
    }
    const std::string json = fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", for_script(data));
    parts.insert(parts.begin(), json);
    return page("blame.html", parts);
}

}  // namespace neumann
