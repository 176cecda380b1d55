#include "apps/requests/chosen_files.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace neumann {

namespace {

constexpr std::array<std::pair<const char*, bool ChosenFiles::*>, 8> groups{{{"pictures", &ChosenFiles::pictures},
                                                                             {"tables", &ChosenFiles::tables},
                                                                             {"sheets", &ChosenFiles::sheets},
                                                                             {"strips", &ChosenFiles::strips},
                                                                             {"page", &ChosenFiles::page},
                                                                             {"layers", &ChosenFiles::layers},
                                                                             {"touch", &ChosenFiles::touch},
                                                                             {"figures", &ChosenFiles::figures}}};

}  // namespace

const std::vector<std::string>& file_groups() {
    static const std::vector<std::string> all = names_of({});
    return all;
}

const std::vector<std::string>& all_file_groups() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const auto& group : groups) names.emplace_back(group.first);
        return names;
    }();
    return all;
}

const std::vector<std::string>& page_file_groups() {
    static const std::vector<std::string> all{"sheets", "strips", "page"};
    return all;
}

ChosenFiles choose_files(const std::vector<std::string>& names, bool white) {
    ChosenFiles files{false, false, false, false, false, false, false, false, white};
    for (const std::string& wanted : names) {
        const auto found = std::ranges::find(groups, wanted, [](const auto& group) { return std::string(group.first); });
        if (found == groups.end())
            throw OptionError("files", fmt::format(": {} not in {{{}}}", wanted, fmt::join(all_file_groups(), ",")));
        files.*(found->second) = true;
    }
    return files;
}

std::vector<std::string> names_of(const ChosenFiles& files) {
    std::vector<std::string> names;
    for (const auto& [name, is_chosen] : groups)
        if (files.*is_chosen) names.emplace_back(name);
    return names;
}

}  // namespace neumann
