// Entries of the table of options, made from the members of methods that hold their values.
#pragma once

#include "core/base/form.h"
#include "operators/render/methods/method_options.h"

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace neumann {

// Makes an option. `get` reads its value from a method, or an optional one; a method has the option if it can be passed to `get`.
// `set` writes the value.
template <class Get, class Set, class Value>
MethodOption option(std::string name, std::string type, std::string help, Get get, Set set, Form<Value> form) {
    const auto print = [form]<class Held>(const Held& held) -> std::string {
        if constexpr (std::is_same_v<Held, std::optional<Value>>)
            return held ? form.print(*held) : "";
        else
            return form.print(held);
    };
    MethodOption o;
    o.kind = MethodOption::Kind::text;
    o.name = std::move(name);
    o.type = std::move(type);
    o.help = std::move(help);
    o.wrong = [form](const std::string& text) { return form.read(text) ? "" : form.wrong(text); };
    o.belongs_to = [](const Method& method) {
        return std::visit([]<class M>(const M&) { return std::is_invocable_v<Get, const M&>; }, method);
    };
    o.read = [=](Method& method, const std::string& text) {
        std::visit(
            [&]<class M>(M& m) {
                if constexpr (std::is_invocable_v<Get, const M&>) set(m, *form.read(text));
            },
            method);
    };
    o.text = [=](const Method& method) {
        return std::visit(
            [&]<class M>(const M& m) -> std::string {
                if constexpr (std::is_invocable_v<Get, const M&>)
                    return print(get(m));
                else
                    return "";
            },
            method);
    };
    return o;
}

template <class Value, class Get, class Set>
MethodOption choice(std::string option_name, std::string type, std::string help, const Named<Value>& all, Get get, Set set) {
    MethodOption o = option(std::move(option_name), std::move(type), std::move(help), get, set, one_of_named(all));
    o.words = names(all);
    return o;
}

template <class Get, class Set>
MethodOption flag(std::string name, std::string help, Get get, Set set) {
    MethodOption o = option(std::move(name), "", std::move(help), get, set, yes_or_no());
    o.kind = MethodOption::Kind::flag;
    return o;
}

template <class Number, class Get, class Set>
MethodOption whole(std::string name, std::string type, std::string help, std::uint64_t low, std::uint64_t high, Get get, Set set) {
    MethodOption o = option(std::move(name), std::move(type), std::move(help), get, set, whole_from<Number>(low, high));
    o.kind = MethodOption::Kind::number;
    return o;
}

}  // namespace neumann
