// Reads the texts of COLLADA's elements: numbers between blanks. All functions throw InputError at the word that is wrong.
#pragma once

#include "core/base/vec.h"
#include "core/reader/xml/element.h"

#include <cstdint>
#include <string>
#include <vector>

namespace neumann::reader::collada {

// The text without the blanks around it.
std::string trimmed_text(const Element& e);

std::vector<double> read_numbers(const Element& e);  // all finite
std::vector<double> read_numbers(const Element& e, std::size_t expected);
double read_number(const Element& e);
// The numbers are not negative and below 2³².
std::vector<std::uint32_t> read_indices(const Element& e);
// A colour of three numbers, or of four of which the last is alpha; none of the three may be negative.
struct Color {
    Rgb rgb{0.0};
    double alpha = 1.0;
};
Color read_color(const Element& e);

// The error "<float_array> has 11 numbers, expected 12", at the element.
InputError wrong_count(const Element& e, std::size_t found, const std::string& expected);

// Reads an attribute that is a whole number and not negative.
std::size_t read_count(const Attribute& a);

}  // namespace neumann::reader::collada
