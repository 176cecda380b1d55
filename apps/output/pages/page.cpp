#include "apps/output/pages/page.h"
#include "apps/output/files/json_text.h"

namespace neumann {

std::string page(std::string_view name, const std::vector<std::string_view>& data) {
    constexpr std::string_view begin = "/*include ", end = "*/", data_mark = "/*data*/";
    const std::string_view text = embedded_file(name);
    std::string out;
    std::size_t size = std::size_t{1} << 19;
    for (const std::string_view part : data) size += part.size();
    out.reserve(size);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t mark = text.find("/*", at);
        out += text.substr(at, mark - at);
        if (mark == std::string_view::npos) break;
        const std::string_view rest = text.substr(mark);
        if (rest.starts_with(begin)) {
            const std::size_t length = rest.find(end);
            out += embedded_file(rest.substr(begin.size(), length - begin.size()));
            at = mark + length + end.size();
        } else if (rest.starts_with(data_mark)) {
            for (const std::string_view part : data) out += part;
            at = mark + data_mark.size();
        } else {
            out += "/*";
            at = mark + 2;
        }
    }
    return out;
}

// A "<" could end the script element or begin a comment. In JSON it only occurs in strings, so it can be escaped.
std::string for_script(const nlohmann::ordered_json& json) {
    std::string text = json_text(json);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    return text;
}

}  // namespace neumann
