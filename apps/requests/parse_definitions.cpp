#include "apps/requests/parse_definitions.h"

#include "core/base/error.h"

namespace neumann {

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts) {
    std::map<std::string, std::string> definitions;
    for (const std::string& text : texts) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) throw InputError("-D " + text + ": expected name=value");
        if (!definitions.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
            throw InputError("-D " + text + ": '" + text.substr(0, equals) + "' is given twice");
    }
    return definitions;
}

}  // namespace neumann
