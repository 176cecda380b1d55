// Tables for papers: LaTeX with the package booktabs.
#pragma once

#include <string>
#include <vector>

namespace neumann {

// A number with its standard error in units of its last digit, as LaTeX: 0.1234(56) is $0.1234(56)$. The error has the
// two digits of which the first three begin with 100 to 354, or else one, by the rule of the Particle Data Group (Review
// of Particle Physics, section 5.3). A number without error has `digits` digits; an infinite error is ∞.
std::string latex_with_error(double value, double standard_error, int digits = 6);
std::string latex_number(double value, int digits);

// Text, with what it may hold that is no ASCII: − × ± ≤ ∞ … and letters.
std::string latex_text(const std::string& text);

// Rows of LaTeX below a head. `columns`: "lrr".
std::string latex_table(const std::string& columns, const std::vector<std::string>& head,
                        const std::vector<std::vector<std::string>>& rows, const std::string& comment);

}  // namespace neumann
