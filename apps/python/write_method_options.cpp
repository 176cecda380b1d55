// Prints neumann/_method_options.py: a class for each method with its options, and the keywords of all options, with their types
// and their help.
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/method_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace neumann {

namespace {

std::string type_of(const MethodOption& o) {
    if (!o.words.empty()) return fmt::format("Literal[\"{}\"]", fmt::join(o.words, "\", \""));
    switch (o.kind) {
        case MethodOption::Kind::text:
            return "Text";
        case MethodOption::Kind::number:
            return "int";
        case MethodOption::Kind::flag:
            return "bool";
    }
    return "";
}

std::string class_of(std::string name) {
    name[0] = static_cast<char>(std::toupper(name[0]));
    return name;
}

std::string keyword(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
}

void print_option(const MethodOption& o, const char* value) {
    fmt::print("    {}: Optional[{}]{}\n    \"\"\"{}\"\"\"\n", keyword(o.name), type_of(o), value, o.help);
}

void print_class(const Method& method) {
    fmt::print("\n\n@dataclass(frozen=True, repr=False)\nclass {}(Method):\n    \"\"\"{}\"\"\"\n\n", class_of(name_of(method)),
               help_of(method));
    fmt::print("    name: ClassVar[str] = \"{}\"\n", name_of(method));
    for (const MethodOption& o : method_options())
        if (o.belongs_to(method)) print_option(o, " = None");
}

void print() {
    fmt::print(R"("""The options of the methods. Made from operators/render/methods/method_options.h when neumann is built."""

from dataclasses import dataclass
from typing import ClassVar, Literal, Optional, Sequence, TypedDict, Union

from ._method import Method

Text = Union[str, float, Sequence[int]]  # "none", 0.9, (8, 8)


class MethodOptions(TypedDict, total=False):
    """What belongs to a method, and is checked against it."""

    method: Optional[Union[str, Method]]
    """{}"""
)",
               method_help());
    for (const MethodOption& o : method_options()) print_option(o, "");
    for (const Method& method : all_methods()) print_class(method);
    fmt::print("\n\nHELP = {{\n    \"method\": \"{}\",\n", method_help());
    for (const MethodOption& o : method_options()) fmt::print("    \"{}\": \"{}\",\n", keyword(o.name), o.help);
    fmt::print("}}\n");
}

}  // namespace

}  // namespace neumann

int main() { neumann::print(); }
