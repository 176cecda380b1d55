// index.html of a study.
#include "apps/commands/study_data.h"
#include "apps/pages/page.h"

namespace neumann {

std::string study_page(const nlohmann::ordered_json& study) { return page("study.html", {for_script(study)}); }

}  // namespace neumann
