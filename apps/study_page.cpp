// index.html: the template with Chart.js and the study's figures put into it, so that it needs no other file.
#include "apps/embedded.h"
#include "apps/study_data.h"

namespace neumann {

namespace {

void put(std::string& page, const std::string& mark, std::string_view text) {
    const std::size_t at = page.find(mark);
    page.replace(at, mark.size(), text);
}

// Within a script element no "</" may stand; in JSON it is inside of a string.
std::string for_script(std::string json) {
    for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3) json.replace(at, 2, "<\\/");
    return json;
}

}  // namespace

std::string study_page(const nlohmann::ordered_json& study) {
    std::string page(embedded::study_page_template());
    put(page, "/*CHART_JS*/", embedded::chart_js());
    put(page, "/*STUDY*/", for_script(study.dump()));
    return page;
}

}  // namespace neumann
