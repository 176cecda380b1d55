// Methods read from text and written as text.
#include "operators/render/methods/method_options.h"

#include "core/base/error.h"
#include "operators/render/methods/method_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace neumann {

namespace {

std::string listed(const std::vector<std::string>& names) {
    if (names.size() == 1) return names.front();
    return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

}  // namespace

Method make_method(const MethodText& text) {
    if (text.name.empty()) {
        const Method open = method::Auto{};
        const bool enough = std::all_of(text.options.begin(), text.options.end(), [&](const auto& given) {
            const auto all = method_options();
            return std::any_of(all.begin(), all.end(),
                               [&](const MethodOption& o) { return o.name == given.first && o.belongs_to(open); });
        });
        return make_method({enough ? name_of(open) : method::Walk::name, text.options});
    }
    const auto is_it = [&](const Method& method) { return name_of(method) == text.name; };
    const auto found = std::find_if(all_methods().begin(), all_methods().end(), is_it);
    if (found == all_methods().end()) throw OptionError("method", ": " + wrong_method(text.name));
    Method method = *found;
    bool lights = false;
    for (const auto& [name, value] : text.options) {
        const auto all = method_options();
        const auto o =
            std::find_if(all.begin(), all.end(), [&, &n = name](const MethodOption& option) { return option.name == n; });
        if (o == all.end())
            throw InputError(fmt::format("'{}' is not an option of a method, such as direct, lights or roulette", name));
        if (!o->belongs_to(method)) {
            std::vector<std::string> owners;
            for (const Method& m : all_methods())
                if (o->belongs_to(m)) owners.push_back(name_of(m));
            throw OptionError(name, fmt::format(" belongs to {}, not to {}", listed(owners), text.name));
        }
        if (const std::string wrong = o->wrong(value); !wrong.empty()) throw OptionError(name, ": " + wrong);
        o->read(method, value);
        lights = lights || name == "lights";
    }
    expect_sense(method, lights);
    return method;
}

Method read_method(const std::string& word) {
    MethodText text;
    std::istringstream parts(word);
    std::string part;
    std::getline(parts, text.name, ':');
    while (std::getline(parts, part, ':')) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos)
            throw InputError(fmt::format("{}: '{}' is no option, expected NAME=VALUE as in direct=bsdf", word, part));
        text.options.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    }
    try {
        return make_method(text);
    } catch (const InputError& e) {
        throw InputError(fmt::format("{}: {}", word, e.what()));
    }
}

MethodText text_of(const Method& method) {
    MethodText text{name_of(method)};
    for (const MethodOption& o : method_options())
        if (const std::string value = o.text(method); !value.empty()) text.options.emplace_back(o.name, value);
    return text;
}

MethodText differences_of(const Method& method) {
    const MethodText usual = text_of(make_method({name_of(method), {}}));
    MethodText text = text_of(method);
    std::erase_if(text.options, [&](const auto& option) {
        return std::find(usual.options.begin(), usual.options.end(), option) != usual.options.end();
    });
    return text;
}

}  // namespace neumann
