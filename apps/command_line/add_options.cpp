#include "apps/command_line/add_options.h"

#include <string_view>

namespace neumann {

CLI::Option& add_option(CLI::App& command, const OptionWords& o, Given& given) {
    using Texts = std::vector<std::string>;
    const auto take = [&given, name = o.name](const Texts& texts) { given.emplace_back(name, texts); };
    if (o.kind == OptionWords::Kind::flag)
        return *command.add_flag_callback(
            o.spelled(), [take] { take({"true"}); }, o.help);
    CLI::Option* added = nullptr;
    if (o.kind == OptionWords::Kind::one) {
        added = command.add_option_function<std::string>(
            o.spelled(), [take](const std::string& text) { take({text}); }, o.help);
        if (o.bare) added->expected(0, 1)->default_str(*o.bare);
    } else {
        added = command.add_option_function<Texts>(o.spelled(), take, o.help);
        if (!o.stands_alone && !o.comma) added->allow_extra_args(false)->take_all();
        if (o.comma) added->delimiter(o.comma);
        if (o.count.second > 0) added->expected(o.count.first, o.count.second);
    }
    if (!o.type.empty() || o.stands_alone) added->type_name(o.type);
    return *added->required(o.is_required);
}

std::vector<std::string> joined_arguments(int argc, char** argv) {
    std::vector<std::string> joined;
    for (int i = 1; i < argc; ++i) {
        const std::string_view text = argv[i];
        // A text that is not a port is the scene.
        if (!joined.empty() && joined.back() == "--live")
            joined.back() += !text.empty() && text.find_first_not_of("0123456789") == text.npos ? "" : "=0";
        const bool petsc = !joined.empty() && joined.back() == "--petsc" && text.size() > 2 && text[0] == '-' && text[1] != '-' &&
                           !text.starts_with("-D") && text.find_first_of("_ ") != text.npos;
        if (petsc)
            joined.back() += "=" + std::string(text);
        else
            joined.emplace_back(text);
    }
    return joined;
}

}  // namespace neumann
