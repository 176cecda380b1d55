// Prints neumann/_method_options.py: the keywords of a method's options with their types and their help.
#include "operators/methods/method_options.h"

#include <fmt/format.h>

namespace neumann {

namespace {

const char* type_of(MethodOption::Kind kind) {
    switch (kind) {
        case MethodOption::Kind::text:
            return "Text";
        case MethodOption::Kind::number:
            return "int";
        case MethodOption::Kind::flag:
            return "bool";
    }
    return "";
}

void print() {
    fmt::print(R"("""The options of the methods. Made from operators/methods/method_options.cpp when neumann is built."""

from typing import Optional, Sequence, TypedDict, Union

Text = Union[str, float, Sequence[int]]  # "none", 0.9, (8, 8)


class MethodOptions(TypedDict, total=False):
    """What belongs to a method, and is checked against it."""

    method: Optional[str]
    """{}"""
)",
               method_help());
    for (const MethodOption& o : method_options())
        fmt::print("    {}: Optional[{}]\n    \"\"\"{}\"\"\"\n", o.name, type_of(o.kind), o.help);
    fmt::print("\n\nHELP = {{\n    \"method\": \"{}\",\n", method_help());
    for (const MethodOption& o : method_options()) fmt::print("    \"{}\": \"{}\",\n", o.name, o.help);
    fmt::print("}}\n");
}

}  // namespace

}  // namespace neumann

int main() { neumann::print(); }
