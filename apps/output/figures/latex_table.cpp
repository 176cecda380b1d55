#include "apps/output/figures/latex_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

namespace neumann {

namespace {

// The power of ten of the first digit.
int exponent_of(double x) { return static_cast<int>(std::floor(std::log10(std::abs(x)))); }

// The power of ten of an error's last digit, of its first three digits.
int last_place(double error) {
    const int exponent = exponent_of(error);
    const double digits = std::round(error / std::pow(10.0, exponent - 2));
    return digits < 355.0 ? exponent - 1 : exponent;
}

std::string with_power(const std::string& mantissa, int exponent) {
    return exponent == 0 ? fmt::format("${}$", mantissa) : fmt::format("${}\\times10^{{{}}}$", mantissa, exponent);
}

}  // namespace

std::string latex_number(double value, int digits) {
    if (!std::isfinite(value)) return std::isnan(value) ? "--" : value > 0.0 ? "$\\infty$" : "$-\\infty$";
    if (value == 0.0) return "$0$";
    const std::string text = fmt::format("{:.{}e}", value, digits - 1);  // rounds up to the next power where it has to
    const int exponent = std::stoi(text.substr(text.find('e') + 1));
    if (exponent < -3 || exponent >= std::max(digits, 4)) return with_power(text.substr(0, text.find('e')), exponent);
    return with_power(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent)), 0);
}

std::string latex_with_error(double value, double standard_error, int digits) {
    if (!std::isfinite(value) || standard_error == 0.0) return latex_number(value, digits);
    if (!std::isfinite(standard_error)) return latex_number(value, 2) + "\\,($\\infty$)";
    const int last = last_place(standard_error);
    const auto units = [&](double x) { return std::round(x / std::pow(10.0, last)); };
    const int first = std::max(units(value) == 0.0 ? last : exponent_of(units(value)) + last, last);
    const int exponent = first < -3 || last > 0 ? first : 0;
    return with_power(
        fmt::format("{:.{}f}({:.0f})", value / std::pow(10.0, exponent), std::max(0, exponent - last), units(standard_error)),
        exponent);
}

std::string latex_text(const std::string& text) {
    static const std::map<std::string, std::string> signs{{"\\", "\\textbackslash{}"},
                                                          {"~", "\\textasciitilde{}"},
                                                          {"^", "\\textasciicircum{}"},
                                                          {"<", "$<$"},
                                                          {">", "$>$"},
                                                          {"|", "$|$"},
                                                          {"#", "\\#"},
                                                          {"$", "\\$"},
                                                          {"%", "\\%"},
                                                          {"&", "\\&"},
                                                          {"_", "\\_"},
                                                          {"{", "\\{"},
                                                          {"}", "\\}"},
                                                          {"−", "$-$"},
                                                          {"×", "$\\times$"},
                                                          {"±", "$\\pm$"},
                                                          {"≤", "$\\le$"},
                                                          {"∞", "$\\infty$"},
                                                          {"²", "$^2$"},
                                                          {"…", "\\ldots{}"}};
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t length = 1;
        while (i + length < text.size() && (static_cast<unsigned char>(text[i + length]) & 0xc0u) == 0x80u) ++length;
        const auto sign = signs.find(text.substr(i, length));
        out += sign == signs.end() ? text.substr(i, length) : sign->second;
        i += length;
    }
    return out;
}

std::string latex_table(const std::string& columns, const std::vector<std::string>& head,
                        const std::vector<std::vector<std::string>>& rows, const std::string& comment) {
    std::string tex = fmt::format("% \\usepackage{{booktabs}}\n% {}\n\\begin{{tabular}}{{{}}}\n\\toprule\n{} \\\\\n\\midrule\n",
                                  comment, columns, fmt::join(head, " & "));
    for (const auto& row : rows) tex += fmt::format("{} \\\\\n", fmt::join(row, " & "));
    return tex + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace neumann
