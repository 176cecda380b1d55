#include "apps/output/pages/explorer_page.h"

#include "apps/output/pages/page.h"
#include "operators/statistics/decay_fit.h"

#include <fmt/format.h>
#include <cmath>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

double number_or(const Json& json, const char* key, double otherwise) {
    const auto found = json.find(key);
    return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
}

Json decay(const Json& run) {
    std::vector<MeanWithError> bounces;
    for (const Json& b : run.at("bounces")) bounces.push_back({number_or(b, "mean", 0.0), number_or(b, "stderr", 0.0)});
    const auto fit = fit_decay(bounces);
    if (!fit) return nullptr;
    return {{"ratio", fit->ratio}, {"log_at_0", fit->log_at_0}, {"first", fit->first}, {"last", fit->last}};
}

}  // namespace

std::string explorer_data(const std::vector<const ExploredRun*>& runs, const Json& comparison) {
    Json all = {{"runs", Json::array()}, {"comparison", comparison}};
    std::string pictures;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const ExploredRun& run = *runs[r];
        Json heads = Json::array();
        for (const PackedPicture& picture : run.pictures.pictures()) {
            pictures += fmt::format("<script type=\"text/plain\" id=\"picture-{}-{}\">", r, heads.size());
            pictures += picture.bytes;
            pictures += "</script>\n";
            heads.push_back(picture.head);
        }
        Json packed = run.pictures.head();
        packed["exposure"] = run.exposure;
        packed["has_rest"] = run.has_rest;
        packed["heads"] = heads;
        all["runs"].push_back(
            {{"run", run.run}, {"convergence", run.convergence}, {"decay", decay(run.run)}, {"pictures", packed}});
        if (!run.paths.is_null()) all["runs"].back()["paths"] = run.paths;
        if (run.is_under_way) all["is_under_way"] = true;
    }
    return fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", for_script(all)) + pictures;
}

std::string explorer_page(std::string_view data) { return page("explorer.html", {data}); }

std::string explorer_page(const std::vector<const ExploredRun*>& runs, const Json& comparison) {
    return explorer_page(explorer_data(runs, comparison));
}

}  // namespace neumann
