// Reads the values of attributes. The whole text must be the value; every function throws InputError at the attribute otherwise.
#pragma once

#include "core/base/vec.h"
#include "core/reader/xml/element.h"

#include <cstdint>

namespace neumann::reader {

double parse_number(const Attribute& a);  // finite
std::int64_t parse_integer(const Attribute& a);
bool parse_boolean(const Attribute& a);
// The parts of a text between blanks or commas.
std::vector<std::string> split(const std::string& text);
std::vector<double> parse_numbers(const Attribute& a);
Vec3 parse_triple(const Attribute& a);

// The attributes x, y and z, with `missing` for those not given; or `value` with one number or three.
Vec3 parse_xyz(const Element& e, double missing);

}  // namespace neumann::reader
