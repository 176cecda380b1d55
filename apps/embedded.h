// Files that are part of the program; see embed.cmake.
#pragma once

#include <string_view>

namespace neumann::embedded {

std::string_view study_page_template();
std::string_view chart_js();

}  // namespace neumann::embedded
