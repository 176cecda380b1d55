#include "apps/command_line/add_method_options.h"

#include <CLI/CLI.hpp>

namespace neumann {

void add_method_options(CLI::App& command, MethodText& method) {
    command.add_option("--method", method.name, method_help())->type_name("NAME")->check(wrong_method);
    for (const MethodOption& o : method_options()) {
        const auto take = [&method, name = o.name](const std::string& text) { method.options.emplace_back(name, text); };
        if (o.kind == MethodOption::Kind::flag) {
            command.add_flag_callback(
                "--" + o.name, [take] { take("true"); }, o.help);
            continue;
        }
        command.add_option_function<std::string>("--" + o.name, take, o.help)->type_name(o.type)->check(o.wrong);
    }
}

}  // namespace neumann
